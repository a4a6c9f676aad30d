// Cards of all kinds, and machines with none.
#include <cstdio>
#include <string>

#include "tests/cuda/cards_run.hpp"

namespace slideway::simulated_cards_test {
namespace {

using testing::Lines;

class SimulatedCards : public testing::CardsRun {
protected:
    /// How many members fit a block, each of so many bytes.
    struct Fit {
        std::size_t members = 0, bytes = 0;
    };
    Fit fit(std::string const& memory, int workers, int samples) {
        Lines const lines =
            run("MEMORY=" + memory, "memory " + std::to_string(workers) + " " + std::to_string(samples));
        Fit found;
        EXPECT_EQ(lines.size(), 2u);
        if (lines.size() != 2) return found;
        EXPECT_EQ(std::sscanf(lines[0].c_str(), "%zu members of %zu bytes", &found.members, &found.bytes), 2);
        EXPECT_EQ(lines[1], "fits");
        return found;
    }
};

TEST_F(SimulatedCards, ServeManyBlocksOfSeveralWorkers) {
    for (char const* const settings : {"DELAY=0", "DELAY=700", "MULTIPROCESSORS=1 DELAY=100"}) {
        EXPECT_EQ(run(settings, "blocks 4 9 1"), Lines{"same bits"}) << settings;
    }
}

TEST_F(SimulatedCards, UseTheirStreamsAgain) {
    auto calls = calls_of("blocks 3 9 1");
    EXPECT_EQ(calls["cudaLaunchKernel"], 27u);
    EXPECT_LE(calls["cudaStreamCreateWithFlags"], 3u);
    // Blocks of two sizes: the room of a stream grows once.
    EXPECT_LE(calls["cudaMalloc"], 6u);
    EXPECT_EQ(calls["cudaMalloc"], calls["cudaFree"]);
    EXPECT_EQ(calls["cudaHostAlloc"], calls["cudaFreeHost"]);
    EXPECT_EQ(calls["cudaStreamCreateWithFlags"], calls["cudaStreamDestroy"]);
    EXPECT_EQ(calls["cudaEventCreateWithFlags"], calls["cudaEventDestroy"]);
}

TEST_F(SimulatedCards, TakeBlocksAsTheirMemoryAllows) {
    std::size_t const memory = 160'000'000;
    auto const of = [&](std::string const& bytes, int workers) { return fit(bytes, workers, 4000); };
    Fit const one = of(std::to_string(memory), 1), three = of(std::to_string(memory), 3);
    EXPECT_GT(one.bytes, 4000u * 10 * 8);
    EXPECT_LE(one.members * one.bytes, memory);
    EXPECT_LE(3 * three.members * three.bytes, memory);
    EXPECT_NEAR(static_cast<double>(one.members) / static_cast<double>(three.members), 3, 0.05);
    EXPECT_LT(of("130000000", 1).members, one.members);
    // Without end they do not grow.
    EXPECT_EQ(fit("1000000000000", 1, 1).members, fit("2000000000000", 1, 1).members);
}

TEST_F(SimulatedCards, SayWhereNotOneMemberFits) {
    for (char const* const settings : {"MEMORY=50000000", "MEMORY=99000000", "MEMORY=300000000 MULTIPROCESSORS=16"}) {
        Lines const lines = run(settings, "memory 4 4000");
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_TRUE(lines[0].starts_with("cuda: simulated GPU has ")) << lines[0];
        EXPECT_NE(lines[0].find(": no room for a member of "), std::string::npos) << lines[0];
        EXPECT_NE(lines[0].find("for each of 4 workers; ask for fewer samples"), std::string::npos) << lines[0];
    }
}

TEST_F(SimulatedCards, TakeBlocksAsLargeAsAsked) {
    Lines const taken = run("MEMORY=160000000", "memory 2 4000 17");
    ASSERT_EQ(taken.size(), 2u);
    EXPECT_TRUE(taken[0].starts_with("17 members of ")) << taken[0];
    EXPECT_EQ(taken[1], "fits");
    Lines const refused = run("MEMORY=160000000", "memory 2 4000 1000");
    ASSERT_EQ(refused.size(), 1u);
    EXPECT_TRUE(refused[0].starts_with("cuda: simulated GPU has 160 MB free, and the threads' stacks take "))
        << refused[0];
    EXPECT_NE(refused[0].find(" members for each of 2 workers, not of 1000; use a smaller"), std::string::npos);
}

TEST_F(SimulatedCards, AreTakenInTurn) {
    for (int rank = 0; rank < 7; ++rank) {
        EXPECT_EQ(run("DEVICES=3", "card " + std::to_string(rank)), Lines{"card " + std::to_string(rank % 3)});
        EXPECT_EQ(run("DEVICES=1", "card " + std::to_string(rank)), Lines{"card 0"});
    }
    Lines const failed = run("DEVICES=3 FAIL=cudaGetDeviceProperties:1", "card 5");
    EXPECT_EQ(failed, Lines{"cuda: card 2: asking what it is failed: unknown error (cudaErrorUnknown)"});
}

TEST_F(SimulatedCards, ServeTheWorkersOfTheirRank) {
    EXPECT_EQ(run("DEVICES=3 DELAY=100", "blocks 3 4 2 7"), (Lines{"same bits", "same bits"}));
}

TEST_F(SimulatedCards, AreMissedInOneLine) {
    EXPECT_EQ(run("DEVICES=0", "card 0"), Lines{"cuda: there is no driver, and so no card; use --backend cpu"});
    EXPECT_EQ(run("FAIL=cudaGetDeviceCount:1:100", "card 0"), Lines{"cuda: there is no card; use --backend cpu"});
    EXPECT_EQ(run("DEVICES=-1", "card 0"), Lines{"cuda: no card can be used: the driver is too old for the runtime "
                                                 "(cudaErrorInsufficientDriver); use --backend cpu"});
    // Older than all that nvcc knows.
    Lines const old = run("ARCH=35", "card 0");
    ASSERT_EQ(old.size(), 1u);
    EXPECT_TRUE(old[0].starts_with("cuda: simulated GPU is of sm_35, and this build has kernels for sm_")) << old[0];
    EXPECT_TRUE(old[0].ends_with("; build with -DCMAKE_CUDA_ARCHITECTURES=35, or use --backend cpu")) << old[0];
}

}  // namespace
}  // namespace slideway::simulated_cards_test
