// What a check makes of members' numbers, of made-up ones.
#include "host/study/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/support/scene_fixture.hpp"

namespace slideway::testing::verification_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t members = 16;

Scene scene() {
    return scene_of("schema = 1\n[mechanism]\nkind = \"slider_crank\"\n[study]\nkind = \"ensemble\"\nmembers = 1000\nduration = \"1 s\"\nsamples = 0\n");
}

std::vector<double> draws(double mean, double sd, unsigned seed, std::size_t count = members) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> draw(mean, sd);
    std::vector<double> values(count);
    for (double& x : values) x = draw(engine);
    return values;
}

std::vector<double> plus(std::vector<double> values, double shift) {
    for (double& x : values) x += shift;
    return values;
}

/// One column of a study and of one check of it.
std::vector<MemberNumbers> numbers(std::vector<double> own, std::vector<double> again, bool is_exponent = false, std::string unit = "N") {
    return {{{{"column", unit, is_exponent, std::move(own)}}, {}, {}}, {{{"column", unit, is_exponent, std::move(again)}}, {}, {}}};
}

CheckedColumn checked(std::vector<MemberNumbers> const& numbers, std::vector<double> const& whole = {}) {
    std::vector<WholeColumn> columns;
    if (!whole.empty()) columns.push_back(whole_of(whole));
    auto const findings = compare(numbers, scene(), columns, 1000);
    EXPECT_EQ(findings.size(), 1u);
    return findings.front();
}

/// A check by `auto` at a hundredth of the tolerance costs four times a member's work, one by dopri5 ten times (docs/integrators.md); together they may
/// have a tenth of the study's, the first one four fifths of that, for six members at least and sixteen at most.
TEST(ForeseenCheck, IsOfAsManyMembersAsATenthOfTheWorkAllows) {
    EXPECT_EQ(foreseen_check(scene(), {}, 1000), 16 * 4);              // of 100 left for both 36 are no room for 16 · 10
    EXPECT_EQ(foreseen_check(scene(), {}, 300), 6 * 4);                // 0.8 · 30 / 4
    EXPECT_EQ(foreseen_check(scene(), {}, 10'000), 16 * 4 + 16 * 10);  // 800, and then 936
    EXPECT_EQ(foreseen_check(scene(), {}, 100), 0);                    // not even for six
}

TEST(ForeseenCheck, IsOfTheMembersThatAreAskedFor) {
    EXPECT_EQ(foreseen_check(scene(), 5u, 1000), 5 * 14);
    EXPECT_EQ(foreseen_check(scene(), 5u, 1), 14);
    EXPECT_EQ(foreseen_check(scene(), 0u, 1000), 0);
}

TEST(ForeseenCheck, RunsMembersThatAreNotStoredInTheStudysWayToo) {
    Scene kept = scene();
    kept.store = Store::statistics;
    EXPECT_EQ(foreseen_check(kept, {}, 1000), 16 + 16 * 4);
    EXPECT_EQ(foreseen_check(kept, {}, 300), 0);
}

/// A steel block of 0.1872 kg falls through 0.1 mm: 1.8366e-4 J with what the crank's speed of π rad/s adds.
TEST(EnergyCheck, IsOfTheFallThroughTheClearance) {
    EXPECT_NEAR(fall_energy(scene()), 0.1872 * (9.81 * 1e-4 + std::pow(1e-4 * std::numbers::pi, 2)), 1e-12);
    MemberNumbers numbers;
    EXPECT_FALSE(audit_energy(numbers, scene())) << "no check asked for it";
    numbers.energy_residual = {1e-6, -1e-6, nan, 1e-6};
    auto const little = audit_energy(numbers, scene());  // 1 s is less than a revolution, and counts as one
    ASSERT_TRUE(little);
    EXPECT_NEAR(little->share, 1e-6 / fall_energy(scene()), 1e-12);
    EXPECT_FALSE(little->is_too_much);
    numbers.energy_residual.assign(4, -2e-6);
    EXPECT_TRUE(audit_energy(numbers, scene())->is_too_much);
    Scene longer = scene();
    longer.integrator.end_time = 20;  // ten revolutions
    EXPECT_NEAR(audit_energy(numbers, longer)->share, 2e-7 / fall_energy(scene()), 1e-12);
    numbers.energy_residual.assign(4, nan);
    EXPECT_FALSE(audit_energy(numbers, scene())) << "nobody came to the end";
}

TEST(EnergyCheck, IsAskedOfExponentsUnderALawThatKeepsEnergyByOneCheckAlone) {
    auto const audits = [](std::string const& law, std::string const& kind, std::string const& asked = "") {
        Scene const study = scene_of("schema = 1\n[contact]\nlaw = \"" + law + "\"\n[study]\nkind = \"" + kind +
                                     "\"\nmembers = 8\nduration = \"2 s\"\n" + asked);
        auto const methods = check_methods(study);
        for (CheckMethod const& m : methods) {
            // The study's own orbits, with their energy.
            if (m.audits_energy) {
                EXPECT_EQ(m.scene.integrator.rtol, study.integrator.rtol);
                EXPECT_TRUE(selects(m.scene.quantities, Quantity::energy_residual));
            }
        }
        return std::ranges::count_if(methods, &CheckMethod::audits_energy);
    };
    std::string const residual = "quantities = [\"energy_residual\"]\n";
    EXPECT_EQ(audits("conservative", "lyapunov"), 1);
    EXPECT_EQ(audits("kelvin_voigt", "lyapunov", residual), 1);
    EXPECT_EQ(audits("paper", "lyapunov", residual), 0) << "its switches make energy";
    EXPECT_EQ(audits("conservative", "tolerance", residual), 0) << "no exponents";
    EXPECT_EQ(audits("paper", "tolerance", residual), 0);
}

/// `auto` is dopri5 where no method for stiff members stands beside it: each of the two would say what the other says.
TEST(CheckMethods, AreTwoWhereAutoHasNoStiffMethodToo) {
    std::string const planar = "[mechanism]\nkind = \"planar_slider_crank\"\n", rigid = "[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n";
    for (std::string const& scene : {planar, planar + rigid, rigid}) {
        for (std::string const method : {"auto", "dopri5", "bs32", "dop853", "verner65"}) {
            Scene const study = scene_of("schema = 1\n" + scene + "[integrator]\nmethod = \"" + method + "\"\n[study]\nmembers = 8\nduration = \"2 s\"\n");
            std::vector<CheckMethod> const methods = check_methods(study);
            ASSERT_EQ(methods.size(), 2u);
            auto const explicit_method = [](CheckMethod const& one) {
                return one.scene.integrator.method == Method::automatic ? Method::dopri5 : one.scene.integrator.method;
            };
            EXPECT_NE(explicit_method(methods[0]), explicit_method(methods[1])) << scene << method;
        }
    }
}

TEST(CheckedNumbers, ThatScatterByRoundingAreTheSame) {
    auto const own = draws(100, 10, 1);
    auto again = own;
    for (double& x : again) x *= 1 + 1e-9;
    EXPECT_FALSE(checked(numbers(own, again)).differs);
}

TEST(CheckedNumbers, ThatAllShiftDifferOnceItCounts) {
    auto const own = draws(100, 10, 1);
    // Half the interval of a mean of a thousand is 0.6: certain, and of no interest, below.
    EXPECT_FALSE(checked(numbers(own, plus(own, 0.2))).differs);
    CheckedColumn const found = checked(numbers(own, plus(own, 2)));
    EXPECT_TRUE(found.differs);
    EXPECT_NEAR(found.pairs.difference, 2, 1e-12);
    EXPECT_FALSE(found.refutes_sign);
}

TEST(CheckedNumbers, OfTooFewMembersAreNotTested) {
    std::vector<double> const own{1, 2, 3, 4, 5};
    EXPECT_FALSE(checked(numbers(own, plus(own, 100))).differs);
}

TEST(CheckedNumbers, OfMembersThatFailedOnEitherSideAreLeftOut) {
    auto own = draws(100, 10, 1), again = plus(own, 2);
    own[3] = nan;
    again[5] = nan;
    CheckedColumn const found = checked(numbers(own, again));
    EXPECT_EQ(found.pairs.pairs, members - 2);
    EXPECT_TRUE(found.differs);
}

TEST(CheckedNumbers, OfAnotherDistributionWithTheSameMeanDiffer) {
    auto const own = draws(0, 1, 1, 64);
    EXPECT_TRUE(checked(numbers(own, draws(0, 100, 2, 64))).differs);
}

TEST(CheckedNumbers, OfManyMembersTellWhatFewDoNot) {
    // What these members were by chance hides what the study is off by.
    auto const again = draws(1, 0.1, 3);
    auto const own = draws(1, 10, 4);
    auto const whole = draws(6, 10, 5, 1000);
    EXPECT_FALSE(checked(numbers(own, again)).differs);
    EXPECT_TRUE(checked(numbers(own, again), whole).differs);
}

TEST(CheckedNumbers, AsSkewedAsRareEventsAreNotHeldAgainstAllMembers) {
    // One member in a hundred does all of it; the check has none of them.
    std::vector<double> whole(1000, 0);
    for (std::size_t i = 0; i < whole.size(); i += 100) whole[i] = 100;
    auto const own = draws(0, 1e-3, 6);
    EXPECT_FALSE(checked(numbers(own, own), whole).differs);
    EXPECT_EQ(checked(numbers(own, own), whole).welch, 0);
}

TEST(CheckedNumbers, RefuteASignThatOnlyTheStudyIsCertainOf) {
    auto const positive = draws(4000, 500, 7), negative = draws(-1, 0.1, 8);
    EXPECT_TRUE(checked(numbers(positive, negative, true)).refutes_sign);
    EXPECT_TRUE(checked(numbers(positive, draws(0, 100, 9), true)).refutes_sign);
    EXPECT_FALSE(checked(numbers(positive, plus(positive, 100), true)).refutes_sign) << "larger, of the same sign";
    EXPECT_FALSE(checked(numbers(draws(0, 100, 10), draws(5, 100, 11), true)).refutes_sign) << "certain in neither";
    EXPECT_FALSE(checked(numbers(positive, negative)).refutes_sign) << "no exponent";
}

TEST(CheckedNumbers, BelowWhatTheFallThroughTheClearanceGivesAreTheSame) {
    // 1e-4 of some 0.2 mJ.
    auto const own = draws(0, 1e-12, 12);
    EXPECT_FALSE(checked(numbers(own, plus(own, 1e-9), false, "J")).differs);
    EXPECT_TRUE(checked(numbers(own, plus(own, 1e-6), false, "J")).differs);
    EXPECT_FALSE(checked(numbers(own, plus(own, 5e-5), false, "s")).differs) << "of one second";
    EXPECT_TRUE(checked(numbers(own, plus(own, 1e-3), false, "s")).differs);
}

TEST(CheckedNumbers, LeaveOutTheResidualOfALawThatKeepsEnergy) {
    auto const has_residual = [](char const* law) {
        Scene scene = scene_of(std::string("schema = 1\n[mechanism]\nkind = \"slider_crank\"\n[contact]\nlaw = \"") + law +
                               "\"\n[study]\nkind = \"ensemble\"\nmembers = 1\nduration = \"1 us\"\nsamples = 0\nquantities = [\"energy_residual\"]\n");
        auto const backend = cpu_backend(best_isa());
        auto const columns = fresh_numbers(scene, {0}, *backend, 1, nullptr).columns;
        return std::any_of(columns.begin(), columns.end(), [](auto const& column) { return column.name == "energy_residual"; });
    };
    EXPECT_TRUE(has_residual("paper"));
    EXPECT_FALSE(has_residual("conservative"));
    EXPECT_FALSE(has_residual("kelvin_voigt"));
}

}  // namespace
}  // namespace slideway::testing::verification_test
