// Which backend a run takes, what it says of it, and what it asks of the card's memory.
#include <algorithm>

#include <fmt/format.h>

#include "host/study/backend_choice.hpp"
#include "tests/cuda/simulated_run.hpp"
#include "tests/system/orbits.hpp"

namespace slideway::testing::simulated_choice_test {
namespace {

constexpr char const* scene = R"(
schema = 1
[study]
members = 100
duration = "1 ms"
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

class Choice : public SimulatedRun {
protected:
    Choice() { write("s.toml", scene); }
    /// The line on stderr about the backend.
    std::string said(std::vector<std::string> options) const {
        options.insert(options.begin(), {"run", "s.toml", "-o", "s.nc", "--threads", "1"});
        Outcome const outcome = run(options);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err.substr(0, outcome.err.find('\n'));
    }
    std::string const processor_ = fmt::format("backend cpu ({}, {} lanes)", name_of(best_isa()), lanes_of(best_isa()));
    std::uint64_t const enough_ = pays_from(best_isa(), 1);
    std::string members(std::uint64_t count) const { return fmt::format("study.members={}", count); }
};

TEST_F(Choice, OfAutoIsTheCardWhereItPays) {
    EXPECT_EQ(said({"--set", members(enough_)}),
              fmt::format("backend cuda (simulated GPU, sm_90): it pays from about {} members on", enough_));
    EXPECT_EQ(results("s.nc").attribute("backend"), "cuda");
    EXPECT_EQ(said({"--set", members(enough_ - 1)}),
              fmt::format("{}: simulated GPU, sm_90 pays from about {} members on", processor_, enough_));
    EXPECT_EQ(results("s.nc").attribute("backend"), "cpu");
}

TEST_F(Choice, OfAutoCountsWhatMayBeAtWorkAtOnce) {
    std::string const few = fmt::format("{}: simulated GPU, sm_90 pays from about {} members on", processor_, enough_);
    // A part of the run.
    write("s.toml", scene);
    Outcome const part =
        run({"run", "s.toml", "-o", "s.nc", "--threads", "1", "--set", members(enough_), "--shard", "1/2"});
    EXPECT_EQ(part.err.substr(0, part.err.find('\n')), few);
    // The columns of a sweep that continues follow one another.
    write("s.toml", orbits::plain_sweep);
    std::vector<std::string> words{"check", "s.toml", "--threads", "1", "--set", members(enough_ / 2)};
    EXPECT_NE(run(words).out.find("cuda (simulated GPU, sm_90)"), std::string::npos);
    words.push_back(orbits::continued_key);
    EXPECT_NE(run(words).out.find(fmt::format("pays from about {} members on", enough_)), std::string::npos);
    EXPECT_EQ(run(words).out.find("cuda ("), std::string::npos);
}

TEST_F(Choice, OfAutoIsNoCardThatIsSlowOrEndsItsKernels) {
    std::vector<std::string> const many{"--set", members(enough_)};
    {
        Setting const display("WATCHDOG", "1");
        EXPECT_EQ(said(many), processor_ + ": simulated GPU drives a display, and its driver ends kernels that last");
        EXPECT_EQ(said({"--backend", "cuda"}), "backend cuda (simulated GPU, sm_90)");
    }
    {
        Setting const slow("ARCH", "120");
        EXPECT_EQ(said(many), processor_ + ": simulated GPU, sm_120 is not made for double precision");
    }
    Setting const unknown("ARCH", "100");
    std::string const refused = processor_ + ": cuda: simulated GPU is of sm_100, and this build has kernels for sm_";
    EXPECT_EQ(said(many).substr(0, refused.size()), refused);
    EXPECT_EQ(run_scene("s.toml", "s.nc", {}).code, 4);
}

TEST_F(Choice, OfAutoIsTheProcessorWhereTheCardLacksTheMemory) {
    Setting const memory("MEMORY", "101000000");
    EXPECT_TRUE(said({"--set", members(enough_), "study.samples=60000"})
                    .starts_with(processor_ + ": cuda: simulated GPU has 101 MB"));
    EXPECT_TRUE(said({"--set", members(enough_), "--block-members", "4000"})
                    .starts_with(processor_ + ": cuda: simulated GPU has 101 MB"));
    Setting const fail("FAIL", "cudaMemGetInfo:1");
    EXPECT_EQ(said({"--set", members(enough_)}),
              processor_ + ": cuda: simulated GPU: asking for its memory failed: unknown error (cudaErrorUnknown)");
}

TEST_F(Choice, OfTheUserIsTaken) {
    EXPECT_EQ(said({"--backend", "cuda", "--set", members(1)}), "backend cuda (simulated GPU, sm_90)");
    EXPECT_EQ(said({"--backend", "cpu", "--set", members(enough_)}), processor_);
    EXPECT_EQ(said({"--isa", "scalar", "--set", members(enough_)}), "backend cpu (scalar, 1 lanes): as --isa says");
}

TEST_F(Choice, WithoutACardIsTheProcessor) {
    {
        Setting const none("DEVICES", "0");
        EXPECT_EQ(said({"--set", members(enough_)}), processor_);
        Outcome const outcome = run_scene("s.toml", "s.nc", {});
        EXPECT_EQ(outcome.code, 4);
        EXPECT_EQ(outcome.err, "cuda: there is no driver, and so no card; use --backend cpu\n");
    }
    Setting const old("DEVICES", "-1");
    std::string const line = said({"--set", members(enough_)});
    EXPECT_TRUE(line.starts_with(processor_ + ": cuda: no card can be used: ")) << line;
    EXPECT_TRUE(line.ends_with("(cudaErrorInsufficientDriver)")) << line;
}

TEST_F(Choice, IsWhatCheckAndListSay) {
    Outcome const check = run({"check", "s.toml", "--backend", "cuda"});
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_NE(check.out.find("cuda (simulated GPU, sm_90), "), std::string::npos) << check.out;
    EXPECT_NE(check.out.find(" on the card\n"), std::string::npos) << check.out;
    EXPECT_EQ(run({"check", "s.toml", "--backend", "cpu"}).out.find("card"), std::string::npos);
    EXPECT_NE(run({"list"}).out.find("cuda (simulated GPU, sm_90)"), std::string::npos);
}

class CardMemory : public Choice {
protected:
    Outcome run_with(std::uint64_t bytes, std::vector<std::string> const& options) const {
        Setting const memory("MEMORY", std::to_string(bytes));
        return run_scene("s.toml", "s.nc", options);
    }
    /// What `check` says that a run takes of the card [B], of four digits.
    double told(std::vector<std::string> options) const {
        options.insert(options.begin(), {"check", "s.toml", "--backend", "cuda"});
        Outcome const outcome = run(options);
        auto const end = outcome.out.find(" MB on the card");
        EXPECT_NE(end, std::string::npos) << outcome.out;
        return 1e6 * std::stod(outcome.out.substr(outcome.out.rfind(' ', end - 1)));
    }
    /// Of which each member needs 0.4 MB.
    std::vector<std::string> const sampled_{"--threads", "1", "--set", "study.samples=5000"};
};

TEST_F(CardMemory, ThatIsToldIsEnough) {
    double const bytes = told(sampled_);
    EXPECT_GT(bytes, 100 * 5000 * 10 * 8);
    // A tenth stays free.
    EXPECT_EQ(run_with(static_cast<std::uint64_t>(1.12 * bytes), sampled_).code, 0);
}

TEST_F(CardMemory, ThatIsTooSmallForAllTakesThemInBatches) {
    std::string const hash = processor_hash("s.toml", sampled_);
    // All hundred would need 40 MB beside the stacks.
    auto const bytes = static_cast<std::uint64_t>(told({"--threads", "1", "--set", "study.members=1"}) + 12e6);
    Outcome const outcome = run_with(bytes, sampled_);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(hash_of("s.nc"), hash);
    std::vector<std::string> at_once = sampled_;
    at_once.insert(at_once.end(), {"--block-members", "100"});
    EXPECT_EQ(run_with(bytes, at_once).code, 4);
}

TEST_F(CardMemory, ThatIsTooSmallForAMemberIsToldBeforeTheStart) {
    Outcome const outcome = run_with(20'000'000, {"--threads", "1"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_TRUE(outcome.err.starts_with("cuda: simulated GPU has 20 MB free")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(std::filesystem::exists(path("s.nc.shards")));
    Setting const memory("MEMORY", "20000000");
    std::string const line = said({"--set", members(enough_)});
    EXPECT_TRUE(line.starts_with(processor_ + ": cuda: simulated GPU has 20 MB free")) << line;
}

TEST_F(CardMemory, ThatABlockAskedForDoesNotFitIsToldBeforeTheStart) {
    Outcome const outcome =
        run_with(120'000'000, {"--threads", "2", "--block-members", "100", "--set", "study.samples=5000"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("not of 100; use a smaller --block-members, fewer --threads, or --backend cpu"),
              std::string::npos)
        << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path("s.nc.shards")));
}

}  // namespace
}  // namespace slideway::testing::simulated_choice_test
