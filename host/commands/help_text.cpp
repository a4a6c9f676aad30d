#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/commands/description.hpp"
#include "host/commands/text.hpp"

namespace slideway::cli {
namespace {

/// "  -o, --output OUT.nc       Result file": a label in a column, and beside or below it what it means.
std::string entry(std::string const& label, std::string const& meaning, std::size_t width) {
    constexpr std::size_t column = 28;
    std::string const left = "  " + label;
    bool const beside = left.size() + 2 <= column;
    return left + (beside ? std::string(column - left.size(), ' ') : "\n" + std::string(column, ' ')) + wrapped(meaning, column, width) + "\n";
}

/// A command that goes on behind a backslash where it is longer than a line.
std::string shell_lines(std::string const& command, std::size_t width) {
    std::string lines = wrapped(command, 6, width - 2, 2);
    for (std::size_t at = 0; (at = lines.find('\n', at)) != lines.npos; at += 3) lines.insert(at, " \\");
    return lines;
}

}  // namespace

std::string OptionDescription::label(Style const& word, Style const& metavariable) const {
    std::vector<std::string> set;
    for (std::string const& name : names) set.push_back(positional ? metavariable(name) : word(name));
    std::string const text = fmt::format("{}", fmt::join(set, ", "));
    if (value.empty() || positional) return text;
    std::string const taken = metavariable(value) + (repeats ? " ..." : "");
    return text + (optional ? " [" + taken + "]" : " " + taken);
}

std::string CommandDescription::synopsis() const {
    std::string text = "slideway " + name + " [OPTION]...";
    for (OptionDescription const& option : options) {
        if (option.positional) text += option.optional ? " [" + option.value + "]" : " " + option.value;
    }
    return text;
}

std::string help_text(CommandDescription const& command, std::size_t width) {
    auto const as_it_is = [](std::string_view word) { return std::string(word); };
    std::string text = fmt::format("{}\n\nUsage: {}\n", wrapped(command.summary, 0, width), command.synopsis());
    for (bool const positional : {true, false}) {
        std::string entries;
        for (OptionDescription const& option : command.options) {
            if (option.positional == positional) entries += entry(option.label(as_it_is, as_it_is), option.meaning, width);
        }
        if (!entries.empty()) text += fmt::format("\n{}:\n{}", positional ? "Arguments" : "Options", entries);
    }
    if (!command.note.empty()) text += fmt::format("\n{}\n", wrapped(command.note, 0, width));
    if (!command.examples.empty()) text += "\nExamples:\n";
    for (Example const& example : command.examples)
        text += fmt::format("  {}\n      {}\n", shell_lines(example.line, width), wrapped(example.meaning, 6, width));
    return text;
}

std::string help_text(std::vector<CommandDescription> const& commands, std::size_t width) {
    std::string text =
        wrapped("Clearance joints of slider mechanisms: ensembles of simulations from a scene file.", 0, width) +
        "\n\nUsage: slideway COMMAND [OPTION]... [ARGUMENT]\n\n"
        "Options:\n";
    text += entry("-h, --help", "This text; behind a command, what it does and its options", width);
    text += entry("--version", "Version and commit", width);
    text += "\nCommands:\n";
    for (CommandDescription const& command : commands) text += entry(command.name, command.summary, width);
    return text + "\nslideway help COMMAND says what a command does, its options and examples.\n";
}

}  // namespace slideway::cli
