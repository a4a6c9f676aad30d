#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/pair_stages.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_clock.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of an explicit pair by the clocks of impacts (ContactClock), in lanes without one by time.  Time t and u = √δ are two
/// components more: y' = 2u f, t' = 2u, u' = δ'.
template <class Pair, class Model, class Real> class ClockStep {
public:
    static constexpr int order = Pair::order;
    static constexpr bool adaptive = true;
    static constexpr bool stiff = false;
    static constexpr bool by_clock = true;
    static constexpr int evaluations = Pair::stages - 1;  // per attempt
    static constexpr bool has_two_estimates = false;
    static constexpr int jacobians = 0;
    static_assert(Pair::adaptive && !Pair::has_two_estimates && Pair::dense_stages == 0);

    /// Says by what clock the next attempt goes, and how far.
    SLIDEWAY_HD void go_by(ContactClock<Real> const& clock, Real own) {
        step_.start = clock;
        step_.own = own;
    }

    /// Idle lanes step in place.  @param to its `step` [s] comes out as what the clock makes of it
    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        begin(from);
        to.faults = Faults<Real>::none();
        if (from.needs.stages) pack.begin_integrals(Stages::template weights<0>(), pace_);
        Stages::run([&](auto s) { stage<s>(pack, from, to); });
        for (int i = 0; i < size; ++i) to.end[i] = at_[i], to.end_rates[i] = rates_[i];
        auto const moves = step_.own > Real(0.0);
        to.step = select(moves, at_[time], step_.own);
        step_.end = {step_.start.pair, at_[root], k_[Pair::stages - 1][root]};
        if (from.needs.stages) pack.end_integrals(select(moves, step_.own / select(moves, to.step, Real(1.0)), Real(1.0)));
    }

    /// The last step by its clock.
    SLIDEWAY_HD ClockedStep<Real> const& step() const { return step_; }

    /// Error estimate of one component at the time of the step's end: that of the time counts with the rate there.
    SLIDEWAY_HD Real error(Attempt<Model, Real> const& to, int i) const {
        Real const of_time = select(step_.start.runs(), Pair::error_slope(k_, time), Real(0.0));
        return step_.own * fnma(to.end_rates[i], of_time, Pair::error_slope(k_, i));
    }

    SLIDEWAY_HD void prepare_dense(Pack<Model, Real>&, Attempt<Model, Real> const&, Mask<Real>) {}

    /// The state inside the step, at fraction θ of its time.
    SLIDEWAY_HD void dense(StepStart<Model, Real> const& from, Attempt<Model, Real> const& to, Real theta, Real* state) const {
        Real const fraction = fraction_of(to.step, theta);
        for (int i = 0; i < size; ++i) state[i] = Pair::dense(k_, i, from.y[i], to.end[i], step_.own, fraction);
    }

private:
    static constexpr int size = Model::size;
    static constexpr int time = size, root = size + 1;
    using Stages = PairStages<Pair>;

    SLIDEWAY_HD void begin(StepStart<Model, Real> const& from) {
        auto const& clock = step_.start;
        pace_ = clock.pace();
        memory_ = from.memory;
        memory_.clock = clock.pair;
        for (int i = 0; i < size; ++i) {
            start_[i] = from.y[i];
            k_[0][i] = pace_ * from.rates[i];
        }
        start_[time] = Real(0.0);
        start_[root] = clock.root;
        k_[0][time] = pace_;
        k_[0][root] = select(clock.runs(), clock.rate, Real(0.0));
    }

    template <int s>
    SLIDEWAY_HD void stage(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        constexpr bool last = s + 1 == Pair::stages;
        Pair::template stage_state<s>(start_, k_, step_.own, at_);
        auto const runs = step_.start.runs();
        Real const u = at_[root];
        memory_.clock_depth = u * u;
        rates_[size] = Real(0.0);
        auto const faults =
            pack.evaluate(from.t + at_[time], at_, memory_, rates_, last ? from.needs.ends : from.needs.stages, to.report);
        to.faults = to.faults.or_else(faults);
        Real const pace = select(runs, u + u, Real(1.0));
        for (int i = 0; i < size; ++i) k_[s][i] = pace * rates_[i];
        k_[s][time] = pace;
        k_[s][root] = select(runs, rates_[size], Real(0.0));
        if (from.needs.stages) pack.add_integrands(Stages::template weights<s>(), to.report, pace);
    }

    /// Fraction of the step by its clock at fraction θ of its time: Newton's method on the continuous extension of t.
    SLIDEWAY_HD Real fraction_of(Real h, Real theta) const {
        auto const runs = step_.start.runs();
        if (none(runs)) return theta;
        Real fraction = theta;
        Real const wanted = theta * h;
        for (int i = 0; i < 4; ++i) {
            Real const here = Pair::dense(k_, time, start_[time], h, step_.own, fraction);
            Real const ahead = Pair::dense(k_, time, start_[time], h, step_.own, fraction + Real(1e-6));
            Real const moved = fraction + (wanted - here) * Real(1e-6) / (ahead - here);
            auto const inside = (moved >= Real(0.0)) & (moved <= Real(1.0));
            fraction = select(inside, moved, fraction);
        }
        return select(runs, fraction, theta);
    }

    ClockedStep<Real> step_;
    typename Model::template Memory<Real> memory_;  // of the member, with the clock
    Real pace_;
    Real k_[Pair::stages][size + 2];
    Real start_[size + 2], at_[size + 2];
    Real rates_[size + 1];  // the derivative, and the clock's
};

}  // namespace slideway::inline SLIDEWAY_ISA
