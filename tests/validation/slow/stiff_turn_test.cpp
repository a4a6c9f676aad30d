// What `auto` saves over a full turn of the crank, most of it in settled contact: too long for every build.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::stiff_turn_test {
namespace {

struct Turn {
    double evaluations = 0;  // of right-hand side or Jacobian, per member
    double residual = 0;     // 95th percentile of |ε| [J]
};

Turn settle(Method method, double tolerance) {
    auto members = testing::scattered_starts(64, 1e-4, std::numbers::pi);
    for (auto& in : members) in.chi_line = in.chi_surface = 10;
    testing::RunOptions o;
    o.parts = {Law::conservative, Damping::rate, true, false};
    o.settings.method = method;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = 2;
    auto const r = testing::run(best_isa(), o, members);
    Turn turn;
    std::vector<double> residuals;
    for (std::size_t i = 0; i < members.size(); ++i) {
        EXPECT_EQ(r.records[i].status, Status::finished);
        turn.evaluations +=
            static_cast<double>(r.records[i].rhs_evaluations + r.records[i].jacobian_evaluations) / 64.0;
        residuals.push_back(std::abs(r.value(i, Quantity::energy_residual)));
    }
    std::sort(residuals.begin(), residuals.end());
    turn.residual = residuals[residuals.size() * 95 / 100];
    return turn;
}

TEST(AutoMethodTurn, TakesASixtiethOfTheExplicitWorkAtTheSameResidual) {
    auto const pair = settle(Method::dopri5, 1e-3);
    // The coarsest tolerance whose residual is no larger.
    Turn best;
    for (double tolerance = 1e-3; tolerance > 1e-4; tolerance /= 2) {
        best = settle(Method::automatic, tolerance);
        if (best.residual <= pair.residual) break;
    }
    EXPECT_LE(best.residual, pair.residual);
    EXPECT_GE(pair.evaluations, 60 * best.evaluations);
    RecordProperty("evaluations_dopri5", std::to_string(pair.evaluations));
    RecordProperty("evaluations_auto", std::to_string(best.evaluations));
}

}  // namespace
}  // namespace slideway::stiff_turn_test
