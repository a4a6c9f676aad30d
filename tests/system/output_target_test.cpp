// No command destroys a file that it was not told to replace: commands × what there is in the place of what they write.
#include <map>
#include <set>

#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/shell.hpp"
#include "tests/system/small_run.hpp"

namespace slideway::testing::output_target_test {
namespace {

namespace fs = std::filesystem;

struct Command {
    char const* name;
    std::vector<std::string> words;  // without its output
    char const* ending;
    std::vector<std::string> inputs;
};
std::vector<Command> const commands{
    {"run", {"run", "s.toml", "--no-progress", "--set", "study.members=2"}, ".nc", {"s.toml"}},
    {"table", {"run", "table.toml", "--no-progress"}, ".nc", {"table.toml", "members.csv"}},
    {"member", {"run", "s.toml", "--no-progress", "--member", "1"}, ".nc", {"s.toml"}},
    {"probe", {"probe", "s.toml"}, ".csv", {"s.toml"}},
    {"states", {"probe", "s.toml", "--csv", "states.csv"}, ".csv", {"s.toml", "states.csv"}},
    {"stats", {"stats", "series.nc", "--member", "0"}, ".csv", {"series.nc"}},
    {"column", {"stats", "series.csv", "--dt", "0.01"}, ".csv", {"series.csv"}},
    {"export", {"export", "series.nc"}, ".csv", {"series.nc"}},
    {"mat", {"export", "series.nc", "--series", "all"}, ".mat", {"series.nc"}},
    {"merge", {"merge", "parts.nc.shards"}, ".nc", {}},
};

class OutputTargets : public SmallRun {
protected:
    OutputTargets() {
        write("members.csv", "initial.y\n1e-5\n2e-5\n");
        std::string scene = small_scene;
        scene = scene.substr(0, scene.find("[study.vary]"));
        scene.replace(scene.find("members = 37"), 12, "design = \"table\"\ntable = \"members.csv\"");
        write("table.toml", scene);
        write("states.csv", "t,y,z,vy,vz,roll,yaw,pitch,wx,wy,wz\n0,1e-5,0,0,0,0,0,0,0,0,0\n");
        std::string series = "x\n";
        for (int i = 0; i < 600; ++i) series += std::to_string(std::sin(0.3 * i)) + "\n";
        write("series.csv", series);
        EXPECT_EQ(run_scene({"-o", "series.nc", "--set", "study.members=2", "study.samples=600", "study.duration=50 ms"}).code, 0);
        EXPECT_EQ(run_scene({"-o", "parts.nc", "--set", "study.members=2", "--shard", "1/1"}).code, 0);
    }

    Outcome with_output(Command const& command, std::string const& output, std::vector<std::string> more = {}) const {
        std::vector<std::string> words = command.words;
        words.insert(words.end(), {"-o", output});
        words.insert(words.end(), more.begin(), more.end());
        return run(std::move(words));
    }
    /// Refused in one line, and all files are as they were.
    void expect_untouched(Command const& command, std::string const& output, std::vector<std::string> const& more = {}) const {
        auto const before = files();
        Outcome const outcome = with_output(command, output, more);
        EXPECT_EQ(outcome.code, 4) << command.name << " -o " << output << ": " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(files(), before) << command.name << " -o " << output;
    }
    void expect_written(Command const& command, std::string const& output, std::vector<std::string> const& more = {}) const {
        Outcome const outcome = with_output(command, output, more);
        EXPECT_EQ(outcome.code, 0) << command.name << " -o " << output << ": " << outcome.err;
    }

    /// For a shell.
    static std::string forced(Command const& command, std::string const& output) {
        std::string line = "'" SLIDEWAY_BINARY "'";
        for (std::string const& word : command.words) line += " '" + word + "'";
        return line + " --force -o " + output;
    }

    /// Names with what they hold, of links what they lead to.
    std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> found;
        for (fs::directory_entry const& entry : fs::recursive_directory_iterator(path(""))) {
            std::string const name = entry.path().lexically_relative(path("")).string();
            if (name == "out" || name == "err" || name.starts_with("shell_")) continue;
            found[name] = fs::is_symlink(fs::symlink_status(entry.path())) ? "-> " + fs::read_symlink(entry.path()).string()
                          : fs::is_regular_file(fs::symlink_status(entry.path())) ? file_text(entry.path())
                                                    : "";
        }
        return found;
    }
};

TEST_F(OutputTargets, ThatAreInputsAreNeverReplaced) {
    for (Command const& command : commands) {
        for (std::string const& input : command.inputs) {
            expect_untouched(command, input);
            expect_untouched(command, "./" + input, {"--force"});
            fs::create_symlink(input, path("to_input"));
            fs::create_hard_link(path(input), path("same_input"));
            expect_untouched(command, "to_input", {"--force"});
            expect_untouched(command, "same_input", {"--force"});
            fs::remove(path("to_input"));
            fs::remove(path("same_input"));
        }
    }
    expect_untouched(commands.back(), "parts.nc.shards/run.toml", {"--force"});
}

TEST_F(OutputTargets, ThatAreForeignAreNeverReplaced) {
    for (Command const& command : commands) {
        std::string const name = std::string("notes") + command.ending;
        write(name, "My notes\nof a year\n");
        expect_untouched(command, name);
        expect_untouched(command, name, {"--force"});
        if (command.words.front() == "run") expect_untouched(command, name, {"--resume"});
    }
}

TEST_F(OutputTargets, ThatAreResultsAreReplacedWhereItIsSaid) {
    for (Command const& command : commands) {
        std::string const name = std::string("o_") + command.name + command.ending;
        expect_written(command, name);
        expect_untouched(command, name);
        expect_written(command, name, {"--force"});
        // A file without a byte is nothing that slideway leaves.
        write(name, "");
        expect_untouched(command, name);
        expect_untouched(command, name, {"--force"});
        fs::remove(path(name));
    }
}

/// A file that opens and cannot be read: nobody can tell whose it is.
TEST_F(OutputTargets, ThatCannotBeReadSayWhy) {
    for (Command const& command : commands) {
        Outcome const outcome = with_output(command, "/proc/self/mem", {"--force"});
        EXPECT_EQ(outcome.code, 4) << command.name;
        EXPECT_EQ(outcome.err, "/proc/self/mem: cannot read: Input/output error\n") << command.name;
    }
}

TEST_F(OutputTargets, OfOneCommandAreForeignToAnother) {
    for (Command const& command : commands) {
        bool const csv = command.ending == std::string(".csv");
        expect_untouched(command, csv ? "members.csv" : "states.csv", {"--force"});
        if (csv && command.words[1] != "series.nc") expect_untouched(command, "series.nc", {"--force"});
    }
    expect_written(commands[3], "p.csv");
    expect_untouched(commands[6], "p.csv", {"--force"});
}

TEST_F(OutputTargets, ThatAreLinksAreFollowed) {
    fs::create_directory(path("elsewhere"));
    for (Command const& command : commands) {
        std::string const name = std::string("o_") + command.name + command.ending, link = "link_" + name;
        fs::create_symlink("elsewhere/" + name, path(link));
        expect_written(command, link);
        EXPECT_TRUE(fs::is_symlink(path(link))) << command.name;
        EXPECT_TRUE(fs::is_regular_file(path("elsewhere/" + name))) << command.name;
        expect_untouched(command, link);
        expect_written(command, link, {"--force"});
        EXPECT_TRUE(fs::is_symlink(path(link))) << command.name;
    }
    fs::create_symlink("loop", path("loop"));
    for (Command const& command : commands) expect_untouched(command, "loop", {"--force"});
}

TEST_F(OutputTargets, ThatAreNoFilesAreRefused) {
    fs::create_directory(path("folder"));
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    for (Command const& command : commands) {
        for (char const* const name : {"folder", "pipe", "/dev/null", "/dev/full", "nowhere/o.nc"}) expect_untouched(command, name, {"--force"});
    }
}

/// As somebody who may not write there; root may write anywhere, and becomes nobody.
TEST_F(OutputTargets, InFoldersThatAreReadOnlyAreKept) {
    std::string const nobody = geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
    fs::permissions(path(""), fs::perms(0755));
    fs::create_directory(path("closed"));
    for (Command const& command : commands) expect_written(command, std::string("closed/o_") + command.name + command.ending);
    fs::permissions(path("closed"), fs::perms(0555));
    if (run_shell(path(""), nobody + "'" SLIDEWAY_BINARY "' --version").code != 0) GTEST_SKIP() << "nobody may start the program";
    auto const before = files();
    for (Command const& command : commands) {
        ShellOutcome const outcome = run_shell(path(""), nobody + forced(command, std::string("closed/o_") + command.name + command.ending));
        EXPECT_EQ(outcome.code, 4) << command.name << ": " << outcome.err;
        EXPECT_NE(outcome.err.find("Permission denied"), std::string::npos) << command.name << ": " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << command.name << ": " << outcome.err;
        EXPECT_EQ(files(), before) << command.name;
    }
    fs::permissions(path("closed"), fs::perms(0755));
}

/// To a program a limit of the size of files is what a full disk is.
TEST_F(OutputTargets, OnAFullDiskStayAsTheyWere) {
    for (Command const& command : commands) {
        std::string const name = std::string("o_") + command.name + command.ending;
        expect_written(command, name);
        std::string const before = file_text(path(name));
        ShellOutcome const outcome = run_shell(path(""), "( ( ulimit -f 0; exec " + forced(command, name) + " >/dev/null ); echo code $? ) 2>&1 | cat");
        EXPECT_TRUE(outcome.out.ends_with("\ncode 4\n")) << command.name << ": " << outcome.out;
        EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2) << command.name << ": " << outcome.out;
        EXPECT_TRUE(file_text(path(name)) == before) << command.name;
    }
}

TEST_F(OutputTargets, ThatComeUpWhileItRunsAreKept) {
    std::string const seconds = "study.duration=200 ms";
    pid_t const child = start({"run", "s.toml", "--no-progress", "-o", "late.nc", "--block-members", "8", "--set", seconds, "study.members=500", "study.verify=0"});
    ASSERT_TRUE(comes_true([&] { return fs::exists(path("late.nc.shards/run.toml")); }));
    write("late.nc", "of somebody else");
    Outcome const outcome = wait(child);
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("late.nc"), std::string::npos);
    EXPECT_EQ(file_text(path("late.nc")), "of somebody else");
    // Nothing that was computed is lost.
    fs::remove(path("late.nc"));
    Outcome const again = run({"run", "s.toml", "--no-progress", "-o", "late.nc", "--set", seconds, "study.members=500", "study.verify=0", "--resume"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(results("late.nc").values("status").size(), 500u);
}

/// While it is written a result is `o.nc.part`, beside a lock without a byte: whatever else has these names is somebody's.
TEST_F(OutputTargets, LeaveForeignFilesUnderTheNamesOfPartsAlone) {
    for (std::string const& name : {std::string("o.nc.part.lock"), std::string("o.nc.part")}) {
        write(name, "precious");
        for (std::size_t i : {0u, 2u, 9u}) expect_untouched(commands[i], "o.nc");
        fs::remove(path(name));
        fs::copy_file(path("s.toml"), path(name));  // the scene itself
        auto const before = files();
        EXPECT_EQ(run({"run", name, "--no-progress", "--set", "study.members=2", "-o", "o.nc"}).code, 4);
        EXPECT_EQ(files(), before);
        fs::remove(path(name));
    }
    // A merge that was killed leaves both.
    write("o.nc.part.lock", "");
    write("o.nc.part", "half a result");
    EXPECT_EQ(with_output(commands[0], "o.nc").code, 0);
    EXPECT_FALSE(fs::exists(path("o.nc.part")));
}

TEST_F(OutputTargets, AreNoShardsOfAnotherRun) {
    std::string shard;
    for (auto const& entry : fs::directory_iterator(path("parts.nc.shards"))) {
        std::string const name = entry.path().filename().string();
        if (name.starts_with("members-")) shard = "parts.nc.shards/" + name;
    }
    ASSERT_NE(shard, "");
    for (Command const& command : commands) expect_untouched(command, shard, {"--force"});
    EXPECT_EQ(run({"merge", "parts.nc.shards", "-o", "parts.nc"}).code, 0);
}

TEST_F(OutputTargets, ThatArePipesAreRefusedBeforeAnythingIsComputed) {
    ShellOutcome const shell = run_shell(path(""), "'" SLIDEWAY_BINARY "' run s.toml --no-progress -o /dev/stdout | cat");
    EXPECT_EQ(shell.out, "");
    EXPECT_NE(shell.err.find("/dev/stdout: is a device or a pipe"), std::string::npos) << shell.err;
    EXPECT_EQ(std::count(shell.err.begin(), shell.err.end(), '\n'), 1) << shell.err;
}

TEST_F(OutputTargets, ByDefaultDifferWhereOverridesDo) {
    std::set<std::string> names;
    for (std::vector<std::string> const& more : std::vector<std::vector<std::string>>{{},
                                                     {"--set", "study.members=2"},
                                                     {"--set", "study.members=3"},
                                                     {"--set", "initial.z=0.01 mm"},
                                                     {"--set", "initial.z=0.02 mm"},
                                                     {"--member", "1"}}) {
        std::vector<std::string> words{"run", "s.toml", "--no-progress"};
        words.insert(words.end(), more.begin(), more.end());
        Outcome const outcome = run(words);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        auto const at = outcome.out.rfind("results      ");
        names.insert(outcome.out.substr(at));
    }
    EXPECT_EQ(names.size(), 6u);
    EXPECT_TRUE(names.contains("results      s.nc\n"));
    EXPECT_TRUE(names.contains("results      s.study.members=2.nc\n"));
}

}  // namespace
}  // namespace slideway::testing::output_target_test
