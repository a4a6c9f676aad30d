// Runs with rigid contacts.
#pragma once

#include "tests/support/ensemble.hpp"

namespace slideway::testing {

inline Parts rigid_planar_parts(bool friction, bool free_crank) {
    Parts parts;
    parts.mechanism = Mechanism::planar_slider_crank;
    parts.damping = Damping::restitution;
    parts.friction = friction;
    parts.free_crank = free_crank;
    parts.rigid = true;
    return parts;
}

inline RunOptions rigid_options(Parts const& parts, double tolerance, double seconds) {
    RunOptions o;
    o.parts = parts;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.max_step = 1e-3;
    o.settings.end_time = seconds;
    o.settings.max_steps = 1'000'000;
    o.quantities = all_quantities & ~without_rigid_contact;
    return o;
}

}  // namespace slideway::testing
