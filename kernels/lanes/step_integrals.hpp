#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/stepped_numbers.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The integrals over a step whose stages are kept, so that they are known at any place inside: those that the pack asks for, by the step's
/// clock, whose pace is what time changes by with it.
template <class Pair, class Model, class Real> class StepIntegrals {
public:
    SLIDEWAY_HD void begin(Pack<Model, Real> const& pack, Real pace) {
        pack.integrands_at_start(numbers_.k[0]);
        for (int i = 0, count = pack.integrals_in_use(); i < count; ++i) {
            numbers_.start[i] = Real(0.0);
            numbers_.k[0][i] = numbers_.k[0][i] * pace;
        }
        numbers_.forget_middle();
    }

    /// With the report of a stage.
    template <int s> SLIDEWAY_HD void stage(Pack<Model, Real> const& pack, typename Pack<Model, Real>::Report const& report, Real pace) {
        pack.integrands(report, numbers_.k[s]);
        for (int i = 0, count = pack.integrals_in_use(); i < count; ++i) numbers_.k[s][i] = numbers_.k[s][i] * pace;
    }

    /// With the report in the middle of the step.
    SLIDEWAY_HD void middle(Pack<Model, Real> const& pack, typename Pack<Model, Real>::Report const& report, Real pace, Mask<Real> lanes,
                            Real whole) {
        Real values[parts];
        pack.integrands(report, values);
        for (int i = 0, count = pack.integrals_in_use(); i < count; ++i) numbers_.set_middle(lanes, i, whole, values[i] * pace);
    }

    /// Means and errors over the whole step.  @param step [s]  @param whole the step by its clock
    SLIDEWAY_HD void finish(Pack<Model, Real>& pack, Real step, Real whole) {
        Real const per_time = Real(1.0) / step, own_per_time = whole * per_time;
        Real means[parts];
        for (int i = 0, count = pack.integrals_in_use(); i < count; ++i) {
            // Of the last stage the weights are those of the step.
            numbers_.end[i] = Pair::template stage_value<Pair::stages - 1>(numbers_.start, numbers_.k, whole, i);
            means[i] = numbers_.end[i] * per_time;
        }
        pack.set_means(step > Real(0.0), means);
        pack.each_audited([&](int i, int place) { pack.audit_error[i] = own_per_time * Pair::error_slope(numbers_.k, place); });
    }

    /// Means over what is left of a step in lanes where it ends early.  @param share of the whole step by its clock
    SLIDEWAY_HD void end_early(Pack<Model, Real>& pack, Mask<Real> early, Real step, Real whole, Real share) const {
        Real means[parts];
        for (int i = 0, count = pack.integrals_in_use(); i < count; ++i) means[i] = numbers_.at(i, whole, share) / step;
        pack.set_means(early, means);
    }

private:
    static constexpr int parts = room(Pack<Model, Real>::integrals);

    SteppedNumbers<Pair, parts, Real> numbers_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
