// What an energy audit says of the method that integrated the member.
#include "kernels/observers/energy_audit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "kernels/methods.hpp"

namespace slideway::energy_audit_test {
namespace {

using Audit = EnergyAudit<double>;

constexpr double smallest = 1e-9;  // M (c ω)²

/// An audit with friction and damping losses of 1 mJ each, whose method made `made` in sum.
Audit audit_with(double made, double turnover = 0, double stored = 0) {
    Audit audit{};
    audit.friction_loss = audit.damping_loss = 1e-3;
    audit.turnover = turnover;
    audit.stored = stored;
    audit.made = made;
    return audit;
}

/// The same whose steps lost and gained `astray` of the 10 mJ that contact exchanged, and nothing in sum.
Audit audit_astray(double astray, double turnover = 0) {
    auto audit = audit_with(0, turnover);
    audit.astray = astray;
    audit.exchanged = 10e-3;
    return audit;
}

bool is_unstable(Audit const& audit) { return left_stable_range(audit, smallest); }

TEST(EnergyAudit, ResidualIsWhatTheBooksDoNotExplain) {
    Audit audit{};
    audit.change = 5, audit.drive_work = 7, audit.friction_loss = 1, audit.damping_loss = 2;
    EXPECT_DOUBLE_EQ(audit.residual(), 1);
    audit.load_work = 3, audit.spring_loss = 4, audit.film_loss = 6;
    EXPECT_DOUBLE_EQ(audit.residual(), 8);
}

TEST(EnergyAudit, AllowsAFifthOfWhatContactTurnedOverAndAFiftiethOfFriction) {
    for (double const sign : {1.0, -1.0}) {
        EXPECT_FALSE(is_unstable(audit_with(sign * 2.19e-4)));
        EXPECT_TRUE(is_unstable(audit_with(sign * 2.21e-4)));
        EXPECT_FALSE(is_unstable(audit_with(sign * 4.19e-4, 0, 1e-3))) << "contact stored 1 mJ";
        EXPECT_TRUE(is_unstable(audit_with(sign * 4.21e-4, 0, 1e-3)));
    }
}

/// Tolerance and rounding leave of a flywheel's energy what is far more than a light slider's contacts ever store.
TEST(EnergyAudit, AllowsWhatRoundingLeavesOfAFlywheel) {
    Audit audit{};
    audit.energy = 10;
    audit.made = 0.99e-7;
    EXPECT_FALSE(is_unstable(audit));
    audit.made = 1.01e-7;
    EXPECT_TRUE(is_unstable(audit));
    audit.made = 0, audit.astray = 0.49e-7;
    EXPECT_FALSE(is_unstable(audit));
    audit.astray = 0.51e-7;
    EXPECT_TRUE(is_unstable(audit));
}

TEST(EnergyAudit, TakesAnOilFilmAsFriction) {
    auto audit = audit_with(2.19e-4);
    std::swap(audit.film_loss, audit.friction_loss);
    EXPECT_FALSE(is_unstable(audit));
    audit.made = 2.21e-4;
    EXPECT_TRUE(is_unstable(audit));
}

TEST(EnergyAudit, LossesThatMadeEnergyExcuseNothing) {
    auto audit = audit_with(1e-5);
    audit.damping_loss = -1;
    EXPECT_FALSE(is_unstable(audit)) << "a fiftieth of friction's 1 mJ";
    audit.friction_loss = -1;
    EXPECT_TRUE(is_unstable(audit));
    audit.friction_loss = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_unstable(audit));
}

TEST(EnergyAudit, AllowsAThousandthOfTheCrank) {
    EXPECT_FALSE(is_unstable(audit_with(1.21e-3, 1)));
    EXPECT_TRUE(is_unstable(audit_with(1.23e-3, 1)));
}

TEST(EnergyAudit, BlamesTheMethodForWhatItMadeAndNotForTheLaw) {
    auto audit = audit_with(0);
    audit.change = 1;  // a thousand times the losses, by the law
    EXPECT_FALSE(is_unstable(audit));
}

TEST(EnergyAudit, ContactsMustBeResolvedThoughGainsAndLossesCancel) {
    EXPECT_FALSE(is_unstable(audit_astray(1.24e-3)));
    EXPECT_TRUE(is_unstable(audit_astray(1.26e-3)));
    // What is small beside the bound of the sum does not matter: here 20 mJ.
    EXPECT_FALSE(is_unstable(audit_astray(9.9e-3, 20)));
    EXPECT_TRUE(is_unstable(audit_astray(10.3e-3, 20)));
}

TEST(EnergyAudit, WithoutANumberIsNotStable) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    double const infinity = std::numeric_limits<double>::infinity();
    for (double const made : {nan, infinity, -infinity}) EXPECT_TRUE(is_unstable(audit_with(made)));
    EXPECT_TRUE(is_unstable(audit_astray(nan)));
}

TEST(EnergyAudit, OfASliderThatNeverMovedIsStable) {
    Audit audit{};
    EXPECT_FALSE(is_unstable(audit));
    audit.made = 2e-9;
    EXPECT_TRUE(is_unstable(audit));
}

TEST(Methods, WithoutASafeErrorControlAreAlwaysAudited) {
    EXPECT_TRUE(is_always_audited(Method::rk4));
    EXPECT_TRUE(is_always_audited(Method::moreau_jean));
    EXPECT_TRUE(is_always_audited(Method::ros34pw2));
    EXPECT_FALSE(is_always_audited(Method::automatic));
    EXPECT_FALSE(is_always_audited(Method::dopri5));
    EXPECT_FALSE(is_always_audited(Method::bs32));
}

}  // namespace
}  // namespace slideway::energy_audit_test
