#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What most steppers are; one that is something else hides it.
struct StepperTraits {
    static constexpr bool stiff = false;
    static constexpr bool by_clock = false;      // steps go by the clocks of impacts
    static constexpr bool ends_early = false;    // a step that was made may end at any place inside
    static constexpr bool has_impulses = false;  // they are a part of the steps, so that nothing happens between these
    static constexpr int jacobians = 0;          // per attempt

    /// Whether error control sets the length of steps.
    template <class Pack> SLIDEWAY_FN static bool adapts(Pack const&) { return true; }
    /// Whether a second estimate of the error says how far the first can be trusted.
    SLIDEWAY_FN static bool has_two_estimates() { return false; }
    template <class Attempt, class Real> SLIDEWAY_FN static void coarse_errors(Attempt const&, Real* /*of_state*/) {}
    /// What there is to do before `dense` in lanes that ask for it.
    template <class Pack, class Attempt, class Lanes> SLIDEWAY_FN static void prepare_dense(Pack&, Attempt const&, Lanes /*wanted*/) {}

    /// What the time would change by over a whole step, as it passes at the step's start and at the end of a part of it: by a clock these differ.
    template <class Real> SLIDEWAY_FN static Real time_at_start(Real whole) { return whole; }
    template <class Stepper, class Real> SLIDEWAY_FN static Real time_at_end(Stepper const& /*of_whole*/, Real whole) { return whole; }
    /// Has the next attempt be a part of another's.
    template <class Stepper, class Real, class In> SLIDEWAY_FN static void go_as(Stepper const& /*whole*/, Real /*share*/, In /*lanes*/) {}
};

}  // namespace slideway::inline SLIDEWAY_ISA
