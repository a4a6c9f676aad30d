// Oblique impacts of one apex with Coulomb friction against the closed form of rigid bodies that touch at a point (model.md 13): Newton's
// restitution, and friction that either stops the slip or opposes what is left of it with all its strength.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_oblique_test {
namespace {

using testing::joint_samples;
using testing::JointState;
using testing::rigid_joint_parts;
using testing::rigid_options;
using Real = long double;
using Vector2 = Eigen::Matrix<Real, 2, 1>;
using Vector3 = Eigen::Matrix<Real, 3, 1>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
using Vector6 = Eigen::Matrix<Real, 6, 1>;

/// (M1.1)
Matrix3 attitude(Real roll, Real yaw, Real pitch) {
    using Turn = Eigen::AngleAxis<Real>;
    return (Turn(pitch, Vector3::UnitZ()) * Turn(yaw, Vector3::UnitY()) * Turn(roll, Vector3::UnitX()))
        .toRotationMatrix();
}

Vector3 inertia(Inputs const& in) { return {in.slider_inertia_x, in.slider_inertia_y, in.slider_inertia_z}; }

/// An apex on the way's upper edges and the slider's upper face, which a slider that falls meets, for one that does not turn.
struct Corner {
    Matrix3 axes;
    Vector3 arm;
    Real gap;

    Corner(Inputs const& in, int s2, int s3)
        : axes(attitude(in.roll, in.yaw, in.pitch)),
          arm(s3 * Real(in.slider_length) / 2, Real(in.way_width) / 2 - in.y, s2 * Real(in.way_depth) / 2 - in.z),
          gap(Real(in.way_width) / 2 + in.clearance_y - axes.col(1).dot(arm)) {}
};

/// The corner whose gap is smallest, and when it closes.
struct Meeting {
    Corner corner;
    Real time, fall;  // [s], [m/s] gained by then

    explicit Meeting(Inputs const& in) : corner(in, 1, 1) {
        for (int const s2 : {-1, 1}) {
            for (int const s3 : {-1, 1}) {
                if (Corner const other(in, s2, s3); other.gap < corner.gap) corner = other;
            }
        }
        // gap + (n_Y vy + n_Z vz) t − n_Y g t²/2 = 0
        Real const n = corner.axes(1, 1), rate = n * in.vy + corner.axes(2, 1) * in.vz, pull = n * in.gravity;
        time = 2 * corner.gap / (std::sqrt(rate * rate + 2 * pull * corner.gap) - rate);
        fall = in.gravity * time;
        corner.arm -= Vector3(0, in.vy * time - fall * time / 2, in.vz * time);
    }
};

/// G, and the velocities before the impact, along the gap and both axes of the face: rows act on (u', ω in the slider's frame).
struct PointImpact {
    Eigen::Matrix<Real, 3, 6> rows;
    Vector6 mobility, before;
    Matrix3 yields;
    Vector3 approach;
    Real restitution;

    PointImpact(Inputs const& in, Meeting const& met) : restitution(in.restitution) {
        auto const& [axes, arm, gap] = met.corner;
        Vector3 const normal = axes.col(1), along = axes.col(0), across = axes.col(2);
        rows << 0, normal.y(), normal.z(), (axes.transpose() * arm.cross(normal)).transpose(),  //
            along.transpose(), (axes.transpose() * arm.cross(along)).transpose(),               //
            across.transpose(), (axes.transpose() * arm.cross(across)).transpose();
        mobility << Vector3::Constant(1 / Real(in.slider_mass)), inertia(in).cwiseInverse();
        before << in.vx, in.vy - met.fall, in.vz, 0, 0, 0;
        yields = rows * mobility.asDiagonal() * rows.transpose();
        approach = rows * before;
    }

    [[nodiscard]] Real rebound() const { return -(1 + restitution) * approach[0]; }
    /// Impulses that stop the slip.
    [[nodiscard]] Vector3 sticking() const {
        return yields.fullPivLu().solve(Vector3(rebound(), -approach[1], -approach[2]));
    }
    /// The friction from which the slip stops.
    [[nodiscard]] Real needed_friction() const { return sticking().tail<2>().norm() / sticking()[0]; }

    /// Impulses if the slip that is left has the direction `angle`.
    [[nodiscard]] Vector3 slipping(Real friction, Real angle) const {
        Vector3 const load(1, -friction * std::cos(angle), -friction * std::sin(angle));
        return load * (rebound() / yields.row(0).dot(load));
    }
    /// Of the slip that is left: along and across this direction.
    [[nodiscard]] Vector2 left(Real friction, Real angle) const {
        Vector2 const slip = (approach + yields * slipping(friction, angle)).tail<2>();
        return {std::cos(angle) * slip.x() + std::sin(angle) * slip.y(),
                std::cos(angle) * slip.y() - std::sin(angle) * slip.x()};
    }
    /// Impulses that leave a slip which they oppose.
    [[nodiscard]] Vector3 slipping(Real friction) const {
        Real const turn = 2 * std::numbers::pi_v<Real> / 3600;
        for (int i = 0; i < 3600; ++i) {
            Real low = i * turn, high = low + turn;
            Real const sign = left(friction, low).y();
            if (sign * left(friction, high).y() > 0 || left(friction, low).x() < 0) continue;
            for (int k = 0; k < 70; ++k) {
                Real const middle = (low + high) / 2;
                (sign * left(friction, middle).y() > 0 ? low : high) = middle;
            }
            return slipping(friction, low);
        }
        ADD_FAILURE() << "no slip";
        return {};
    }
    [[nodiscard]] Vector3 unlimited(Real friction) const {
        return friction < needed_friction() ? slipping(friction) : sticking();
    }
    /// Of these impulses.
    [[nodiscard]] Real energy(Vector3 const& impulse) const { return (approach + yields * impulse / 2).dot(impulse); }
    /// Newton's restitution makes energy of some slips: the impulses are then as far from those without restitution as none is made (M13.7).
    [[nodiscard]] Vector3 impulses(Real friction) const {
        Vector3 const wanted = unlimited(friction);
        if (energy(wanted) <= 0) return wanted;
        PointImpact plastic = *this;
        plastic.restitution = 0;
        Vector3 const least = plastic.unlimited(friction);
        Real low = 0, high = 1;
        for (int k = 0; k < 70; ++k) {
            Real const middle = (low + high) / 2;
            (energy(least + middle * (wanted - least)) < 0 ? low : high) = middle;
        }
        return least + low * (wanted - least);
    }
};

/// A slider of unequal sides whose upper face falls on one corner of its way.
Inputs falling(double e, double vx, double vz) {
    Inputs in;
    in.slider_length = 0.05, in.way_width = 0.02, in.way_depth = 0.03;
    in.clearance_y = in.clearance_z = 1e-3;
    in.slider_mass = 0.2, in.slider_inertia_x = 6e-5, in.slider_inertia_y = 9e-5, in.slider_inertia_z = 4e-5;
    in.restitution = e;
    in.roll = 0.012, in.yaw = -0.005, in.pitch = 0.009;
    in.y = -5e-4;
    in.vx = vx, in.vy = -0.2, in.vz = vz;
    return complete_inputs(in);
}

struct Landed {
    JointState state;
    double friction_loss, damping_loss, onsets;
};

Landed landed(Inputs const& in, double time) {
    auto o = rigid_options(rigid_joint_parts(true), 1e-12, time);
    o.series = selections::twelve_states;
    o.sample_times = {time};
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return {joint_samples(r, 1, 1)[0][0], r.value(0, Quantity::friction_loss), r.value(0, Quantity::damping_loss),
            r.value(0, Quantity::contact_onsets)};
}

/// @param share of the friction that stops the slip  @param tolerance of velocities [m/s], of angular momenta and losses as shares
void expect_closed_form(Inputs in, Real share, double tolerance) {
    Meeting const met(in);
    PointImpact const impact(in, met);
    Real const friction = share * impact.needed_friction();
    in.friction_static = in.friction_kinetic = static_cast<double>(friction);
    Vector3 const impulse = impact.impulses(in.friction_kinetic), after = impact.approach + impact.yields * impulse;
    Vector6 const rates = impact.before + impact.mobility.asDiagonal() * impact.rows.transpose() * impulse;

    double const wait = 2e-5, end = static_cast<double>(met.time) + wait;
    auto const [s, friction_loss, damping_loss, onsets] = landed(in, end);
    ASSERT_EQ(onsets, 1);
    Real const since = end - met.time;
    EXPECT_NEAR(static_cast<double>(s.vx - rates[0]), 0, tolerance) << share;
    EXPECT_NEAR(static_cast<double>(s.vy + in.gravity * since - rates[1]), 0, tolerance) << share;
    EXPECT_NEAR(static_cast<double>(s.vz - rates[2]), 0, tolerance) << share;
    // In flight nothing turns the slider: its angular momentum in space stays.
    Vector3 const turning = attitude(s.roll, s.yaw, s.pitch) * inertia(in).cwiseProduct(Vector3(s.wx, s.wy, s.wz));
    Vector3 const expected = met.corner.axes * inertia(in).cwiseProduct(rates.tail<3>());
    EXPECT_LT(static_cast<double>((turning - expected).norm()), tolerance * static_cast<double>(expected.norm()))
        << share;
    Vector3 const lost = -(impact.approach + after).cwiseProduct(impulse) / 2;
    double const scale = static_cast<double>(lost.cwiseAbs().sum());
    EXPECT_NEAR(damping_loss, static_cast<double>(lost[0]), 10 * tolerance * scale) << share;
    EXPECT_NEAR(friction_loss, static_cast<double>(lost[1] + lost[2]), 10 * tolerance * scale) << share;
}

TEST(RigidOblique, ImpactsOfOneApexSlipBelowTheFrictionThatStopsThemAndStickAbove) {
    for (double const e : {0.2, 0.5, 0.9}) {
        for (double const vx : {-0.06, 0.02, 0.15}) {
            for (double const vz : {-0.04, 0.03}) {
                auto const in = falling(e, vx, vz);
                for (Real const share : {0.1L, 0.5L, 0.9L, 0.999L, 1.1L, 1.5L}) expect_closed_form(in, share, 1e-10);
                // Little holds the slip: the loads converge slowly.
                expect_closed_form(in, 1.001L, 5e-9);
            }
        }
    }
}

TEST(RigidOblique, FrictionThatNeverStopsTheSlipTakesItsShareOfTheImpulse) {
    // Fast along the way: the friction is μ times the load whatever the speed, so twice the speed leaves the same impulse.
    auto in = falling(0.5, 3, 0);
    in.friction_static = in.friction_kinetic = 0.1;
    auto twice = in;
    twice.vx = 6;
    double const end = static_cast<double>(Meeting(in).time) + 2e-5;
    auto const slow = landed(in, end).state, fast = landed(twice, end).state;
    EXPECT_NEAR(static_cast<double>((fast.vx - 6) / (slow.vx - 3)), 1, 1e-4);
    Real const pushed = (slow.vy + in.gravity * Real(end) - in.vy), dragged = slow.vx - 3;
    EXPECT_NEAR(static_cast<double>(-dragged / pushed), 0.1, 0.1 * 0.012);  // up to the tilt
}

}  // namespace
}  // namespace slideway::rigid_oblique_test
