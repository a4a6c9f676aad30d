#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/mechanisms/guided_centre.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A crank pin A.
template <class Real> struct CrankPin {
    Real x, y, vx, vy;

    SLIDEWAY_FN CrankPin(GivenMotion<Real> const& turning, SliderParameters<Real> const& p) {
        auto crank = sincos(turning.place);
        x = p.crank_length * crank.cos;
        y = p.crank_length * crank.sin;
        vx = negated(turning.velocity) * y;
        vy = turning.velocity * x;
    }
};

/// A rod of length L on a crank pin A, and the slider's centre at its other end: x follows from D² + (y − y_A)² + z² = L².
template <class Real> class RodOnPin {
public:
    Real x, vx;

    SLIDEWAY_FN RodOnPin(GivenMotion<Real> const& turning, bool accelerates, Real const* s, SliderParameters<Real> const& p, Faults<Real>& faults)
        : pin_(turning, p) {
        Real const y = s[0], z = s[1], vz = s[3];
        Real const one(1.0);
        Real const dy = y - pin_.y;
        Real const reach = fnma(z, z, fnma(dy, dy, p.rod_length * p.rod_length));
        faults.geometry = reach <= Real(0.0);  // NaN has another cause
        d_ = sqrt(reach);
        Real const inverse_d = d_ * (one / reach);  // root and division side by side
        ky_ = negated(dy) * inverse_d;
        kz_ = negated(z) * inverse_d;
        Real const dvy = s[2] - pin_.vy;
        Real const dd = fma(ky_, dvy, kz_ * vz);
        Real const gamma = negated(fma(dvy, dvy, fma(vz, vz, dd * dd))) * inverse_d;
        x = pin_.x + d_;
        vx = pin_.vx + dd;
        // a_Bx = aAx − κy aAy + γ + κy y'' + κz z''
        Real const minus_speed_squared = negated(turning.velocity * turning.velocity);
        aax_ = minus_speed_squared * pin_.x;
        aay_ = minus_speed_squared * pin_.y;
        if (accelerates) {
            aax_ = fnma(turning.acceleration, pin_.y, aax_);
            aay_ = fma(turning.acceleration, pin_.x, aay_);
        }
        bias_ = fnma(ky_, aay_, aax_) + gamma;
    }

protected:
    /// Where its pin and the centre are, for the report.
    SLIDEWAY_FN PointMotion<Real> pin_motion() const {
        Real const zero(0.0);
        return {{pin_.x, pin_.y, zero}, {pin_.vx, pin_.vy, zero}, {aax_, aay_, zero}};
    }
    /// Contact forces and weights on the centre.
    SLIDEWAY_FN static Vec3<Real> weighed(Vec3<Real> const& force, SliderParameters<Real> const& p) {
        return {fma(p.weighing_mass, p.gravity_x, force.x), fma(p.weighing_mass, p.gravity_y, force.y),
                fma(p.weighing_mass, p.gravity_z, force.z)};
    }
    /// What y and z feel of them beside the rod's inertia, and `pull`, what is left along x.
    struct Felt { Real y, z, pull; };
    SLIDEWAY_FN Felt felt(Vec3<Real> const& force, SliderParameters<Real> const& p) const {
        Real const pull = fnma(p.m_ab, aax_, fnma(p.mass, bias_, force.x));
        return {fma(ky_, pull, fnma(p.m_ab, aay_, force.y)), fma(kz_, pull, force.z), pull};
    }

    CrankPin<Real> pin_;
    Real d_, ky_, kz_;  // x − x_A [m], and κ = ∂x/∂(y, z)
    Real aax_, aay_, bias_;
};

/// x alone.  Where the rod does not reach, as far as it is.
template <class Real> SLIDEWAY_FN Real along_rod(Real angle, Real const* s, SliderParameters<Real> const& p) {
    auto const crank = sincos(angle);
    Real const dy = fnma(p.crank_length, crank.sin, s[0]);
    Real const reach = fnma(s[1], s[1], fnma(dy, dy, p.rod_length * p.rod_length));
    return fma(p.crank_length, crank.cos, sqrt(max(reach, Real(0.0))));
}

/// The same rod without what its masses do, for contacts that are stiff.
template <class Real> class RodConstraint {
public:
    Real x, vx;

    SLIDEWAY_FN RodConstraint(GivenMotion<Real> const& turning, Real const* s, SliderParameters<Real> const& p) : pin_(turning, p) {
        Real const dy = s[0] - pin_.y;
        Real const d = sqrt(fnma(s[1], s[1], fnma(dy, dy, p.rod_length * p.rod_length)));
        Real const inverse_d = Real(1.0) / d;
        ky_ = negated(dy) * inverse_d;
        kz_ = negated(s[1]) * inverse_d;
        x = pin_.x + d;
        vx = pin_.vx + fma(ky_, s[2] - pin_.vy, kz_ * s[3]);
    }

    SLIDEWAY_FN void masses(SliderParameters<Real> const& p, SliderLinearisation<Real>& out) const {
        Real const one(1.0);
        out.mass_y = p.mass * fma(ky_, ky_, one);
        out.mass_z = p.mass * fma(kz_, kz_, one);
        out.mass_yz = p.mass * ky_ * kz_;
    }

    /// κ: x' = κy y' + κz z', but for what the crank does.
    SLIDEWAY_FN Translation<Real> slope() const { return {ky_, kz_}; }

    /// A force (f_x, f_y, f_z) gives f_y + κy f_x and f_z + κz f_x.
    SLIDEWAY_FN Translation<Real> project(Vec3<Real> const& force) const {
        return {fma(ky_, force.x, force.y), fma(kz_, force.x, force.z)};
    }

protected:
    CrankPin<Real> pin_;
    Real ky_, kz_;
};

/// What a crank and a rod prescribe of the slider, whose crank is driven.
/// Source: Qian et al. 2020, section 4; equations as in model.md 6.
struct CrankAndRod {
    using Base = SliderBase;
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "slider_crank";
        info.meaning = "spatial slider-crank, its slider with clearance on a rectangular way";
        info.series = selections::spatial_series;
        info.quantities = selections::all_quantities;
        info.keys |= groups_of(KeyGroup::crank, KeyGroup::links, KeyGroup::rod_centre, KeyGroup::drive, KeyGroup::body, KeyGroup::pin);
        info.drive = DriveKind::crank;
        info.on_cards = true;
        return info;
    }();

    template <class Real> class At : public RodOnPin<Real> {
    public:
        SLIDEWAY_FN At(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive, Faults<Real>& faults)
            : At(driven_crank(drive, t, p), drive.by == DriveBy::profile, s, p, faults) {}

        /// m a_B + m_AB a_A − F = λ(B − A), the X row eliminated: a symmetric 2×2 system with determinant m²(1 + κy² + κz²).
        SLIDEWAY_FN Vec3<Real> accelerations(Vec3<Real> const& contact_force, SliderParameters<Real> const& p) const {
            Real const one(1.0);
            auto const f = this->felt(this->weighed(contact_force, p), p);
            Real const ky2 = fma(ky_, ky_, one), kz2 = fma(kz_, kz_, one), kyz = ky_ * kz_;
            Real const scale = one / (p.mass * fma(kz_, kz_, ky2));
            Real const ay = fms(kz2, f.y, kyz * f.z) * scale;
            Real const az = fms(ky2, f.z, kyz * f.y) * scale;
            return {fma(ky_, ay, fma(kz_, az, this->bias_)), ay, az};
        }

        /// m Δu' − P along the rod, Δx' = κy Δy' + κz Δz'.
        SLIDEWAY_FN GuidedCentre<Real> centre(SliderParameters<Real> const& p) const {
            Real const zero(0.0), one(1.0), ky2 = fma(ky_, ky_, one), kz2 = fma(kz_, kz_, one), kyz = ky_ * kz_;
            Real const scale = one / (p.mass * fma(kz_, kz_, ky2));
            return {.slope = zero,
                    .slope_y = ky_,
                    .slope_z = kz_,
                    .masses = {one, zero, zero, p.mass * ky2, p.mass * kyz, p.mass * kz2},
                    .inverse = {zero, zero, zero, kz2 * scale, negated(kyz * scale), ky2 * scale},
                    .unloaded = accelerations({zero, zero, zero}, p),
                    .drive_x = this->pin_.vx,
                    .drive_y = this->pin_.vy,
                    .driven = p.mass + p.m_ab};
        }

        /// What a force changes of the acceleration.
        SLIDEWAY_FN Vec3<Real> response(Vec3<Real> const& force, SliderParameters<Real> const& p) const { return centre(p).response(force); }

        SLIDEWAY_FN void put_rates(Vec3<Real> const&, Real*) const {}

        template <class Report>
        SLIDEWAY_FN void tell(PointMotion<Real> const& centre, SliderTurning<Real> const& turning,
                              Vec3<Real> const& contact_force, SliderParameters<Real> const& p, bool powers_alone, Report& report) const {
            report.fill_crank(this->pin_motion(), centre, this->d_, turning, contact_force, p, powers_alone);
            if (!accelerates_) return;
            // At constant speed the crank's own inertia does nothing.
            Real const torque = p.motor.inertia * turning_.acceleration;
            report.crank_power = fma(torque, turning_.velocity, report.crank_power);
            if (powers_alone) return;
            report.drive_torque = report.drive_torque + torque;
            report.energy = fma(Real(0.5) * p.motor.inertia * turning_.velocity, turning_.velocity, report.energy);
        }

    private:
        SLIDEWAY_FN At(GivenMotion<Real> const& turning, bool accelerates, Real const* s, SliderParameters<Real> const& p, Faults<Real>& faults)
            : RodOnPin<Real>(turning, accelerates, s, p, faults), turning_(turning), accelerates_(accelerates) {}

        using RodOnPin<Real>::ky_, RodOnPin<Real>::kz_;
        GivenMotion<Real> turning_;
        bool accelerates_;
    };

    template <class Real> struct Constraint : RodConstraint<Real> {
        SLIDEWAY_FN Constraint(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive)
            : RodConstraint<Real>(driven_crank(drive, t, p), s, p) {}
    };

    template <class Real>
    SLIDEWAY_FN static Real along(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive) {
        return along_rod(driven_crank(drive, t, p).place, s, p);
    }
    template <class Real>
    SLIDEWAY_FN static GivenMotion<Real> crank(Real t, Real const*, SliderParameters<Real> const& p, DrivePlan const& drive) {
        return driven_crank(drive, t, p);
    }
};

using SliderCrank = SpatialSlider<CrankAndRod>;

}  // namespace slideway::inline SLIDEWAY_ISA
