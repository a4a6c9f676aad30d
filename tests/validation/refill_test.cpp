// Lanes of sliders that are refilled: little idles, however the members' costs differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::refill_test {
namespace {

testing::RunOptions options_of(Method method, double end_time) {
    testing::RunOptions o;
    o.parts = {Law::conservative, Damping::rate, true, false};
    o.settings.method = method;
    o.settings.rtol = o.settings.atol = 1e-4;
    o.settings.end_time = end_time;
    o.quantities = 0;
    return o;
}

double utilisation(testing::EnsembleResult const& r) {
    return static_cast<double>(r.lane_steps_useful) / static_cast<double>(r.lane_steps_executed);
}

/// Dearest over cheapest member, leaving out one in twenty at either end.
double spread(testing::EnsembleResult const& r) {
    std::vector<double> costs;
    for (auto const& record : r.records) {
        EXPECT_EQ(record.status, Status::finished);
        costs.push_back(static_cast<double>(record.steps_accepted + record.steps_rejected));
    }
    std::sort(costs.begin(), costs.end());
    return costs[costs.size() * 19 / 20] / costs[costs.size() / 20];
}

TEST(Refill, KeepsTheLanesBusyWhereInputsVaryByAFifth) {
    auto members = testing::scattered_starts(512);
    for (std::size_t i = 0; i < members.size(); ++i) {
        double const x = 0.8 + 0.4 * std::fmod(static_cast<double>(i) * 0.6180339887498949, 1.0);
        members[i].crank_speed *= x;
        members[i].clearance_y = members[i].clearance_z = 1e-4 * x;
    }
    for (auto const method : {Method::automatic, Method::dopri5, Method::bs32}) {
        auto const r = testing::run(best_isa(), options_of(method, 0.04), members);
        EXPECT_GE(utilisation(r), 0.98) << name_of(method);
    }
}

TEST(Refill, KeepsTheLanesBusyWhereCostsDifferTenfold) {
    // The faster a member flies, the more often it bounces.
    auto members = testing::scattered_starts(512);
    for (std::size_t i = 0; i < members.size(); ++i) {
        auto& in = members[i];
        double const x = std::fmod(static_cast<double>(i) * 0.6180339887498949, 1.0);
        in.eta = 0;
        in.vy = -0.01 * std::pow(400, x);
    }
    for (auto const method : {Method::automatic, Method::dopri5}) {
        auto const r = testing::run(best_isa(), options_of(method, 0.01), members);
        EXPECT_GE(spread(r), 10) << name_of(method);
        EXPECT_GE(utilisation(r), 0.90) << name_of(method);
    }
}

}  // namespace
}  // namespace slideway::refill_test
