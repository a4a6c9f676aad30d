#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/step_integrals.hpp"
#include "kernels/lanes/stepped_numbers.hpp"
#include "kernels/lanes/stepper_traits.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_clock.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of an explicit pair by the clocks of impacts (ContactClock), in lanes without one by time.  Time t and u = √δ are two
/// components, before the state's: y' = 2u f, t' = 2u, u' = δ'.  A step that was made may end early, at any place inside.
template <class Pair, class Model, class Real> class ClockStep : public StepperTraits {
public:
    static constexpr bool by_clock = true;
    SLIDEWAY_HD static int order(Pack<Model, Real> const&) { return Pair::order; }
    SLIDEWAY_HD static int evaluations(Pack<Model, Real> const&) { return Pair::stages - 1; }  // per attempt

    /// Says by what clock the next attempt goes, and how far.  @param deep lanes deep within an impact
    SLIDEWAY_HD void go_by(ContactClock<Real> const& clock, Real own, Mask<Real> deep) {
        step_.start = clock;
        step_.own = own;
        step_.deep = select(deep, Real(1.0), Real(0.0));
    }

    /// Idle lanes step in place.  @param to its `step` [s] comes out as what the clock makes of it
    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        begin(pack, from);
        to.faults = Faults<Real>::none();
        Pair::each_stage([&](auto s) { stage<s>(pack, from, to); });
        for (int i = 0; i < first + states_; ++i) numbers_.end[i] = at_[i];
        share_ = Real(1.0);
        whole_ = step_.own;
        finish(to);
        if (from.needs.stages) integrals_.finish(pack, to.step, whole_);
    }

    /// Prepares steps in the lanes of the mask to end early: with a slope in the middle the inside of a step is known to order 5.
    SLIDEWAY_NOINLINE void look_inside(Pack<Model, Real>& pack, StepStart<Model, Real> const& from,
                                       Attempt<Model, Real>& to, Mask<Real> lanes) {
        Real const half(0.5);
        for (int i = 0; i < first + states_; ++i) at_[i] = numbers_.at(i, whole_, half);
        pack.tell_stages(true);
        auto const slopes = evaluate(pack, from, to, lanes, false);
        pack.tell_stages(false);
        for (int i = 0; i < first + states_; ++i) numbers_.set_middle(lanes, i, whole_, slopes.of[i]);
        if (from.needs.stages) integrals_.middle(pack, to.report, slopes.of[time], lanes, whole_);
    }

    /// Ends steps early in the lanes of the mask, whose others stay as they are.  @param share of the whole step by its clock
    SLIDEWAY_NOINLINE void end_early(Pack<Model, Real>& pack, StepStart<Model, Real> const& from,
                                     Attempt<Model, Real>& to, Mask<Real> lanes, Real share) {
        share_ = select(lanes, share, share_);
        auto const early = share_ < Real(1.0);
        for (int i = 0; i < first + states_; ++i) at_[i] = select(early, numbers_.at(i, whole_, share_), numbers_.end[i]);
        evaluate(pack, from, to, lanes, true);
        step_.own = whole_ * share_;
        finish(to);
        if (from.needs.stages) integrals_.end_early(pack, early, to.step, whole_, share_);
    }

    SLIDEWAY_HD Real time_at_start(Real /*whole*/) const { return step_.own * step_.pace_at_start(); }
    SLIDEWAY_HD Real time_at_end(ClockStep const& of_whole, Real /*whole*/) const { return of_whole.step_.own * step_.pace_at_end(); }
    SLIDEWAY_HD void go_as(ClockStep const& whole, Real share, Mask<Real> in) {
        go_by(whole.step_.start, select(in, whole.step_.own * share, Real(0.0)), whole.step_.is_deep());
    }

    /// The last step by its clock.
    SLIDEWAY_HD ClockedStep<Real> const& step() const { return step_; }

    /// Error estimates of the components at the time of the step's end: that of the time counts with the rates there.
    SLIDEWAY_HD void errors(Attempt<Model, Real> const& to, Real* of_state) const {
        Real const of_time = select(step_.start.runs(), Pair::error_slope(numbers_.k, time), Real(0.0));
        for (int i = first; i < first + states_; ++i) of_state[i - first] = step_.own * fnma(to.end_rates[i - first], of_time, Pair::error_slope(numbers_.k, i));
    }

    /// The state inside the step, at fraction θ of its time.
    SLIDEWAY_HD void dense(StepStart<Model, Real> const&, Attempt<Model, Real> const& to, Real theta, Real* state) const {
        Real const share = share_at(to.step, theta);
        for (int i = first; i < first + states_; ++i) state[i - first] = numbers_.at(i, whole_, share);
    }

private:
    static constexpr int size = Model::size;
    static constexpr int time = 0, root = 1, first = 2, components = first + size;  // the state's from `first` on

    /// Derivatives by the clock.
    struct Slopes { Real of[components]; };

    SLIDEWAY_HD void begin(Pack<Model, Real> const& pack, StepStart<Model, Real> const& from) {
        auto const& clock = step_.start;
        Real const pace = step_.pace_at_start();
        memory_ = from.memory;
        memory_.clock = clock.pair;
        states_ = pack.states();
        for (int i = first; i < first + states_; ++i) {
            numbers_.start[i] = from.y[i - first];
            numbers_.k[0][i] = pace * from.rates[i - first];
        }
        numbers_.start[time] = Real(0.0);
        numbers_.start[root] = clock.root;
        numbers_.k[0][time] = pace;
        numbers_.k[0][root] = step_.root_rate(clock.root, clock.rate);
        numbers_.forget_middle();
        if (from.needs.stages) integrals_.begin(pack, pace);
    }

    template <int s>
    SLIDEWAY_HD void stage(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        constexpr bool last = s + 1 == Pair::stages;
        pack.tell_stages(!last);
        Pair::template stage_state<s>(numbers_.start, numbers_.k, step_.own, at_, first + states_);
        // A fault of one stage is NaN in those after it, whose own faults say nothing.
        to.faults =
            to.faults.or_else(evaluate_at(pack, from, to, last ? from.needs.ends : from.needs.stages, numbers_.k[s], last));
        if (from.needs.stages) integrals_.template stage<s>(pack, to.report, numbers_.k[s][time]);
    }

    /// Evaluates the derivative at `at_`.
    SLIDEWAY_HD Faults<Real> evaluate_at(Pack<Model, Real> const& pack, StepStart<Model, Real> const& from,
                                         Attempt<Model, Real>& to, bool report_wanted, Real* slopes, bool at_end) {
        // The pace first: its root and its division need not wait for what follows.
        Real const u = at_[root], evenness = step_.evenness(u), pace = step_.pace(u, evenness);
        memory_.clock_depth = u * u;
        // Who goes out there is out: what follows then has its derivative already.  Not quite zero, for means of depths divide by their sum.
        if (at_end && !from.needs.switches) memory_.clock_depth = select(step_.is_little(u), Real(1e-30), memory_.clock_depth);
        Real& of_clock = rates_[states_];
        of_clock = Real(0.0);
        auto const faults = pack.evaluate(from.t + at_[time], at_ + first, memory_, rates_, report_wanted, to.report);
        for (int i = first; i < first + states_; ++i) slopes[i] = pace * rates_[i - first];
        slopes[time] = pace;
        slopes[root] = step_.root_rate_by(evenness, of_clock);
        return faults;
    }

    /// The same for lanes whose step is made already.
    SLIDEWAY_HD Slopes evaluate(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to,
                                Mask<Real> lanes, bool at_end) {
        Slopes slopes;
        to.faults = to.faults.or_else(evaluate_at(pack, from, to, true, slopes.of, at_end).within(lanes));
        pack.count_evaluations(lanes, 1);
        return slopes;
    }

    /// The attempt's end, which is where the derivative was evaluated last.
    SLIDEWAY_HD void finish(Attempt<Model, Real>& to) {
        for (int i = first; i < first + states_; ++i) to.end[i - first] = at_[i], to.end_rates[i - first] = rates_[i - first];
        to.step = select(step_.own > Real(0.0), at_[time], step_.own);
        step_.end = {step_.start.pair, at_[root], select(step_.start.runs(), rates_[states_], Real(0.0))};
    }

    /// Share of the whole step by its clock at fraction θ of the time of its end: Newton's method on the continuous extension of t.
    SLIDEWAY_HD Real share_at(Real h, Real theta) const {
        auto const runs = step_.start.runs();
        Real share = theta * share_;
        if (none(runs)) return share;
        Real const first = share, wanted = theta * h;
        for (int i = 0; i < 4; ++i) {
            Real const here = numbers_.at(time, whole_, share), ahead = numbers_.at(time, whole_, share + Real(1e-6));
            Real const moved = share + (wanted - here) * Real(1e-6) / (ahead - here);
            auto const inside = (moved >= Real(0.0)) & (moved <= share_);
            share = select(inside, moved, share);
        }
        return select(runs, share, first);
    }

    ClockedStep<Real> step_;
    typename Model::template Memory<Real> memory_;  // of the member, with the clock
    SteppedNumbers<Pair, components, Real> numbers_;
    StepIntegrals<Pair, Model, Real> integrals_;   // if needs.stages
    Real whole_, share_;                           // of the step by its clock: as it was tried, and what is left of it
    Real at_[components];                          // where the derivative is evaluated
    Real rates_[size + 1];                         // the derivative there, and the clock's
    StateCount<Model> states_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
