#pragma once

#include "kernels/laws/friction.hpp"
#include "kernels/mechanisms/planar_parameters.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Bounces that would be over within this time [s] end at once, in lasting contact: the sum of a geometric series.
inline constexpr double chatter_time = 1e-7;
/// Events of which each comes within this time [s] of the one before, and how many of them count as impacts without end: apices that meet their faces in
/// turn, whose speeds friction keeps up.  From there on impacts have no restitution, and flights of that time end at once.
inline constexpr double quick_time = 1e-6, most_quick_events = 256;
/// So do impacts of both corners in turn whose next is due within this time.  Events that are nearer to one another than some 1e-13 of the
/// run are no longer located.  @param end of the run [s]
template <class Real> SLIDEWAY_FN Real rattle_time(Real end) { return max(Real(1e-11), Real(1e-12) * end); }
inline constexpr int rattles_tried = 48;
/// Impacts of corners at their walls, one upon the other.
inline constexpr int impacts_at_once = 8;
/// A contact that slips slower than this [slip scales] is at rest along its wall.
inline constexpr double slip_at_rest = 2e-9;
/// Violation of the conditions of contact, in units of their motion, that still is rounding.
inline constexpr double most_violation = 1e-9;
/// Events that may follow one another within `no_time`; more of them come to no end.
inline constexpr double most_events_at_once = 64;
template <class Real> SLIDEWAY_FN Real no_time(Real end) { return Real(10.0) * rattle_time(end); }
/// A corner that is found as far inside its wall [clearances] met it when time could no longer resolve it: impacts pile up without becoming weaker.
/// What lasts is put back onto its wall, which moves other corners by the error of a step: far less.
inline constexpr double most_overshoot = 1e-4;
/// Force [force scales] beyond which a wedged block counts as jammed: it grows without bound on the way there.
inline constexpr double jamming_force = 1e7;

/// Force [N] of what weight and drive do to the slider.
template <class Real> SLIDEWAY_FN Real force_scale(PlanarParameters<Real> const& p) {
    Real const drive = p.crank_length * p.rate_scale * p.rate_scale;
    return p.slider_mass * (abs(p.gravity_x) + abs(p.gravity_y) + drive);
}
/// Speed [m/s] along the way.
template <class Real> SLIDEWAY_FN Real slip_scale(PlanarParameters<Real> const& p) { return p.crank_length * p.rate_scale; }
template <class Real> struct RigidSliderParameters : SliderParameters<Real> {
    Real restitution;
    Real slip_scale;  // as of the planar slider, of what guides this one
    Real pace;        // and its rate [1/s]
};

/// A pair of the joint that slips slower than this comes to rest [slip units], and one that sticks slips from `slip_again` on.
inline constexpr double slip_stops = 3e-7, slip_again = 1e-6;
/// Slip unit of a run [slip scales].  Around the dead centres friction turns all at once, and steps become as short as it takes to follow: what is
/// made of them below a slip v costs as v² of the friction's work, which is to be far less than the tolerance.  What an impact leaves of a slip is
/// against the slip scale: its end sets others in motion.
SLIDEWAY_FN double slip_unit(double rtol) {
    double const wide = ::sqrt(::sqrt(rtol * 1e12));
    return !(wide > 1) ? 1.0 : wide > 100 ? 100.0 : wide;
}

/// Coefficient up to which a contact sticks: a static one below the kinetic has no meaning.
template <class Real> SLIDEWAY_FN Real holding_coefficient(FrictionParameters<Real> const& friction) {
    return max(friction.static_coefficient, friction.kinetic_coefficient);
}

}  // namespace slideway::inline SLIDEWAY_ISA
