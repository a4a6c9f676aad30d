#pragma once

#include "kernels/lanes/attempt.hpp"
#include "kernels/lanes/fine_time.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A step that a pack tries with one stepper, as all see it who have a say in it.
template <class Stepper, class Model, class Real> class PackStep {
public:
    Pack<Model, Real>& pack;
    Results<Model>& results;
    IntegratorSettings const& settings;
    Stepper stepper;
    Attempt<Model, Real> attempt;  // the members' own
    Real landing;                  // known time at which it ends at the latest [s]
    Mask<Real> lands;              // lanes where it ends there
    Real squared_norm;             // of its error, where that is controlled

    SLIDEWAY_HD PackStep(Pack<Model, Real>& of_members, Results<Model>& of_block, IntegratorSettings const& of_method)
        : pack(of_members), results(of_block), settings(of_method) {}

    /// Whether error control sets its length.
    SLIDEWAY_HD bool adapts() const {
        if constexpr (requires { Stepper::adapts(pack); }) return Stepper::adapts(pack);
        else return Stepper::adaptive;
    }
    SLIDEWAY_HD bool is_auto() const { return settings.method == Method::automatic; }

    SLIDEWAY_HD FineTime<Real> fine_time() const { return {pack.state.constants.end, Model::has_shadows && !HasImpacts<Model>}; }
    /// Least step that moves time [s].
    SLIDEWAY_HD Real resolution() const { return fine_time().resolution(); }

    /// The derivative at the end, where impact speeds or contacts are others than those that the step had.
    SLIDEWAY_HD Faults<Real> restart(Mask<Real> touched) {
        auto const& c = pack.state.course;
        auto const faults = pack.evaluate(c.t, c.y, pack.state.contacts.memory, attempt.end_rates, true, attempt.report);
        pack.count_evaluations(touched, 1);
        if (pack.needs.quantities) {
            auto& observer = pack.state.observation.observer;
            observer.switch_over(touched, attempt.report, pack.needs.switches);
        }
        pack.begin_next(touched, attempt.end_rates, attempt.report);
        return faults;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
