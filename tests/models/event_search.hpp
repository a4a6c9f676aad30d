#pragma once

#include <array>
#include <utility>

#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a model says of one of its events.
struct EventInfo {
    Direction direction;
    bool resets;  // the model's `reset` changes the state there; else the event is only located
};

/// Finds and applies a model's events inside the accepted steps, in the order of their times.  The cubic through the event
/// function's values and slopes at both ends tells where its zeros are: all of them, up to three in a step, a pair or none where it
/// grazes zero.  The stepper's dense output then places them.  An event that resets the state ends its step.
/// @tparam Model states `events`, how many; `event_table`, an EventInfo each; `event_values(t, state, rates, parameters, values, slopes)`, which follow from
/// the state alone; `reset(event, lanes, state, parameters)`; and `at_rest(rates)`
template <class Model, class Real> class EventSearch {
public:
    static constexpr int size = Model::size;
    static constexpr int events = Model::events;

    /// Ends the accepted steps where an event resets the state.
    /// @param accepted lanes with an accepted step  @param t_end time of its end, then of the reset [s]  @param landed lanes that end where they were to
    template <class Stepper>
    SLIDEWAY_HD void run(Pack<Model, Real>& pack, Stepper& stepper, Attempt<Model, Real> const& attempt, Mask<Real> accepted, Real& t_end,
                         Mask<Real>& landed) {
        find_all(pack, stepper, attempt, accepted);
        auto& c = pack.state.course;
        t_end = select(ended_, fma(attempt.step, fraction_, c.t), t_end);
        c.fine_time = select(ended_, Real(0.0), c.fine_time);
        landed = landed & !ended_;
    }

    /// Puts lanes whose step an event ended into the state after its reset: the attempt's `end` and `end_rates` hold it.  Before that
    /// they are those of the whole step, which the stepper's dense output wants.
    SLIDEWAY_HD void reset(Pack<Model, Real>& pack, Attempt<Model, Real>& attempt) {
        if (any(ended_)) place_resets(pack, attempt);
    }

    /// Lanes whose resets pile up: bounces that come to an end in finite time after infinitely many of them, or an event that its own
    /// reset brings about again.  A model that knows better leaves that state by its reset (ReliefValve::reset); without, time
    /// stands still, or creeps by rounding errors.  To be asked once a step, at its end.
    SLIDEWAY_HD Mask<Real> piled_up(Pack<Model, Real>& pack, Real step) const {
        if (none(ended_)) return ended_;
        auto& c = pack.state.course;
        auto const at_once = c.t - c.resets.time <= Real(at_once_within) * step;
        c.resets.in_row = select(ended_, select(at_once, c.resets.in_row + Real(1.0), Real(0.0)), c.resets.in_row);
        c.resets.time = select(ended_, c.t, c.resets.time);
        return ended_ & (c.resets.in_row >= Real(most_at_once));
    }

    /// Lanes of which all is known that is asked for.
    SLIDEWAY_HD Mask<Real> complete(Pack<Model, Real>& pack, Mask<Real> accepted) const {
        if (!pack.needs.quantities) return mask_of<Real>(false);
        auto const& c = pack.state.course;
        auto& observer = pack.state.observation.observer;
        observer.settle(accepted & Model::at_rest(c.rates), c.y);
        return accepted & observer.complete();
    }

private:
    static constexpr double absent = 2.0;         // beyond every step
    static constexpr double most_at_once = 32.0;  // resets; a few of them may fall together
    static constexpr double at_once_within =
        1e-6;  // of a step: ten times what a double zero of the cubic may be off by
    using Each = std::make_integer_sequence<int, events>;

    /// The step that is searched.
    template <class Stepper> struct Step {
        Stepper const& stepper;
        Attempt<Model, Real> const& attempt;
    };

    /// The event functions at one instant, and their time derivatives.
    struct Values {
        Real value[events], slope[events];
    };

    SLIDEWAY_FN static Values values(Pack<Model, Real> const& pack, Real t, Real const* state, Real const* rates) {
        Values v;
        Model::event_values(t, state, rates, pack.state.constants.parameters, v.value, v.slope);
        return v;
    }
    SLIDEWAY_FN static Values at_start(Pack<Model, Real> const& pack) {
        auto const& c = pack.state.course;
        return values(pack, c.t, c.y, c.rates);
    }
    SLIDEWAY_FN static Values at_end(Pack<Model, Real> const& pack, Attempt<Model, Real> const& attempt) {
        return values(pack, pack.state.course.t + attempt.step, attempt.end, attempt.end_rates);
    }
    SLIDEWAY_FN static Mask<Real> may_cross(Real step, Values const& start, Values const& end, int event) {
        return slideway::may_cross(start.value[event], step * start.slope[event], end.value[event],
                                   step * end.slope[event]);
    }

    template <class Stepper>
    SLIDEWAY_HD void find_all(Pack<Model, Real>& pack, Stepper& stepper, Attempt<Model, Real> const& attempt, Mask<Real> accepted) {
        ended_ = mask_of<Real>(false);
        fraction_ = Real(1.0);
        auto const start = at_start(pack), end = at_end(pack, attempt);
        auto candidates = mask_of<Real>(false);
        for (int event = 0; event < events; ++event) candidates = candidates | may_cross(attempt.step, start, end, event);
        candidates = candidates & accepted;
        if (none(candidates)) return;
        stepper.prepare_dense(pack, attempt, candidates);
        search(pack, Step<Stepper>{stepper, attempt}, candidates, Each{});
    }

    template <class Stepper, int... event>
    SLIDEWAY_NOINLINE void search(Pack<Model, Real>& pack, Step<Stepper> const& step, Mask<Real> accepted,
                                  std::integer_sequence<int, event...>) {
        auto const start = at_start(pack), end = at_end(pack, step.attempt);
        bool const found = (int{find<event>(pack, step, accepted, start, end)} | ...) != 0;
        while (found && apply_earliest(pack, step, accepted)) {}
    }

    /// Times of one event in the step.  @return whether any lane has it.
    template <int event, class Stepper>
    SLIDEWAY_HD bool find(Pack<Model, Real> const& pack, Step<Stepper> const& step, Mask<Real> accepted,
                          Values const& start, Values const& end) {
        for (auto& theta : zeros_[event]) theta = Real(absent);
        Real const& h = step.attempt.step;
        auto const candidates = accepted & may_cross(h, start, end, event);
        if (none(candidates)) return false;
        auto const zeros = cubic_zeros(candidates, start.value[event], h * start.slope[event], end.value[event],
                                       h * end.slope[event], info_of(event).direction);
        if (none(zeros.any)) return false;
        for (int i = 0; i < 3; ++i) zeros_[event][i] = placed<event>(pack, step, zeros.at[i]);
        return true;
    }

    /// A zero of the cubic moved to that of the dense output: three Newton steps with the cubic's slope leave the rounding.
    template <int event, class Stepper>
    SLIDEWAY_FN static Real placed(Pack<Model, Real> const& pack, Step<Stepper> const& step, CubicZero<Real> const& zero) {
        auto const present = zero.theta <= Real(1.0);
        if (none(present)) return zero.theta;
        Real theta = select(present, zero.theta, Real(0.5));
        for (int i = 0; i < 3; ++i) {
            Real state[size];
            step.stepper.dense(pack.start(), step.attempt, theta, state);  // the compiler drops what the event does not depend on
            auto const here = values(pack, fma(step.attempt.step, theta, pack.state.course.t), state, step.attempt.end_rates);
            Real const moved = theta - here.value[event] / zero.slope;
            // A grazing zero has no slope to go by, and a NaN stays where the cubic has it.
            auto const inside = (moved >= zero.low) & (moved <= zero.high);
            theta = select(inside, moved, theta);
        }
        return select(present, theta, zero.theta);
    }

    SLIDEWAY_NOINLINE void place_resets(Pack<Model, Real>& pack, Attempt<Model, Real>& attempt) {
        Real const t = fma(attempt.step, fraction_, pack.state.course.t);
        for (int i = 0; i < size; ++i) attempt.end[i] = select(ended_, reset_[i], attempt.end[i]);
        Real rates[size];
        pack.evaluate(t, attempt.end, pack.state.contacts.memory, rates, pack.needs.ends, attempt.report);
        pack.count_evaluations(ended_, 1);
        for (int i = 0; i < size; ++i) attempt.end_rates[i] = select(ended_, rates[i], attempt.end_rates[i]);
    }

    /// An entry of the model's table.  Of a copy, because device code cannot index a constant of the host.
    SLIDEWAY_HD static constexpr EventInfo info_of(int event) {
        constexpr auto table = std::to_array(Model::event_table);
        return table[static_cast<std::size_t>(event)];
    }

    /// @return whether any lane had an event left.
    template <class Stepper>
    SLIDEWAY_HD bool apply_earliest(Pack<Model, Real>& pack, Step<Stepper> const& step, Mask<Real> accepted) {
        Real first = Real(absent), which = Real(-1.0);
        // Of simultaneous events those come first that let the step go on: none of them is lost to a reset.
        for (bool const resets : {false, true}) {
            for (int event = 0; event < events; ++event) {
                if (info_of(event).resets != resets) continue;
                for (auto const& theta : zeros_[event]) {
                    auto const earlier = theta < first;
                    first = select(earlier, theta, first);
                    which = select(earlier, Real(static_cast<double>(event)), which);
                }
            }
        }
        auto const due = accepted & !ended_ & (first <= Real(1.0));
        if (none(due)) return false;
        Real const theta = select(due, first, Real(1.0));
        Real const t = fma(step.attempt.step, theta, pack.state.course.t);
        Real state[size];
        step.stepper.dense(pack.start(), step.attempt, theta, state);
        for (int event = 0; event < events; ++event) {
            auto const here = due & (which == Real(static_cast<double>(event)));
            if (none(here)) continue;
            for (auto& zero : zeros_[event]) zero = select(here & (zero == first), Real(absent), zero);
            if (pack.needs.quantities) pack.state.observation.observer.event(here, event, t, state);
            if (!info_of(event).resets) continue;
            Model::reset(event, here, state, pack.state.constants.parameters);
            for (int i = 0; i < size; ++i) reset_[i] = select(here, state[i], reset_[i]);
            fraction_ = select(here, theta, fraction_);
            ended_ = ended_ | here;
        }
        return true;
    }

    Real zeros_[events][3];  // fractions of the step, `absent` where there is none
    Real reset_[size], fraction_;
    Mask<Real> ended_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
