// The energy audit (model.md 8): what the conservative law keeps and what the paper's mode switching makes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/ensemble.hpp"

namespace slideway {
namespace {

/// Largest |value| of a quantity over the members.
double worst(testing::EnsembleResult const& r, Quantity q) {
    double value = 0;
    for (std::size_t i = 0; i < r.records.size(); ++i) {
        EXPECT_EQ(r.records[i].status, Status::finished);
        value = std::max(value, std::abs(r.value(i, q)));
    }
    return value;
}

testing::RunOptions options(Law law, double tolerance, double end_time) {
    testing::RunOptions o;
    o.parts = {law, Damping::point, true, false};
    // What the tolerance does, for a method that has no other: auto's stiff part has a floor of its own.
    o.settings.method = Method::dopri5;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = end_time;
    o.settings.max_steps = 3'000'000;
    return o;
}

/// Energies that tolerances left behind.  Members are chaotic: one of them may gain little where another gains much, so that what
/// falls is the trend.
struct Trend {
    std::vector<double> tolerances, energies;

    void add(double tolerance, double energy) {
        tolerances.push_back(std::log10(tolerance));
        energies.push_back(std::log10(energy));
    }
    /// Orders of energy for one of the tolerance, by least squares.
    double slope() const {
        auto const n = static_cast<double>(tolerances.size());
        double const x = std::accumulate(tolerances.begin(), tolerances.end(), 0.0) / n;
        double const y = std::accumulate(energies.begin(), energies.end(), 0.0) / n;
        double products = 0, squares = 0;
        for (std::size_t i = 0; i < tolerances.size(); ++i) {
            products += (tolerances[i] - x) * (energies[i] - y);
            squares += (tolerances[i] - x) * (tolerances[i] - x);
        }
        return products / squares;
    }
};

TEST(ConservativeLaw, KeepsTheEnergyOfAFreeStart) {
    // No friction, no damping, crank at rest: nothing may change the energy, and 0.1 s holds about ten impacts.
    auto members = testing::scattered_starts(16, 1e-4, 0.0);
    for (auto& in : members) in.eta = 0;
    double onsets = 0;
    Trend trend;
    struct {
        double tolerance, bound;
    } const steps[] = {{1e-5, 1e-5}, {1e-7, 1e-6}, {1e-9, 1e-8}, {1e-11, 1e-10}};
    for (auto const& [tolerance, bound] : steps) {
        auto o = options(Law::conservative, tolerance, 0.1);
        o.parts.friction = false;
        auto const r = testing::run(best_isa(), o, members);
        double const change = worst(r, Quantity::energy_change);
        for (std::size_t i = 0; i < members.size(); ++i)
            onsets = std::max(onsets, r.value(i, Quantity::contact_onsets));
        EXPECT_LT(change, bound) << tolerance;
        trend.add(tolerance, change);
    }
    EXPECT_GT(trend.slope(), 0.6);
    EXPECT_GE(onsets, 5) << "the members must have met the way";
}

TEST(ConservativeLaw, ResidualFallsWithTheTolerance) {
    // Friction, damping and the crank on; 0.3 s of the defaults: 2e-8 J at 1e-6, 1e-11 J at 1e-10 (model.md 8).
    auto const members = testing::scattered_starts(8);
    Trend trend;
    struct {
        double tolerance, bound;
    } const steps[] = {{1e-4, 1e-4}, {1e-6, 1e-6}, {1e-8, 1e-8}, {1e-10, 1e-10}};
    for (auto const& step : steps) {
        auto const r = testing::run(best_isa(), options(Law::conservative, step.tolerance, 0.3), members);
        double const residual = worst(r, Quantity::energy_residual);
        RecordProperty("residual_at_" + std::to_string(step.tolerance), std::to_string(residual));
        EXPECT_LT(residual, step.bound) << step.tolerance;
        trend.add(step.tolerance, residual);
    }
    EXPECT_GT(trend.slope(), 0.6);
}

TEST(PaperLaw, MakesEnergyWhereModesSwitch) {
    // 0.3 s of the defaults: 1.6 to 4.0 mJ, always positive, against 31 mJ of crank work (model.md 8).
    auto const members = testing::scattered_starts(16);
    auto const r = testing::run(best_isa(), options(Law::paper, 1e-8, 0.3), members);
    for (std::size_t i = 0; i < members.size(); ++i) {
        EXPECT_GT(r.value(i, Quantity::energy_residual), 0.5e-3) << i;
        EXPECT_LT(r.value(i, Quantity::energy_residual), 8e-3) << i;
    }
}

TEST(PaperLaw, ResidualDoesNotFallWithTheTolerance) {
    auto const members = testing::scattered_starts(8);
    auto const mean = [&](double tolerance) {
        auto const r = testing::run(best_isa(), options(Law::paper, tolerance, 0.1), members);
        double sum = 0;
        for (std::size_t i = 0; i < members.size(); ++i) sum += r.value(i, Quantity::energy_residual);
        return sum / static_cast<double>(members.size());
    };
    double const loose = mean(1e-6), tight = mean(1e-10);
    EXPECT_GT(loose, 1e-4);
    EXPECT_GT(tight, 1e-4);
    EXPECT_LT(std::abs(loose - tight), 0.7 * std::max(loose, tight));
}

}  // namespace
}  // namespace slideway
