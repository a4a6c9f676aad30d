#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/structure/source_tree.hpp"

namespace slideway::structure {
namespace {

constexpr std::size_t longest_source = 500;  // lines

std::vector<SourceFile> repository_files() {
    auto files = files_below({".ci", "bench", "cmake", "docs", "host", "kernels", "python", "scenes", "scripts", "tests"});
    auto const in_root = files_in_root();
    files.insert(files.end(), in_root.begin(), in_root.end());
    std::erase_if(files, [](SourceFile const& f) { return has_ending(f.path, {".csv", ".png", ".nc", ".pyc"}); });
    return files;
}

bool is_source(SourceFile const& file) {
    return has_ending(file.path, {".hpp", ".cpp", ".cu", ".in", ".cmake", "CMakeLists.txt", ".sh", ".py", ".toml",
                                  ".json", ".ci/run", ".clang-format", ".clang-tidy"});
}

// The names are put together here so that this file does not contain what it looks for.
Pattern machine_path() { return Pattern("(^|[^\\w.$}/])/(" + std::string("work|root|home/") + "\\w+)(/|\\b)"); }

TEST(Repository, HasItsLicence) {
    auto const files = files_in_root();
    auto const licence = std::ranges::find(files, "LICENSE", &SourceFile::path);
    ASSERT_NE(licence, files.end());
    EXPECT_TRUE(licence->text.starts_with("MIT License"));
}

TEST(Repository, NamesNoPathOfOneMachine) {
    Pattern const pattern = machine_path();
    for (SourceFile const& file : repository_files()) {
        auto const lines = lines_of(file.text);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            EXPECT_FALSE(pattern.match_in(lines[i])) << file.path << ':' << i + 1 << ": " << lines[i];
        }
    }
}

TEST(Repository, MachinePathIsRecognised) {
    Pattern const pattern = machine_path();
    for (std::string const folder : {"work", "root", "home"}) {
        EXPECT_TRUE(pattern.match_in("see /" + folder + "/somebody/x.csv")) << folder;
        EXPECT_FALSE(pattern.match_in("see build/" + folder + "/somebody/x.csv")) << folder;
    }
}

TEST(Repository, SourcesHaveNoTabsAndNoTrailingBlanks) {
    for (SourceFile const& file : repository_files()) {
        if (!is_source(file)) continue;
        auto const lines = lines_of(file.text);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            EXPECT_EQ(lines[i].find('\t'), std::string::npos) << file.path << ':' << i + 1 << ": tab";
            EXPECT_FALSE(lines[i].ends_with(' ') || lines[i].ends_with('\r'))
                << file.path << ':' << i + 1 << ": trailing blank";
        }
    }
}

TEST(Repository, SourcesEndWithOneNewline) {
    for (SourceFile const& file : repository_files()) {
        if (!is_source(file) || file.text.empty()) continue;
        EXPECT_TRUE(file.text.ends_with('\n') && !file.text.ends_with("\n\n")) << file.path;
    }
}

TEST(Repository, SourcesStayShort) {
    for (SourceFile const& file : repository_files()) {
        if (!is_source(file)) continue;
        EXPECT_LT(lines_of(file.text).size(), longest_source) << file.path;
    }
}

TEST(Repository, HeadersAreGuarded) {
    for (SourceFile const& file : repository_files()) {
        if (!file.path.ends_with(".hpp")) continue;
        EXPECT_NE(file.text.find("#pragma once\n"), std::string::npos) << file.path;
    }
}

}  // namespace
}  // namespace slideway::structure
