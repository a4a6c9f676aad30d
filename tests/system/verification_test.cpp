// What a run says of its own numbers.
#include "tests/system/small_run.hpp"

namespace slideway::testing::verification_test {
namespace {

class VerifiedRun : public SmallRun {
protected:
    Outcome verified(std::vector<std::string> options) const {
        options.insert(options.begin(), {"run", "s.toml", "--no-progress", "--verify", "-o", "o.nc"});
        return run(std::move(options));
    }
    std::string of_group(char const* attribute) const { return results("o.nc").group_attribute("verification", attribute); }
};

/// A tolerance that keeps resting contacts ringing.
std::vector<std::string> const coarse{"--set", "integrator.method=dopri5", "--set", "integrator.rtol=1e-3", "--set", "contact.law=conservative",
                                      "--set", "study.duration=0.15 s", "--set", R"(study.quantities=["rms_acceleration","mode_time"])"};

TEST_F(VerifiedRun, OfAFallInFreeFlightIsResolved) {
    Outcome const outcome = verified({"--set", "study.duration=1 ms"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\nresolved: "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" by auto at rtol 1e-08"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" by verner65 at rtol 1e-08"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(of_group("resolution"), "resolved");
    EXPECT_NE(run({"info", "o.nc"}).out.find("\nresolved: "), std::string::npos);
}

TEST_F(VerifiedRun, OfADrivenPlanarMechanismComparesMembersThatFinished) {
    // Its crank turns on between the start and the end, where the contacts are looked at.
    for (std::string const law : {"", "contact.law=rigid"}) {
        std::vector<std::string> command{"run",   std::string(SLIDEWAY_SCENES) + "/crosshead.toml", "--set", "study.members=16", "--set", "study.verify=8",
                                         "--force", "--no-progress", "-o", "planar.nc"};
        if (!law.empty()) command.insert(command.end(), {"--set", law});
        Outcome const outcome = run(command);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.out.find(": 8 members again"), std::string::npos) << outcome.out;
        EXPECT_EQ(outcome.out.find("cut short"), std::string::npos) << outcome.out;
    }
}

TEST_F(VerifiedRun, WithContactsThatRingByItsToleranceIsNot) {
    Outcome const outcome = verified(coarse);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\nNOT RESOLVED by dopri5 at rtol 1e-03: "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("warning: NOT RESOLVED"), std::string::npos) << outcome.err;
    EXPECT_EQ(of_group("resolution"), "not_resolved");
}

TEST_F(VerifiedRun, HasThePayloadOfAnUncheckedOne) {
    ASSERT_EQ(verified({}).code, 0);
    ASSERT_EQ(run_scene({"--set", "study.verify=0", "-o", "p.nc"}).code, 0);
    EXPECT_EQ(hash_of("o.nc"), hash_of("p.nc"));
    EXPECT_EQ(run({"info", "o.nc"}).code, 0);
}

TEST_F(VerifiedRun, UnaskedTakesAtMostATenthOfTheWork) {
    // 37 members leave no room for as many as it needs.
    Outcome const outcome = run_scene({"-o", "o.nc"});
    EXPECT_NE(outcome.out.find("not checked against tighter tolerances: a tenth of the study's work"), std::string::npos) << outcome.out;
    EXPECT_EQ(of_group("resolution"), "not_checked");

    ASSERT_EQ(run_scene({"-o", "many.nc", "--set", "study.members=1000", "--set", "study.samples=0"}).code, 0);
    ResultReader const file = results("many.nc");
    EXPECT_NE(file.group_attribute("verification", "resolution"), "not_checked") << file.group_attribute("verification", "summary");
    double const share = std::stod(file.group_attribute("verification", "share_of_work"));
    EXPECT_GT(share, 0);
    EXPECT_LE(share, 0.1);
}

TEST_F(VerifiedRun, OfStatisticsAloneIsCheckedToo) {
    ASSERT_EQ(run_scene({"-o", "o.nc", "--set", "study.members=1000", "--set", "study.samples=0", "--set", "study.store=statistics"}).code, 0);
    EXPECT_NE(of_group("resolution"), "not_checked") << of_group("summary");
    EXPECT_LE(std::stod(of_group("share_of_work")), 0.1);
}

TEST_F(VerifiedRun, GoesOnAfterItsEnd) {
    ASSERT_EQ(run_scene({"-o", "whole.nc", "--set", "study.members=1000", "--set", "study.samples=0"}).code, 0);
    ASSERT_EQ(run_scene({"-o", "o.nc", "--set", "study.members=1000", "--set", "study.samples=0", "--shard", "1/2"}).code, 0);
    ASSERT_EQ(run_scene({"-o", "o.nc", "--set", "study.members=1000", "--set", "study.samples=0", "--resume"}).code, 0);
    EXPECT_EQ(hash_of("o.nc"), hash_of("whole.nc"));
    EXPECT_EQ(of_group("summary"), results("whole.nc").group_attribute("verification", "summary"));
}

/// As a single run: the check is the same, whoever ran the members.
TEST_F(VerifiedRun, OfPartsIsCheckedWhereTheyAreMerged) {
    for (std::string const& more : {std::string("study.seed=1"), std::string("study.verify=6"), std::string("study.verify=0")}) {
        auto const parts = [&](std::string const& output, std::vector<std::string> options) {
            options.insert(options.begin(), {"-o", output, "--force", "--set", "study.members=1000", "study.samples=0", more});
            EXPECT_EQ(run_scene(options).code, 0);
        };
        parts("whole.nc", {});
        parts("o.nc", {"--shard", "1/2"});
        Outcome const half = run({"merge", "o.nc.shards", "-o", "half.nc", "--force"});
        EXPECT_EQ(half.code, 5) << half.err;
        EXPECT_EQ(results("half.nc").group_attribute("verification", "summary"), "");
        parts("o.nc", {"--shard", "2/2"});
        Outcome const merged = run({"merge", "o.nc.shards", "-o", "o.nc", "--force"});
        EXPECT_EQ(merged.code, 0) << merged.err;
        EXPECT_EQ(hash_of("o.nc"), hash_of("whole.nc"));
        for (char const* const attribute : {"resolution", "summary", "settings", "share_of_work", "exponent_sign"}) {
            EXPECT_NE(of_group(attribute), "") << attribute;
            EXPECT_EQ(of_group(attribute), results("whole.nc").group_attribute("verification", attribute)) << attribute << more;
        }
        EXPECT_NE(merged.out.find(of_group("summary").substr(0, 40)), std::string::npos) << merged.out;
        std::filesystem::remove_all(path("o.nc.shards"));
    }
}

/// Energy is audited of exponents alone, and not of a law that makes it by itself: others that ask for the residual are resolved as before.
TEST_F(VerifiedRun, AuditsTheEnergyOfExponentsUnderALawThatKeepsIt) {
    auto const summary = [&](std::string const& law, std::string const& kind) {
        Outcome const outcome = verified({"--force", "--set", "contact.law=" + law, "study.kind=" + kind, "study.duration=5 ms", "study.members=8"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return of_group("summary");
    };
    EXPECT_EQ(summary("paper", "ensemble").find("energy audit"), std::string::npos);
    EXPECT_EQ(summary("conservative", "ensemble").find("energy audit"), std::string::npos);
    write("s.toml", std::string(small_scene).replace(std::string(small_scene).find("samples = 6\n"), 12, "Ttr = 0\ndt = \"0.1 ms\"\n"));
    EXPECT_EQ(summary("paper", "lyapunov").find("energy audit"), std::string::npos);
    EXPECT_NE(summary("conservative", "lyapunov").find("energy audit: the integration makes"), std::string::npos);
}

TEST_F(VerifiedRun, IsAskedForByTheScene) {
    ASSERT_EQ(run_scene({"-o", "o.nc", "--set", "study.verify=6", "--set", "study.duration=1 ms"}).code, 0);
    EXPECT_NE(of_group("summary").find(": 6 members again"), std::string::npos) << of_group("summary");
    expect_refusal(2, "study.verify", {"run", "s.toml", "--no-progress", "--set", "study.verify=-1"});
}

}  // namespace
}  // namespace slideway::testing::verification_test
