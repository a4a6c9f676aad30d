#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/planar_parameters.hpp"
#include "kernels/mechanisms/planar_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What all planar slider-cranks share.
struct PlanarBase {
    using Inputs = slideway::Inputs;
    static constexpr int size = 6, room = size, crank_state[] = {0, 3};
    static constexpr MechanismInfo info = [] {
        MechanismInfo info{};
        info.name = "planar_slider_crank";
        info.meaning = "block between two walls, with a driven or a free crank, all in one plane";
        info.states = size;
        Series const state[] = {Series::crank_angle,           Series::rod_angle,            Series::pitch,
                                Series::crank_angular_velocity, Series::rod_angular_velocity, Series::wz};
        Selection states = 0;
        for (int i = 0; i < size; ++i) {
            info.state[i] = state[i];
            states |= selection_of(state[i]);
        }
        info.series = states | selections::of({Series::y, Series::vy, Series::x, Series::vx, Series::normal_force,
                                               Series::crank_torque, Series::surfaces, Series::points, Series::ax,
                                               Series::ay});
        info.always = states | selections::of({Series::y, Series::vy});
        info.quantities =
            selections::all_quantities & ~selections::apex_quantities & ~selections::sensor_quantities &
            ~selections::force_quantities & ~selections::of({Quantity::switching_energy, Quantity::film_loss});
        info.keys = groups_of(KeyGroup::slider, KeyGroup::smooth_friction, KeyGroup::planar, KeyGroup::crank, KeyGroup::links, KeyGroup::turning,
                              KeyGroup::drive, KeyGroup::elastic,
                              KeyGroup::hertz, KeyGroup::point_damping, KeyGroup::restitution);
        info.drive = DriveKind::crank;
        info.spatial = false;
        info.prescribed = 1u << 0 | 1u << 3;  // angle and speed of a driven crank
        info.may_turn_freely = true;
        return info;
    }();
    template <class Real> using Parameters = PlanarParameters<Real>;
    template <class Real> using Report = PlanarReport<Real>;

    /// Sizes against which integrator.atol is meant: c/l1, c/l2, 2c/L_k, and times ω.
    template <class Real> SLIDEWAY_FN static void scales(PlanarParameters<Real> const& p, Real* scale) {
        scale[0] = p.clearance / p.crank_length;
        scale[1] = p.clearance / p.rod_length;
        scale[2] = p.clearance / p.half_length;
        for (int i = 0; i < 3; ++i) scale[3 + i] = scale[i] * p.rate_scale;
    }

    /// Energy of the slider at the scale of its velocity, M (c ω)² [J], against which the audit's absolute tolerance is meant.
    template <class Real> SLIDEWAY_FN static Real energy_scale(PlanarParameters<Real> const& p) {
        Real const speed = touch_speed(p);
        return p.slider_mass * speed * speed;
    }
    template <class Real> SLIDEWAY_FN static Real touch_speed(PlanarParameters<Real> const& p) { return p.clearance * p.rate_scale; }

    /// Length [m] against which the tolerance of a located touch is meant.
    template <class Real> SLIDEWAY_FN static Real touch_scale(PlanarParameters<Real> const& p) { return p.clearance; }
    /// The links' angles say where the slider is.
    template <class Real> SLIDEWAY_FN static Real touch_rounding(PlanarParameters<Real> const& p) { return Real(1e-15) * (p.crank_length + p.rod_length); }

    SLIDEWAY_HD static PlanarParameters<double> parameters(Inputs const& inputs) { return planar_parameters(inputs); }

    /// θ2 and its rate follow from the slider's y and vy: l1 sin θ1 + l2 sin θ2 = y.  NaN where the rod does not reach.
    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        auto const crank = sincos(in.start_angle);
        double const sine = (in.y - in.crank_length * crank.sin) / in.rod_length;
        s[0] = in.start_angle;
        s[1] = ::asin(sine);
        s[2] = in.pitch;
        s[3] = start_speed(in);
        s[4] = (in.vy - in.crank_length * crank.cos * start_speed(in)) / (in.rod_length * ::sqrt(1 - sine * sine));
        s[5] = in.wz;
    }

    /// Which component of the state an entry of `series_table` is; -1 if none.
    SLIDEWAY_HD static constexpr int state_of_series(int series) {
        for (int i = 0; i < size; ++i) {
            if (static_cast<int>(info.state[i]) == series) return i;
        }
        return -1;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
