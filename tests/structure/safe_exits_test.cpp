// What keeps exits safe is in one place each: words that let a user remove something, what opens files, what prints, the list of signals.
#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/structure/source_tree.hpp"

namespace slideway::structure::safe_exits_test {
namespace {

/// "path: line" of each line below a folder in which a pattern is found, but for lines that hold one of `allowed`; comments of C++ are left aside,
/// those of Python are what its users read.
std::vector<std::string> lines_with(Pattern const& pattern, std::set<std::string> const& files, std::vector<std::string> const& allowed = {},
                                    std::string_view folder = "host") {
    std::vector<std::string> found;
    for (SourceFile const& file : files_below({folder})) {
        if (!has_ending(file.path, {".cpp", ".hpp", ".py"}) || files.contains(file.path)) continue;
        auto const lines = lines_of(file.text);
        for (std::string const& whole : lines) {
            std::string const line = has_ending(file.path, {".py"}) ? whole : whole.substr(0, whole.find("//"));
            auto const is_in = [&](std::string const& part) { return line.find(part) != line.npos; };
            if (pattern.match_in(line) && std::ranges::none_of(allowed, is_in)) found.push_back(file.path + ": " + line);
        }
    }
    return found;
}

using Lines = std::vector<std::string>;

TEST(SafeExits, WordsThatLetAUserRemoveFilesAreInOnePlace) {
    std::string const of_need = "(no longer needed|no more needed|(may|can|could) (now )?be (removed|deleted)|remove the (folder|file)|delete)";
    Pattern const words("\"[^\"]*" + of_need + "[^\"]*\""), anywhere(of_need);
    EXPECT_TRUE(words.match_in(R"(print("{}; {} is no longer needed");)"));
    EXPECT_TRUE(words.match_in(R"("give another name with -o, or remove the folder")"));
    EXPECT_EQ(lines_with(words, {"host/store/shard_claim.cpp"}, {": cannot remove the folder: "}), Lines{});
    EXPECT_TRUE(anywhere.match_in("    The shards stay; remove the folder when they are no longer needed."));
    EXPECT_EQ(lines_with(anywhere, {}, {}, "python/slideway"), Lines{});
}

TEST(SafeExits, FilesAreOpenedByOneHelper) {
    Pattern const opens(R"((std::[io]?fstream\b|\bfopen\(|::open\(|\bnc_open\(|(^|[^:\w.])open\())");
    EXPECT_TRUE(opens.match_in("    std::ifstream in(path);"));
    EXPECT_TRUE(opens.match_in("int const file = open(path.c_str(), O_RDONLY);"));
    // Of the system, of the program itself, and through a library that is told to look first.
    EXPECT_EQ(lines_with(opens, {"host/base/open_file.cpp"}, {"\"/proc/", "\"/dev/null\"", "file(program, std::ios::binary)", "nc_open(path.c_str()", "NetcdfFile::open(", "static NetcdfFile open("}),
              Lines{});
}

TEST(SafeExits, OnlyOnePrinterWritesToTheStreams) {
    Pattern const prints(R"(fmt::print\b|std::c(out|err)\b|\bf?printf\(|\bf?puts\(|\bfputc\(|\bputchar\(|\bfwrite\()");
    EXPECT_TRUE(prints.match_in("    fmt::print(\"{}\", title);"));
    // Progress prints numbers, and nothing of anybody else's.
    EXPECT_EQ(lines_with(prints, {"host/commands/text.cpp", "host/run/progress.cpp"}), Lines{});
}

TEST(SafeExits, SignalsThatStopARunAreListedOnce) {
    Pattern const signals(R"(\bSIG(INT|TERM|HUP|QUIT|USR1|USR2|ALRM)\b)");
    EXPECT_EQ(lines_with(signals, {"host/base/process.hpp"}), Lines{});
}

}  // namespace
}  // namespace slideway::structure::safe_exits_test
