#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/mechanisms/guided_centre.hpp"
#include "kernels/mechanisms/offset_slider.hpp"
#include "kernels/mechanisms/slider_loads.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/twist.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

inline constexpr int pair_count = 4 * face_count;

/// A pair of an apex and the face that it may touch (M13.9): its gap grows by γ = normal · u, its apex slides along the face by slip · u.
template <class Real> struct JointPair {
    Twist<Real> normal, slip[2];
    Twist<Real> pushed, dragged[2];  // velocities that unit impulses along them give
    Real bias;                       // γ' of a slider that keeps its velocity [m/s²]
};

/// A slider with a rigid joint in one state: its pairs, and how it answers to impulses there.  What guides it is numbers.  Compiled once per instruction
/// set, as a RigidJoint is.
template <class Real> class JointPairs {
public:
    /// @param x, vx of the centre along the nominal way  @param s state of the slider, of which y z vy vz φ ϑ ψ ωx ωy ωz are looked at
    SLIDEWAY_NOINLINE JointPairs(GuidedCentre<Real> const& centre, Real x, Real vx, Real const* s, SliderParameters<Real> const& p, bool misaligned);

    GuidedCentre<Real> centre;
    Real x;  // [m]
    SliderTurning<Real> turning;
    JointMotion<Real> motion;
    Twist<Real> velocity;

    /// Takes up what acts on the slider beside weight, contact and drive.
    SLIDEWAY_FN void take_up(SliderLoads<Real> const& loads) {
        if (is_offset_) load_force_ = loads.force;
        else centre.unloaded = centre.unloaded + centre.response(loads.force);
        load_torque_ = loads.torque;
    }
    /// Lets the pin or the centre of mass lie elsewhere, before loads are taken up; `centre` is then the pin's.
    SLIDEWAY_FN void move(OffsetSlider<Real> const& offset) {
        offset_ = offset;
        is_offset_ = true;
    }

    SLIDEWAY_FN JointGeometry<Real> const& geometry() const { return p_.joint.geometry; }

    /// Change of the velocity by an impulse.
    SLIDEWAY_FN Twist<Real> response(Twist<Real> const& impulse) const {
        if (is_offset_) {
            auto const to = offset_.response(PinGuide{centre}, impulse.linear, offset_.about_pin(impulse.linear, impulse.angular, turning, p_), turning, p_);
            return {to.hole, to.spin_up};
        }
        auto const& light = p_.inverse_inertia;
        auto const& a = impulse.angular;
        return {centre.response(impulse.linear), {light.x * a.x, light.y * a.y, light.z * a.z}};
    }

    /// An impulse as the free components of the velocity feel it: q, y, z of the centre, and about the slider's axes.
    SLIDEWAY_FN void feel(Twist<Real> const& impulse, Real (&felt)[6]) const {
        auto const linear = centre.feel(impulse.linear);
        felt[0] = linear.x, felt[1] = linear.y, felt[2] = linear.z;
        felt[3] = impulse.angular.x, felt[4] = impulse.angular.y, felt[5] = impulse.angular.z;
        if (!is_offset_) return;
        // x' of the hole's centre follows its turning too.
        auto const& axes = turning.axes;
        auto const along = [&](Vec3<Real> const& axis) {
            auto const moved = cross(axis, offset_.pin);
            return fma(centre.slope_y, moved.y, fms(centre.slope_z, moved.z, moved.x));
        };
        felt[3] = fma(impulse.linear.x, along(axes.x), felt[3]);
        felt[4] = fma(impulse.linear.x, along(axes.y), felt[4]);
        felt[5] = fma(impulse.linear.x, along(axes.z), felt[5]);
    }
    /// Masses and inertias of these components.
    SLIDEWAY_FN void masses(Real (&m)[6][6]) const {
        if (is_offset_) {
            offset_.put_masses(centre, turning, p_, m);
            return;
        }
        for (auto& row : m) {
            for (auto& entry : row) entry = Real(0.0);
        }
        auto const& of_centre = centre.masses;
        m[0][0] = of_centre.qq, m[0][1] = m[1][0] = of_centre.qy, m[0][2] = m[2][0] = of_centre.qz;
        m[1][1] = of_centre.yy, m[1][2] = m[2][1] = of_centre.yz, m[2][2] = of_centre.zz;
        m[3][3] = p_.inertia.x, m[4][4] = p_.inertia.y, m[5][5] = p_.inertia.z;
    }

    /// Acceleration without contact: under weight, drive, loads and gyroscopic moment.
    SLIDEWAY_FN Twist<Real> unloaded_acceleration() const {
        if (is_offset_) {
            PinGuide by{centre};
            auto const to = offset_.answer(by, load_force_, load_torque_, turning, p_);
            return {to.hole, to.spin_up};
        }
        auto const& w = turning.omega;
        auto const& light = p_.inverse_inertia;
        Vec3<Real> momentum{p_.inertia.x * w.x, p_.inertia.y * w.y, p_.inertia.z * w.z};
        auto moment = cross(momentum, w) + load_torque_;
        return {centre.unloaded, {light.x * moment.x, light.y * moment.y, light.z * moment.z}};
    }

    /// Change of the rate q' of the guide that comes with one of the velocity.
    SLIDEWAY_FN Real rate_change(Twist<Real> const& change) const {
        if (!is_offset_) return centre.rate_change(change.linear);
        return centre.rate_change(change.linear + cross(from_slider(turning.axes, change.angular), offset_.pin));
    }

    /// What the drive does in an impact [J].  @param change of the velocity
    SLIDEWAY_FN Real impulse_work(Twist<Real> const& impulse, Twist<Real> const& change) const {
        if (!is_offset_) return centre.impulse_work(impulse.linear, change.linear);
        auto const turned = from_slider(turning.axes, change.angular);
        return centre.impulse_work(impulse.linear - p_.slider_mass * cross(turned, offset_.centre), change.linear + cross(turned, offset_.pin));
    }

    /// @param number 4 face + place in the face
    SLIDEWAY_NOINLINE void put_pair(int number, JointPair<Real>& pair) const {
        SLIDEWAY_EXPECT(number >= 0 && number < pair_count);
        Signs const signs(number);
        number < 8 ? put_pair_of<Axis::y>(signs, pair) : put_pair_of<Axis::z>(signs, pair);
    }

    /// v' of the slip of a slider that keeps its velocity [m/s²].
    SLIDEWAY_NOINLINE void put_slip_bias(int number, Real (&bias)[2]) const {
        Signs const signs(number);
        number < 8 ? put_slip_bias_of<Axis::y>(signs, bias) : put_slip_bias_of<Axis::z>(signs, bias);
    }

private:
    /// Of a pair: which side its face is on, and where its apex is along X and across the face.
    struct Signs {
        Real side, along, across;

        SLIDEWAY_FN explicit Signs(int number)
            : side(number / 4 % 2 == 0 ? 1.0 : -1.0), along(number % 4 < 2 ? 1.0 : -1.0), across(number % 4 == 0 || number % 4 == 3 ? 1.0 : -1.0) {}
    };
    /// ρ of an apex, as arranged for its face.
    template <Axis axis> SLIDEWAY_FN Vec3<Real> arm_of(Signs const& signs) const {
        using Faces = FacePair<axis>;
        auto const& g = p_.joint.geometry;
        return {signs.along * g.half_length, fms(signs.side, Faces::half_main(g), Faces::main(motion)),
                fms(signs.across, Faces::half_across(g), Faces::across(motion))};
    }
    template <Axis axis> SLIDEWAY_FN Vec3<Real> second_slip() const {
        using Faces = FacePair<axis>;
        return Faces::arranged(Faces::is_y ? motion.axes.z : motion.axes.y);
    }

    template <Axis axis> SLIDEWAY_FN void put_pair_of(Signs const& signs, JointPair<Real>& pair) const {
        using Faces = FacePair<axis>;
        Real const zero(0.0), side = signs.side;
        auto n = Faces::normal(motion);
        auto const arm = arm_of<axis>(signs);
        auto v = Faces::arranged(motion.velocity);
        auto w = Faces::arranged_axial(motion.spin);
        auto m = cross(w, n);
        // δ'' of constant u' and ω: s [(ω × (ω × n))·ρ − 2 (m_y v_y + m_z v_z)], m = ω × n; the gap is −δ.
        Real const turning = dot(cross(w, m), arm), moving = fma(m.y, v.y, m.z * v.z);
        pair.bias = negated(side * (turning - (moving + moving)));
        // Of the normal force the translation feels what acts across the way (model.md 4).
        pair.normal = row<axis>({zero, side * n.y, side * n.z}, arm, side * n);
        auto const first = Faces::arranged(motion.axes.x);
        auto const second = second_slip<axis>();
        pair.slip[0] = row<axis>(first, arm, first);
        pair.slip[1] = row<axis>(second, arm, second);
        pair.pushed = response(pair.normal);
        pair.dragged[0] = response(pair.slip[0]);
        pair.dragged[1] = response(pair.slip[1]);
    }

    /// v = u' + ω × ρ along e: v' = e · (u'' + α × ρ) + e · (ω × ρ') + (ω × e) · v, ρ' = (0, −y', −z').
    template <Axis axis> SLIDEWAY_FN void put_slip_bias_of(Signs const& signs, Real (&bias)[2]) const {
        using Faces = FacePair<axis>;
        auto v = Faces::arranged(motion.velocity);
        auto w = Faces::arranged_axial(motion.spin);
        auto const first = Faces::arranged(motion.axes.x), second = second_slip<axis>();
        auto const apex = v + cross(w, arm_of<axis>(signs));
        auto const shift = cross(w, Vec3<Real>{Real(0.0), negated(v.y), negated(v.z)});
        bias[0] = dot(first, shift) + dot(cross(w, first), apex);
        bias[1] = dot(second, shift) + dot(cross(w, second), apex);
    }

    /// What a unit force comes to.  @param force on the translation  @param arm, direction of its moment
    template <Axis axis>
    SLIDEWAY_FN Twist<Real> row(Vec3<Real> const& force, Vec3<Real> const& arm, Vec3<Real> const& direction) const {
        using Faces = FacePair<axis>;
        auto const torque = Faces::arranged_axial(cross(arm, direction));
        auto const& axes = motion.axes;
        return {to_inertial(misaligned_, Faces::arranged(force), p_.joint.way),
                {dot(axes.x, torque), dot(axes.y, torque), dot(axes.z, torque)}};
    }

    /// The pin's answer as an OffsetSlider asks for it.
    struct PinGuide {
        GuidedCentre<Real> const& centre;
        SLIDEWAY_FN Vec3<Real> accelerations(Vec3<Real> const& force, SliderParameters<Real> const&) const { return centre.unloaded + centre.response(force); }
        SLIDEWAY_FN Vec3<Real> response(Vec3<Real> const& force, SliderParameters<Real> const&) const { return centre.response(force); }
    };

    Vec3<Real> load_force_, load_torque_;  // along the ground's and the slider's axes [N], [N m]; the force where the slider is offset
    OffsetSlider<Real> offset_;
    bool is_offset_ = false;
    SliderParameters<Real> const& p_;
    bool const misaligned_;
};

template <class Real>
SLIDEWAY_HD JointPairs<Real>::JointPairs(GuidedCentre<Real> const& of_guide, Real along, Real vx, Real const* s, SliderParameters<Real> const& p, bool misaligned)
    : centre(of_guide),
      x(along),
      turning(SliderTurning<Real>::of(s)),
      motion(joint_motion(misaligned, turning.axes, Vec3<Real>{x, s[0], s[1]}, Vec3<Real>{vx, s[2], s[3]}, turning.spin, p.joint.way)),
      velocity{{vx, s[2], s[3]}, turning.omega},
      load_force_{Real(0.0), Real(0.0), Real(0.0)},
      load_torque_(load_force_),
      p_(p),
      misaligned_(misaligned) {}

}  // namespace slideway::inline SLIDEWAY_ISA
