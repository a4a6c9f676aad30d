// Which inputs matter, by the correlations of a tolerance report.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/study/tolerance_report.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/support/tolerance_file.hpp"

namespace slideway::testing::tolerance_correlation_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class ToleranceCorrelations : public ToleranceFile {
protected:
    /// Correlations of a force that is the sum of two inputs, both taken from 0 to 1, over at most `most` members.
    /// @param clearances, etas of the inputs: what their distributions say beside their ends
    ColumnCorrelations of_a_sum(std::string const& design, std::size_t most, std::string const& clearances = "",
                                std::string const& etas = "") const {
        Scene const study = scene_of("schema = 1\n[study]\nkind = \"tolerance\"\nduration = 1\n" + design +
                                     fmt::format(R"(
            quantities = ["peak_normal_force", "mode_time"]
            [study.vary]
            "joint.clearance" = {{ dist = "unif", low = 1e-4, high = 2e-4{} }}
            "contact.eta" = {{ dist = "unif", low = 0.01, high = 0.02{} }}
        )",
                                                 clearances, etas));
        ;
        std::vector<MadeUpMember> members(study.members);
        for (std::size_t i = 0; i < members.size(); ++i) {
            Inputs const inputs = member_inputs(study, i);
            members[i].number = i;
            members[i].clearance = 1e4 * inputs.clearance_y - 1;
            members[i].eta = 100 * inputs.eta - 1;
            members[i].force = members[i].clearance + members[i].eta;
        }
        NetcdfFile const file = write(members);
        ReportSettings settings;
        settings.most_correlated = most;
        return tolerance_report(ResultView(file), study, settings).correlations.at(0);
    }
};

/// Of a sum of two independent uniform inputs each has the product-moment correlation 1/sqrt(2) with it, and that of
/// ranks is 12 E(x F(x + y)) - 3 = 12 (1/20 + 31/120) - 3 = 0.7, F the distribution of the sum.  Drawn members have it
/// with a standard error of 0.018 (Bonett and Wright 2000).
void expect_equal_shares(ColumnCorrelations const& force) {
    ASSERT_EQ(force.members, 1024u);
    for (Estimate const& input : force.ranks) EXPECT_NEAR(input.value, 0.7, 0.06);
    for (double const coefficient : force.regression.coefficients) EXPECT_NEAR(coefficient, std::sqrt(0.5), 0.05);
    EXPECT_NEAR(force.regression.r_squared, 1, 1e-12);
}

TEST_F(ToleranceCorrelations, BelongToTheirMembers) {
    auto members = numbered_members(0, 1000);
    shuffle(members);
    NetcdfFile const file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), scene(DesignKind::sobol, 5000));
    ASSERT_EQ(report.correlations.size(), 5u);
    ColumnCorrelations const& force = report.correlations[0];
    EXPECT_EQ(force.members, 800u);
    EXPECT_NEAR(force.ranks[0].value, 1, 1e-14);  // a cube does not change ranks
    EXPECT_NEAR(force.ranks[1].value, 0, 0.05);
    EXPECT_LT(force.ranks[1].interval.low, 0);
    EXPECT_GT(force.ranks[1].interval.high, 0);
    EXPECT_EQ(force.ranking, (std::vector<std::size_t>{0, 1}));
    // A uniform x against x³: r = Cov/σσ = (1/5 - 1/8)/√(1/12 · (1/7 - 1/16)) = 0.9165.
    EXPECT_NEAR(force.regression.r_squared, 0.9165 * 0.9165, 0.005);
    EXPECT_NEAR(report.correlations[4].ranks[0].value, -1, 1e-14);   // mode_time[surface] falls
    EXPECT_TRUE(std::isnan(report.correlations[1].ranks[0].value));  // mode_time[free] is constant
    EXPECT_EQ(report.correlations[2].members, 0u);                   // mode_time[point] is not there
}

TEST_F(ToleranceCorrelations, LeaveMembersWithoutANumberOut) {
    auto members = numbered_members(0, 400);
    for (MadeUpMember& m : members) {
        bool const there = m.number % 4 != 0;
        m.mode_time[1] = there ? -m.force : nan;
        if (!there) m.clearance = -m.clearance;  // of these the input would spoil the order
    }
    NetcdfFile const file = write(members);
    ToleranceReport const report = tolerance_report(ResultView(file), scene(DesignKind::mc, 400));
    ColumnCorrelations const& point = report.correlations[2];
    EXPECT_EQ(point.members, 220u);  // of the 320 that finished 100 are multiples of 4
    EXPECT_NEAR(point.ranks[0].value, -1, 1e-14);
    EXPECT_EQ(report.correlations[0].members, 320u);
    EXPECT_LT(report.correlations[0].ranks[0].value, 0.7);
}

TEST_F(ToleranceCorrelations, OfAPartOfSobolsPointsAreThoseOfAll) {
    // Every eighth of these points lies in the same quarter of the first input.
    expect_equal_shares(of_a_sum("design = \"sobol\"\nmembers = 8192\n", 1024));
}

TEST_F(ToleranceCorrelations, OfAPartOfAGridAreThoseOfAll) {
    // Every 64th member of these has one and the same level of the input that changes with every member.
    expect_equal_shares(of_a_sum("design = \"grid\"\n", 1024, ", levels = 1024", ", levels = 64"));
    expect_equal_shares(of_a_sum("design = \"grid\"\n", 1024, ", levels = 64", ", levels = 1024"));
}

TEST_F(ToleranceCorrelations, OfNoMoreMembersThanTheLimitUseAll) {
    EXPECT_EQ(of_a_sum("design = \"sobol\"\nmembers = 1024\n", 1024).members, 1024u);
    EXPECT_EQ(of_a_sum("design = \"sobol\"\nmembers = 1024\n", 1023).members, 1023u);
}

}  // namespace
}  // namespace slideway::testing::tolerance_correlation_test
