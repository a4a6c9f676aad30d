#include "tests/system/terminal.hpp"

#include <set>
#include <sstream>

#include "host/commands/description.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/scene.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::terminal_test {
namespace {

std::size_t columns_of(std::string const& line) {
    return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// TOML breaks neither strings nor tables within a line.
bool is_unbreakable(std::string const& line) { return line.starts_with("title = ") || line.starts_with("table = ") || line.find(" = {") != line.npos; }

void expect_fit(std::string const& text, std::size_t columns, std::string const& what) {
    EXPECT_NE(text, "") << what;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(columns_of(line) <= columns || is_unbreakable(line)) << what << " on " << columns << " columns: " << line;
    }
}

std::string without_blanks(std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    return text;
}

class Terminal : public Program {};

TEST_F(Terminal, HasRoomForHelpAndTheList) {
    for (unsigned short const columns : {80, 120}) {
        expect_fit(on_terminal({"help"}, columns), columns, "help");
        expect_fit(on_terminal({"list"}, columns), columns, "list");
        for (auto const& command : cli::command_descriptions()) expect_fit(on_terminal({"help", command.name}, columns), columns, command.name);
    }
    EXPECT_EQ(without_blanks(on_terminal({"list"}, 80)), without_blanks(run({"list"}).out)) << "lines are broken and nothing is lost";
    EXPECT_NE(on_terminal({"list"}, 80), run({"list"}).out);
}

/// One of each kind of study with each mechanism: `check` says no more of others.
TEST_F(Terminal, HasRoomForScenes) {
    namespace fs = std::filesystem;
    std::set<fs::path> scenes;
    for (auto const& entry : fs::directory_iterator(SLIDEWAY_SCENES)) {
        if (entry.path().extension() == ".toml") scenes.insert(entry.path());
    }
    std::set<std::pair<StudyKind, std::string>> seen;
    for (fs::path const& scene : scenes) {
        Scene const read = read_scene(scene.string());
        if (!seen.insert({read.study, info(read.parts.mechanism).name}).second && scene.filename() != "tolerance_table.toml") continue;
        // A short path, with its tables as they lie beside it.
        fs::path const copy = path("a") / "s.toml";
        fs::create_directories(copy.parent_path());
        fs::copy_file(scene, copy, fs::copy_options::overwrite_existing);
        for (TableFile const& table : read.tables) {
            fs::path const place = copy.parent_path() / table.given;
            fs::create_directories(place.parent_path());
            fs::copy_file(table.path, place, fs::copy_options::overwrite_existing);
        }
        expect_fit(on_terminal({"check", copy.string()}, 80), 80, scene.filename());
    }
    EXPECT_GT(seen.size(), 10u);
}

TEST_F(Terminal, HasRoomForResults) {
    std::string const file = path("s.nc").string(), scenes = SLIDEWAY_SCENES;
    expect_fit(on_terminal({"run", scenes + "/tolerance_table.toml", "--set", "study.duration=0.01", "--no-progress", "-o", file}, 80), 80, "run");
    std::string const info = on_terminal({"info", file, "--members"}, 80);
    expect_fit(info, 80, "info");
    EXPECT_NE(info.find("peak_normal_force"), info.npos);
    // What has no room beside the other columns stands below.
    for (char const* const quantile : {"0.1 %", "99.9 %"}) EXPECT_NE(info.find(quantile), info.npos) << quantile;
    expect_fit(on_terminal({"probe", scenes + "/slider_crank_0.1mm.toml"}, 80), 80, "probe");
    EXPECT_NE(on_terminal({"probe", scenes + "/slider_crank_0.1mm.toml"}, 80).find("P8"), std::string::npos);
}

TEST_F(Terminal, ShowsNoRowThatHasNothingInItsColumns) {
    std::string const file = path("s.nc").string(), scene = std::string(SLIDEWAY_SCENES) + "/tolerance_0.1mm.toml";
    run({"run", scene, "--set", "study.base=8", "study.duration=0.002", "--quiet", "-o", file});
    std::string const info = on_terminal({"info", file}, 80);
    std::istringstream lines(info);
    std::size_t sums = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("all first orders") == line.npos) continue;
        ++sums;
        EXPECT_NE(line.find('['), line.npos) << line;  // the interval of the first orders; there is no total of them
    }
    EXPECT_GT(sums, 0u) << info;
    EXPECT_EQ(info.find("..."), info.npos) << "flags of the compiler are whole: " << info;
}

}  // namespace
}  // namespace slideway::testing::terminal_test
