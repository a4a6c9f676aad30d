#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What most steppers are; one that is something else hides it.
struct StepperTraits {
    static constexpr bool adaptive = true;       // error control sets the length of steps, as a rule
    static constexpr bool stiff = false;
    static constexpr bool by_clock = false;      // steps go by the clocks of impacts
    static constexpr bool ends_early = false;    // a step that was made may end at any place inside
    static constexpr bool has_impulses = false;  // they are a part of the steps, so that nothing happens between these
    static constexpr int jacobians = 0;          // per attempt
};

}  // namespace slideway::inline SLIDEWAY_ISA
