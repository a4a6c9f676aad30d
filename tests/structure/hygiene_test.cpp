#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/structure/source_tree.hpp"

namespace slideway::structure::hygiene_test {
namespace {

constexpr std::size_t longest_source = 500;  // lines

std::vector<SourceFile> repository_files() {
    auto files = files_below({".ci", ".github", "bench", "cmake", "docs", "host", "kernels", "python", "scenes", "scripts", "tests"});
    auto const in_root = files_in_root();
    files.insert(files.end(), in_root.begin(), in_root.end());
    std::erase_if(files, [](SourceFile const& f) { return has_ending(f.path, {".csv", ".png", ".nc", ".pyc"}); });
    return files;
}

bool is_source(SourceFile const& file) {
    return has_ending(file.path, {".hpp", ".cpp", ".cu", ".in", ".cmake", "CMakeLists.txt", ".sh", ".py", ".toml",
                                  ".json", ".yml", ".yaml", ".cff", ".ci/run", ".clang-format", ".clang-tidy"});
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

TEST(Repository, HoldsNoHalfMergedFile) {
    for (SourceFile const& file : repository_files()) {
        for (std::string const& line : lines_of(file.text)) {
            bool const marks = line.starts_with(std::string(7, '<') + ' ') || line.starts_with(std::string(7, '>') + ' ');
            EXPECT_FALSE(marks) << file.path << ": " << line;
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

/// What a line of Python draws by: "matplotlib", "plotly" or text of an "svg".
Pattern drawing() { return Pattern(R"((?:^\s*(?:import|from) |<)(matplotlib|plotly|svg)\b)"); }

TEST(Repository, OneModuleDrawsByMatplotlibAndOneByPlotly) {
    Pattern const draws = drawing();
    std::set<std::string> found;
    for (SourceFile const& file : files_below({"bench", "examples", "python/examples", "python/slideway", "scripts"})) {
        if (!file.path.ends_with(".py") || file.path.find("/tests/") != file.path.npos) continue;
        for (std::string const& line : lines_of(file.text)) {
            // The type of the axis that a user gives draws nothing.
            if (line == "    from matplotlib.axes import Axes as Axes") continue;
            if (auto const by = draws.match_in(line, 1)) found.insert(file.path + ": " + *by);
        }
    }
    EXPECT_EQ(found, (std::set<std::string>{"python/slideway/plot/axes.py: matplotlib", "python/slideway/report/traces.py: plotly"}));
}

TEST(Repository, DrawingIsFound) {
    EXPECT_EQ(drawing().match_in("    import matplotlib.pyplot as plt", 1), "matplotlib");
    EXPECT_EQ(drawing().match_in("from plotly.offline import get_plotlyjs", 1), "plotly");
    EXPECT_EQ(drawing().match_in(R"(    parts = ['<svg xmlns="http://www.w3.org/2000/svg">'])", 1), "svg");
    EXPECT_EQ(drawing().match_in("# matplotlib takes its time", 1), std::nullopt);
}

/// Lines of code, comments and blank lines left aside.
std::vector<std::string> code_lines(std::string const& text) {
    auto lines = lines_of(code_only(text));
    for (auto& line : lines) line.erase(line.find_last_not_of(' ') + 1);
    std::erase(lines, "");
    return lines;
}

bool opens_namespace(std::string const& line) { return line.starts_with("namespace ") && line.ends_with('{'); }

/// What is wrong with a test that shares a unit with others: all it has stands in a namespace without a name, and that alone
/// in one that ends with the file's name.
std::string wrong_as_a_part(SourceFile const& file, std::set<std::string>& names) {
    auto const lines = code_lines(file.text);
    auto const first = std::ranges::find_if(lines, [](auto const& line) { return !line.starts_with("#include"); });
    if (first == lines.end() || !first->starts_with("namespace ") || !first->ends_with("_test {")) return "no namespace of its own comes first";
    if (*(first + 1) != "namespace {") return "what it has is not in a namespace without a name";
    std::string const name = first->substr(0, first->size() - 2), file_name = file.path.substr(file.path.rfind('/') + 1);
    if (!name.ends_with(file_name.substr(0, file_name.size() - 4))) return "its namespace has not the file's name";
    if (!names.insert(file.path.substr(0, file.path.find('/', 6)) + name.substr(name.find_last_of(": ") + 1)).second) return "another file has its namespace";
    bool const closed = lines.back() == "}" && *(lines.end() - 2) == "}" && std::ranges::count_if(lines, opens_namespace) == 2;
    return closed ? "" : "its namespaces do not end the file";
}

TEST(Repository, TestsMayShareAUnit) {
    std::set<std::string> names;
    Pattern const gtest(R"((^|[^:\w])testing::(Test|TestWithParam|Values|ValuesIn|Combine|Assertion\w+)\b)");
    for (SourceFile const& file : files_below({"tests"})) {
        // Those of parity declare what is there once for each instruction set, and stay units of their own.
        if (!file.path.ends_with("_test.cpp") || file.path.starts_with("tests/parity/")) continue;
        EXPECT_EQ(wrong_as_a_part(file, names), "") << file.path;
        // In a unit with others slideway::testing is there, where this file alone has gtest's.
        EXPECT_EQ(gtest.match_in(code_only(file.text)), std::nullopt) << file.path;
    }
    EXPECT_GT(names.size(), 100U);
}

TEST(Repository, TestsThatMayNotShareAUnitAreFound) {
    auto const wrong = [](std::string const& path, std::string const& text) {
        std::set<std::string> names{"tests/unittaken_test"};
        return wrong_as_a_part({path, text}, names);
    };
    std::string const whole = "#include <set>\n// Words.\nnamespace a::b_test {\nnamespace {\nint f();\n}  // namespace\n}  // namespace a::b_test\n";
    EXPECT_EQ(wrong("tests/unit/c/b_test.cpp", whole), "");
    EXPECT_EQ(wrong("tests/unit/c/d_test.cpp", whole), "its namespace has not the file's name");
    EXPECT_EQ(wrong("tests/unit/b_test.cpp", "int f();\n" + whole), "no namespace of its own comes first");
    EXPECT_EQ(wrong("tests/unit/b_test.cpp", whole + "int g();\n"), "its namespaces do not end the file");
    EXPECT_EQ(wrong("tests/unit/b_test.cpp", "namespace b_test {\nint f();\n}\n"), "what it has is not in a namespace without a name");
    EXPECT_EQ(wrong("tests/unit/taken_test.cpp", "namespace taken_test {\nnamespace {\n}\n}\n"), "another file has its namespace");
}

/// A pack takes a list of its lanes in braces: Real x{0.5} sets the first of them, and whatever stands in memory behind that number the others.
Pattern braced_number() { return Pattern(R"(\b(?:(?:Isa)?Real|Batch<\w+>)(?: const)?(?: \w+)?\{[^}])"); }

TEST(Repository, NumbersOfKernelsAreNotInitialisedInBraces) {
    Pattern const braced = braced_number();
    for (SourceFile const& file : files_below({"kernels", "tests", "bench", "examples"})) {
        if (!has_ending(file.path, {".hpp", ".cpp", ".cu"})) continue;
        EXPECT_EQ(braced.match_in(code_only(file.text)), std::nullopt) << file.path << ": write it in parentheses (kernels/real.hpp)";
    }
}

TEST(Repository, BracedNumbersAreFound) {
    Pattern const braced = braced_number();
    for (char const* const code : {"Real x{0.5};", "Real const half{0.5};", "return Real{1};", "IsaReal y{a};", "Batch<Arch> z{0.0};"}) {
        EXPECT_TRUE(braced.match_in(code)) << code;
    }
    for (char const* const code : {"Real x(0.5);", "Real const half(0.5);", "Real zero{};", "struct OfReal {int i;", "-> Real { return a; }", "Quad<Real> q{a, b};"}) {
        EXPECT_FALSE(braced.match_in(code)) << code;
    }
}

/// Names that a source declares in namespaces without a name: of functions, types and constants, but not of aliases.
std::set<std::string> private_names(std::string const& text) {
    static Pattern const declared(R"(^(?:(?:struct|class|enum class|enum) (\w+)|(?!using |[ }])(?:[\w:<>,&*\[\]. ]*[ &*>])(\w+)(?: = |\(|\[|\{|;)))");
    std::set<std::string> names;
    bool is_private = false;
    for (auto const& line : lines_of(text)) {
        if (opens_namespace(line)) is_private = line == "namespace {";
        if (line == "}  // namespace") is_private = false;
        if (!is_private) continue;
        for (std::size_t const group : {1U, 2U}) {
            if (auto const name = declared.match_in(line, group); name && !name->empty()) names.insert(*name);
        }
    }
    return names;
}

TEST(Repository, SourcesOfALayerMayShareAUnit) {
    std::map<std::string, std::string> owners;  // of a name of a layer
    Pattern const alone(R"((/planar|planar_runs|rigid_planar|random_states|spatial_runs|golden_writer)\.cpp$)");
    for (SourceFile const& file : files_below({"host", "tests/oracle"})) {
        // These are of units of their own: the host's side of kernels, and some of the reference.
        if (!file.path.ends_with(".cpp") || file.path.starts_with("host/backend/") || alone.match_in(file.path)) continue;
        for (auto const& name : private_names(file.text)) {
            auto const [owner, is_first] = owners.try_emplace(file.path.substr(0, file.path.rfind('/') + 1) + name, file.path);
            EXPECT_TRUE(is_first) << file.path << ": " << name << " is a private name of " << owner->second << " too";
        }
    }
    EXPECT_GT(owners.size(), 500U);
}

TEST(Repository, PrivateNamesAreFound) {
    std::set<std::string> const expected{"Some", "Kind", "words", "of", "one_of", "least"};
    EXPECT_EQ(private_names("namespace a {\nint open();\nnamespace {\nusing Other = int;\nstruct Some {\n    int inner;\n};\nenum class Kind {};\n"
                            "constexpr char const* words[] = {\"x\"};\nstd::vector<int> of(int x) { return {x}; }\nauto const& one_of(int i) {\n}\n"
                            "std::size_t const least = 4;\n}  // namespace\nint late();\n}  // namespace a\n"),
              expected);
}

}  // namespace
}  // namespace slideway::structure::hygiene_test
