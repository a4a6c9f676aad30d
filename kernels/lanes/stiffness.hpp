#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// When `method = "auto"` changes a member between the explicit pair and the stiff method.  Ω is the rate of its stiffest motion: Ω²
/// is the trace of M⁻¹K of the touching contacts, plus the square of that of M⁻¹D.  Looks are taken once a stint of the explicit pair,
/// so that an impact is over before there are enough of them.
struct Stiffness {
    // The pair is held up where hΩ stays near its limit of stability: a look counts 1.
    static constexpr double held_up_above = 0.9;
    // Contact that lasts keeps vibrating, with amplitudes that only the tolerance sees: a look counts a little.
    static constexpr double lasting_above = 0.1;
    static constexpr double lasting_share = 1.0 / 16;
    // Every other look takes 1 off; at this sum the member changes over.
    static constexpr double enough = 3.0;
    // A corner that rattles on its face changes Ω tenfold from look to look: half the former Ω² counts too.
    static constexpr double memory = 0.5;
    // It goes back when contact is lost, or after so many steps with hΩ below that.
    static constexpr double calm_below = 0.25;
    static constexpr double calm_steps = 6.0;
    // It changes over only while its vibrations have less energy than M (c ω)² times this squared; slower in all velocities, in their
    // scales, it has no impacts.
    static constexpr double creep_below = 0.1;
    // It goes back where an apex comes into contact faster than that, in units of c ω: a corner has a fifth of the mass, and at this
    // speed the energy above.
    static constexpr double impact_above = 0.3;
};

/// The same of rigid contacts, where friction takes back a slip v to the side at the rate Ω = 4 μ Σ λ/(m |v|), without ringing and without impacts in a step.
struct SlipStiffness {
    // The pair is stable up to 3.3 of the rates, of which this is the largest and another: a look counts 1, every other takes 1 off.
    static constexpr double held_up_above = 3.5;
    static constexpr double enough = 16.0;
    // Below that the pair could do the same steps.
    static constexpr double calm_below = 2.5;
    static constexpr double calm_steps = 6.0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
