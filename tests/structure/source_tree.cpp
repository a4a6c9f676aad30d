#include "tests/structure/source_tree.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

namespace slideway::structure {

namespace {

std::filesystem::path const root = SLIDEWAY_SOURCE;

SourceFile read(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {path.lexically_relative(root).generic_string(), {std::istreambuf_iterator<char>(in), {}}};
}

void sort_by_path(std::vector<SourceFile>& files) { std::ranges::sort(files, {}, &SourceFile::path); }

enum class Blank { comments, comments_and_literals };

/// Replaces what is left out by spaces.  Raw strings and digit separators do not occur in this repository's sources
/// in a way that would matter: at worst the rest of a line is blanked.
std::string blanked(std::string_view text, Blank what) {
    std::string out(text);
    auto const blank = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < std::min(to, out.size()); ++i) {
            if (out[i] != '\n') out[i] = ' ';
        }
    };
    for (std::size_t i = 0; i < text.size();) {
        std::string_view const rest = text.substr(i);
        std::size_t end = i + 1;
        if (rest.starts_with("//")) {
            end = std::min(text.find('\n', i), text.size());
            blank(i, end);
        } else if (rest.starts_with("/*")) {
            end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
            blank(i, end);
        } else if (text[i] == '"' ||
                   (text[i] == '\'' && (i == 0 || !std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
            while (end < text.size() && text[end] != text[i] && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
            if (what == Blank::comments_and_literals) blank(i + 1, end);
            ++end;
        }
        i = end;
    }
    return out;
}

}  // namespace

std::vector<SourceFile> files_below(std::initializer_list<std::string_view> folders) {
    std::vector<SourceFile> files;
    for (std::string_view const folder : folders) {
        if (!std::filesystem::is_directory(root / folder)) continue;
        for (auto const& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            if (entry.is_regular_file()) files.push_back(read(entry.path()));
        }
    }
    sort_by_path(files);
    return files;
}

std::vector<SourceFile> files_in_root() {
    std::vector<SourceFile> files;
    for (auto const& entry : std::filesystem::directory_iterator(root)) {
        if (entry.is_regular_file()) files.push_back(read(entry.path()));
    }
    sort_by_path(files);
    return files;
}

std::string code_only(std::string_view text) { return blanked(text, Blank::comments_and_literals); }

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        std::size_t const end = std::min(text.find('\n'), text.size());
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::vector<std::string> quoted_includes(std::string_view text) {
    static Pattern const include(R"re(^\s*#\s*include\s*"([^"]*)")re");
    std::vector<std::string> paths;
    for (std::string const& line : lines_of(blanked(text, Blank::comments))) {
        if (auto path = include.match_in(line, 1)) paths.push_back(*path);
    }
    return paths;
}

struct Pattern::Regex {
    std::regex value;
};

Pattern::Pattern(std::string const& expression) : regex_(new Regex{std::regex(expression)}) {}

std::optional<std::string> Pattern::match_in(std::string const& text, std::size_t group) const {
    std::smatch match;
    if (!std::regex_search(text, match, regex_->value)) return std::nullopt;
    return match[group];
}

bool has_ending(std::string_view path, std::initializer_list<std::string_view> endings) {
    return std::ranges::any_of(endings, [&](std::string_view ending) { return path.ends_with(ending); });
}

}  // namespace slideway::structure
