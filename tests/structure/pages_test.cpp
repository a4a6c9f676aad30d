// The pages of the repository: their links lead somewhere, and their lines fit an editor.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "kernels/status.hpp"
#include "tests/structure/source_tree.hpp"

namespace slideway::structure::pages_test {
namespace {

constexpr std::size_t longest_line = 160;         // characters
constexpr std::size_t largest_picture = 200'000;  // bytes

std::vector<SourceFile> pages() {
    auto files = files_below({".github", "bench", "docs", "python", "tests"});
    auto const in_root = files_in_root();
    files.insert(files.end(), in_root.begin(), in_root.end());
    std::erase_if(files, [](SourceFile const& f) { return !f.path.ends_with(".md"); });
    return files;
}

std::size_t characters(std::string const& line) {
    return static_cast<std::size_t>(std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// The lines outside fenced blocks.
std::vector<std::string> prose_of(std::string const& text) {
    std::vector<std::string> lines;
    bool fenced = false;
    for (std::string const& line : lines_of(text)) {
        bool const fence = line.starts_with("```");
        if (!fence && !fenced) lines.push_back(line);
        if (fence) fenced = !fenced;
    }
    return lines;
}

/// A heading's anchor: in lower case, without what is no letter, digit, blank, '-' or '_'; blanks are '-'.
std::string anchor_of(std::string const& heading) {
    std::string anchor;
    for (char const c : heading.substr(std::min(heading.find_first_not_of("# "), heading.size()))) {
        auto const u = static_cast<unsigned char>(c);
        if (std::isalnum(u) || c == '-' || c == '_' || u >= 0x80) anchor += static_cast<char>(u < 0x80 ? std::tolower(u) : u);
        if (c == ' ') anchor += '-';
    }
    return anchor;
}

std::set<std::string> anchors_of(std::string const& text) {
    std::set<std::string> anchors;
    for (std::string const& line : prose_of(text)) {
        if (line.starts_with("#")) anchors.insert(anchor_of(line));
    }
    return anchors;
}

/// Targets of `[text](target)` that are files of the repository; spans of code and addresses elsewhere are left aside.
std::vector<std::string> links_of(std::string const& text) {
    static std::regex const code("`[^`]*`"), link(R"(\]\(([^)\s]+)\))");
    std::vector<std::string> targets;
    for (std::string const& line : prose_of(text)) {
        std::string const plain = std::regex_replace(line, code, "`");
        for (std::sregex_iterator at(plain.begin(), plain.end(), link), end; at != end; ++at) {
            if ((*at)[1].str().find("://") == std::string::npos) targets.push_back((*at)[1]);
        }
    }
    return targets;
}

/// Why a link of a page leads nowhere; empty where it does not.
std::string broken(SourceFile const& page, std::string const& target, std::map<std::string, std::set<std::string>> const& anchors) {
    namespace fs = std::filesystem;
    auto const hash = target.find('#');
    std::string const file = target.substr(0, hash);
    fs::path const path = file.empty() ? fs::path(page.path) : (fs::path(page.path).parent_path() / file).lexically_normal();
    if (!fs::exists(fs::path(SLIDEWAY_SOURCE) / path)) return "there is no " + path.generic_string();
    if (hash == std::string::npos) return {};
    auto const found = anchors.find(path.generic_string());
    bool const is_there = found != anchors.end() && found->second.contains(target.substr(hash + 1));
    return is_there ? "" : path.generic_string() + " has no heading " + target.substr(hash);
}

TEST(Pages, LinksLeadSomewhere) {
    std::map<std::string, std::set<std::string>> anchors;
    for (SourceFile const& page : pages()) anchors[page.path] = anchors_of(page.text);
    ASSERT_GT(anchors.size(), 10u);
    for (SourceFile const& page : pages()) {
        for (std::string const& target : links_of(page.text)) {
            auto const why = broken(page, target, anchors);
            EXPECT_TRUE(why.empty()) << page.path << ": " << target << ": " << why;
        }
    }
}

/// A page teaches, shows how a job is done, is looked up, explains, or is evidence, which no newcomer meets.
TEST(Pages, AreOfOneKind) {
    std::set<std::string> const kinds{"docs/tutorial", "docs/how_to", "docs/reference", "docs/explanation", "docs/evidence"};
    for (SourceFile const& page : pages()) {
        if (!page.path.starts_with("docs/") || page.path == "docs/README.md") continue;
        EXPECT_TRUE(kinds.contains(std::filesystem::path(page.path).parent_path().generic_string())) << page.path;
    }
}

/// Words, tables included: what has a letter or a digit in it.
std::size_t words(std::string const& text) {
    std::istringstream in(text);
    auto const is_letter = [](unsigned char c) { return std::isalnum(c) != 0 || (c >= 0xC3 && c <= 0xCF); };
    return static_cast<std::size_t>(std::ranges::count_if(std::istream_iterator<std::string>(in), std::istream_iterator<std::string>(),
                                                          [&](std::string const& word) { return std::ranges::any_of(word, is_letter); }));
}

/// A ceiling that falls, or is raised by a commit that says why.
TEST(Pages, HaveAtMostSoManyWords) {
    std::size_t all = 0, for_newcomers = 0;
    for (SourceFile const& page : pages()) {
        std::size_t const count = words(page.text);
        all += count;
        if (page.path == "README.md" || (page.path.starts_with("docs/") && !page.path.starts_with("docs/evidence/"))) for_newcomers += count;
    }
    EXPECT_LE(all, 46'907u);
    EXPECT_LE(for_newcomers, 30'000u);
    EXPECT_EQ(words("| µm | a-b | λ₁ 3 | → ≤ |\n"), 4u);
}

TEST(Pages, BrokenLinksAreRecognised) {
    SourceFile const page{"docs/explanation/sample.md", "# A heading of `code`, and more\n"};
    std::map<std::string, std::set<std::string>> const anchors{{"docs/explanation/model.md", anchors_of(page.text)}};
    EXPECT_EQ(links_of("see [a](model.md), `[b](c)`, [d](https://e.f/g)\n```\n[h](i)\n```\n[j](#k)\n"), (std::vector<std::string>{"model.md", "#k"}));
    EXPECT_EQ(broken(page, "model.md#a-heading-of-code-and-more", anchors), "");
    EXPECT_EQ(broken(page, "../../README.md", anchors), "");
    EXPECT_NE(broken(page, "model.md#another", anchors), "");
    EXPECT_NE(broken(page, "no_such_page.md", anchors), "");
}

TEST(Pages, AreAllInTheIndex) {
    std::set<std::string> listed;
    for (SourceFile const& page : pages()) {
        if (page.path != "docs/README.md") continue;
        for (std::string const& target : links_of(page.text)) listed.insert(target);
    }
    for (SourceFile const& page : pages()) {
        if (!page.path.starts_with("docs/") || page.path == "docs/README.md") continue;
        EXPECT_TRUE(listed.contains(page.path.substr(5))) << "docs/README.md does not list " << page.path;
    }
}

/// What is wrong with the pictures of a folder, a line each: one that no page shows, and one that is too large.
std::vector<std::string> picture_faults(std::vector<SourceFile> const& pictures, std::vector<SourceFile> const& shown_by) {
    namespace fs = std::filesystem;
    std::set<std::string> shown;
    for (SourceFile const& page : shown_by) {
        for (std::string const& target : links_of(page.text)) {
            shown.insert((fs::path(page.path).parent_path() / target).lexically_normal().generic_string());
        }
    }
    std::vector<std::string> faults;
    for (SourceFile const& picture : pictures) {
        if (!shown.contains(picture.path)) faults.push_back(picture.path + " is on no page");
        if (picture.text.size() >= largest_picture) faults.push_back(picture.path + " is too large");
    }
    return faults;
}

/// That a page's pictures are there is checked with its links.
TEST(Pages, PicturesAreShownAndSmall) {
    auto const pictures = files_below({"docs/pictures"});
    EXPECT_FALSE(pictures.empty());
    for (std::string const& fault : picture_faults(pictures, pages())) ADD_FAILURE() << fault;
}

TEST(Pages, FaultsOfPicturesAreRecognised) {
    SourceFile const page{"docs/sample.md", "![A slider](pictures/a.svg) and [b](pictures/b.svg)\n"};
    SourceFile const small{"docs/pictures/a.svg", "<svg/>"}, large{"docs/pictures/b.svg", std::string(largest_picture, ' ')};
    EXPECT_TRUE(picture_faults({small}, {page}).empty());
    EXPECT_EQ(picture_faults({small, large}, {page}), std::vector<std::string>{"docs/pictures/b.svg is too large"});
    EXPECT_EQ(picture_faults({small}, {}), std::vector<std::string>{"docs/pictures/a.svg is on no page"});
    EXPECT_NE(broken(page, "pictures/no_such_picture.svg", {}), "");
}

/// Every picture says in words what it shows.
TEST(Pages, PicturesHaveWords) {
    for (SourceFile const& page : pages()) {
        for (std::string const& line : prose_of(page.text)) EXPECT_EQ(line.find("![]("), std::string::npos) << page.path << ": " << line;
    }
}

/// Each status has a section that says what to do.
TEST(Pages, StatusesAreExplained) {
    std::string page;
    for (SourceFile const& one : pages()) {
        if (one.path == "docs/how_to/troubleshooting.md") page = one.text;
    }
    for (std::string name : status_names) EXPECT_NE(page.find("\n### `" + name + "`\n"), std::string::npos) << name;
    EXPECT_NE(page.find("\n### `not_run`\n"), std::string::npos);
}

/// The lines of fenced blocks that call the program by its name alone, before the page has said to put `folder` on the PATH.
std::vector<std::string> calls_without_path(std::string const& text, std::string const& folder) {
    std::vector<std::string> calls;
    bool fenced = false;
    std::string prose;  // whose sentences go over lines
    for (std::string const& line : lines_of(text)) {
        bool const fence = line.starts_with("```");
        if (fence) fenced = !fenced;
        if (!fence && !fenced) prose += line + ' ';
        auto const folder_at = prose.find(folder);
        if (folder_at != std::string::npos && prose.find("`PATH`", folder_at) != std::string::npos) return calls;
        std::string const command = line.substr(line.starts_with("$ ") ? 2 : 0);
        if (fenced && command.starts_with("slideway ")) calls.push_back(line);
    }
    return calls;
}

/// Whoever reads from the top can call the program where the first command does.
TEST(Pages, SayWhereTheProgramIsBeforeTheyCallIt) {
    std::size_t found = 0;
    for (SourceFile const& page : pages()) {
        if (page.path != "README.md" && page.path != "docs/tutorial/tutorial.md") continue;
        ++found;
        for (std::string const& call : calls_without_path(page.text, "`build/release/bin")) ADD_FAILURE() << page.path << ": " << call;
    }
    EXPECT_EQ(found, 2u);
}

TEST(Pages, CallsWithoutAPathAreRecognised) {
    std::string const call = "```\n$ slideway run a.toml\n```\n", path = "It is `bin/slideway`;\nput `bin` on your `PATH`.\n";
    EXPECT_EQ(calls_without_path(call + path, "`bin"), std::vector<std::string>{"$ slideway run a.toml"});
    EXPECT_EQ(calls_without_path("```\nslideway list\n```\n", "`bin"), std::vector<std::string>{"slideway list"});
    EXPECT_TRUE(calls_without_path("```\nbash scripts/demo.sh\n```\n" + path + call, "`bin").empty());
}

/// Rows of tables cannot be broken, fenced blocks show what a program prints, and the program writes docs/reference/keys.md.
TEST(Pages, LinesFit) {
    for (SourceFile const& page : pages()) {
        if (page.path.starts_with("bench/") || page.path.starts_with("python/") || page.path == "docs/reference/keys.md") continue;
        for (std::string const& line : prose_of(page.text)) {
            if (line.starts_with("|")) continue;
            EXPECT_LE(characters(line), longest_line) << page.path << ": " << line;
        }
    }
}

}  // namespace
}  // namespace slideway::structure::pages_test
