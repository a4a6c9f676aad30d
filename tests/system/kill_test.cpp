#include "tests/system/kills.hpp"

namespace slideway::testing::kill_test {
namespace {

TEST_F(KilledRun, GoesOnWhereItWas) { kill_and_resume(6, {"--threads", "2", "--block-members", "8"}); }

TEST_F(KilledRun, KeepsWhatItFinishedWhenItIsAskedToStop) {
    std::string const hash = undisturbed_hash();
    write_scene(400, "0.2 s");
    std::string const long_hash = undisturbed_hash();
    EXPECT_NE(hash, long_hash);
    pid_t const child = start(run_words({"--threads", "2", "--block-members", "8"}));
    for (int i = 0; i < 1000 && shards().listed.empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    auto const asked = std::chrono::steady_clock::now();
    kill(child, SIGTERM);
    Outcome const outcome = wait(child);
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(5));
    EXPECT_FALSE(std::filesystem::exists(path("o.nc")));
    expect_kept();
    std::uint64_t const finished = before_.count();
    EXPECT_GT(finished, 0u);
    EXPECT_LT(finished, 400u);
    EXPECT_NE(outcome.err.find(std::to_string(400 - finished) + " members have not run"), std::string::npos)
        << outcome.err;

    // Without --resume nobody touches the work of hours.
    Outcome const refused = run_scene({});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("--resume"), std::string::npos) << refused.err;
    expect_kept();

    Outcome const resumed = run_scene({"--resume"});
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(hash_of("o.nc"), long_hash);
    expect_no_leftovers();
}

TEST_F(KilledRun, IsDoneInStretchesOfLimitedTime) {
    write_scene(200, "0.1 s");
    std::string const hash = undisturbed_hash();
    int stretches = 0;
    for (int code = 5; code == 5 && stretches < 100; ++stretches) {
        Outcome const outcome =
            run_scene({"--threads", "1", "--block-members", "8", "--max-hours", "0.00008", "--resume"});  // 0.29 s
        code = outcome.code;
        ASSERT_TRUE(code == 5 || code == 0) << outcome.err;
        EXPECT_EQ(std::filesystem::exists(path("o.nc")), code == 0);
        expect_kept();
    }
    EXPECT_GT(stretches, 1);
    EXPECT_EQ(hash_of("o.nc"), hash);
    expect_no_leftovers();
}

TEST_F(KilledRun, StartsFreshWhereThereIsNothingToResume) {
    write_scene(400, "5 ms");
    std::string const hash = undisturbed_hash();
    EXPECT_EQ(run_scene({"--resume"}).code, 0);
    EXPECT_EQ(hash_of("o.nc"), hash);
    expect_no_leftovers();
}

}  // namespace
}  // namespace slideway::testing::kill_test
