#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/crank_states.hpp"
#include "kernels/mechanisms/drive.hpp"
#include "kernels/mechanisms/scotch_yoke.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Its crank has no mass of its own; what turns is motor and flywheel.
struct YokeMotorBase : CrankStateBase {
    SLIDEWAY_HD static SliderParameters<double> parameters(Inputs const& in) {
        auto p = parameters_without_rod(in);
        p.motor.inertia = in.drive_inertia;
        return p;
    }
};

/// A scotch yoke on a motor, or without a drive: x = r cos θ and (J + M x_θ²) θ'' = T − x_θ (M x_θθ θ'² − F_x − M g_x), of Lagrange's equation with
/// x_θ = dx/dθ (model.md 15).
struct YokeOnMotor : DrivenGuide<YokeOnMotor> {
    using Base = YokeMotorBase;
    static constexpr bool is_free = false;
    static constexpr MechanismInfo info = [] {
        auto info = crank_state_info(ScotchYokeDrive::info, "scotch_yoke_motor");
        info.keys &= ~groups_of(KeyGroup::turning);
        return info;
    }();

    template <class Real> class At {
    public:
        Real x, vx;

        SLIDEWAY_FN At(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive, Faults<Real>&)
            : speed_(s[11]), motor_(motor_torque(drive, p.motor, t, s[10], s[11])), torque_(motor_) {
            auto const turned = sincos(s[10]);
            x = p.crank_length * turned.cos;
            slope_ = negated(p.crank_length) * turned.sin;
            vx = slope_ * speed_;
        }
        /// A torque on the crank, beside the motor's.
        SLIDEWAY_FN void turn(Real torque) { torque_ = torque_ + torque; }

        SLIDEWAY_FN Vec3<Real> accelerations(Vec3<Real> const& force, SliderParameters<Real> const& p) {
            Real const bend = negated(x) * (speed_ * speed_);  // x_θθ θ'²
            Real const pull = fms(p.slider_mass, bend - p.gravity_x, force.x);
            turning_ = fnma(slope_, pull, torque_) / fma(p.slider_mass * slope_, slope_, p.motor.inertia);
            Real const lightness = Real(1.0) / p.slider_mass;
            return {fma(slope_, turning_, bend), fma(force.y, lightness, p.gravity_y), fma(force.z, lightness, p.gravity_z)};
        }
        /// x' = x_θ θ', and no drive does anything in an impact.
        SLIDEWAY_FN GuidedCentre<Real> centre(SliderParameters<Real> const& p) {
            Real const zero(0.0), one(1.0), lightness = one / p.slider_mass, turned = fma(p.slider_mass * slope_, slope_, p.motor.inertia);
            return {.slope = slope_,
                    .slope_y = zero,
                    .slope_z = zero,
                    .masses = {turned, zero, zero, p.slider_mass, zero, p.slider_mass},
                    .inverse = {one / turned, zero, zero, lightness, zero, lightness},
                    .unloaded = accelerations({zero, zero, zero}, p),
                    .drive_x = zero,
                    .drive_y = zero,
                    .driven = zero};
        }
        /// What a force changes of the acceleration.
        SLIDEWAY_FN Vec3<Real> response(Vec3<Real> const& force, SliderParameters<Real> const& p) const {
            Real const lightness = Real(1.0) / p.slider_mass;
            return {slope_ * slope_ * force.x / fma(p.slider_mass * slope_, slope_, p.motor.inertia), force.y * lightness, force.z * lightness};
        }
        SLIDEWAY_FN void put_rates(Vec3<Real> const&, Real* rates) const {
            rates[10] = speed_;
            rates[11] = turning_;
        }
        template <class Report>
        SLIDEWAY_FN void tell(PointMotion<Real> const& centre, SliderTurning<Real> const& turning, Vec3<Real> const& force,
                              SliderParameters<Real> const& p, bool powers_alone, Report& report) const {
            report.fill_guided(centre, turning, fms(p.slider_mass, centre.acceleration.x - p.gravity_x, force.x), p, powers_alone);
            report.crank_power = motor_ * speed_;
            if (powers_alone) return;
            report.drive_torque = motor_;
            report.energy = fma(Real(0.5) * p.motor.inertia * speed_, speed_, report.energy);
        }

    private:
        Real speed_, slope_, motor_, torque_;
        Real turning_;  // θ''
    };

    template <class Real>
    SLIDEWAY_FN static AlongWay<Real> motion(Real, Real const* s, SliderParameters<Real> const& p, DrivePlan const&) {
        auto const turned = sincos(s[10]);
        return {p.crank_length * turned.cos, negated(p.crank_length * s[11]) * turned.sin, Real(0.0)};
    }
    template <class Real> SLIDEWAY_FN static GivenMotion<Real> crank(Real, Real const* s, SliderParameters<Real> const&, DrivePlan const&) {
        return {s[10], s[11], Real(0.0)};
    }
};

using ScotchYokeMotor = SpatialSlider<YokeOnMotor>;

}  // namespace slideway::inline SLIDEWAY_ISA
