// The command line as plain data, read off its parser: help, the man page and the completions of shells are made of it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slideway::cli {

struct OptionDescription {
    std::vector<std::string> names;  // "-o", "--output"; of a positional its word: "SCENE"
    std::string value;               // word for what it takes: "OUT.nc"; empty for a flag
    std::string meaning;
    bool positional = false, optional = false;  // optional: a positional, or the value of an option, that may be left out
    bool repeats = false;                       // takes several values

    using Style = std::function<std::string(std::string_view)>;
    /// "-o, --output OUT.nc", "--members [A..B]", "SCENE".  @param word, metavariable how names, and what stands for values, are set
    std::string label(Style const& word, Style const& metavariable) const;
};

/// A command line that does something, and what.
struct Example {
    std::string line, meaning;
};

struct CommandDescription {
    std::string name, summary, note;  // note: a sentence below the options; may be empty
    std::vector<OptionDescription> options;
    std::vector<Example> examples;
    /// "slideway run [OPTION]... SCENE"
    std::string synopsis() const;
};

/// All commands, as the parser of the command line has them.
std::vector<CommandDescription> const& command_descriptions();

/// What `slideway help COMMAND` prints, in lines of at most `width` columns.
std::string help_text(CommandDescription const& command, std::size_t width);
/// What `slideway help` prints.
std::string help_text(std::vector<CommandDescription> const& commands, std::size_t width);

/// slideway.1: all commands, keys of a scene, exit codes, files, environment, examples.
std::string man_page(std::vector<CommandDescription> const& commands);

/// Shells that completions are written for.
inline constexpr char const* shell_names[] = {"bash", "zsh", "fish"};
/// The script that teaches a shell the command line, keys for --set included; it asks the program for `candidates`.  @throws SceneError for another shell
std::string completion(std::string const& shell);
/// What may stand for the last of the words behind `slideway`, one a line: "candidate<TAB>meaning"; "*/" stands for all folders, "*.nc" for all files with
/// this ending.  But for options not only what begins as the word does: that is for the shell, which may match otherwise.
std::string candidates(std::vector<CommandDescription> const& commands, std::span<std::string const> words);

}  // namespace slideway::cli
