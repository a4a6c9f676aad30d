// The repository's own files as text, for the tests that read them.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slideway::structure {

struct SourceFile {
    std::string path;  // from the repository's root, with '/'
    std::string text;
};

/// Files below the given folders of the repository, sorted by path; a folder that does not exist counts as empty.
std::vector<SourceFile> files_below(std::initializer_list<std::string_view> folders);

/// Plain files directly in the repository's root, sorted by path.
std::vector<SourceFile> files_in_root();

/// The text with comments, string and character literals blanked; lines keep their numbers.
std::string code_only(std::string_view text);

std::vector<std::string> lines_of(std::string_view text);

/// Paths in quotes of the #include lines, those commented out left aside.
std::vector<std::string> quoted_includes(std::string_view text);

/// A regular expression, in one unit: std::regex takes seconds to compile.
class Pattern {
public:
    explicit Pattern(std::string const& expression);
    /// The first match, or a group of it; nothing where nothing matches.
    [[nodiscard]] std::optional<std::string> match_in(std::string const& text, std::size_t group = 0) const;

private:
    struct Regex;
    std::shared_ptr<Regex const> regex_;
};

bool has_ending(std::string_view path, std::initializer_list<std::string_view> endings);

}  // namespace slideway::structure
