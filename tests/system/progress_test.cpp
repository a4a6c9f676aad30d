// What a run says of its progress where nobody sits before a terminal.
#include <csignal>
#include <regex>

#include "tests/system/small_run.hpp"

namespace slideway::testing::progress_test {
namespace {

class ProgressLines : public SmallRun {
protected:
    /// What stderr says once it has said the word, of a run that then is ended.
    std::string said_until(std::string const& word, std::vector<std::string> const& options) {
        std::vector<std::string> words{"run", "s.toml", "-o", "s.nc", "--threads", "1", "--set", "study.members=1", "study.samples=0"};
        words.insert(words.end(), options.begin(), options.end());
        pid_t const child = start(words);
        EXPECT_TRUE(comes_true([&] { return file_text(path("err")).find(word) != std::string::npos; }));
        kill(child, SIGTERM);
        Outcome const outcome = wait(child);
        EXPECT_EQ(outcome.code, 5) << outcome.err;
        return outcome.err;
    }
};

TEST_F(ProgressLines, OfOneMemberTellHowFarItIs) {
    // A minute of work, and more.
    std::string const err = said_until("members/s", {"study.duration=1000"});
    std::smatch line;
    ASSERT_TRUE(std::regex_search(err, line, std::regex(R"( *([0-9.]+) %  0 of 1 members  [0-9.e-]+ members/s  ETA [0-9]+:[0-9:]+\n)"))) << err;
    EXPECT_GT(std::stod(line[1]), 0);
    EXPECT_LT(std::stod(line[1]), 100);
}

/// One of them takes a minute, all others milliseconds: all threads work on one block, which ends with the last member.
TEST_F(ProgressLines, CountMembersThatEndedBesideOneThatGoesOn) {
    write("table.csv", "initial.y [mm],mechanism.crank_speed [rad/s]\n0.01,300\n0,0.001\n0,0.001\n0,0.001\n0,0.001\n0,0.001\n");
    write("s.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nkind = \"tolerance\"\ndesign = \"table\"\ntable = \"table.csv\"\nduration = 100\n"
                    "quantities = [\"mean_normal_force\"]\n");
    for (char const* const threads : {"1", "2"}) {
        std::filesystem::remove(path("err"));
        pid_t const child = start({"run", "s.toml", "-o", "s.nc", "--threads", threads});
        EXPECT_TRUE(comes_true([&] { return file_text(path("err")).find(" 5 of 6 members ") != std::string::npos; }));
        kill(child, SIGTERM);
        EXPECT_EQ(wait(child).code, 5);
        std::filesystem::remove_all(path("s.nc.shards"));
    }
}

TEST_F(ProgressLines, TellHowFarTheCheckIs) {
    // The member takes seconds; running it again, by two methods at a hundredth of the tolerance, some fourteen times as long.
    std::string const err = said_until("checking:", {"study.duration=10", "--verify"});
    EXPECT_TRUE(std::regex_search(err, std::regex(R"(checking: +[0-9.]+ % of 1 members  ETA )"))) << err;
    EXPECT_EQ(err.find("100.0 % of 1 members"), std::string::npos) << err;
}

}  // namespace
}  // namespace slideway::testing::progress_test
