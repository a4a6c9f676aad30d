#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/run/ranks.hpp"
#include "tests/support/mpirun.hpp"
#include "tests/support/sanitizer.hpp"

namespace slideway::testing::ranks_test {
namespace {

std::optional<Launch> launch_in(std::map<std::string, std::string> const& variables) {
    return find_launch([&](char const* name) {
        auto const found = variables.find(name);
        return found == variables.end() ? nullptr : found->second.c_str();
    });
}

TEST(Launcher, IsKnownByTheVariablesItSets) {
    struct Case {
        std::map<std::string, std::string> variables;
        int count;
        bool first;
    };
    for (auto const& [variables, count, first] :
         {Case{{{"OMPI_COMM_WORLD_SIZE", "4"}, {"OMPI_COMM_WORLD_RANK", "0"}, {"PMIX_RANK", "0"}}, 4, true},
          Case{{{"OMPI_COMM_WORLD_SIZE", "4"}, {"OMPI_COMM_WORLD_RANK", "3"}, {"PMIX_RANK", "3"}}, 4, false},
          Case{{{"PMI_SIZE", "2"}, {"PMI_RANK", "1"}, {"PMI_FD", "7"}}, 2, false},
          Case{{{"MV2_COMM_WORLD_SIZE", "8"}, {"MV2_COMM_WORLD_RANK", "0"}}, 8, true},
          Case{{{"PMIX_RANK", "2"}, {"SLURM_STEP_NUM_TASKS", "16"}}, 16, false}, Case{{{"PMIX_RANK", "0"}}, 0, true}}) {
        auto const launch = launch_in(variables);
        ASSERT_TRUE(launch) << variables.begin()->first;
        EXPECT_EQ(launch->count, count) << variables.begin()->first;
        EXPECT_EQ(launch->first, first) << variables.begin()->first;
        EXPECT_TRUE(variables.contains(launch->told_by));
    }
}

TEST(Launcher, IsNobodyInAPlainShellOrBatchJob) {
    EXPECT_FALSE(launch_in({}));
    EXPECT_FALSE(launch_in({{"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "0"}, {"SLURM_JOB_ID", "17"}}));
    EXPECT_FALSE(launch_in({{"OMPI_COMM_WORLD_SIZE", ""}, {"PMI_SIZE", "many"}}));
}

/// Runs ranks_program in a folder of its own.
class RanksOfAJob : public ::testing::Test {
protected:
    RanksOfAJob() : folder_(std::filesystem::temp_directory_path() / ("slideway_ranks_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~RanksOfAJob() override { std::filesystem::remove_all(folder_); }
    void SetUp() override {
        if (auto const why = why_no_ranks(); !why.empty()) GTEST_SKIP() << why;
    }

    ShellOutcome job(int ranks, std::string const& words) const {
        return run_shell(folder_, mpirun(ranks, 60) + program + words);
    }
    ShellOutcome shell(std::string const& command) const { return run_shell(folder_, command); }

    static inline std::string const program = "'" SLIDEWAY_RANKS_PROGRAM "' ";

private:
    std::filesystem::path folder_;
};

std::vector<std::string> lines_of(std::string const& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST_F(RanksOfAJob, GetEveryPlaceOnce) {
    constexpr std::size_t count = 1500;
    for (int const ranks : {1, 2, 3}) {
        for (int const threads : {1, 4}) {
            if (ranks == 2 && threads == 4) continue;  // as one and three are
            SCOPED_TRACE(std::to_string(ranks) + " ranks of " + std::to_string(threads) + " threads");
            ShellOutcome const outcome = job(ranks, "places 1500 " + std::to_string(threads) + " 7");
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            std::vector<int> taken(count, 0), by(static_cast<std::size_t>(ranks), 0);
            int reported = -1, lefts = 0;
            for (std::string const& line : lines_of(outcome.out)) {
                std::istringstream words(line);
                std::string word;
                std::size_t rank = 0, first = 0, stretch = 0;
                words >> word;
                if (word == "reported") words >> reported;
                if (word == "left") {
                    EXPECT_EQ(line, "left 0");
                    ++lefts;
                }
                if (word != "place") continue;
                words >> rank >> first >> stretch;
                ASSERT_LT(rank, by.size());
                ASSERT_LE(first + stretch, count);
                EXPECT_LE(stretch, 7u);
                for (std::size_t i = first; i < first + stretch; ++i) ++taken[i];
                by[rank] += static_cast<int>(stretch);
            }
            EXPECT_EQ(taken, std::vector<int>(count, 1));
            EXPECT_EQ(lefts, ranks);
            EXPECT_EQ(reported, static_cast<int>(count) - by[0]);  // what other ranks finish, rank 0 hears
            EXPECT_EQ(reported > 0, ranks > 1);
        }
    }
}

TEST_F(RanksOfAJob, GetNoPlaceOnceOneAbandons) {
    for (int const ranks : {1, 3}) {
        ShellOutcome const outcome = job(ranks, "abandon");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        std::string expected = "ranks " + std::to_string(ranks) + "\n";
        for (int i = 0; i < ranks; ++i) expected += "rank " + std::to_string(i) + " stopped\n";
        EXPECT_EQ(outcome.out, expected);
    }
}

TEST_F(RanksOfAJob, TellEachOtherTextsOfAnyLength) {
    for (int const ranks : {1, 3}) {
        SCOPED_TRACE(std::to_string(ranks) + " ranks");
        ShellOutcome const outcome = job(ranks, "texts 0 1 5000 10000000");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        std::string expected = "ranks " + std::to_string(ranks) + "\n";
        for (std::string const bytes : {"0", "1", "5000", "10000000"}) {
            expected += bytes + " bytes\n";
            for (char const* const code : {"7", "42"}) {
                expected += "gathered all\n";
                for (int i = 0; i < ranks; ++i)
                    expected += "rank " + std::to_string(i) + " got the text and " + code + "\n";
            }
        }
        EXPECT_EQ(outcome.out, expected);
    }
}

TEST_F(RanksOfAJob, KnowTheirPlaceOnTheirMachine) {
    for (int const ranks : {1, 3}) {
        std::string expected = fmt::format("ranks {}\n", ranks);
        for (int i = 0; i < ranks; ++i) expected += fmt::format("rank {} is {} of {} here\n", i, i, ranks);
        ShellOutcome const outcome = job(ranks, "machine");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, expected);
    }
}

TEST_F(RanksOfAJob, EndTogetherWhenOneFails) {
    for (int const ranks : {1, 3}) {
        ShellOutcome const outcome = job(ranks, "failure");
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_EQ(outcome.out, "ranks " + std::to_string(ranks) + "\nheard disk.nc: no space left\n");
    }
}

TEST_F(RanksOfAJob, EndWhenOneLeavesWithoutAWord) {
    for (char const* const who : {"0", "2"}) {
        auto const start = std::chrono::steady_clock::now();
        ShellOutcome const outcome = job(3, std::string("desertion ") + who);
        EXPECT_EQ(outcome.code, 6) << outcome.err;
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
        EXPECT_NE(outcome.err.find("failed: left\n"), std::string::npos) << outcome.err;
    }
}

TEST_F(RanksOfAJob, EndWhenRankZeroFailsAmidTheirWork) {
    for (char const* const what : {"crowded", "deaf"}) {
        SCOPED_TRACE(what);
        if (memory_is_watched && std::string_view(what) == "crowded") continue;  // has no memory for another thread
        ShellOutcome const outcome = job(3, what);
        EXPECT_EQ(outcome.code, 4) << outcome.err;  // not 124, that of what hangs
        EXPECT_NE(outcome.err.find("in a round\n"), std::string::npos) << outcome.err;
    }
}

TEST_F(RanksOfAJob, WaitForEachOtherWithoutLoad) {
    ShellOutcome const outcome = job(3, "waiting");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::map<std::string, int> seen;
    for (std::string const& line : lines_of(outcome.out)) {
        std::istringstream words(line);
        std::string name;
        double load = 1;
        words >> name >> load;
        if (name == "ranks") continue;
        ++seen[name];
        EXPECT_LT(load, 0.2) << line;
    }
    EXPECT_EQ(seen, (std::map<std::string, int>{{"gather", 1}, {"agree", 2}}));
}

TEST_F(RanksOfAJob, OfAnotherMpiAreRefused) {
    // Another launcher's variables: this MPI does not know them, and each process would take itself for the only one.
    // An MPI that begins, and is not ended, keeps its memory: a build that looks for leaks is not to look here.
    ShellOutcome const outcome = shell("ASAN_OPTIONS=detect_leaks=0 PMI_SIZE=2 PMI_RANK=1 " + program + "abandon");
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_TRUE(outcome.err.starts_with("slideway: PMI_SIZE says that this is one of 2 processes")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(RanksOfAJob, OfABuildWithoutMpiAreRefused) {
    // Each of them would run everything.
    std::string const lone = "'" SLIDEWAY_LONE_PROGRAM "' abandon";
    ShellOutcome const two = shell(mpirun(2) + lone);
    EXPECT_EQ(two.code, 2) << two.out;
    EXPECT_EQ(two.out, "");
    EXPECT_NE(two.err.find("says that this is one of 2 processes, but this slideway was built without MPI"),
              std::string::npos)
        << two.err;
    EXPECT_EQ(shell(mpirun(1) + lone).code, 0);
    EXPECT_EQ(shell(lone).code, 0);
    EXPECT_EQ(shell("PMIX_RANK=1 " + lone).code, 2);
}

TEST(RankAlone, HasAllToItselfWithoutMpi) {
    auto const ranks = Ranks::join();
    EXPECT_EQ(ranks->rank(), 0);
    EXPECT_EQ(ranks->count(), 1);
    EXPECT_EQ(ranks->local_rank(), 0);
    EXPECT_EQ(ranks->local_count(), 1);
    EXPECT_EQ(ranks->broadcast("scene"), "scene");
    auto const queue = ranks->share(10, nullptr);
    EXPECT_EQ(queue->take(7, 0).count, 7u);
    EXPECT_EQ(queue->left(), 3u);
    Stretch const rest = queue->take(7, 7);
    EXPECT_EQ(rest.first, 7u);
    EXPECT_EQ(rest.count, 3u);
    EXPECT_EQ(queue->take(1, 3).count, 0u);
    EXPECT_EQ(ranks->gather("results"), std::vector<std::string>{"results"});
    EXPECT_EQ(ranks->agree(5), 5);
    // Where MPI is linked it can say that nobody started it.
    if (auto* const symbol = dlsym(RTLD_DEFAULT, "MPI_Initialized")) {
        int is_initialised = 1;
        reinterpret_cast<int (*)(int*)>(symbol)(&is_initialised);
        EXPECT_EQ(is_initialised, 0);
    }
}

}  // namespace
}  // namespace slideway::testing::ranks_test
