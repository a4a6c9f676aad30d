#pragma once

#include "kernels/block.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/slider_linearisation.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What all mechanisms with one slider in a clearance joint share, and what the slider-crank has of it, whatever law, friction, way and
/// damping.
struct SliderBase {
    using Inputs = slideway::Inputs;
    static constexpr int size = state_size;   // a mechanism's own
    static constexpr int room = most_states;  // of the lanes that all share
    static constexpr int crank_state[] = {10, 11};  // angle and speed, of a mechanism whose crank turns freely
    template <class Real> using Parameters = SliderParameters<Real>;
    template <class Real> using Report = SliderReport<Real>;
    template <class Real> using Linearisation = SliderLinearisation<Real>;

    /// Which component of the state an entry of `series_table` is; -1 if none.
    SLIDEWAY_HD static constexpr int state_of_series(int series) { return series < size ? series : -1; }

    /// Sizes against which integrator.atol is meant: c, c·ω, 2c/L_k, 2c/L_k·ω.
    template <class Real> SLIDEWAY_FN static void scales(SliderParameters<Real> const& p, Real* scale) {
        scale[0] = p.length_scale_y;
        scale[1] = p.length_scale_z;
        scale[2] = p.length_scale_y * p.rate_scale;
        scale[3] = p.length_scale_z * p.rate_scale;
        scale[4] = scale[5] = scale[6] = p.tilt_scale;
        scale[7] = scale[8] = scale[9] = p.tilt_scale * p.rate_scale;
    }

    /// Energy of the slider at the scale of its velocity, M (c ω)² [J], against which the audit's absolute tolerance is meant.
    template <class Real> SLIDEWAY_FN static Real energy_scale(SliderParameters<Real> const& p) {
        Real const speed = touch_speed(p);
        return p.slider_mass * speed * speed;
    }
    /// Speed [m/s] that those of touches are measured in.
    template <class Real> SLIDEWAY_FN static Real touch_speed(SliderParameters<Real> const& p) {
        return max(p.length_scale_y, p.length_scale_z) * p.rate_scale;
    }

    /// Length [m] against which the tolerance of a located touch is meant.
    template <class Real> SLIDEWAY_FN static Real touch_scale(SliderParameters<Real> const& p) {
        return min(p.length_scale_y, p.length_scale_z);
    }
    /// The state has the slider's place within the clearance.
    template <class Real> SLIDEWAY_FN static Real touch_rounding(SliderParameters<Real> const&) { return Real(0.0); }

    SLIDEWAY_HD static SliderParameters<double> parameters(Inputs const& inputs) { return slider_parameters(inputs); }
    /// Speed [m/s] of the motion along the way, r ω.
    SLIDEWAY_FN static double speed_along(SliderParameters<double> const& p) { return p.crank_length * p.rate_scale; }
    /// Rate [1/s] of the motion along the way.
    SLIDEWAY_FN static double pace(SliderParameters<double> const& p) { return p.rate_scale; }

    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        double const start[size] = {in.y, in.z, in.vy, in.vz, in.roll, in.yaw, in.pitch, in.wx, in.wy, in.wz};
        for (int i = 0; i < size; ++i) s[i] = start[i];
    }
};

/// What lanes look up of the state of a mechanism.
template <class Parameters> struct StateFunctions {
    int count = 0;  // components
    void (*scales)(Parameters const&, double*) = nullptr;
    void (*start)(Inputs const&, double*) = nullptr;
    int (*of_series)(int) = nullptr;

    template <class Base> static constexpr StateFunctions of() {
        return {Base::size, [](Parameters const& p, double* scale) { Base::scales(p, scale); }, &Base::initial_state, &Base::state_of_series};
    }
};

/// The way of a mechanism without crank and rod passes through (0, offset_y, offset_z).
SLIDEWAY_HD inline SliderParameters<double> parameters_without_rod(Inputs const& in) {
    auto p = slider_parameters(in);
    p.joint.way.offset.x -= in.rod_length;
    p.joint.way.station = 0;
    p.rod_mass = p.crank_moment = 0;
    return p;
}

/// A slider free along the way too.  The way passes through (0, offset_y, offset_z); speeds are counted by the fall through the clearance,
/// √(g c).
struct FreeSliderBase : SliderBase {
    static constexpr int size = 12;
    SLIDEWAY_HD static constexpr int state_of_series(int series) { return series < size ? series : -1; }

    template <class Real> SLIDEWAY_FN static void scales(SliderParameters<Real> const& p, Real* scale) {
        SliderBase::scales(p, scale);
        scale[10] = p.length_scale_y;
        scale[11] = p.length_scale_y * p.rate_scale;
    }

    SLIDEWAY_HD static SliderParameters<double> parameters(Inputs const& in) {
        auto p = parameters_without_rod(in);
        p.rate_scale = max(::sqrt(::fabs(in.gravity) / min(play_y(in), play_z(in))), 1.0);
        return p;
    }
    /// After a fall as far as the slider is long.
    SLIDEWAY_FN static double speed_along(SliderParameters<double> const& p) {
        double const fall = (abs(p.gravity_x) + abs(p.gravity_y) + abs(p.gravity_z)) * 2 * p.joint.geometry.half_length;
        return max(::sqrt(fall), touch_speed(p));
    }
    SLIDEWAY_FN static double pace(SliderParameters<double> const& p) { return min(speed_along(p) / (2 * p.joint.geometry.half_length), p.rate_scale); }

    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        SliderBase::initial_state(in, s);
        s[10] = in.x;
        s[11] = in.vx;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
