#pragma once

#include "kernels/conditions.hpp"
#include "kernels/joint/apex.hpp"
#include "kernels/joint/contact_memory.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/planar_base.hpp"
#include "kernels/mechanisms/planar_corners.hpp"
#include "kernels/mechanisms/planar_links.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The planar slider-crank whose slider is a block between two walls (Flores, Leine & Glocker 2010; model.md 7).  State: θ1 θ2 ψ
/// θ1' θ2' ψ', absolute angles of crank, rod and slider.  Penetration of corner (s3, s1):
///   δ = s1 (y + s3 a sin ψ) − 2b sin²(ψ/2) − c,   y = l1 sin θ1 + l2 sin θ2,
/// with the point law at each corner, its force along Y, friction along X.  Unless the crank is free a drive holds it at ω: θ1 = θ0 + ω t.
struct PlanarSliderCrank : PlanarBase {
    template <class Real> using Memory = ContactMemory<Real, 1>;

    /// Time derivative of the state.
    /// @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real, class Laws>
    SLIDEWAY_NOINLINE static Faults<Real> derivative(Real t, Real const* s, PlanarParameters<Real> const& p,
                                                     Memory<Real> const& memory, Conditions<Laws> const& block,
                                                     Real* rates, PlanarReport<Real>* report) {
        PlanarLinks<Real> links(t, s, p, block.drive, block.loads);
        PlanarCorners<Real> corners(links, s, p);
        if constexpr (Full) report->contact.start(corners.depth, corners.rate);
        auto push = corners.push_of_nothing();
        if (any(corners.deepest() > Real(0.0))) {
            Quad<Real> const elastic = corners.loads(p.point);
            Quad<Real> force = corners.damped(elastic, memory.impact_speed[0], p.point, p.damping, block.remembers);
            corners.add_normal(force, push);
            if (block.friction) {
                Real const power = corners.add_friction(force, links.vx, p, push);
                if constexpr (Full) report->contact.friction_power = power;
            }
            if constexpr (Full) report->contact.tell(force, elastic, p.point.potential_share);
        }
        auto motion = links.accelerations(push.fx, push.fy, p);
        rates[0] = links.w1;
        rates[1] = links.w2;
        rates[2] = s[5];
        rates[3] = motion.a1;
        rates[4] = motion.a2;
        rates[5] = (push.torque + links.loads.torque) / p.slider_inertia;
        if constexpr (Full) links.tell(motion, s[5], p, *report);
        return Faults<Real>::none();
    }

    /// Gap of a corner: its penetration negated [m].
    template <class Real, class Laws>
    SLIDEWAY_NOINLINE static Real gap(Real t, Real const* s, PlanarParameters<Real> const& p,
                                      Conditions<Laws> const& block, Apex corner) {
        return planar_gap(t, s, p, block.drive, corner);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
