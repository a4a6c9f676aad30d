#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/mechanisms/event_info.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Finds and applies a model's events inside the accepted steps, in the order of their times.  The cubic through the event
/// function's values and slopes at both ends tells where its zeros are, twice over within a step or grazing too; the stepper's
/// dense output then places them.  An event that resets the state ends its step.
template <class Model, class Real> class EventSearch {
public:
    static constexpr int size = Model::size;
    static constexpr int events = Model::events;

    /// Finds the events; `fraction()` then tells where the steps end.  @param accepted lanes with an accepted step.
    template <class Stepper> SLIDEWAY_HD void run(Pack<Model, Real>& pack, Stepper const& stepper, Mask<Real> accepted) {
        auto& c = pack.state.course;
        auto const& p = pack.state.constants.parameters;
        ended_ = mask_of<Real>(false);
        fraction_ = Real(1.0);
        Model::event_values(c.t + pack.step, pack.end, pack.end_rates, p, end_.value, end_.slope);
        auto candidates = mask_of<Real>(false);
        for (int event = 0; event < events; ++event) {
            candidates = candidates | may_cross(c.watch.value[event], c.watch.slope[event], end_.value[event],
                                                end_.slope[event]);
        }
        candidates = candidates & accepted;
        if (any(candidates)) search(pack, stepper, candidates);
    }

    /// Puts lanes whose step an event ended into the state after its reset: the pack's `end` and `end_rates` hold it.  Before that they
    /// are those of the whole step, which the stepper's dense output wants.
    SLIDEWAY_HD void reset(Pack<Model, Real>& pack) {
        if (any(ended_)) place_resets(pack);
    }

    /// Lanes whose step an event ended, and the fraction of the step at which.
    SLIDEWAY_HD Mask<Real> ended() const { return ended_; }
    SLIDEWAY_HD Real fraction() const { return fraction_; }

    /// What the next step's search starts from.
    SLIDEWAY_HD void keep(Mask<Real> in, EventValues<events, Real>& watch) const { keep_events(in, end_, watch); }

private:
    static constexpr double absent = 2.0;  // beyond every step

    template <class Stepper>
    SLIDEWAY_NOINLINE void search(Pack<Model, Real>& pack, Stepper const& stepper, Mask<Real> accepted) {
        auto const& c = pack.state.course;
        bool found = false;
        for (int event = 0; event < events; ++event) {
            auto const info = Model::event_table[event];
            zeros_[event] = cubic_zeros(accepted, c.watch.value[event], pack.step * c.watch.slope[event],
                                        end_.value[event], pack.step * end_.slope[event], info.direction);
            if (none(zeros_[event].any)) continue;
            found = true;
            for (auto& zero : zeros_[event].at) place(pack, stepper, event, zero);
        }
        while (found && apply_earliest(pack, stepper, accepted)) {
        }
    }

    SLIDEWAY_NOINLINE void place_resets(Pack<Model, Real>& pack) {
        Real const t = fma(pack.step, fraction_, pack.state.course.t);
        for (int i = 0; i < size; ++i) pack.end[i] = select(ended_, reset_[i], pack.end[i]);
        Real rates[size];
        pack.evaluate(t, pack.end, rates, pack.needs.ends, pack.end_report);
        pack.count_evaluations(ended_, 1);
        for (int i = 0; i < size; ++i) pack.end_rates[i] = select(ended_, rates[i], pack.end_rates[i]);
        Model::event_values(t, pack.end, pack.end_rates, pack.state.constants.parameters, end_.value, end_.slope);
    }

    template <class Stepper>
    SLIDEWAY_HD static void dense_state(Pack<Model, Real> const& pack, Stepper const& stepper, Real theta, Real* state) {
        for (int i = 0; i < size; ++i) state[i] = stepper.dense(pack, i, theta);
    }

    /// Moves a zero of the cubic to that of the dense output: three Newton steps with the cubic's slope leave the rounding.
    template <class Stepper>
    SLIDEWAY_HD void place(Pack<Model, Real> const& pack, Stepper const& stepper, int event, CubicZero<Real>& zero) const {
        auto const present = zero.theta <= Real(1.0);
        if (none(present)) return;
        auto const& c = pack.state.course;
        Real theta = select(present, zero.theta, Real(0.5));
        for (int i = 0; i < 3; ++i) {
            Real state[size], value[events], slope[events];
            dense_state(pack, stepper, theta, state);
            Model::event_values(fma(pack.step, theta, c.t), state, pack.end_rates, pack.state.constants.parameters,
                                value, slope);
            Real const moved = theta - value[event] / zero.slope;
            // A grazing zero has no slope to go by, and a NaN stays where the cubic has it.
            auto const inside = (moved >= zero.low) & (moved <= zero.high);
            theta = select(inside, moved, theta);
        }
        zero.theta = select(present, theta, zero.theta);
    }

    /// @return whether any lane had an event left.
    template <class Stepper>
    SLIDEWAY_HD bool apply_earliest(Pack<Model, Real>& pack, Stepper const& stepper, Mask<Real> accepted) {
        Real first = Real(absent), which = Real(-1.0);
        for (int event = 0; event < events; ++event) {
            for (auto const& zero : zeros_[event].at) {
                auto const earlier = zero.theta < first;
                first = select(earlier, zero.theta, first);
                which = select(earlier, Real(static_cast<double>(event)), which);
            }
        }
        auto const due = accepted & !ended_ & (first <= Real(1.0));
        if (none(due)) return false;
        Real const theta = select(due, first, Real(1.0));
        Real const t = fma(pack.step, theta, pack.state.course.t);
        Real state[size];
        dense_state(pack, stepper, theta, state);
        for (int event = 0; event < events; ++event) {
            auto const here = due & (which == Real(static_cast<double>(event)));
            if (none(here)) continue;
            for (auto& zero : zeros_[event].at) {
                zero.theta = select(here & (zero.theta == first), Real(absent), zero.theta);
            }
            if (pack.needs.quantities) pack.state.observation.observer.event(here, event, t, state);
            if (!Model::event_table[event].resets) continue;
            Model::reset(event, here, state, pack.state.constants.parameters);
            for (int i = 0; i < size; ++i) reset_[i] = select(here, state[i], reset_[i]);
            fraction_ = select(here, theta, fraction_);
            ended_ = ended_ | here;
        }
        return true;
    }

    CubicZeros<Real> zeros_[events];
    EventValues<events, Real> end_;
    Real reset_[size], fraction_;
    Mask<Real> ended_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
