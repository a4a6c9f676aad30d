#include "host/base/process.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

namespace slideway::apart_test {
namespace {

constexpr ApartLimits limits{5, std::uint64_t{1} << 30};

TEST(WorkApart, GivesItsAnswerWhateverIsInIt) {
    std::string const long_text(300'000, 'x');
    for (std::string const& text : {std::string(), std::string("a\nb"), std::string(1, '\0'), long_text}) {
        auto const outcome = run_apart([&] { return text; }, limits);
        EXPECT_EQ(outcome.answer, text);
        EXPECT_EQ(outcome.signal, 0);
    }
}

TEST(WorkApart, ChangesNothingHere) {
    int number = 1;
    EXPECT_EQ(run_apart([&] { return std::to_string(number = 2); }, limits).answer, "2");
    EXPECT_EQ(number, 1);
}

TEST(WorkApart, ThatDiesIsTold) {
    for (int const signal : {SIGSEGV, SIGABRT, SIGBUS}) {
        auto const outcome = run_apart([&]() -> std::string { std::signal(signal, SIG_DFL), raise(signal); return "lived"; }, limits);
        EXPECT_FALSE(outcome.answer);
        EXPECT_EQ(outcome.signal, signal);
    }
    EXPECT_FALSE(run_apart([]() -> std::string { throw std::runtime_error("no"); }, limits).answer);
    EXPECT_FALSE(run_apart([]() -> std::string { _exit(0); }, limits).answer);
}

TEST(WorkApart, ThatDoesNotEndIsEnded) {
    auto const outcome = run_apart([]() -> std::string {
        for (bool volatile goes_on = true; goes_on;) {}
        return "ended";
    }, {1, limits.bytes});
    EXPECT_FALSE(outcome.answer);
    EXPECT_EQ(outcome.signal, SIGXCPU);
}

// Sanitizers map more than any limit.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(WorkApart, ThatTakesAllMemoryIsEnded) {
    EXPECT_FALSE(run_apart([] { return std::to_string(std::vector<char>(std::size_t{3} << 30).size()); }, limits).answer);
    EXPECT_EQ(run_apart([] { return std::to_string(std::vector<char>(1 << 20).size()); }, limits).answer, "1048576");
}
#endif

TEST(WorkApart, SaysNothingAndRunsNoHandlers) {
    std::string const trace = (std::filesystem::temp_directory_path() / ("slideway_apart_" + std::to_string(getpid()))).string();
    static char const* name;
    name = trace.c_str();
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::printf("once ");
    run_apart([] {
        std::atexit([] { std::fclose(std::fopen(name, "w")); });
        std::printf("out");
        std::fflush(stdout);
        std::fprintf(stderr, "err");
        return std::string();
    }, limits);
    std::fflush(stdout);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "once ");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_FALSE(std::filesystem::exists(trace));
}

}  // namespace
}  // namespace slideway::apart_test
