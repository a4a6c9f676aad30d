#pragma once

#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/mechanisms/crank_states.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What crank and rod do where nothing prescribes the crank's angle θ: masses of (θ, y, z), of which x' = κθ θ' + κy y' + κz z'.
template <class Real> struct TurningMasses {
    Real slope;            // κθ = r (−sin θ − κy cos θ) [m]
    Real own, by_y, by_z;  // row of θ [kg m²], [kg m]

    /// @param x, y of the crank pin
    SLIDEWAY_FN TurningMasses(Real x, Real y, Real ky, Real kz, SliderParameters<Real> const& p) {
        slope = negated(fma(ky, x, y));
        Real const rod = fnma(p.m_ab, y, p.mass * slope);  // what moves along x with it
        own = fma(slope, fnma(p.m_ab, y, rod), fma(p.m_aa, p.crank_length * p.crank_length, p.motor.inertia));
        by_y = fma(ky, rod, p.m_ab * x);
        by_z = kz * rod;
    }
};

/// Crank and rod on a motor, or without a drive: θ and θ' are numbers 10 and 11 of the state (model.md 15).
struct CrankAndRodOnMotor {
    using Base = CrankStateBase;
    static constexpr MechanismInfo info = crank_state_info(CrankAndRod::info, "slider_crank_motor");

    template <class Real> class At : public RodOnPin<Real> {
    public:
        SLIDEWAY_FN At(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive, Faults<Real>& faults)
            : RodOnPin<Real>({s[10], s[11], Real(0.0)}, false, s, p, faults), speed_(s[11]), motor_(motor_torque(drive, p.motor, t, s[10], s[11])),
              torque_(motor_) {}

        /// A torque on the crank, beside the motor's.
        SLIDEWAY_FN void turn(Real torque) { torque_ = torque_ + torque; }

        SLIDEWAY_FN Vec3<Real> accelerations(Vec3<Real> const& contact_force, SliderParameters<Real> const& p) {
            Real const one(1.0), x = this->pin_.x, y = this->pin_.y;
            auto const f = this->felt(this->weighed(contact_force, p), p);
            // Of the rod's weight what the pin carries, and the crank's.
            Real const carried = fma(p.rod_mass, one - p.rod_mass_center, p.crank_moment / p.crank_length);
            Real const weight = carried * fms(p.gravity_y, x, p.gravity_x * y);
            auto const a = solved(f, fma(p.m_ab * y, this->bias_, weight + torque_), this->bias_, p);
            turning_ = a.turning;
            return a.centre;
        }
        /// No drive does anything in an impact.
        SLIDEWAY_FN GuidedCentre<Real> centre(SliderParameters<Real> const& p) {
            Real const zero(0.0);
            Elimination const e(this->pin_.x, this->pin_.y, ky_, kz_, p);
            auto const& m = e.masses;
            Real const light = Real(1.0) / e.left;
            return {.slope = m.slope,
                    .slope_y = ky_,
                    .slope_z = kz_,
                    .masses = {m.own, m.by_y, m.by_z, p.mass * e.ky2, p.mass * e.kyz, p.mass * e.kz2},
                    .inverse = {light, negated(e.to_y * light), negated(e.to_z * light), fma(e.to_y * e.to_y, light, e.kz2 * e.scale),
                                fms(e.to_y * e.to_z, light, e.kyz * e.scale), fma(e.to_z * e.to_z, light, e.ky2 * e.scale)},
                    .unloaded = accelerations({zero, zero, zero}, p),
                    .drive_x = zero,
                    .drive_y = zero,
                    .driven = zero};
        }
        /// What a force changes of the acceleration.
        SLIDEWAY_FN Vec3<Real> response(Vec3<Real> const& force, SliderParameters<Real> const& p) const {
            return solved({fma(ky_, force.x, force.y), fma(kz_, force.x, force.z), force.x}, Real(0.0), Real(0.0), p).centre;
        }

        SLIDEWAY_FN void put_rates(Vec3<Real> const&, Real* rates) const {
            rates[10] = speed_;
            rates[11] = turning_;
        }

        template <class Report>
        SLIDEWAY_FN void tell(PointMotion<Real> const& centre, SliderTurning<Real> const& turning,
                              Vec3<Real> const& contact_force, SliderParameters<Real> const& p, bool powers_alone, Report& report) const {
            auto pin = this->pin_motion();
            pin.acceleration.x = fnma(turning_, pin.position.y, pin.acceleration.x);
            pin.acceleration.y = fma(turning_, pin.position.x, pin.acceleration.y);
            report.fill_crank(pin, centre, this->d_, turning, contact_force, p, powers_alone);
            report.crank_power = motor_ * speed_;
            if (powers_alone) return;
            report.drive_torque = motor_;
            Real const height = fma(p.gravity_x, pin.position.x, p.gravity_y * pin.position.y) * (p.crank_moment / p.crank_length);
            report.energy = fma(Real(0.5) * p.motor.inertia * speed_, speed_, report.energy - height);
        }

    private:
        using RodOnPin<Real>::ky_, RodOnPin<Real>::kz_;

        /// Three symmetric equations, of (θ, y, z); those of y and z are eliminated first.
        struct Elimination {
            TurningMasses<Real> masses;
            Real ky2, kz2, kyz, scale, to_y, to_z, left;

            SLIDEWAY_FN Elimination(Real x, Real y, Real ky, Real kz, SliderParameters<Real> const& p) : masses(x, y, ky, kz, p) {
                Real const one(1.0);
                ky2 = fma(ky, ky, one), kz2 = fma(kz, kz, one), kyz = ky * kz;
                scale = one / (p.mass * fma(kz, kz, ky2));
                to_y = fms(kz2, masses.by_y, kyz * masses.by_z) * scale, to_z = fms(ky2, masses.by_z, kyz * masses.by_y) * scale;
                left = fnma(to_z, masses.by_z, fnma(to_y, masses.by_y, masses.own));
            }
        };
        struct Solved {
            Real turning;
            Vec3<Real> centre;
        };
        SLIDEWAY_FN Solved solved(typename RodOnPin<Real>::Felt const& f, Real torque, Real bias, SliderParameters<Real> const& p) const {
            Elimination const e(this->pin_.x, this->pin_.y, ky_, kz_, p);
            auto const& m = e.masses;
            Real const turning = fnma(e.to_z, f.z, fnma(e.to_y, f.y, fma(m.slope, f.pull, torque))) / e.left;
            Real const fy = fnma(m.by_y, turning, f.y), fz = fnma(m.by_z, turning, f.z);
            Real const ay = fms(e.kz2, fy, e.kyz * fz) * e.scale, az = fms(e.ky2, fz, e.kyz * fy) * e.scale;
            return {turning, {fma(m.slope, turning, fma(ky_, ay, fma(kz_, az, bias))), ay, az}};
        }

        Real speed_, motor_, torque_;
        Real turning_;  // θ''
    };

    /// Of (vy, vz) the masses that forces across the rod move while the crank gives way.
    template <class Real> class Constraint : public RodConstraint<Real> {
    public:
        SLIDEWAY_FN Constraint(Real, Real const* s, SliderParameters<Real> const& p, DrivePlan const&)
            : RodConstraint<Real>({s[10], s[11], Real(0.0)}, s, p), turning_(this->pin_.x, this->pin_.y, this->ky_, this->kz_, p) {}

        SLIDEWAY_FN void masses(SliderParameters<Real> const& p, SliderLinearisation<Real>& out) const {
            RodConstraint<Real>::masses(p, out);
            Real const y = turning_.by_y / turning_.own, z = turning_.by_z / turning_.own;
            out.mass_y = fnma(y, turning_.by_y, out.mass_y);
            out.mass_z = fnma(z, turning_.by_z, out.mass_z);
            out.mass_yz = fnma(y, turning_.by_z, out.mass_yz);
        }
        SLIDEWAY_FN Translation<Real> project(Vec3<Real> const& force) const {
            auto const across = RodConstraint<Real>::project(force);
            Real const turned = turning_.slope * force.x / turning_.own;
            return {fnma(turned, turning_.by_y, across.y), fnma(turned, turning_.by_z, across.z)};
        }

    private:
        TurningMasses<Real> turning_;
    };

    template <class Real> SLIDEWAY_FN static Real along(Real, Real const* s, SliderParameters<Real> const& p, DrivePlan const&) {
        return along_rod(s[10], s, p);
    }
    template <class Real> SLIDEWAY_FN static GivenMotion<Real> crank(Real, Real const* s, SliderParameters<Real> const&, DrivePlan const&) {
        return {s[10], s[11], Real(0.0)};
    }
};

using SliderCrankMotor = SpatialSlider<CrankAndRodOnMotor>;

}  // namespace slideway::inline SLIDEWAY_ISA
