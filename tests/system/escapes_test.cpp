// What others wrote (titles, names of files, attributes) never reaches a terminal as what it would obey.
#include <nlohmann/json.hpp>

#include "host/config/scene.hpp"
#include "tests/system/small_run.hpp"
#include "tests/system/terminal.hpp"

namespace slideway::testing::escapes_test {
namespace {

/// U+009B begins a sequence, ESC too, U+202E turns what follows around, BEL rings.
constexpr char const* title = "A \u009b2J \u001b[2J \u202e txet \u0007 end";
constexpr char const* shown_title = "A \\u009b2J \\u001b[2J \\u202e txet \\u0007 end";

bool is_obeyed_by_a_terminal(std::string const& text) {
    for (char const* const bytes : {"\u009b", "\u001b", "\u202e", "\u0007", "\r"}) {
        if (text.find(bytes) != std::string::npos) return true;
    }
    return false;
}

class Escapes : public SmallRun {
protected:
    Escapes() {
        std::string scene = small_scene;
        scene.replace(scene.find("A small ensemble"), 16, "A \\u009b2J \\u001b[2J \\u202e txet \\u0007 end");
        write(name_, scene);
    }
    Outcome expect_harmless(std::vector<std::string> const& words, int code = 0) const {
        Outcome const outcome = run(words);
        EXPECT_EQ(outcome.code, code) << words[0] << outcome.err;
        EXPECT_FALSE(is_obeyed_by_a_terminal(outcome.out)) << words[0] << ' ' << outcome.out;
        EXPECT_FALSE(is_obeyed_by_a_terminal(outcome.err)) << words[0] << ' ' << outcome.err;
        return outcome;
    }
    std::string const name_ = "s\u009b\u202e\u001b.toml", shown_name_ = "s\\u009b\\u202e\\u001b";
};

TEST_F(Escapes, AreInWhatCommandsSayOfTitlesAndNames) {
    std::string const result = "r\u202e\u009b.nc";
    Outcome const ran = expect_harmless({"run", name_, "-o", result});
    EXPECT_NE(ran.out.find(shown_title + std::string(" (") + shown_name_ + ".toml)"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("r\\u202e\\u009b.nc"), std::string::npos) << ran.out;
    Outcome const info = expect_harmless({"info", result, "--scene"});
    EXPECT_NE(info.out.find(shown_title), std::string::npos) << info.out;
    expect_harmless({"info", result, "--check"});
    expect_harmless({"check", name_});
    expect_harmless({"probe", name_});
    EXPECT_NE(expect_harmless({"run", name_, "-o", result}, 4).err.find("r\\u202e\\u009b.nc: is there already"), std::string::npos);
    EXPECT_NE(expect_harmless({"info", "no\u009b.nc"}, 4).err.find("no\\u009b.nc"), std::string::npos);
    EXPECT_NE(expect_harmless({"check", "no\u202e.toml"}, 2).err.find("no\\u202e.toml"), std::string::npos);
    EXPECT_NE(expect_harmless({"no\u009b"}, 2).err.find("no\\u009b"), std::string::npos);
}

TEST_F(Escapes, AreInWarningsAndInWhatMergeSays) {
    EXPECT_EQ(run({"run", name_, "-o", "q\u009b.nc", "--no-progress", "--shard", "1/2"}).code, 0);
    Outcome const stopped = expect_harmless({"run", name_, "-o", "t\u009b.nc", "--max-hours", "0"}, 5);
    EXPECT_NE(stopped.err.find("kept in t\\u009b.nc.shards"), std::string::npos) << stopped.err;
    Outcome const merged = expect_harmless({"merge", "q\u009b.nc.shards", "-o", "m\u202e.nc"}, 5);
    EXPECT_NE(merged.out.find("m\\u202e.nc; q\\u009b.nc.shards is still needed"), std::string::npos) << merged.out;
}

/// JSON and TOML read the escapes back: nothing is lost to a program.
TEST_F(Escapes, AreReadBackByPrograms) {
    ASSERT_EQ(run({"run", name_, "-o", "r.nc", "--quiet"}).code, 0);
    EXPECT_EQ(nlohmann::json::parse(expect_harmless({"info", "r.nc", "--json"}).out)["title"], title);
    EXPECT_EQ(nlohmann::json::parse(expect_harmless({"check", name_, "--json"}).out)["scene"], name_);
    write("again.toml", expect_harmless({"check", name_, "--resolved"}).out);
    EXPECT_EQ(read_scene(path("again.toml").string(), {}).title, title);
    EXPECT_EQ(results("r.nc").attribute("title"), title) << "a result holds what the scene does";
}

TEST_F(Escapes, AreOnATerminalToo) {
    std::string const text = on_terminal({"check", path(name_).string()}, 100);
    EXPECT_FALSE(is_obeyed_by_a_terminal(text)) << text;
    EXPECT_NE(text.find(shown_name_), std::string::npos) << text;
}

/// Of failed members the summary prints a command: bash finds the same file by it.
TEST_F(Escapes, LeaveTheCommandThatRepeatsAMemberWhole) {
    Outcome const ran = expect_harmless({"run", name_, "-o", "r.nc", "--no-progress", "--set", "integrator.max_steps=3"}, 3);
    auto const at = ran.out.find("    slideway run $'");
    ASSERT_NE(at, std::string::npos) << ran.out;
    std::string const line = ran.out.substr(at + 4, ran.out.find('\n', at) - at - 4);
    write("again.sh", "slideway() { '" SLIDEWAY_BINARY "' \"$@\" -o again.nc --quiet; }\n" + line + "\n");
    EXPECT_EQ(WEXITSTATUS(std::system(("cd '" + path("").string() + "' && bash again.sh 2>err").c_str())), 3) << file_text(path("err"));
    EXPECT_TRUE(std::filesystem::exists(path("again.nc"))) << line;
}

}  // namespace
}  // namespace slideway::testing::escapes_test
