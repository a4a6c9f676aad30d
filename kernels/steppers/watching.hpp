#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// At which events of the contacts steps end, the same for a whole block.
enum class Watching {
    nothing,
    gaps,              // no event ends a step that has been made
    touches,           // pairs meet: what restitution needs, v0 changing only at accepted touch events (model.md 4)
    touches_and_parts, // pairs part too: for a law that switches there, between shadows and their member
    clocks,            // touches and parts alike, held within a step as with `modes`; √δ of the shallowest pair is the step's clock
    modes,             // a law that switches has its contacts held within a step, so that the derivative is smooth and the stepper keeps its
                       // order; a pair whose depth changes sign ends the step and is turned over explicitly
};

/// Whether steps are tried that end just beyond the next event.  What remembers impact speeds may let go of a pair that has not parted yet, and push it
/// again when another has: a step beyond both would not see that.
constexpr bool looks_ahead(Watching watching) { return watching == Watching::gaps || watching == Watching::touches; }
constexpr bool holds_contacts(Watching watching) { return watching == Watching::modes || watching == Watching::clocks; }

}  // namespace slideway::inline SLIDEWAY_ISA
