// A tolerance report of columns that vary by no more than rounding, beside one that varies.
#include <cmath>

#include "host/study/tolerance_report.hpp"
#include "tests/support/tolerance_file.hpp"

namespace slideway::testing::noise_floor_report_test {
namespace {

using ReportOfRounding = ToleranceFile;

/// Rounding, in time with the first input: of it alone indices would say that it drives all.
double with_noise(double value, double input) { return value * (1 + 1e-12 * (input > 0.5)); }

TEST_F(ReportOfRounding, ASaltelliDesignHasNoIndexOfRounding) {
    auto members = radial_members(0, 256);
    for (MadeUpMember& m : members) m.mode_time[2] = with_noise(0.25, m.clearance);
    NetcdfFile file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), scene(DesignKind::saltelli, 4 * 256));
    ColumnIndices const &force = report.indices->columns[0], &line = report.indices->columns[3];
    EXPECT_EQ(force.why_none, "");
    EXPECT_NEAR(force.indices.total[0].value, 0.8, 0.1);
    EXPECT_TRUE(line.why_none.starts_with("varies by 1.3e-13 s")) << line.why_none;
    for (auto const& of_input : {line.indices.first, line.indices.total}) {
        for (Estimate const& index : of_input) EXPECT_TRUE(std::isnan(index.value) && std::isnan(index.interval.low));
    }
    EXPECT_TRUE(std::isnan(line.indices.first_sum.value));

    write_statistics(file, report);
    file.close();
    NetcdfFile const back = NetcdfFile::open(path());
    EXPECT_TRUE(back.group("sensitivity")->text(DataFile::global, "without_index").starts_with("mode_time[line] varies by 1.3e-13 s"));
}

TEST_F(ReportOfRounding, ATableHasNoCorrelationOfRounding) {
    auto members = numbered_members(0, 100);
    for (MadeUpMember& m : members) m.mode_time[0] = with_noise(0.5, static_cast<double>(m.number) - 49.5);
    NetcdfFile const file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), scene(DesignKind::table, 100));
    EXPECT_NEAR(report.correlations[0].ranks[0].value, 1, 1e-14);
    EXPECT_NE(report.correlations[1].why_none, "");
    for (Estimate const& rank : report.correlations[1].ranks) EXPECT_TRUE(std::isnan(rank.value));
    EXPECT_TRUE(std::isnan(report.correlations[1].regression.r_squared));
}

}  // namespace
}  // namespace slideway::testing::noise_floor_report_test
