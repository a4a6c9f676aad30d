#pragma once

#include "kernels/joint/joint_stiffness.hpp"
#include "kernels/loads/drive_plan.hpp"
#include "kernels/math/dense_solve.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/mechanisms/guided_centre.hpp"
#include "kernels/mechanisms/mechanism_report.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A slider whose pin P = u + A s_P, or whose centre of mass G = u + A s_G, does not lie in its hole's centre u (model.md 16).  Its guide moves
/// P with all of the slider's mass M there; what the distance h = G − P adds is a force on it, and couples the slider's turning to it.
template <class Real> struct OffsetSlider {
    Vec3<Real> pin, pin_velocity;          // d = A s_P from u, ω × d, along the axes of the ground
    Vec3<Real> centre, centre_velocity;    // h from P, ω × h
    Vec3<Real> pin_pull, centre_pull;      // ω × (ω × d), ω × (ω × h)
    Vec3<Real> turned_x, turned_y, turned_z;  // A e_i × h: how G moves about P when the slider turns about its axes

    SLIDEWAY_FN static OffsetSlider of(SliderTurning<Real> const& turning, SliderParameters<Real> const& p) {
        OffsetSlider o;
        auto const& axes = turning.axes;
        o.pin = from_slider(axes, p.pin);
        o.pin_velocity = cross(turning.spin, o.pin);
        o.pin_pull = cross(turning.spin, o.pin_velocity);
        o.centre = from_slider(axes, p.mass_center) - o.pin;
        o.centre_velocity = cross(turning.spin, o.centre);
        o.centre_pull = cross(turning.spin, o.centre_velocity);
        o.turned_x = cross(axes.x, o.centre);
        o.turned_y = cross(axes.y, o.centre);
        o.turned_z = cross(axes.z, o.centre);
        return o;
    }

    /// The state with y and z of the pin.
    template <int size> SLIDEWAY_FN static void put_place(Real const* s, Vec3<Real> const& pin, Real (&of_pin)[size]) {
        for (int i = 0; i < size; ++i) of_pin[i] = s[i];
        of_pin[0] = s[0] + pin.y;
        of_pin[1] = s[1] + pin.z;
    }
    /// The state as a guide sees it: y z vy vz are the pin's.
    template <int size> SLIDEWAY_FN void put_pin(Real const* s, Real (&of_pin)[size]) const {
        put_place(s, pin, of_pin);
        of_pin[2] = s[2] + pin_velocity.y;
        of_pin[3] = s[3] + pin_velocity.z;
    }

    /// How a slider answers: ω' along its axes [rad/s²], accelerations of P and u [m/s²], and what P is pushed with for them, its turning included [N].
    struct Answer { Vec3<Real> spin_up, pin, hole, force; };

    /// Newton and Euler about P: a_P = a(F − M ω × (ω × h)) − M R (ω' × h), with a and R = ∂a/∂F of the guide.
    /// @param force on the slider but its weight [N]  @param torque of it about u, along the slider's axes [N m]
    template <class Guide>
    SLIDEWAY_FN Answer answer(Guide& guide, Vec3<Real> const& force, Vec3<Real> const& torque, SliderTurning<Real> const& turning,
                              SliderParameters<Real> const& p) const {
        Real const zero(0.0);
        auto const& w = turning.omega;
        Vec3<Real> const gravity{p.gravity_x, p.gravity_y, p.gravity_z};
        auto const left = p.slider_mass * (gravity - guide.accelerations({zero, zero, zero}, p) - centre_pull);
        auto const gyroscopic = cross(w, Vec3<Real>{p.inertia.x * w.x, p.inertia.y * w.y, p.inertia.z * w.z});
        auto const moment = about_pin(force, torque, turning, p) - gyroscopic + Vec3<Real>{dot(turned_x, left), dot(turned_y, left), dot(turned_z, left)};
        auto a = response(guide, force - p.slider_mass * centre_pull, moment, turning, p);
        a.pin = guide.accelerations(a.force, p);
        a.hole = a.pin - cross(from_slider(turning.axes, a.spin_up), pin) - pin_pull;
        return a;
    }

    /// What forces alone change, or impulses:
    ///   (I_G + M Hᵀ (1 − M R) H) ω' = τ_P − h × M R F,  H x = h × x,
    /// symmetric and positive definite, for a guide never makes the slider lighter.
    /// @param force on P  @param moment about it, along the slider's axes
    template <class Guide>
    SLIDEWAY_FN Answer response(Guide const& guide, Vec3<Real> const& force, Vec3<Real> const& moment, SliderTurning<Real> const& turning,
                                SliderParameters<Real> const& p) const {
        Real const mass = p.slider_mass;
        Vec3<Real> const turned[3] = {turned_x, turned_y, turned_z};
        auto const left = mass * guide.response(force, p);
        Real spin_up[3] = {moment.x - dot(turned_x, left), moment.y - dot(turned_y, left), moment.z - dot(turned_z, left)};
        Real matrix[3][3];
        for (int j = 0; j < 3; ++j) {
            auto const felt = mass * (turned[j] - mass * guide.response(turned[j], p));
            for (int i = 0; i < 3; ++i) matrix[i][j] = dot(turned[i], felt);
        }
        matrix[0][0] = matrix[0][0] + p.inertia.x;
        matrix[1][1] = matrix[1][1] + p.inertia.y;
        matrix[2][2] = matrix[2][2] + p.inertia.z;
        LuFactors<3, Real> factors;
        factors.factor(matrix);
        factors.solve(spin_up);
        Answer a;
        a.spin_up = {spin_up[0], spin_up[1], spin_up[2]};
        auto const turning_up = from_slider(turning.axes, a.spin_up);
        a.force = force - mass * cross(turning_up, centre);
        a.pin = guide.response(a.force, p);
        a.hole = a.pin - cross(turning_up, pin);
        return a;
    }

    /// Moment about P, along the slider's axes, of a force with a torque about u.
    SLIDEWAY_FN Vec3<Real> about_pin(Vec3<Real> const& force, Vec3<Real> const& torque, SliderTurning<Real> const& turning,
                                     SliderParameters<Real> const& p) const {
        return torque - cross(p.pin, to_slider(turning.axes, force));
    }

    /// A report: of P with all mass there, and then what is otherwise.  @param u motion of the hole's centre
    template <class Guide, class Report>
    SLIDEWAY_FN void tell(Guide const& guide, PointMotion<Real> const& u, Answer const& a, SliderTurning<Real> const& turning,
                          SliderParameters<Real> const& p, bool powers_alone, Report& report) const {
        auto const at_pin = u.velocity + pin_velocity;
        guide.tell({u.position + pin, at_pin, a.pin}, turning, a.force, p, powers_alone, report);
        if (powers_alone) return;
        report.fill_slider(u, turning, p);
        Real const kinetic = dot(centre_velocity, at_pin + Real(0.5) * centre_velocity);
        Real const height = fma(p.gravity_x, centre.x, fma(p.gravity_y, centre.y, p.gravity_z * centre.z));
        report.energy = fma(p.slider_mass, kinetic - height, report.energy);
    }

    /// Masses of q' of the guide, y' and z' of the hole's centre, and ω; a guide that prescribes q' leaves that row alone.
    /// @param guided how P answers
    SLIDEWAY_FN void put_masses(GuidedCentre<Real> const& guided, SliderTurning<Real> const& turning, SliderParameters<Real> const& p,
                                Real (&masses)[6][6]) const {
        Real const zero(0.0), one(1.0);
        auto const& axes = turning.axes;
        auto const& of_pin = guided.masses;
        // Of (q', y', z') of P: its turning about the hole's centre moves it across the way.
        auto const across = [&](Vec3<Real> const& axis) {
            auto const moved = cross(axis, pin);
            return Vec3<Real>{zero, moved.y, moved.z};
        };
        Vec3<Real> const at_pin[6] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}, across(axes.x), across(axes.y), across(axes.z)};
        Vec3<Real> const none{zero, zero, zero}, at_centre[6] = {none, none, none, turned_x, turned_y, turned_z};
        auto const moved = [&](int i) {
            auto const& v = at_pin[i];
            return Vec3<Real>{fma(guided.slope, v.x, fma(guided.slope_y, v.y, guided.slope_z * v.z)), v.y, v.z};
        };
        for (int i = 0; i < 6; ++i) {
            auto const& v = at_pin[i];
            Vec3<Real> const momentum{fma(of_pin.qq, v.x, fma(of_pin.qy, v.y, of_pin.qz * v.z)), fma(of_pin.qy, v.x, fma(of_pin.yy, v.y, of_pin.yz * v.z)),
                                      fma(of_pin.qz, v.x, fma(of_pin.yz, v.y, of_pin.zz * v.z))};
            for (int j = 0; j < 6; ++j) {
                Real const coupled = dot(moved(i) + at_centre[i], at_centre[j]) + dot(at_centre[i], moved(j));
                masses[i][j] = fma(p.slider_mass, coupled, dot(momentum, at_pin[j]));
            }
        }
        masses[3][3] = masses[3][3] + p.inertia.x;
        masses[4][4] = masses[4][4] + p.inertia.y;
        masses[5][5] = masses[5][5] + p.inertia.z;
    }
};

/// x of the hole's centre of a slider whose guide moves its pin.
template <class Guide, class Real>
SLIDEWAY_FN Real along_way(Real t, Real const* s, Axes<Real> const& lies, SliderParameters<Real> const& p, DrivePlan const& drive, bool is_offset) {
    if (!is_offset) return Guide::along(t, s, p, drive);
    auto const pin = from_slider(lies, p.pin);
    Real moved[Guide::Base::size];
    OffsetSlider<Real>::put_place(s, pin, moved);
    return Guide::along(t, moved, p, drive) - pin.x;
}

/// The state that a guide sees: of the pin, where it does not lie in the hole's centre.
template <class Real, int size> class PinState {
public:
    Real const* state;
    OffsetSlider<Real> offset;

    SLIDEWAY_FN PinState(Real const* s, SliderParameters<Real> const& p, bool is_offset) : state(s) {
        if (is_offset) move(s, SliderTurning<Real>::of(s), p);
    }
    SLIDEWAY_FN PinState(Real const* s, SliderTurning<Real> const& turning, SliderParameters<Real> const& p, bool is_offset) : state(s) {
        if (is_offset) move(s, turning, p);
    }
    PinState(PinState const&) = delete;
    PinState& operator=(PinState const&) = delete;

    SLIDEWAY_FN bool is_offset() const { return state == moved_; }
    /// From the pin's place and speed along the way to those of the hole's centre.
    SLIDEWAY_FN void leave_pin(Real& x, Real& vx) const {
        if (!is_offset()) return;
        x = x - offset.pin.x;
        vx = vx - offset.pin_velocity.x;
    }

private:
    SLIDEWAY_FN void move(Real const* s, SliderTurning<Real> const& turning, SliderParameters<Real> const& p) {
        offset = OffsetSlider<Real>::of(turning, p);
        offset.put_pin(s, moved_);
        state = moved_;
    }

    Real moved_[size];
};

}  // namespace slideway::inline SLIDEWAY_ISA
