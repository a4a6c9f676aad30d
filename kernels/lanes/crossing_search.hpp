#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Finds where members cross the surface of a section inside their accepted steps, and records time and state.  The cubic through the
/// ends' values and slopes tells in which steps, up to three times in each; a step of the same method from the same start then ends
/// there, so that a section has the accuracy of the steps themselves, and the orbit does not know of it.
template <class Stepper, class Model, class Real> class CrossingSearch {
public:
    /// @param accepted lanes with an accepted step, which the pack still holds.
    SLIDEWAY_HD static void run(Pack<Model, Real>& pack, Results<Model>& results, Mask<Real> accepted) {
        auto const& c = pack.state.course;
        Surface const surface{pack, results.crossings()};
        auto const recorded = accepted & (c.t + pack.step > pack.state.constants.first_stop);
        if (none(recorded)) return;
        Real const v0 = surface.value(c.t, c.y), v1 = surface.value(c.t + pack.step, pack.end);
        // Derivatives at the ends of a stiff step belong to fast motions that the method damps.
        Real const chord = v1 - v0;
        Real const s0 = Stepper::stiff ? chord : pack.step * surface.slope(c.t, c.y, c.rates, v0);
        Real const s1 =
            Stepper::stiff ? chord : pack.step * surface.slope(c.t + pack.step, pack.end, pack.end_rates, v1);
        auto const candidates = recorded & may_cross(v0, s0, v1, s1);
        if (any(candidates)) record(pack, results, candidates, surface, v0, s0, v1, s1);
    }

private:
    static constexpr int size = Model::size;
    static constexpr int corrections = 5;  // of Newton's method

    struct Surface {
        Pack<Model, Real> const& pack;
        CrossingPlan const& plan;

        SLIDEWAY_HD Real value(Real t, Real const* state) const {
            if (plan.on == CrossingPlan::On::state) return state[plan.index] - Real(plan.level);
            auto const& p = pack.state.constants.parameters;
            return pack.model.gap(t, state, p, plan.on == CrossingPlan::On::gap_z, plan.index) - Real(plan.level);
        }

        /// Time derivative where the value is known; of a gap by a difference over a thousandth of the step, along the motion.
        SLIDEWAY_HD Real slope(Real t, Real const* state, Real const* rates, Real value_here) const {
            if (plan.on == CrossingPlan::On::state) return rates[plan.index];
            Real const ahead = Real(1e-3) * pack.step;
            Real moved[size];
            for (int i = 0; i < size; ++i) moved[i] = fma(ahead, rates[i], state[i]);
            auto const steps = pack.step > Real(0.0);
            return select(steps, (value(t + ahead, moved) - value_here) / select(steps, ahead, Real(1.0)), Real(0.0));
        }
    };

    /// What of the stint's attempt another attempt overwrites, as it asks for no reports.
    struct Attempt {
        SLIDEWAY_HD explicit Attempt(Pack<Model, Real> const& pack)
            : needs(pack.needs), busy(pack.busy), step(pack.step), faults(pack.faults) {
            for (int i = 0; i < size; ++i) end[i] = pack.end[i], end_rates[i] = pack.end_rates[i];
        }
        SLIDEWAY_HD void restore(Pack<Model, Real>& pack) const {
            pack.needs = needs;
            pack.busy = busy;
            pack.step = step;
            pack.faults = faults;
            for (int i = 0; i < size; ++i) pack.end[i] = end[i], pack.end_rates[i] = end_rates[i];
        }

        ReportNeeds needs;
        Mask<Real> busy;
        Real step;
        Faults<Real> faults;
        Real end[size], end_rates[size];
    };

    SLIDEWAY_NOINLINE static void record(Pack<Model, Real>& pack, Results<Model>& results, Mask<Real> candidates,
                                         Surface const& surface, Real v0, Real s0, Real v1, Real s1) {
        auto const zeros = cubic_zeros(candidates, v0, s0, v1, s1, direction_of(surface.plan));
        if (none(zeros.any)) return;
        // The attempt is the stint's; another stepper makes its own.
        Attempt const attempt(pack);
        pack.needs = {};
        auto const starts_below = v0 < Real(0.0), ends_below = v1 < Real(0.0);
        auto sides = mask_of<Real>(false);  // of those that are looked for
        if (surface.plan.direction != CrossingPlan::Direction::falling) sides = sides | (starts_below & !ends_below);
        if (surface.plan.direction != CrossingPlan::Direction::rising) sides = sides | ((!starts_below) & ends_below);
        Real const found = present(zeros.at[0]) + present(zeros.at[1]) + present(zeros.at[2]);
        auto const single = sides & (found == Real(1.0));
        for (auto const& zero : zeros.at) {
            auto at = candidates & (zero.theta <= Real(1.0));
            if (none(at)) continue;
            place(pack, surface, attempt.step, at, single, zero, v0, v1);
            Real const t = pack.state.course.t + pack.step;
            at = at & (t >= pack.state.constants.first_stop);
            results.take_crossing(pack, at, t, pack.end);
        }
        attempt.restore(pack);
    }

    /// Ends a step at the crossing: the pack's `step` and `end` are then those of the section.  Newton's method from the cubic's zero,
    /// within its monotone stretch; where the step's ends lie on two sides and the cubic has one zero, they bracket it, and a false
    /// position (Illinois: an end that stays counts half) ends what Newton has not, or what has no slope to go by.
    SLIDEWAY_HD static void place(Pack<Model, Real>& pack, Surface const& surface, Real whole, Mask<Real> at,
                                  Mask<Real> bracketed, CubicZero<Real> const& zero, Real v0, Real v1) {
        Real theta = select(at, zero.theta, Real(0.0));
        Real low = select(bracketed, Real(0.0), zero.low), high = select(bracketed, Real(1.0), zero.high);
        Real of_low = v0, of_high = v1;
        auto wanted = at;
        for (int i = 0; i < 60 && any(wanted); ++i) {
            Real const here = value_after(pack, surface, whole, theta, wanted);
            auto const below = here < Real(0.0), low_below = of_low < Real(0.0);
            auto const as_low = (below & low_below) | ((!below) & (!low_below));
            auto const is_low = wanted & bracketed & as_low, is_high = wanted & bracketed & !as_low;
            of_high = select(is_low, Real(0.5) * of_high, select(is_high, here, of_high));
            of_low = select(is_high, Real(0.5) * of_low, select(is_low, here, of_low));
            low = select(is_low, theta, low);
            high = select(is_high, theta, high);
            Real next = low - of_low * ((high - low) / (of_high - of_low));
            if (!Stepper::stiff && i < corrections) {
                Real const t = pack.state.course.t + pack.step;
                Real const slope = whole * surface.slope(t, pack.end, pack.end_rates, here);
                Real const moved = theta - here / slope;
                // A grazing zero has no slope to go by, and a NaN goes nowhere.
                auto const inside = (moved > low) & (moved < high);
                next = select(inside, moved, select(bracketed, next, theta));
            } else {
                wanted = wanted & bracketed;
            }
            wanted = wanted & (next > low) & (next < high) & !(next == theta) & !(here == Real(0.0));
            theta = select(wanted, next, theta);
        }
        value_after(pack, surface, whole, theta, at);
    }

    /// The surface's value after a step of a fraction of the whole one.
    /// @param at lanes that need it: what it costs must not depend on what others need.
    SLIDEWAY_NOINLINE static Real value_after(Pack<Model, Real>& pack, Surface const& surface, Real whole, Real theta,
                                              Mask<Real> at) {
        pack.busy = at;
        pack.step = select(at, whole * theta, Real(0.0));
        Stepper stepper;
        stepper.attempt(pack);
        pack.count_evaluations(at, Stepper::evaluations);
        return surface.value(pack.state.course.t + pack.step, pack.end);
    }

    SLIDEWAY_FN static Real present(CubicZero<Real> const& zero) { return count<Real>(zero.theta <= Real(1.0)); }

    SLIDEWAY_HD static Direction direction_of(CrossingPlan const& plan) {
        return plan.direction == CrossingPlan::Direction::rising    ? Direction::rising
               : plan.direction == CrossingPlan::Direction::falling ? Direction::falling
                                                                    : Direction::both;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
