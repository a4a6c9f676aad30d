#pragma once

#include <type_traits>

#include "kernels/joint/joint.hpp"
#include "kernels/mechanisms/no_memory.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What every mechanism with a clearance joint tells of it beside its derivative.
/// @tparam Mechanism has `position(t, state, parameters)`, of the slider's centre [m]; only a misaligned way asks for its X.
template <class Mechanism, class Law, class Friction, class Way, class Damping> struct SliderContact {
    using Contact = Joint<Law, Friction, Damping>;
    static constexpr bool has_memory = Contact::has_memory;
    static constexpr bool can_hold = Contact::can_hold;
    static constexpr bool conserving = !Law::switches;
    template <class Real>
    using Memory = std::conditional_t<has_memory, ImpactMemory<Real>,
                                      std::conditional_t<can_hold, HeldContacts<Real>, NoMemory<Real>>>;

    /// Which apices touch, as a number (Joint::pattern): members of one pattern have the same work to do.
    template <class Real>
    SLIDEWAY_NOINLINE static Real contact_pattern(Real t, Real const* s, SliderParameters<Real> const& p) {
        return Contact::pattern(pose(t, s, p), p.joint.geometry);
    }

    /// Mean speed, in units of c ω, at which the fastest of the apices that come into contact in a step has approached its face; 0 where
    /// none does.
    template <class Real>
    SLIDEWAY_NOINLINE static Real approach_speed(Real t, Real const* s, Real step, Real const* end,
                                                 SliderParameters<Real> const& p) {
        Real const way = Contact::approach(pose(t, s, p), pose(t + step, end, p), p.joint.geometry);
        return way / (step * max(p.length_scale_y, p.length_scale_z) * p.rate_scale);
    }

    /// Gap of an apex to the face on its side along Y, or along Z: its penetration negated [m].  @param apex P1…P8 from 0
    template <class Real>
    SLIDEWAY_NOINLINE static Real gap(Real t, Real const* s, SliderParameters<Real> const& p, bool z_faces, int apex) {
        return negated(Contact::penetration(pose(t, s, p), p.joint.geometry, z_faces, apex));
    }

private:
    /// Where the slider is in its joint; without its motion.
    template <class Real>
    SLIDEWAY_FN static JointMotion<Real> pose(Real t, Real const* s, SliderParameters<Real> const& p) {
        Real const zero(0.0);
        Vec3<Real> const still{zero, zero, zero};
        return Way::motion(axes(attitude(s[4], s[5], s[6])), Mechanism::position(t, s, p), still, still, p.joint.way);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
