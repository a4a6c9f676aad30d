// How a slider's centre answers to impulses where its crank turns freely, and what the crank does then.
#include <gtest/gtest.h>

#include <numbers>

#include "kernels/mechanisms/scotch_yoke_motor.hpp"
#include "kernels/mechanisms/slider_crank_motor.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway::guided_centre_test {
namespace {

Inputs inputs(MechanismInfo const& of) {
    Inputs in;
    in.rod_mass = 0.3, in.rod_mass_center = 0.4, in.crank_mass = 0.2, in.drive_inertia = 2e-4;
    return complete_inputs(in, of);
}

/// An impulse P changes (q', y', z') so that masses · change = what they feel of it.
template <class Guide> void expect_momentum(double angle, double y) {
    SCOPED_TRACE(angle);
    auto const p = Guide::Base::parameters(inputs(Guide::info));
    double const s[12] = {y, -0.02, 0.3, -0.1, 0, 0, 0, 0, 0, 0, angle, 30};
    auto faults = Faults<double>::none();
    typename Guide::template At<double> at(0, s, p, DrivePlan{.by = DriveBy::nothing}, faults);
    auto const centre = at.centre(p);
    for (Vec3<double> const& impulse : {Vec3<double>{1, 0, 0}, Vec3<double>{0, 1, 0}, Vec3<double>{0, 0, 1}, Vec3<double>{-0.3, 0.7, 0.4}}) {
        auto const change = centre.response(impulse), felt = centre.feel(impulse);
        double const q = centre.rate_change(change);
        auto const& m = centre.masses;
        // Of 0.05 kg m²/s; what does not reach the crank at a dead centre is left out up to 1e-8 of that.
        EXPECT_NEAR(m.qq * q + m.qy * change.y + m.qz * change.z, felt.x, 2e-9);
        EXPECT_NEAR(m.qy * q + m.yy * change.y + m.yz * change.z, felt.y, 5e-8);
        EXPECT_NEAR(m.qz * q + m.yz * change.y + m.zz * change.z, felt.z, 5e-8);
        // As forces change accelerations.
        auto const with = at.accelerations(impulse, p), without = at.accelerations({0, 0, 0}, p);
        EXPECT_NEAR(change.x, with.x - without.x, 1e-9);
        EXPECT_NEAR(change.y, with.y - without.y, 1e-9);
        EXPECT_NEAR(change.z, with.z - without.z, 1e-9);
    }
}

TEST(GuidedCentre, OfAFreeCrankTakesImpulsesUpAtEveryAngle) {
    // Dead centres and their next neighbours among them: there x' does not say what θ' is.  They are at 0 and π of a slider on the crank's height.
    for (double const dead : {0.0, std::numbers::pi}) {
        for (double const off : {0.0, 1e-13, 1e-10, -1e-8, 1e-7, 1e-4, 0.5, -1.3}) {
            for (double const y : {0.0, 0.01}) expect_momentum<CrankAndRodOnMotor>(dead + off, y);
            expect_momentum<YokeOnMotor>(dead + off, 0.01);
        }
    }
}

}  // namespace
}  // namespace slideway::guided_centre_test
