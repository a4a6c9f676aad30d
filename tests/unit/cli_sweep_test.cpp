// Sweeps as a user runs them: columns that start afresh, and columns that follow one another.
#include "cli_orbits.hpp"

namespace slideway::testing::orbits {
namespace {

class Sweep : public OrbitProgram {};

TEST_F(Sweep, GivesEachColumnTheSameStarts) {
    ResultReader const file = results_of(sweep);
    EXPECT_EQ(file.values("joint_clearance"), (std::vector<double>{2e-4, 2e-4, 2e-4, 1e-4, 1e-4, 1e-4}));
    auto const y = file.values("initial_y");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(y[i], y[i + 3]);
    EXPECT_NE(y[0], y[1]);
    EXPECT_EQ(file.values("section_count"), std::vector<double>(6, 2));
    EXPECT_EQ(file.shape("lyapunov_exponent"), (std::vector<std::size_t>{6, 1}));
    for (double const x : file.values("lyapunov_exponent")) EXPECT_TRUE(std::isfinite(x));
    for (double const time : file.values("lyapunov_time")) EXPECT_DOUBLE_EQ(time, turn);
}

TEST_F(Sweep, HasAsColumnsTheSectionsOfItsValues) {
    auto const columns = sections_of(results_of(plain_sweep));
    for (std::size_t column = 0; column < 2; ++column) {
        auto const alone =
            sections_of(results_of(by_phase, {"--set", "study.members=3", "--set",
                                              fmt::format("joint.clearance=\"{} mm\"", column == 0 ? "0.2" : "0.1")}));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(columns[3 * column + i], alone[i]) << column << ' ' << i;
    }
}

TEST_F(Sweep, ContinuedIsFreshInItsFirstColumnAlone) {
    auto const fresh = sections_of(results_of(plain_sweep)),
               continued = sections_of(results_of(plain_sweep, {"--set", continued_key}));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(continued[i], fresh[i]);
        EXPECT_NE(continued[i + 3], fresh[i + 3]);
    }
}

TEST_F(Sweep, ContinuedStartsWhereTheColumnBeforeEnded) {
    ResultReader const file =
        results_of(plain_sweep, {"--set", continued_key, "--set", "study.values=[\"0.1 mm\",\"0.1 mm\"]"});
    auto const columns = sections_of(file);
    for (std::size_t i = 0; i < 3; ++i) {
        // The same, step by step, by hand: the last section as the initial state of a run that starts at its angle.
        State const& start = columns[i].back().state;
        std::vector<std::string> options{"--set", "study.members=1",
                                         "--set", "joint.clearance=\"0.1 mm\"",
                                         "--set", "mechanism.start_angle=\"90 deg\""};
        for (std::size_t j = 0; j < start.size(); ++j) {
            std::string const key = state_names[j] == "y" ? "study.vary.\"initial.y\"" : "initial." + state_names[j];
            std::string const value = state_names[j] == "y" ? "{{dist=\"const\",value={:.17g}}}" : "{:.17g}";
            options.insert(options.end(), {"--set", key + "=" + fmt::format(fmt::runtime(value), start[j])});
        }
        EXPECT_EQ(columns[i + 3], sections_of(results_of(by_phase, options))[0]) << i;
        EXPECT_DOUBLE_EQ(columns[i + 3][0].time, turn);
    }
}

TEST_F(Sweep, ContinuedGoesOnFromTheScenesStartAfterAFailure) {
    // The middle column's gap is a tenth of the others': it takes more steps than it may.
    std::string const values = "study.values=[\"0.5 mm\",\"0.05 mm\",\"0.5 mm\"]";
    ResultReader const whole = results_of(plain_sweep, {"--set", continued_key, "--set", values});
    auto const accepted = whole.values("steps_accepted"), rejected = whole.values("steps_rejected");
    double most = 0, least = 1e300;
    for (std::size_t i = 0; i < 9; ++i) {
        double const steps = accepted[i] + rejected[i];
        if (i / 3 == 1) least = std::min(least, steps);
        if (i / 3 == 0) most = std::max(most, steps);
    }
    ASSERT_LT(most, least);
    Outcome const outcome =
        run_scene(plain_sweep, {"--max-failures", "100%", "--set", continued_key, "--set", values, "--set",
                                fmt::format("integrator.max_steps={:.0f}", most), "-o", "r.nc"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const file = results();
    EXPECT_EQ(file.values("status"), (std::vector<double>{0, 0, 0, 2, 2, 2, 0, 0, 0}));
    auto const columns = sections_of(file);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(columns[i + 6], columns[i]) << i;
}

TEST_F(Sweep, OutOfTimeLeavesAWholeFile) {
    for (std::string const start : {"fresh", "continue"}) {
        Outcome const outcome = run_scene(sweep, {"--max-hours", "0", "--set", "study.start=" + start, "-o", "r.nc"});
        EXPECT_EQ(outcome.code, 5);
        EXPECT_NE(outcome.err.find("6 of 6 members were not run"), std::string::npos) << outcome.err;
        ResultReader const file = results();
        EXPECT_EQ(file.values("status"), std::vector<double>(6, -1));
        EXPECT_EQ(file.values("section_count"), std::vector<double>(6, 0));
        EXPECT_EQ(file.stored_hash(), file.computed_hash());
    }
}

}  // namespace
}  // namespace slideway::testing::orbits
