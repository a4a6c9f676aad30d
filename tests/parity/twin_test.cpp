// Two packs abreast do in every lane what one does, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/models/by_isa.hpp"
#include "tests/parity/twin_functions.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(TwinKernel const, twin_kernel)

namespace {

bool same_bits(std::vector<double> const& a, std::vector<double> const& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class TwinParity : public ::testing::TestWithParam<Isa> {
protected:
    void SetUp() override {
        if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
    }
    TwinKernel const& kernel() const { return *twin_kernel_by_isa(GetParam()); }
};

TEST_P(TwinParity, EveryOperationIsThatOfItsHalves) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    // Every lane another case: signs, ties, zeros of both signs, infinities, NaN.
    double const a[16] = {1.5, -2.5, 0.0, -0.0, 3.25, 1e300, nan, 7, -7, 0.1, 2.5, 1e-5, INFINITY, 5, -1e9, 0.3};
    double const b[16] = {0.5, -2.5, -0.0, 0.0, -4, 40, 1, 2.1, 3, 0.1, 1.5, -2e-5, 3, -6, 2.25, 0.7};
    double const c[16] = {-3, 1, 2, -1, 1e-17, 1e290, 4, 8, -8, -0.01, 0, 9, 1, -2, 2e9, 0.2};
    std::size_t const size = vocabulary_results * vocabulary_lanes;
    std::vector<double> twin(size, -77), single(size, -77);
    kernel().vocabulary({a, b, c, twin.data()}, true);
    kernel().vocabulary({a, b, c, single.data()}, false);
    for (int row = 0; row < vocabulary_results; ++row) {
        for (std::size_t lane = 0; lane < vocabulary_lanes; ++lane) {
            auto const at = static_cast<std::size_t>(row) * vocabulary_lanes + lane;
            EXPECT_EQ(std::memcmp(&twin[at], &single[at], sizeof(double)), 0)
                << "result " << row << " lane " << lane << ": " << twin[at] << ", not " << single[at];
            EXPECT_NE(twin[at], -77) << "result " << row << " is missing";
        }
    }
    // Against algebra, lest both be wrong alike.
    EXPECT_EQ(twin[0], 2.0);
    EXPECT_DOUBLE_EQ(twin[10 * vocabulary_lanes + 7], 22.7);
    EXPECT_EQ(twin[19 * vocabulary_lanes + 13], 0) << "5 < -6";
}

TEST_P(TwinParity, MasksSpanBothHalves) {
    int const lanes = kernel().twin_lanes;
    unsigned const full = (1u << lanes) - 1;
    unsigned returned = 0;
    EXPECT_EQ(kernel().truth(0, returned), 0);
    EXPECT_EQ(returned, 0u);
    EXPECT_EQ(kernel().truth(full, returned), 3);
    EXPECT_EQ(returned, full);
    for (int i = 0; i < lanes; ++i) {
        unsigned const only = 1u << i;
        EXPECT_EQ(kernel().truth(only, returned), 1) << i;
        EXPECT_EQ(returned, only);
        EXPECT_EQ(kernel().truth(full & ~only, returned), 1) << i;
        EXPECT_EQ(returned, full & ~only);
    }
}

/// Valves that chatter, swing and come to rest, some more than the seats of the largest pack.
TwinValves valves_of(TwinKernel const& kernel, bool twin, std::size_t members = 150) {
    TwinValves valves;
    for (std::size_t i = 0; i < members; ++i) valves.inflows.push_back(0.2 + 9.8 * static_cast<double>(i) / 149);
    valves.settings.method = Method::dopri5;
    valves.settings.rtol = valves.settings.atol = 1e-6;
    valves.settings.end_time = 8;
    valves.settings.max_step = 0.5;
    kernel.valves(valves, twin);
    return valves;
}

void expect_same(TwinValves const& got, TwinValves const& want) {
    ASSERT_LE(got.records.size(), want.records.size());
    for (std::size_t i = 0; i < got.records.size(); ++i) {
        auto const &g = got.records[i], &w = want.records[i];
        EXPECT_EQ(g.status, w.status) << i;
        EXPECT_EQ(g.steps_accepted, w.steps_accepted) << i;
        EXPECT_EQ(g.steps_rejected, w.steps_rejected) << i;
        EXPECT_EQ(g.rhs_evaluations, w.rhs_evaluations) << i;
        EXPECT_EQ(g.time, w.time) << i;
    }
    EXPECT_TRUE(same_bits(got.states,
                          {want.states.begin(), want.states.begin() + static_cast<std::ptrdiff_t>(got.states.size())}));
    EXPECT_TRUE(
        same_bits(got.lifts, {want.lifts.begin(), want.lifts.begin() + static_cast<std::ptrdiff_t>(got.lifts.size())}));
}

TEST_P(TwinParity, ValvesAreThoseOfOnePack) {
    auto const want = valves_of(kernel(), false);
    std::size_t recorded = 0, rejected = 0;
    for (double const lift : want.lifts) recorded += std::isfinite(lift);
    for (auto const& record : want.records) rejected += record.steps_rejected;
    EXPECT_GT(recorded, 500u);
    EXPECT_GT(rejected, 10u);
    expect_same(valves_of(kernel(), true), want);
}

TEST_P(TwinParity, IdleLanesOfEitherHalfChangeNothing) {
    auto const want = valves_of(kernel(), false);
    for (std::size_t const members : {1u, 5u, 8u, 9u, 17u}) expect_same(valves_of(kernel(), true, members), want);
}

TEST_P(TwinParity, ValvesAreThoseOfScalar) {
    expect_same(valves_of(kernel(), true), valves_of(*twin_kernel_by_isa(Isa::scalar), false));
}

std::string isa_name(::testing::TestParamInfo<Isa> const& info) { return std::string(name_of(info.param)); }

INSTANTIATE_TEST_SUITE_P(Isas, TwinParity, ::testing::ValuesIn(built_isas()), isa_name);

}  // namespace
}  // namespace slideway
