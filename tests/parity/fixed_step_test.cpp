// Equal steps give a member the same bits in every instruction set, group of packs, lane and company.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/models/by_isa.hpp"
#include "tests/parity/fixed_step_functions.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(FixedStepKernel const, fixed_step_kernel)

namespace {

constexpr int groups = 4;

std::vector<double> run(Isa isa, bool valve, std::vector<double> const& values, int group = 0) {
    std::vector<double> states(3 * values.size());
    fixed_step_kernel_by_isa(isa)->run({valve, values.data(), values.size(), 2000, states.data()}, group);
    return states;
}

std::vector<double> spread(std::size_t count, double low, double high) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(count));
    }
    return values;
}

bool same_bits(std::vector<double> const& a, std::vector<double> const& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class FixedStepParity : public ::testing::TestWithParam<Isa> {
protected:
    void SetUp() override {
        if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
    }
};

TEST_P(FixedStepParity, GivesTheBitsOfScalarInEveryGroup) {
    // Not a multiple of any pack: the last group is padded.
    for (auto const& [valve, values] :
         {std::pair{false, spread(131, 0.5, 28)}, std::pair{true, spread(131, 0.2, 10)}}) {
        auto const want = run(Isa::scalar, valve, values, 1);
        ASSERT_TRUE(std::isfinite(want.back()));
        for (int group = 0; group < groups; ++group) {
            EXPECT_TRUE(same_bits(want, run(GetParam(), valve, values, group)))
                << "valve " << valve << " group " << group;
        }
    }
}

TEST_P(FixedStepParity, ValveEventsAndResetsHaveTheBitsOfScalar) {
    // In flight, at impacts fast and slow, below and above the opening pressure, on the seat, at rest; side by side in a pack.
    double const equilibrium = 6;  // x √(x + 10) = 24
    double const states[][3] = {{0.5, 1, 8},   {0, -2, 7},   {-1e-17, -1e-7, 7},   {0, -1e-7, 10.5}, {0, 0, 9},
                                {0, 0, 10.01}, {1, 0, -0.1}, {equilibrium, 0, 16}, {0, 1e-3, 5}};
    std::vector<double> inflows, start;
    for (std::size_t i = 0; i < 72; ++i) {
        inflows.push_back(i % 9 == 7 ? 24 : 0.2 + 0.1 * static_cast<double>(i));
        start.insert(start.end(), states[i % 9], states[i % 9] + 3);
    }
    auto const evaluate = [&](Isa isa) {
        auto after = start;
        std::vector<double> events(4 * 72), at_rest(72);
        fixed_step_kernel_by_isa(isa)->valve({inflows.data(), after.data(), events.data(), at_rest.data(), 72});
        return std::vector{after, events, at_rest};
    };
    auto const want = evaluate(Isa::scalar), got = evaluate(GetParam());
    for (std::size_t i = 0; i < want.size(); ++i) EXPECT_TRUE(same_bits(want[i], got[i])) << i;
    auto const& after = got[0];
    EXPECT_EQ(after[3 * 0 + 1], 1) << "flies on";
    EXPECT_DOUBLE_EQ(after[3 * 1 + 1], 1.6) << "rebounds";
    EXPECT_EQ(after[3 * 2 + 1], 0) << "ends on its seat";
    EXPECT_DOUBLE_EQ(after[3 * 3 + 1], 0.8e-7) << "rebounds and opens";
    for (std::size_t i = 0; i < 72; ++i) EXPECT_EQ(got[2][i], i % 9 == 7 ? 1 : 0) << "member " << i;
}

TEST_P(FixedStepParity, AMemberAloneHasTheBitsItHasInCompany) {
    auto const values = spread(70, 0.5, 28);
    auto const together = run(GetParam(), false, values);
    for (std::size_t i = 0; i < values.size(); i += 3) {
        auto const alone = run(GetParam(), false, {values[i]});
        EXPECT_EQ(std::memcmp(alone.data(), &together[3 * i], 3 * sizeof(double)), 0) << "member " << i;
    }
}

TEST_P(FixedStepParity, ADivergingNeighbourChangesNothing) {
    auto values = spread(19, 0.5, 28);
    auto const clean = run(GetParam(), false, values);
    values[7] = std::numeric_limits<double>::quiet_NaN();
    values[12] = 1e200;
    auto const got = run(GetParam(), false, values);
    EXPECT_TRUE(std::isnan(got[3 * 7 + 1]));
    EXPECT_FALSE(std::isfinite(got[3 * 12 + 1]));
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i == 7 || i == 12) continue;
        EXPECT_EQ(std::memcmp(&got[3 * i], &clean[3 * i], 3 * sizeof(double)), 0) << "member " << i;
    }
}

std::string isa_name(::testing::TestParamInfo<Isa> const& info) { return std::string(name_of(info.param)); }

INSTANTIATE_TEST_SUITE_P(Isas, FixedStepParity, ::testing::ValuesIn(built_isas()), isa_name);

}  // namespace
}  // namespace slideway
