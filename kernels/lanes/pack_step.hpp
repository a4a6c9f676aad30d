#pragma once

#include "kernels/lanes/error_norm.hpp"
#include "kernels/lanes/fine_time.hpp"
#include "kernels/lanes/neighbours.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A step that a pack attempts with one stepper: its length, its end and its error, shared by all who limit it.
template <class Stepper, class Model, class Real> struct PackStep {
    Pack<Model, Real>& pack;
    Results<Model>& results;
    IntegratorSettings const& settings;
    Stepper stepper;
    Attempt<Model, Real> attempt;  // the members' own
    [[no_unique_address]] Neighbours<Model, Real> neighbours;
    Real landing;        // known time at which it ends at the latest [s]
    Mask<Real> lands;    // lanes that are to end there
    Real squared_norm;   // largest squared error of member and neighbours, where error control is at work
    Real former_memory;  // of error control, before the attempt

    SLIDEWAY_HD PackStep(Pack<Model, Real>& of_members, Results<Model>& of_block, IntegratorSettings const& of_method)
        : pack(of_members), results(of_block), settings(of_method), neighbours(of_block.shadows()) {}

    /// Whether error control sets its length.
    SLIDEWAY_HD bool adapts() const { return Stepper::adapts(pack); }
    SLIDEWAY_HD bool is_auto() const { return settings.method == Method::automatic; }
    /// The longest that it may be [s].
    SLIDEWAY_HD Real longest() const { return Real(Stepper::stiff ? settings.stiff_max_step : settings.max_step); }

    SLIDEWAY_HD FineTime<Real> fine_time() const { return {pack.state.constants.end, Model::has_shadows && !IsRigid<Model>}; }
    /// Least step that moves time [s].
    SLIDEWAY_HD Real resolution() const { return fine_time().resolution(); }
    /// Least step that an event may cut [s].
    SLIDEWAY_HD Real least_cut() const { return resolution() * Real(64.0); }

    /// Of an attempt, the members' own or a neighbour's.
    SLIDEWAY_HD Real squared_error(StepStart<Model, Real> const& from, Attempt<Model, Real> const& to) {
        return ErrorNorm<Stepper, Model, Real>::squared(pack, stepper, settings, from, to);
    }
    /// Goes on from the end in lanes whose impact speeds or contacts have changed there.
    SLIDEWAY_HD Faults<Real> restart(Mask<Real> in) { return pack.restart(in, attempt.end_rates, attempt.report); }
};

}  // namespace slideway::inline SLIDEWAY_ISA
