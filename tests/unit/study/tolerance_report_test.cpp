#include "host/study/tolerance_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/support/scene_fixture.hpp"
#include "tests/support/tolerance_file.hpp"

namespace slideway::testing::tolerance_report_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using ToleranceReportOf = ToleranceFile;

std::uint64_t count_of(std::vector<StatusCount> const& counts, Status status) {
    for (StatusCount const& count : counts) {
        if (count.status == status) return count.members;
    }
    return 0;
}

TEST_F(ToleranceReportOf, IndependentDrawsIsOfThoseThatFinished) {
    auto members = numbered_members(1000, 1000);
    shuffle(members);
    NetcdfFile const file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), scene(DesignKind::mc, 5000));

    EXPECT_EQ(count_of(report.statuses, Status::finished), 800u);
    EXPECT_EQ(count_of(report.statuses, Status::max_steps), 50u);
    EXPECT_EQ(count_of(report.statuses, Status::geometry), 50u);
    ASSERT_EQ(report.columns.size(), 5u);
    EXPECT_EQ(report.columns[0].column.name(), "peak_normal_force");
    EXPECT_EQ(report.columns[3].column.name(), "mode_time[line]");

    // 1000 … 1999 without those that end in 3 and 7, by hand.
    std::vector<double> kept;
    for (int x = 1000; x < 2000; ++x) {
        if (x % 10 != 3 && x % 10 != 7) kept.push_back(x);
    }
    double const mean = std::accumulate(kept.begin(), kept.end(), 0.0) / 800;
    double squares = 0;
    for (double const x : kept) squares += (x - mean) * (x - mean);
    double const sd = std::sqrt(squares / 799);
    for (auto const& [index, factor] : {std::pair{0u, 1.0}, std::pair{3u, 2.0}}) {
        ColumnStatistics const& column = report.columns[index];
        EXPECT_EQ(column.summary.count, 800u);
        EXPECT_NEAR(column.summary.mean, factor * mean, 1e-9);
        EXPECT_NEAR(column.summary.sd, factor * sd, 1e-9);
        EXPECT_EQ(column.summary.min, factor * 1000);
        EXPECT_EQ(column.summary.max, factor * 1999);
        // t(799, 0.975) = 1.96293.
        EXPECT_NEAR(column.mean.high - column.mean.low, factor * 2 * 1.96293 * sd / std::sqrt(800), 1e-4 * sd);
        ASSERT_EQ(column.quantiles.size(), 9u);
        EXPECT_EQ(column.quantiles[4].p, 0.5);
        EXPECT_EQ(column.quantiles[4].value, factor * 0.5 * (kept[399] + kept[400]));
        EXPECT_LT(column.quantiles[4].interval.low, column.quantiles[4].value);
        EXPECT_TRUE(std::isnan(column.quantiles[8].interval.high));  // 99.9 % of 800
        auto const& counts = column.histogram.counts;
        EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}), 800u);
    }
    EXPECT_EQ(report.columns[2].summary.count, 0u);  // NaN of everyone
    EXPECT_EQ(report.columns[2].summary.missing, 800u);
    EXPECT_TRUE(report.columns[2].histogram.counts.empty());
    EXPECT_FALSE(report.all_met.has_value());
    EXPECT_FALSE(report.indices.has_value());
    EXPECT_NE(report.policy.find("meet no limit"), std::string::npos);
}

TEST_F(ToleranceReportOf, LimitsCountsFailedMembersAsRefused) {
    Scene study = scene(DesignKind::lhs, 5000);
    study.limits = {limit("peak_normal_force", "", -infinity, 1499), limit("mode_time", "line", 2200, infinity),
                    limit("mode_time", "point", 0, 1)};
    NetcdfFile const file = write(numbered_members(1000, 1000));
    ToleranceReport const report = tolerance_report(ResultView(file), study);
    ASSERT_EQ(report.limits.size(), 3u);
    for (LimitYield const& limit : report.limits) EXPECT_EQ(limit.met.trials, 900u);
    EXPECT_EQ(report.limits[0].met.successes, 400u);  // of 1000 … 1499
    EXPECT_EQ(report.limits[1].met.successes, 720u);  // of 1100 … 1999
    EXPECT_EQ(report.limits[2].met.successes, 0u);    // NaN meets nothing
    EXPECT_EQ(report.limits[1].unit, "s");
    ASSERT_TRUE(report.all_met.has_value());
    EXPECT_EQ(report.all_met->successes, 0u);
    EXPECT_EQ(report.all_met->interval.low, 0);
    EXPECT_NE(report.intervals.find("as a rule too wide"), std::string::npos);

    study.limits.pop_back();
    Proportion const both = *tolerance_report(ResultView(file), study).all_met;
    EXPECT_EQ(both.successes, 320u);  // of 1100 … 1499
    EXPECT_EQ(both.trials, 900u);
    EXPECT_LT(both.interval.low, 320.0 / 900);
    EXPECT_GT(both.interval.high, 320.0 / 900);
}

TEST_F(ToleranceReportOf, MembersThatHaveNotRunLeavesNoIntervals) {
    for (DesignKind const kind : {DesignKind::mc, DesignKind::saltelli}) {
        auto members = radial_members(0, 100);
        Scene study = scene(kind, 400);
        study.limits = {limit("peak_normal_force", "", -infinity, 1.5)};
        auto const report_of = [&] { return tolerance_report(ResultView(write(members)), study); };
        ToleranceReport const whole = report_of();
        members[301].status = Status::not_run;
        ToleranceReport const part = report_of();
        EXPECT_EQ(count_of(part.statuses, Status::not_run), 1u);
        EXPECT_NE(part.intervals.find("none: members have not run, and not at random"), std::string::npos);
        for (auto const& [report, is_whole] : {std::pair{&whole, true}, std::pair{&part, false}}) {
            EXPECT_EQ(std::isnan(report->columns[0].mean.low), !is_whole);
            EXPECT_EQ(std::isnan(report->columns[0].quantiles[4].interval.low), !is_whole);
            EXPECT_EQ(std::isnan(report->all_met->interval.low), !is_whole);
            if (kind == DesignKind::saltelli) {
                EXPECT_EQ(std::isnan(report->indices->columns[0].indices.total[0].interval.low), !is_whole);
                EXPECT_FALSE(std::isnan(report->indices->columns[0].indices.total[0].value));
            } else {
                EXPECT_EQ(std::isnan(report->correlations[0].ranks[0].interval.low), !is_whole);
            }
        }
    }
}

TEST_F(ToleranceReportOf, ADesignThatIsNotRandomHasNoIntervals) {
    Scene study = scene(DesignKind::grid, 5000);
    study.limits = {limit("peak_normal_force", "", 0, 1499)};
    NetcdfFile const file = write(numbered_members(0, 1000));
    ToleranceReport const report = tolerance_report(ResultView(file), study);
    EXPECT_TRUE(std::isnan(report.columns[0].mean.low));
    EXPECT_TRUE(std::isnan(report.columns[0].quantiles[4].interval.low));
    EXPECT_TRUE(std::isnan(report.all_met->interval.low));
    EXPECT_FALSE(std::isnan(report.all_met->value));
    EXPECT_TRUE(std::isnan(report.correlations[0].ranks[0].interval.low));
    EXPECT_NEAR(report.correlations[0].ranks[0].value, 1, 1e-14);
    EXPECT_EQ(report.intervals.find("none"), 0u);
}

TEST_F(ToleranceReportOf, ASaltelliDesignTellsInputsApart) {
    auto members = radial_members(0, 4096);
    shuffle(members);
    NetcdfFile const file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), scene(DesignKind::saltelli, 4 * 4096));
    EXPECT_EQ(report.inputs, (std::vector<std::string>{"joint.clearance", "contact.eta"}));
    EXPECT_TRUE(report.correlations.empty());
    ASSERT_TRUE(report.indices.has_value());
    EXPECT_EQ(report.indices->used(), 4096u);
    ASSERT_EQ(report.indices->columns.size(), 5u);
    // Of 2 x1 + x2 the variances are as 4 to 1, without interaction; mode_time[free] is x2 alone.
    SobolIndices const& force = report.indices->columns[0].indices;
    EXPECT_NEAR(force.total[0].value, 0.8, 0.01);
    EXPECT_NEAR(force.total[1].value, 0.2, 0.01);
    EXPECT_NEAR(force.first_sum.value, 1, 0.02);
    EXPECT_LT(force.total[0].interval.low, 0.8);
    EXPECT_GT(force.total[0].interval.high, 0.8);
    EXPECT_EQ(report.indices->columns[0].ranking, (std::vector<std::size_t>{0, 1}));
    SobolIndices const& free = report.indices->columns[1].indices;
    EXPECT_EQ(free.total[0].value, 0);
    EXPECT_NEAR(free.total[1].value, 1, 0.02);
    EXPECT_EQ(report.indices->columns[1].ranking, (std::vector<std::size_t>{1, 0}));
    EXPECT_TRUE(std::isnan(report.indices->columns[3].indices.total[0].value));  // constant
}

TEST_F(ToleranceReportOf, ASaltelliDesignUsesDrawsForDistributionsAndWholeRowsForIndices) {
    // Members 4·100 + 2 to 4·300 + 1 of the design: half a row at both ends.
    auto members = radial_members(100, 201);
    members.erase(members.begin(), members.begin() + 2);
    members.erase(members.end() - 2, members.end());
    auto const at = [&](std::uint64_t number) -> MadeUpMember& { return members[number - 402]; };
    at(4 * 150).status = Status::geometry;      // A of row 150
    at(4 * 160 + 3).status = Status::unstable;  // AB of row 160: no draw
    at(4 * 180 + 2).force = nan;                // finished, but has no number
    std::erase_if(members, [](MadeUpMember const& m) { return m.number == 4 * 170 + 1; });  // B of row 170
    shuffle(members);
    Scene study = scene(DesignKind::saltelli, 4 * 1000);
    study.limits = {limit("peak_normal_force", "", -infinity, 1.5)};
    NetcdfFile const file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), study);

    // Draws: A and B of rows 101 … 300, by their numbers.
    auto const all = radial_members(101, 200);
    std::vector<double> draws, rows, whole_rows;
    std::uint64_t met = 0;
    for (MadeUpMember const& m : all) {
        std::uint64_t const row = m.number / 4;
        if (row < 300 && row != 150 && row != 160 && row != 170) {
            whole_rows.push_back(m.mode_time[0]);
            if (row != 180) rows.push_back(m.force);
        }
        if (m.number % 4 >= 2 || m.number == 4 * 150 || m.number == 4 * 170 + 1) continue;
        draws.push_back(m.force);
        met += m.force <= 1.5;
    }
    EXPECT_EQ(report.columns[0].summary.count, draws.size());
    EXPECT_EQ(report.columns[0].summary.missing, 0u);
    EXPECT_NEAR(report.columns[0].summary.mean, std::accumulate(draws.begin(), draws.end(), 0.0) / 398, 1e-12);
    EXPECT_EQ(report.all_met->trials, 399u);  // the failed one ran
    EXPECT_EQ(report.all_met->successes, met);
    EXPECT_EQ(count_of(report.draws, Status::finished), 398u);
    EXPECT_EQ(count_of(report.draws, Status::geometry), 1u);
    EXPECT_EQ(count_of(report.draws, Status::unstable), 0u);
    EXPECT_EQ(count_of(report.statuses, Status::unstable), 1u);

    EXPECT_EQ(report.indices->rows, 201u);
    EXPECT_EQ(report.indices->failed, 2u);
    EXPECT_EQ(report.indices->incomplete, 3u);
    EXPECT_EQ(report.indices->used(), 196u);
    SobolIndices const& force = report.indices->columns[0].indices;
    EXPECT_EQ(force.missing, 1u);
    EXPECT_EQ(force.rows, 195u);
    EXPECT_EQ(report.indices->columns[1].indices.missing, 0u);
    BootstrapSettings const bootstrap{500, 0.95, study.seed, 1};
    SobolIndices const expected = sobol_indices({2, rows}, bootstrap);
    SobolIndices const expected_free = sobol_indices({2, whole_rows}, bootstrap);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(force.first[i].value, expected.first[i].value);
        EXPECT_EQ(force.total[i].interval.low, expected.total[i].interval.low);
        EXPECT_EQ(report.indices->columns[1].indices.total[i].value, expected_free.total[i].value);
    }
    EXPECT_NE(report.policy.find("members of A and B"), std::string::npos);
}

TEST_F(ToleranceReportOf, ASceneGoesByTheNumbersOfItsOwnDesign) {
    // With the members that the scene draws; the force is of unit-free inputs, 3 x1 + 2 x2 + x3, variances as 9 : 4 : 1.
    Scene const study = scene_of(R"(
        schema = 1
        [mechanism]
        kind = "slider_crank"
        [study]
        kind = "tolerance"
        design = "saltelli"
        base = 1024
        duration = "0.1 s"
        quantities = ["peak_normal_force", "mode_time"]
        [study.vary]
        "joint.clearance" = { dist = "unif", low = 1e-4, high = 2e-4 }
        "contact.eta" = { dist = "unif", low = 0.01, high = 0.02 }
        "initial.z" = { dist = "unif", low = 0, high = 1e-5 }
        [study.limits]
        "peak_normal_force" = { max = 11.5 }
        "mode_time[free]" = { min = 0.012 }
    )");
    ASSERT_EQ(study.members, 5u * 1024);
    std::vector<MadeUpMember> members(study.members);
    std::uint64_t within = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        Inputs const inputs = member_inputs(study, i);
        MadeUpMember& m = members[i];
        m.number = i;
        m.force = 3e4 * inputs.clearance_y + 200 * inputs.eta + 1e5 * inputs.z;
        m.mode_time[0] = inputs.eta;
        within += i % 5 < 2 && m.force <= 11.5 && inputs.eta >= 0.012;
    }
    shuffle(members);
    NetcdfFile const file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), study);
    SobolIndices const& force = report.indices->columns[0].indices;
    double const expected[] = {9.0 / 14, 4.0 / 14, 1.0 / 14};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(force.first[i].value, expected[i], 0.02) << i;
        EXPECT_NEAR(force.total[i].value, expected[i], 0.02) << i;
    }
    EXPECT_EQ(report.indices->columns[0].ranking, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(report.inputs, (std::vector<std::string>{"joint.clearance", "contact.eta", "initial.z"}));
    EXPECT_NEAR(report.limits[1].met.value, 0.8, 0.005);  // eta, uniform from 0.01 to 0.02
    EXPECT_EQ(report.limits[1].limit.name(), "mode_time[free]");
    EXPECT_EQ(report.all_met->successes, within);
    EXPECT_EQ(report.all_met->trials, 2048u);
}

TEST_F(ToleranceReportOf, AnotherScenesResultIsRefused) {
    auto members = numbered_members(1000, 20);
    {
        NetcdfFile const file = write(members);
        EXPECT_THROW(tolerance_report(ResultView(file), scene(DesignKind::mc, 1019)), FileError);
        EXPECT_NO_THROW(tolerance_report(ResultView(file), scene(DesignKind::mc, 1020)));
        Scene study = scene(DesignKind::mc, 1020);
        study.limits = {limit("drive_work", "", 0, 1)};
        try {
            tolerance_report(ResultView(file), study);
            FAIL() << "drive_work is not there";
        } catch (FileError const& error) {
            EXPECT_NE(std::string(error.what()).find("has no drive_work"), std::string::npos) << error.what();
        }
    }
    members[3].number = members[11].number;
    NetcdfFile const file = write(members);
    EXPECT_THROW(tolerance_report(ResultView(file), scene(DesignKind::mc, 5000)), FileError);
}

}  // namespace
}  // namespace slideway::testing::tolerance_report_test
