// Every call of the runtime fails once: the worker is told so in one line, nothing is lost or left behind, and a card that is not
// lost does the next work.
#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/cuda/cards_run.hpp"

namespace slideway::simulated_failures_test {
namespace {

using testing::Lines;

/// What was tried when a function failed.
struct Tried {
    char const* function;
    char const* text;  // nullptr: nothing is told; who gives something back cannot be helped
    friend void PrintTo(Tried const& tried, std::ostream* out) { *out << tried.function; }
};

Tried const all_tried[] = {
    {"cudaGetDeviceCount", "cuda: no card can be used: unknown error (cudaErrorUnknown); use --backend cpu"},
    {"cudaGetDeviceProperties", "cuda: card 0: asking what it is failed"},
    {"cudaSetDevice", "cuda: simulated GPU: taking the card failed"},
    {"cudaFuncGetAttributes", "cuda: simulated GPU: loading a kernel failed"},
    {"cudaOccupancyMaxActiveBlocksPerMultiprocessor", "cuda: simulated GPU: asking for the kernel's occupancy failed"},
    {"cudaMemGetInfo", "cuda: simulated GPU: asking for its memory failed"},
    {"cudaStreamCreateWithFlags", "cuda: simulated GPU: making a stream failed"},
    {"cudaEventCreateWithFlags", "cuda: simulated GPU: making an event failed"},
    {"cudaHostAlloc", "cuda: simulated GPU: pinning "},
    {"cudaMalloc", "cuda: simulated GPU: allocating "},
    {"cudaMemcpyAsync", "cuda: simulated GPU: "},  // sending or fetching a block
    {"cudaLaunchKernel", "cuda: simulated GPU: starting a kernel failed"},
    {"cudaEventRecord", "cuda: simulated GPU: marking the end of a block failed"},
    {"cudaEventQuery", "cuda: simulated GPU: integrating a block failed"},
    {"cudaDeviceGetAttribute", "cuda: simulated GPU: asking for its "},
    {"cudaDriverGetVersion", nullptr},
    {"cudaFree", nullptr},
    {"cudaFreeHost", nullptr},
    {"cudaStreamSynchronize", nullptr},
    {"cudaStreamDestroy", nullptr},
    {"cudaEventDestroy", nullptr},
};

class FailingCalls : public testing::CardsRun, public ::testing::WithParamInterface<Tried> {};

TEST_P(FailingCalls, AreToldInOneLine) {
    auto const [function, text] = GetParam();
    auto const calls = calls_of("blocks 1 3 1");
    ASSERT_TRUE(calls.contains(function)) << "is it still used?";
    std::uint64_t last = calls.at(function);
    // How often the end of a block is asked for is chance; for each of the three it is once.
    if (std::string_view(function) == "cudaEventQuery") last = 3;
    for (std::uint64_t const n : {std::uint64_t(1), (last + 1) / 2, last}) {
        Lines const lines = run("FAIL=" + std::string(function) + ":" + std::to_string(n), "blocks 1 3 2");
        ASSERT_EQ(lines.size(), 2u);
        if (text == nullptr) {
            EXPECT_EQ(lines[0], "same bits");
        } else {
            EXPECT_TRUE(lines[0].starts_with(text)) << lines[0];
            bool const is_named = lines[0].ends_with(" failed: unknown error (cudaErrorUnknown)");
            EXPECT_TRUE(is_named || lines[0] == text) << lines[0];
        }
        EXPECT_EQ(lines[1], "same bits") << "call " << n;
    }
    // While others are at work, which go on or fail in turn.
    Lines const lines = run("DELAY=300 FAIL=" + std::string(function) + ":2", "blocks 3 3 2");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_TRUE(lines[0] == "same bits" || (text != nullptr && lines[0].starts_with(text))) << lines[0];
    EXPECT_TRUE(lines[0] == "same bits" || lines[1] == "same bits") << lines[1];
}

INSTANTIATE_TEST_SUITE_P(Of, FailingCalls, ::testing::ValuesIn(all_tried),
                         [](auto const& tried) { return std::string(tried.param.function); });

class SimulatedCard : public testing::CardsRun {};

TEST_F(SimulatedCard, NoOtherCallIsMade) {
    for (auto const& [function, count] : calls_of("blocks 2 3 1")) {
        if (function == "kernel" || function == "cudaGetDevice") continue;  // the second is the program's own
        bool const is_known = std::ranges::any_of(all_tried, [&](Tried const& t) { return t.function == function; });
        EXPECT_TRUE(is_known) << function << " needs a place in the table above";
    }
}

TEST_F(SimulatedCard, ALostCardIsToldToAll) {
    for (int const workers : {1, 3}) {
        for (char const* const kernel : {"kernel:1:214", "kernel:2:700", "kernel:3:719"}) {
            Lines const lines =
                run("DELAY=200 FAIL=" + std::string(kernel), "blocks " + std::to_string(workers) + " 3 2");
            ASSERT_EQ(lines.size(), 2u);
            EXPECT_TRUE(lines[0].starts_with("cuda: simulated GPU: ")) << lines[0];
            EXPECT_NE(lines[0].find(" failed: "), std::string::npos) << lines[0];
            EXPECT_NE(lines[0].find("(cudaError"), std::string::npos) << lines[0];
            EXPECT_TRUE(lines[1].starts_with("cuda: no card can be used: ")) << lines[1];
        }
    }
}

TEST_F(SimulatedCard, AKernelAtWorkEndsWithTheCallThatFailed) {
    for (char const* const call : {"cudaEventQuery:3", "cudaEventRecord:1", "cudaMemcpyAsync:2"}) {
        Lines const lines = run("FAIL=" + std::string(call), "endless", 15);
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_TRUE(lines[0].ends_with("failed: unknown error (cudaErrorUnknown)")) << lines[0];
    }
}

}  // namespace
}  // namespace slideway::simulated_failures_test
