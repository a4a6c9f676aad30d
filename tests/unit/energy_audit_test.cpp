// What an energy audit says of the method that integrated the member.
#include "kernels/observers/energy_audit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernels/methods.hpp"

namespace slideway {
namespace {

using Audit = EnergyAudit<double>;

/// An audit whose residual is `residual`, beside friction and damping losses of 1 mJ each and a crank that moved `turnover`.
Audit audit_with(double residual, double turnover = 0, double stored = 0) {
    double const friction = 1e-3, damping = 1e-3, work = 0.5 * turnover;
    return {residual + work - friction - damping, work, friction, damping, turnover, stored};
}

constexpr EnergyScales<double> scales{1e-9, 2e-4, 4e-3};  // M (c ω)², M a c, √(c/a)

bool unstable_if_conserving(Audit const& audit) { return left_stable_range<true>(audit, scales, 0.1); }
bool unstable_if_switching(Audit const& audit, double time) { return left_stable_range<false>(audit, scales, time); }

TEST(EnergyAudit, ResidualIsWhatTheBooksDoNotExplain) {
    EXPECT_DOUBLE_EQ((Audit{5, 7, 1, 2, 0, 0}.residual()), 1);
    EXPECT_NEAR(audit_with(-3e-4, 0.02).residual(), -3e-4, 1e-17);
}

TEST(EnergyAudit, OfAConservingLawAllowsAFifthOfWhatWasTurnedOver) {
    for (double const sign : {1.0, -1.0}) {
        EXPECT_FALSE(unstable_if_conserving(audit_with(sign * 3.99e-4)));
        EXPECT_TRUE(unstable_if_conserving(audit_with(sign * 4.01e-4)));
        EXPECT_FALSE(unstable_if_conserving(audit_with(sign * 5.99e-4, 0, 1e-3))) << "contact stored 1 mJ";
        EXPECT_TRUE(unstable_if_conserving(audit_with(sign * 6.01e-4, 0, 1e-3)));
    }
}

TEST(EnergyAudit, OfAConservingLawAllowsAThousandthOfTheCrank) {
    EXPECT_FALSE(unstable_if_conserving(audit_with(1.39e-3, 1)));
    EXPECT_TRUE(unstable_if_conserving(audit_with(1.41e-3, 1)));
}

TEST(EnergyAudit, OfASwitchingLawAllowsWhatCrankContactAndCrossingsBrought) {
    // 25 crossings of 4 ms in 0.1 s, and one more: 26 × 0.2 mJ.
    double const bound = 10e-3 + 3e-3 + 26 * 2e-4;
    EXPECT_FALSE(unstable_if_switching(audit_with(bound - 1e-5, 10e-3, 3e-3), 0.1));
    EXPECT_TRUE(unstable_if_switching(audit_with(bound + 1e-5, 10e-3, 3e-3), 0.1));
    EXPECT_FALSE(unstable_if_switching(audit_with(bound + 1e-5, 10e-3, 3e-3), 0.2)) << "more time, more crossings";
}

TEST(EnergyAudit, WithoutANumberIsNotStable) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    double const infinity = std::numeric_limits<double>::infinity();
    for (double const residual : {nan, infinity, -infinity}) {
        EXPECT_TRUE(unstable_if_conserving(audit_with(residual)));
        EXPECT_TRUE(unstable_if_switching(audit_with(residual), 0.1));
    }
}

TEST(EnergyAudit, KnowsNoCrossingsWithoutGravityAndCrank) {
    EnergyScales<double> const weightless{1e-9, 0, std::numeric_limits<double>::infinity()};
    EXPECT_FALSE(left_stable_range<false>(Audit{0, 0, 0, 0, 0, 0}, weightless, 1.0));
    EXPECT_TRUE(left_stable_range<false>(Audit{2e-9, 0, 0, 0, 0, 0}, weightless, 1.0));
}

TEST(Methods, WithoutASafeErrorControlAreAlwaysAudited) {
    EXPECT_TRUE(is_always_audited(Method::rk4));
    EXPECT_TRUE(is_always_audited(Method::ros34pw2));
    EXPECT_FALSE(is_always_audited(Method::automatic));
    EXPECT_FALSE(is_always_audited(Method::dopri5));
    EXPECT_FALSE(is_always_audited(Method::bs32));
}

}  // namespace
}  // namespace slideway
