#pragma once

#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/guided_centre.hpp"
#include "kernels/mechanisms/slider_base.hpp"
#include "kernels/mechanisms/slider_linearisation.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Position, velocity and acceleration along the way's nominal direction.
template <class Real> struct AlongWay { Real x, vx, ax; };

/// What guides a slider without crank and rod: M u'' = F_c + M g⃗, of which x'' is given where a drive moves it (model.md 7).
/// @tparam Drive has `motion(t, state, parameters, drive)`, an AlongWay, and `is_free`: nothing drives it, x and vx are numbers 10 and 11 of the
/// state and the forces give its acceleration.
template <class Drive> struct DrivenGuide {
    template <class Real> class At {
    public:
        Real x, vx;

        SLIDEWAY_FN At(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive, Faults<Real>&) {
            auto along = Drive::motion(t, s, p, drive);
            x = along.x;
            vx = along.vx;
            ax_ = along.ax;
        }

        SLIDEWAY_FN Vec3<Real> accelerations(Vec3<Real> const& force, SliderParameters<Real> const& p) const {
            Real const lightness = Real(1.0) / p.slider_mass;
            return {Drive::is_free ? fma(force.x, lightness, p.gravity_x) : ax_, fma(force.y, lightness, p.gravity_y),
                    fma(force.z, lightness, p.gravity_z)};
        }

        /// M Δu' = P, of which Δx' is 0 where a drive moves it.
        SLIDEWAY_FN GuidedCentre<Real> centre(SliderParameters<Real> const& p) const {
            Real const zero(0.0), one(1.0), lightness = one / p.slider_mass;
            constexpr bool free = Drive::is_free;
            return {.slope = free ? one : zero,
                    .slope_y = zero,
                    .slope_z = zero,
                    .masses = {free ? p.slider_mass : one, zero, zero, p.slider_mass, zero, p.slider_mass},
                    .inverse = {free ? lightness : zero, zero, zero, lightness, zero, lightness},
                    .unloaded = accelerations({zero, zero, zero}, p),
                    .drive_x = free ? zero : vx,
                    .drive_y = zero,
                    .driven = p.slider_mass};
        }

        /// What a force changes of the acceleration.
        SLIDEWAY_FN Vec3<Real> response(Vec3<Real> const& force, SliderParameters<Real> const& p) const { return centre(p).response(force); }

        SLIDEWAY_FN void put_rates([[maybe_unused]] Vec3<Real> const& acceleration, [[maybe_unused]] Real* rates) const {
            if constexpr (Drive::is_free) {
                rates[10] = vx;
                rates[11] = acceleration.x;
            }
        }

        template <class Report>
        SLIDEWAY_FN void tell(PointMotion<Real> const& centre, SliderTurning<Real> const& turning,
                              Vec3<Real> const& force, SliderParameters<Real> const& p, bool powers_alone, Report& report) const {
            // M x'' − F_cx − M g_x
            Real const drive =
                Drive::is_free ? Real(0.0) : fms(p.slider_mass, centre.acceleration.x - p.gravity_x, force.x);
            report.fill_guided(centre, turning, drive, p, powers_alone);
        }

    private:
        Real ax_;
    };

    /// Along X the slider is driven, or no contact is stiff.
    template <class Real> struct Constraint {
        Real x, vx;

        SLIDEWAY_FN Constraint(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive) {
            auto const along = Drive::motion(t, s, p, drive);
            x = along.x;
            vx = along.vx;
        }
        SLIDEWAY_FN void masses(SliderParameters<Real> const& p, SliderLinearisation<Real>& out) const {
            out.mass_y = out.mass_z = p.slider_mass;
            out.mass_yz = Real(0.0);
        }
        SLIDEWAY_FN Translation<Real> slope() const { return {Real(0.0), Real(0.0)}; }
        SLIDEWAY_FN Translation<Real> project(Vec3<Real> const& force) const { return {force.y, force.z}; }
    };

    template <class Real> SLIDEWAY_FN static Real along(Real t, Real const* s, SliderParameters<Real> const& p, DrivePlan const& drive) {
        return Drive::motion(t, s, p, drive).x;
    }
};

/// Of what moves along the way without crank and rod.
struct DrivenBase : SliderBase {
    SLIDEWAY_HD static SliderParameters<double> parameters(Inputs const& in) { return parameters_without_rod(in); }
};

}  // namespace slideway::inline SLIDEWAY_ISA
