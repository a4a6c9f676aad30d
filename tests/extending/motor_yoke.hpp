// A scotch yoke on a flywheel that a motor turns: its torque falls with the speed, T = T0 (1 − ω/ω0), so that crank angle and speed are states.
#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/drive.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/models/slider_lanes.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the slider's own numbers do not have.  Like those, numbers of type Real and nothing else.
template <class Real> struct MotorParameters : SliderParameters<Real> {
    Real stall_torque;   // T0 [N m]
    Real torque_slope;   // T0/ω0 [N m s]
    Real flywheel;       // J [kg m²]
};

/// The ten numbers of the slider, then crank angle θ and speed ω.
struct MotorBase : SliderBase {
    static constexpr int size = 12;
    template <class Real> using Parameters = MotorParameters<Real>;

    SLIDEWAY_HD static constexpr int state_of_series(int series) {
        if (series == static_cast<int>(Series::crank_angle)) return 10;
        if (series == static_cast<int>(Series::crank_angular_velocity)) return 11;
        return SliderBase::state_of_series(series);
    }
    template <class Real> SLIDEWAY_FN static void scales(MotorParameters<Real> const& p, Real* scale) {
        SliderBase::scales(p, scale);
        scale[10] = p.length_scale_y / p.crank_length;
        scale[11] = scale[10] * p.rate_scale;
    }
    SLIDEWAY_HD static MotorParameters<double> parameters(Inputs const& in) {
        MotorParameters<double> p;
        static_cast<SliderParameters<double>&>(p) = DrivenBase::parameters(in);
        p.stall_torque = in.mechanism_a;
        p.torque_slope = in.mechanism_a / in.mechanism_b;
        p.flywheel = in.mechanism_c;
        return p;
    }
    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        SliderBase::initial_state(in, s);
        s[10] = in.start_angle;
        s[11] = in.crank_speed;
    }
};
template <> struct LanesOf<MotorBase> : SpatialLanes<MotorBase> {};

/// x = r cos θ and (J + M x_θ²) θ'' = T − x_θ (M x_θθ θ'² − F_x − M g_x), of Lagrange's equation with x_θ = dx/dθ.
struct MotorAndYoke {
    using Base = MotorBase;
    static constexpr Key keys[] = {
        {"mechanism.stall_torque", &Inputs::mechanism_a, "N m", Rule::positive, KeyGroup::mechanism, "torque of the motor at rest", 0.2},
        {"mechanism.no_load_speed", &Inputs::mechanism_b, "rad/s", Rule::positive, KeyGroup::mechanism, "speed at which the motor has no torque", 100},
        {"mechanism.flywheel_inertia", &Inputs::mechanism_c, "kg m2", Rule::positive, KeyGroup::mechanism, "inertia of crank and flywheel", 1e-3},
    };
    static constexpr Signal signals[] = {
        {"motor_torque", "N m", "torque of the motor"},
        {"motor_power", "W", "power of the motor", statistics_of(Statistic::maximum, Statistic::mean)},
    };
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "motor_yoke";
        info.meaning = "scotch yoke on a flywheel that a motor turns";
        info.states = 12;
        info.state[10] = Series::crank_angle;
        info.state[11] = Series::crank_angular_velocity;
        info.series |= selections::of({Series::crank_angle, Series::crank_angular_velocity});
        info.always |= selections::of({Series::crank_angle, Series::crank_angular_velocity});
        info.keys |= groups_of(KeyGroup::crank);
        info.own_keys = keys;
        info.signals = signals;
        return info;
    }();

    /// In the order of `signals`.
    template <class Real, class Report>
    SLIDEWAY_FN static void put_signals(Real, Real const* s, MotorParameters<Real> const& p, Report const&, Real* values) {
        values[0] = fnma(p.torque_slope, s[11], p.stall_torque);
        values[1] = values[0] * s[11];
    }

    template <class Real> class At {
    public:
        Real x, vx;

        SLIDEWAY_FN At(Real, Real const* s, MotorParameters<Real> const& p, DrivePlan const&, Faults<Real>&) : speed_(s[11]) {
            auto const crank = sincos(s[10]);
            x = p.crank_length * crank.cos;
            slope_ = negated(p.crank_length) * crank.sin;
            vx = slope_ * speed_;
            torque_ = fnma(p.torque_slope, speed_, p.stall_torque);
        }
        SLIDEWAY_FN Vec3<Real> accelerations(Vec3<Real> const& force, MotorParameters<Real> const& p) {
            Real const bend = negated(x) * (speed_ * speed_);  // x_θθ θ'²
            Real const pull = fms(p.slider_mass, bend - p.gravity_x, force.x);
            turning_ = fnma(slope_, pull, torque_) / fma(p.slider_mass * slope_, slope_, p.flywheel);
            Real const lightness = Real(1.0) / p.slider_mass;
            return {fma(slope_, turning_, bend), fma(force.y, lightness, p.gravity_y), force.z * lightness};
        }
        SLIDEWAY_FN void put_rates(Vec3<Real> const&, Real* rates) const {
            rates[10] = speed_;
            rates[11] = turning_;
        }
        template <class Report>
        SLIDEWAY_FN void tell(PointMotion<Real> const& centre, SliderTurning<Real> const& turning, Vec3<Real> const& force,
                              MotorParameters<Real> const& p, bool powers_alone, Report& report) const {
            report.fill_guided(centre, turning, fms(p.slider_mass, centre.acceleration.x - p.gravity_x, force.x), p, powers_alone);
            report.crank_power = torque_ * speed_;  // the motor's
            if (powers_alone) return;
            report.energy = fma(Real(0.5) * p.flywheel * speed_, speed_, report.energy);
        }

    private:
        Real speed_, slope_, torque_, turning_;
    };

    template <class Real> using Constraint = DrivenGuide<MotorAndYoke>::Constraint<Real>;  // along X no contact is stiff
    template <class Real> SLIDEWAY_FN static AlongWay<Real> motion(Real, Real const* s, SliderParameters<Real> const& p, DrivePlan const&) {
        auto const crank = sincos(s[10]);
        return {p.crank_length * crank.cos, negated(p.crank_length * s[11]) * crank.sin, Real(0.0)};
    }
    template <class Real> SLIDEWAY_FN static Real along(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive) { return motion(t, s, p, drive).x; }
};
using MotorYoke = SpatialSlider<MotorAndYoke>;

}  // namespace slideway::inline SLIDEWAY_ISA

#define SLIDEWAY_MECHANISM MotorYoke
#define SLIDEWAY_BASE MotorBase
