// Sweeps as a user runs them: columns that start afresh, and columns that follow one another.
#include "tests/system/orbits.hpp"

namespace slideway::testing::orbits::sweep_test {
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

// A share of no gap would be anything: that of a slider that just fits lay 4 mm inside the way of the next column, or was NaN.
TEST_F(Sweep, ContinuedBeginsInTheMiddleFromAndToAPreload) {
    std::string const springs = R"(schema = 1
[mechanism]
crank_speed = "900 rpm"
[contact]
law = "kelvin_voigt"
apex_stiffness = 1e6
apex_damping = 100
[study]
kind = "sweep"
members = 2
parameter = "joint.clearance"
values = ["0.2 mm", "0 mm", "0.2 mm", "-1 um", "-2 um", "0.1 mm"]
transient_revolutions = 0
revolutions = 1
phase = "90 deg"
exponents = 0
quantities = ["energy_residual"]
[study.vary]
"initial.vy" = { dist = "unif", low = -1e-3, high = 1e-3 }
)";
    Outcome const outcome = run_scene(springs, {"--set", continued_key, "-o", "r.nc"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const file = results();
    EXPECT_EQ(file.values("status"), std::vector<double>(12, 0));
    for (double const residual : file.values("energy_residual")) EXPECT_LT(std::abs(residual), 1e-6);
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

TEST_F(Sweep, OutOfTimeLeavesNoFile) {
    for (std::string const start : {"fresh", "continue"}) {
        Outcome const outcome = run_scene(sweep, {"--max-hours", "0", "--set", "study.start=" + start, "-o", "r.nc"});
        EXPECT_EQ(outcome.code, 5);
        EXPECT_NE(outcome.err.find("6 members have not run"), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(path("r.nc")));
    }
}

// ---- continued sweeps that are interrupted, or divided ----

/// Four columns of five starts, one of which fails in the second column, so that the third begins afresh there.
class ContinuedSweep : public OrbitProgram {
protected:
    static constexpr std::size_t columns = 4, starts = 5, total = columns * starts;
    std::vector<std::string> options(std::vector<std::string> more) const {
        std::vector<std::string> all{"--set",          continued_key,
                                     "--set",          fmt::format("study.members={}", starts),
                                     "--set",          "study.values=[\"0.2 mm\",\"0.1 mm\",\"0.15 mm\",\"0.1 mm\"]",
                                     "--set",          "study.revolutions=1",
                                     "--set",          "integrator.max_steps=" + std::to_string(limit_),
                                     "--max-failures", "100%"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Outcome sweep_with(std::vector<std::string> more) const { return run_scene(plain_sweep, options(std::move(more))); }

    /// The hash of a run that nothing disturbs.
    std::string undisturbed() {
        EXPECT_EQ(sweep_with({"-o", "whole.nc"}).code, 0);
        ResultReader const free = results("whole.nc");
        auto steps = free.values("steps_accepted");
        auto const rejected = free.values("steps_rejected");
        std::vector<double> of_second;
        for (std::size_t i = 0; i < total; ++i) steps[i] += rejected[i];
        of_second.assign(steps.begin() + starts, steps.begin() + 2 * starts);
        limit_ = static_cast<std::uint64_t>(*std::max_element(of_second.begin(), of_second.end())) - 1;
        EXPECT_EQ(sweep_with({"-o", "whole.nc"}).code, 0);
        ResultReader const file = results("whole.nc");
        auto const status = file.values("status");
        EXPECT_GT(std::count(status.begin() + starts, status.begin() + 2 * starts, 2), 0);
        EXPECT_GT(std::count(status.begin(), status.end(), 0), static_cast<std::ptrdiff_t>(total / 2));
        return file.computed_hash();
    }

    /// Removes the shards of members from `member` on, as if they had not been finished.
    std::size_t forget(std::string const& shards, std::size_t from, std::size_t to) const {
        std::size_t removed = 0;
        for (auto const& entry : std::filesystem::directory_iterator(path(shards))) {
            std::string const name = entry.path().filename().string();
            if (!name.starts_with("members-")) continue;
            std::size_t const first = std::stoul(name.substr(8));
            if (first >= from && first < to) {
                std::filesystem::remove(entry.path());
                ++removed;
            }
        }
        return removed;
    }

    std::uint64_t limit_ = 100000000;
};

TEST_F(ContinuedSweep, ResumedAtAnyColumnIsTheSame) {
    std::string const whole = undisturbed();
    // Shards of one start each, all of them, to begin with.
    EXPECT_EQ(sweep_with({"--block-members", "1", "--shard", "1/1", "-o", "r.nc"}).code, 0);
    std::filesystem::copy(path("r.nc.shards"), path("all"), std::filesystem::copy_options::recursive);
    auto const resumed_without = [&](std::size_t from, std::size_t to) {
        std::filesystem::remove_all(path("r.nc.shards"));
        std::filesystem::remove(path("r.nc"));
        std::filesystem::copy(path("all"), path("r.nc.shards"), std::filesystem::copy_options::recursive);
        EXPECT_EQ(forget("r.nc.shards", from, to), to - from);
        Outcome const outcome = sweep_with({"--resume", "-o", "r.nc"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return results().computed_hash();
    };
    for (std::size_t column = 0; column < columns; ++column) {
        EXPECT_EQ(resumed_without(column * starts, total), whole) << "from column " << column;
        EXPECT_EQ(resumed_without(column * starts, (column + 1) * starts), whole) << "column " << column << " alone";
        EXPECT_EQ(resumed_without(column * starts + 2, column * starts + 3), whole) << "one start of column " << column;
    }
    EXPECT_EQ(resumed_without(3, total - 2), whole);
    EXPECT_EQ(resumed_without(0, total), whole);
}

TEST_F(ContinuedSweep, InPartsIsTheSame) {
    std::string const whole = undisturbed();
    // Of seven parts two have no start.
    for (std::size_t const parts : {2, 3, 7}) {
        for (std::size_t part = parts; part >= 1; --part) {
            Outcome const outcome =
                sweep_with({"--shard", fmt::format("{}/{}", part, parts), "--threads", "2", "-o", "r.nc"});
            EXPECT_EQ(outcome.code, 0) << outcome.err;
        }
        EXPECT_EQ(run({"merge", "r.nc.shards", "-o", "r.nc", "--force"}).code, 0);
        EXPECT_EQ(results().computed_hash(), whole) << parts;
        std::filesystem::remove_all(path("r.nc.shards"));
    }
}

TEST_F(ContinuedSweep, OfAFewMembersIsThatOfAll) {
    undisturbed();
    ResultReader const whole = results("whole.nc");
    for (auto const& [first, last] : {std::pair{8, 8}, {4, 5}, {7, 13}, {3, 17}, {15, 19}}) {
        ASSERT_EQ(sweep_with({"--members", fmt::format("{}..{}", first, last), "-o", "few.nc"}).code, 0);
        ResultReader const few = results("few.nc");
        for (int m = first; m <= last; ++m) {
            EXPECT_EQ(member_of(few, static_cast<std::size_t>(m - first)),
                      member_of(whole, static_cast<std::size_t>(m)))
                << m;
        }
    }
}

}  // namespace
}  // namespace slideway::testing::orbits::sweep_test
