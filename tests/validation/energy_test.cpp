// The energy audit (model.md 8): what laws of one potential keep and what the paper's mode switching makes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::energy_test {
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

/// Median |value|: how a quantity falls, which the one member that a tolerance treats worst does not tell.
double middle(testing::EnsembleResult const& r, Quantity q) {
    std::vector<double> values;
    for (std::size_t i = 0; i < r.records.size(); ++i) values.push_back(std::abs(r.value(i, q)));
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

testing::RunOptions options(Law law, double tolerance, double end_time) {
    testing::RunOptions o;
    o.parts = {law, Damping::point, true, false};
    o.settings.method = Method::dopri5;  // auto's stiff method has a floor of its own, see stiff_test.cpp
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = end_time;
    o.settings.max_steps = 3'000'000;
    return o;
}

/// Laws that do not switch.
class ConservingLaw : public ::testing::TestWithParam<Law> {};

TEST_P(ConservingLaw, KeepsTheEnergyOfAFreeStart) {
    // No friction, no damping, crank at rest: nothing may change the energy, and 0.1 s holds about ten impacts.
    auto members = testing::scattered_starts(16, 1e-4, 0.0, GetParam());
    for (auto& in : members) in.eta = 0;
    double onsets = 0, last = INFINITY;
    struct {
        double tolerance, bound;
    } const steps[] = {{1e-5, 1e-5}, {1e-7, 1e-6}, {1e-9, 1e-8}, {1e-11, 1e-10}};
    for (auto const& [tolerance, bound] : steps) {
        auto o = options(GetParam(), tolerance, 0.1);
        o.parts.friction = false;
        auto const r = testing::run(best_isa(), o, members);
        double const change = worst(r, Quantity::energy_change);
        for (std::size_t i = 0; i < members.size(); ++i)
            onsets = std::max(onsets, r.value(i, Quantity::contact_onsets));
        EXPECT_LT(change, bound) << tolerance;
        EXPECT_LT(middle(r, Quantity::energy_change), last / 10) << tolerance;
        last = middle(r, Quantity::energy_change);
    }
    EXPECT_GE(onsets, 5) << "the members must have met the way";
}

/// Falling starts of the default mechanism over 0.3 s.  @param bound [J] at a tolerance of 1, to which the residual is proportional
/// @return medians of the residual at tolerances of 1e-4, 1e-6, 1e-8 and 1e-10
std::vector<double> expect_falling_residual(Law law, std::vector<Inputs> const& members, bool friction, double bound) {
    std::vector<double> medians;
    for (double const tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
        auto o = options(law, tolerance, 0.3);
        o.parts.friction = friction;
        auto const r = testing::run(best_isa(), o, members);
        double const residual = worst(r, Quantity::energy_residual);
        ::testing::Test::RecordProperty("residual_at_" + std::to_string(tolerance), std::to_string(residual));
        EXPECT_LT(residual, bound * tolerance) << tolerance;
        double const last = medians.empty() ? INFINITY : medians.back();
        medians.push_back(middle(r, Quantity::energy_residual));
        EXPECT_LT(medians.back(), last / 10) << tolerance;
    }
    return medians;
}

TEST_P(ConservingLaw, ResidualFallsWithTheTolerance) {
    // Friction, damping and the crank on; 0.3 s of the defaults: 2e-8 J at 1e-6, 1e-11 J at 1e-10 (model.md 8).
    expect_falling_residual(GetParam(), testing::scattered_starts(8, 1e-4, 3.141592653589793, GetParam()), true, 1);
}

INSTANTIATE_TEST_SUITE_P(Laws, ConservingLaw, ::testing::ValuesIn([] {
                             auto found = testing::every_law();
                             std::erase_if(found, [](Law law) { return slideway::info(law).switches; });
                             return found;
                         }()),
                         [](auto const& p) { return std::string(slideway::info(p.param).name); });

TEST(KelvinVoigt, KeepsEnergyWithoutDampingAsTheConservativeLawDoes) {
    // Crank on, no friction, c = 0.
    auto const residuals = [](Law law) {
        auto members = testing::scattered_starts(8, 1e-4, 3.141592653589793, law);
        for (auto& in : members) in.eta = 0;
        return expect_falling_residual(law, members, false, 10);
    };
    auto const kelvin_voigt = residuals(Law::kelvin_voigt), conservative = residuals(Law::conservative);
    for (std::size_t i = 0; i < kelvin_voigt.size(); ++i) EXPECT_LT(kelvin_voigt[i], 10 * conservative[i]) << i;
}

/// Three of ten were, where steps found changes of the contacts by their error alone.
TEST(ContinuousLaws, HaveFewStepsRejected) {
    for (Law const law : testing::every_law()) {
        if (!slideway::info(law).continuous) continue;
        auto const r = testing::run(best_isa(), options(law, 1e-6, 0.1), testing::scattered_starts(32, 1e-4, 3.141592653589793, law));
        double accepted = 0, rejected = 0;
        for (auto const& record : r.records) accepted += record.steps_accepted, rejected += record.steps_rejected;
        EXPECT_LT(rejected, 0.2 * (accepted + rejected)) << slideway::info(law).name << ": " << rejected << " of " << accepted + rejected;
    }
}

TEST(Laws, MakeEnergyIfTheySaySo) {
    // Nothing rubs or damps, the crank is at rest: what changes the energy in the first impacts is the law.
    for (Law const law : testing::every_law()) {
        auto members = testing::scattered_starts(16, 1e-4, 0.0, law);
        for (auto& in : members) in.eta = 0;
        auto o = options(law, 1e-9, 0.02);
        o.parts.friction = false;
        double const made = worst(testing::run(best_isa(), o, members), Quantity::energy_change);
        EXPECT_EQ(made > 1e-6, info(law).switches) << info(law).name << ": " << made;
        EXPECT_EQ(made < 1e-8, !info(law).switches) << info(law).name << ": " << made;
    }
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
}  // namespace slideway::energy_test
