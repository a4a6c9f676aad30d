// The man page and the completions, in the programs that read them.
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/support/shell.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::completion_test {
namespace {

class Completion : public Program {
protected:
    /// Runs a script in the test's folder; the program is on the path, for it says what may stand on a command line.
    ShellOutcome shell(std::string const& program, std::string const& script) const {
        write("script", script);
        std::string const folder = std::filesystem::path(SLIDEWAY_BINARY).parent_path().string();
        return run_shell(path(""), fmt::format("TERM=dumb HOME=$PWD PATH='{}':\"$PATH\" {} script", folder, program));
    }
    bool is_there(std::string const& program) const { return run_shell(path(""), "command -v " + program).code == 0; }
    std::string written(std::vector<std::string> const& options, std::string const& name) const {
        std::vector<std::string> arguments{"help"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        Outcome const outcome = run(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        write(name, outcome.out);
        return path(name).string();
    }
    /// What bash offers for the last of the words.
    std::string in_bash(std::vector<std::string> const& words) const {
        std::string quoted;
        for (std::string const& word : words) quoted += " '" + word + "'";
        ShellOutcome const outcome = shell("bash --norc", fmt::format("source ./s.bash\nCOMP_WORDS=({})\nCOMP_CWORD={}\n_slideway\n"
                                                                      "printf '%s\\n' \"${{COMPREPLY[@]}}\" | LC_ALL=C sort\n", quoted, words.size() - 1));
        EXPECT_EQ(outcome.err, "") << quoted;
        return outcome.out;
    }
};

TEST_F(Completion, OfBashKnowsCommandsOptionsAndValues) {
    if (!is_there("bash")) GTEST_SKIP() << "bash is not installed";
    written({"--completion", "bash"}, "s.bash");
    EXPECT_EQ(in_bash({"slideway", "me"}), "merge\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--max"}), "--max-failures\n--max-hours\n");
    EXPECT_EQ(in_bash({"slideway", "check", "--max"}), "\n") << "of run alone";
    EXPECT_EQ(in_bash({"slideway", "run", "--backend", ""}), "auto\ncpu\ncuda\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--isa", "sc"}), "scalar\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--isa", "=", "sc"}), "scalar\n") << "bash breaks words at =";
    EXPECT_EQ(in_bash({"slideway", "run", "--threads", ""}), "\n") << "a number";
    EXPECT_EQ(in_bash({"slideway", "help", "pro"}), "probe\n");
    for (char const* const name : {"o.csv", "o.mat", "o.nc"}) write(name, "");
    EXPECT_EQ(in_bash({"slideway", "export", "-o", "o"}), "o.csv\no.mat\n");
    EXPECT_EQ(in_bash({"slideway", "help", "--completion", "z"}), "zsh\n");
}

TEST_F(Completion, OfBashKnowsKeysAndTheirChoices) {
    if (!is_there("bash")) GTEST_SKIP() << "bash is not installed";
    written({"--completion", "bash"}, "s.bash");
    EXPECT_EQ(in_bash({"slideway", "run", "--set", "joint.clearance"}), "joint.clearance=\njoint.clearance_y=\njoint.clearance_y_minus=\njoint.clearance_y_plus=\njoint.clearance_z=\n"
                                                                           "joint.clearance_z_minus=\njoint.clearance_z_plus=\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--set", "contact.law", "="}), "conservative\nfoundation\nkelvin_voigt\npaper\nrigid\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--set", "contact.law", "=", "k"}), "kelvin_voigt\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--set", "contact.law=k"}), "contact.law=kelvin_voigt\n") << "where = breaks no words";
    EXPECT_EQ(in_bash({"slideway", "run", "--set", "study.seed", "=", "3", "friction.en"}), "friction.enabled=\n") << "--set takes many";
    EXPECT_EQ(in_bash({"slideway", "run", "--set", "study.seed", "=", "3", "--res"}), "--resume\n");
}

TEST_F(Completion, OfBashKnowsFilesByTheirEndings) {
    if (!is_there("bash")) GTEST_SKIP() << "bash is not installed";
    written({"--completion", "bash"}, "s.bash");
    for (char const* const name : {"x1.toml", "x2.nc", "x3.csv", "x4.html", "x 5.toml"}) write(name, "");
    std::filesystem::create_directory(path("x6.nc.shards"));
    EXPECT_EQ(in_bash({"slideway", "run", "x"}), "x 5.toml\nx1.toml\nx6.nc.shards\n");
    EXPECT_EQ(in_bash({"slideway", "run", "x1.toml", "-o", "x"}), "x2.nc\nx6.nc.shards\n");
    EXPECT_EQ(in_bash({"slideway", "stats", "x"}), "x2.nc\nx3.csv\nx6.nc.shards\n");
    EXPECT_EQ(in_bash({"slideway", "merge", "x"}), "x6.nc.shards\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--output", "=", "x2"}), "x2.nc\n");
    EXPECT_EQ(in_bash({"slideway", "run", "--output=x2"}), "--output=x2.nc\n") << "where = breaks no words";
}

TEST_F(Completion, OfFishKnowsCommandsOptionsAndValues) {
    std::string const script = written({"--completion", "fish"}, "s.fish");
    if (!is_there("fish")) GTEST_SKIP() << "fish is not installed";
    EXPECT_EQ(shell("fish -n", file_text(script)).code, 0);
    auto const offered = [&](std::string const& line) {
        return shell("fish", "source s.fish\ncomplete -C '" + line + "' | string split -f 1 \\t | LC_ALL=C sort\n").out;
    };
    EXPECT_EQ(offered("slideway me"), "merge\n");
    EXPECT_EQ(offered("slideway run --max"), "--max-failures\n--max-hours\n");
    EXPECT_EQ(offered("slideway check --max"), "");
    EXPECT_EQ(offered("slideway run --backend "), "auto\ncpu\ncuda\n");
    EXPECT_EQ(offered("slideway run --set contact.law="), "contact.law=conservative\ncontact.law=foundation\ncontact.law=kelvin_voigt\ncontact.law=paper\n");
    EXPECT_EQ(offered("slideway run --set joint.clearance_"), "joint.clearance_y=\njoint.clearance_z=\n");
    write("x1.toml", "");
    EXPECT_EQ(offered("slideway run x1"), "x1.toml\n");
}

TEST_F(Completion, OfZshKnowsCommandsOptionsAndValues) {
    std::string const script = written({"--completion", "zsh"}, "_slideway");
    if (!is_there("zsh")) GTEST_SKIP() << "zsh is not installed";
    EXPECT_EQ(shell("zsh -n", file_text(script)).code, 0);
    if (!std::filesystem::exists("/usr/share/zsh/functions/Completion")) GTEST_SKIP() << "the completion system of zsh is not installed";
    write("x1.toml", "");
    // A zsh on a terminal of its own; Tab completes in place, and a function in place of the program says what it got.
    auto const completed = [&](std::string const& line) {
        std::string const session = fmt::format(
            "zmodload zsh/zpty\nzpty z zsh -f -i\n"
            "zpty -w z \"PS1= ; fpath=($PWD \\$fpath); autoload -U compinit; compinit -u -D; slideway() {{ print -r -- G\\\"\\\"OT:\\$*:; exit }}\"\n"
            "sleep 1\nzpty -n -w z $'{}\\t\\n'\n"
            "for ((i = 0; i < 50; ++i)); do zpty -r -t z part && all+=$part; [[ $all == *GOT:*:* ]] && break; sleep 0.1; done\n"
            "print -r -- ${{${{all##*GOT:}}%%:*}}\n", line);
        return shell("zsh -f", session).out;
    };
    EXPECT_EQ(completed("slideway me"), "merge\n");
    EXPECT_EQ(completed("slideway run --max-h"), "run --max-hours\n");
    EXPECT_EQ(completed("slideway run --backend cu"), "run --backend cuda\n");
    EXPECT_EQ(completed("slideway run --set contact.law=k"), "run --set contact.law=kelvin_voigt\n");
    EXPECT_EQ(completed("slideway run --set joint.clearance_y"), "run --set joint.clearance_y=\n");
    EXPECT_EQ(completed("slideway run x"), "run x1.toml\n");
}

TEST_F(Completion, OfAnotherShellIsRefused) {
    expect_refusal(2, "use one of bash, zsh, fish", {"help", "--completion", "csh"});
    expect_refusal(2, "--completion", {"help", "--completion"});
}

TEST_F(Completion, ComesWithAManPageWithoutWarnings) {
    written({"--man"}, "slideway.1");
    bool checked = false;
    for (auto const& [program, command] :
         {std::pair{"groff", "groff -man -Tutf8 -ww slideway.1 >page"}, {"mandoc", "mandoc -T lint -W warning slideway.1 >&2"}}) {
        if (!is_there(program)) continue;
        checked = true;
        ShellOutcome const outcome = shell("sh", command);
        EXPECT_EQ(outcome.code, 0) << program;
        EXPECT_EQ(outcome.err, "") << program;
    }
    if (!checked) GTEST_SKIP() << "neither groff nor mandoc is installed";
}

TEST_F(Completion, AndTheManPageAreInstalled) {
    if (!is_there("cmake")) GTEST_SKIP() << "cmake is not installed";
    auto const build = std::filesystem::path(SLIDEWAY_BINARY).parent_path().parent_path();
    ShellOutcome const outcome = shell("sh", fmt::format("cmake --install '{}' --prefix '{}'", build.string(), path("prefix").string()));
    ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    std::array<std::pair<char const*, std::vector<std::string>>, 4> const files{{{"man/man1/slideway.1", {"help", "--man"}},
                                                                               {"bash-completion/completions/slideway", {"help", "--completion", "bash"}},
                                                                               {"zsh/site-functions/_slideway", {"help", "--completion", "zsh"}},
                                                                               {"fish/vendor_completions.d/slideway.fish", {"help", "--completion", "fish"}}}};
    for (auto const& [file, arguments] : files) EXPECT_EQ(file_text(path("prefix") / "share" / file), run(arguments).out) << file;
    EXPECT_TRUE(std::filesystem::exists(path("prefix/bin/slideway")));
}

TEST_F(Completion, IsLeftOutWhereTheProgramDoesNotRun) {
    if (!is_there("cmake")) GTEST_SKIP() << "cmake is not installed";
    ShellOutcome const outcome = shell("sh", fmt::format("cmake -DSLIDEWAY_PROGRAM=/nowhere/slideway -DCMAKE_INSTALL_PREFIX='{}' -P '{}/cmake/pages.cmake'",
                                                    path("prefix").string(), SLIDEWAY_SOURCE));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("does not run here"), outcome.out.npos) << outcome.out;
    EXPECT_FALSE(std::filesystem::exists(path("prefix")));
}

}  // namespace
}  // namespace slideway::testing::completion_test
