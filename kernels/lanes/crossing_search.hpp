#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Finds where members cross the surface of a section inside their accepted steps, and records time and state.  The cubic through the
/// ends' values and slopes tells in which steps, up to three times in each; a step of the same method from the same start then ends
/// there, so that a section has the accuracy of the steps themselves, and the orbit does not know of it.
/// A crossing is a change of side.  Who is on the surface, to the last bit, where a step ends is on the side where it came from until it
/// leaves: it crosses there if it leaves to the other side, and has touched the surface if not.  A start on the surface has come from
/// neither side and is no crossing; nor has who ends the run there left.
template <class Stepper, class Model, class Real> class CrossingSearch {
public:
    /// @param stepper that made the step  @param accepted lanes with an accepted step.
    SLIDEWAY_HD static void run(Pack<Model, Real>& pack, Results<Model>& results, Stepper const& stepper,
                                Attempt<Model, Real> const& whole, Mask<Real> accepted) {
        auto& c = pack.state.course;
        Surface const surface{pack, stepper, results.crossings(), whole.step, nearest_turn(results.crossings(), c.y, whole.end)};
        Real const zero(0.0), end = c.t + whole.step;
        auto const recorded = accepted & (results.by_turns() ? results.records_at(pack.state, end, whole.end) : end > pack.state.constants.first_stop);
        Span span;
        span.v1 = surface.value(end, whole.end);
        Real ends_on = side_of(span.v1, c.side);
        if (any(recorded)) {
            span.v0 = surface.value(c.t, c.y);
            // Derivatives at the ends of a stiff step belong to fast motions that the method damps.
            Real const chord = span.v1 - span.v0;
            span.s0 = Stepper::stiff ? chord : stepper.time_at_start(whole.step) * surface.slope(c.t, c.y, c.rates, span.v0);
            span.s1 = Stepper::stiff ? chord : stepper.time_at_end(stepper, whole.step) * surface.slope(end, whole.end, whole.end_rates, span.v1);
            // What rests on the surface leaves it some time within the step, which the cubic cannot know: it swings.  What turns round there
            // by s0²/4 v1, which rounding of the values does not show, rests too.
            auto const rests = (span.v0 == zero) & (abs(span.s0) <= Real(1e-8) * abs(span.v1));
            Real const goes = select(rests, span.v1, span.s0), leaves_to = side_of(span.v0, side_of(goes, c.side));
            auto const leaves = recorded & (span.v0 == zero) & results.records_at(pack.state, c.t, c.y) & (leaves_to * c.side < zero);
            if (any(leaves)) record_start(pack, results, leaves, leaves_to);
            ends_on = select(recorded, side_of(span.v1, leaves_to), ends_on);
            span.v0 = beside_zero(span.v0, leaves_to);
            span.v1 = beside_zero(span.v1, ends_on);
            auto const candidates = recorded & (!rests) & may_cross(span.v0, span.s0, span.v1, span.s1);
            if (any(candidates)) record(pack, results, candidates, surface, span);
        }
        c.side = select(accepted, ends_on, c.side);
    }

private:
    static constexpr int size = Model::size;
    static constexpr int corrections = 5;  // of Newton's method

    struct Surface {
        Pack<Model, Real> const& pack;
        Stepper const& stepper;  // that made the step
        CrossingPlan const& plan;
        Real const& whole;  // the step that is searched
        Real level;

        SLIDEWAY_HD Real value(Real t, Real const* state) const {
            if (plan.on == CrossingPlan::On::state) return state[plan.index] - level;
            auto const& p = pack.state.constants.parameters;
            return pack.model.gap(t, state, p, plan.on == CrossingPlan::On::gap_z, plan.index) - Real(plan.level);
        }

        /// Time derivative where the value is known; of a gap by a difference over a thousandth of the step, along the motion.
        SLIDEWAY_HD Real slope(Real t, Real const* state, Real const* rates, Real value_here) const {
            return slope(t, state, rates, value_here, whole);
        }
        SLIDEWAY_HD Real slope(Real t, Real const* state, Real const* rates, Real value_here, Real step) const {
            if (plan.on == CrossingPlan::On::state) return rates[plan.index];
            Real const ahead = Real(1e-3) * step;
            Real moved[size];
            for (int i = 0, n = pack.states(); i < n; ++i) moved[i] = fma(ahead, rates[i], state[i]);
            auto const steps = step > Real(0.0);
            return select(steps, (value(t + ahead, moved) - value_here) / select(steps, ahead, Real(1.0)), Real(0.0));
        }
    };

    /// The level of an angle that a step may cross: the turn of it that is nearest to the step's middle.
    SLIDEWAY_FN static Real nearest_turn(CrossingPlan const& plan, Real const* start, Real const* end) {
        Real const level(plan.level);
        if (!plan.turns) return level;
        Real const turn(6.283185307179586), middle = Real(0.5) * (start[plan.index] + end[plan.index]);
        return fma(turn, round_even((middle - level) / turn), level);
    }

    /// The surface's values at the ends of the step, and their slopes per step.
    struct Span { Real v0, s0, v1, s1; };

    /// 1 or −1, by the sign of a number; the other one's where it is 0.
    SLIDEWAY_FN static Real side_of(Real value, Real of_zero) {
        Real const zero(0.0);
        return select(value > zero, Real(1.0), select(value < zero, Real(-1.0), of_zero));
    }
    /// A value, on a side: what is 0 becomes the least number that is not.
    SLIDEWAY_FN static Real beside_zero(Real value, Real side) { return select(value == Real(0.0), Real(1e-300) * side, value); }

    /// The crossing of lanes whose step starts on the surface.  @param side that they go to
    SLIDEWAY_HD static void record_start(Pack<Model, Real>& pack, Results<Model>& results, Mask<Real> at, Real side) {
        auto const& c = pack.state.course;
        Mask<Real> const rises = side > Real(0.0);
        if (!results.crossings().wants(Direction::rising)) at = at & !rises;
        if (!results.crossings().wants(Direction::falling)) at = at & rises;
        results.take_crossing(pack, at, c.t, c.y);
    }

    SLIDEWAY_NOINLINE static void record(Pack<Model, Real>& pack, Results<Model>& results, Mask<Real> candidates,
                                         Surface const& surface, Span const& span) {
        auto const zeros = cubic_zeros(candidates, span.v0, span.s0, span.v1, span.s1, surface.plan.direction);
        if (none(zeros.any)) return;
        auto const starts_below = span.v0 < Real(0.0), ends_below = span.v1 < Real(0.0);
        auto sides = mask_of<Real>(false);  // of those that are looked for
        if (surface.plan.wants(Direction::rising)) sides = sides | (starts_below & !ends_below);
        if (surface.plan.wants(Direction::falling)) sides = sides | ((!starts_below) & ends_below);
        Real const found = present(zeros.at[0]) + present(zeros.at[1]) + present(zeros.at[2]);
        Mask<Real> const single = sides & (found == Real(1.0));
        // The members' attempt stays as it is: another stepper makes its own.
        Attempt<Model, Real> attempt;
        for (auto const& zero : zeros.at) {
            Mask<Real> at = candidates & (zero.theta <= Real(1.0));
            if (none(at)) continue;
            place(pack, surface, attempt, {at, single}, zero, span);
            Real const t = pack.state.course.t + attempt.step;
            at = at & results.records_at(pack.state, t, attempt.end);
            results.take_crossing(pack, at, t, attempt.end);
        }
    }

    /// Lanes whose crossing is wanted, and those of them whose step's ends bracket it.
    struct Wanted { Mask<Real> at, bracketed; };

    /// Ends a step at the crossing: the attempt's `step` and `end` are then those of the section.  Newton's method from the cubic's zero,
    /// within its monotone stretch; where the step's ends lie on two sides and the cubic has one zero, they bracket it, and a false
    /// position (Illinois: an end that stays counts half) ends what Newton has not, or what has no slope to go by.
    SLIDEWAY_HD static void place(Pack<Model, Real>& pack, Surface const& surface, Attempt<Model, Real>& attempt,
                                  Wanted const& lanes_of, CubicZero<Real> const& zero, Span const& span) {
        auto const &at = lanes_of.at, &bracketed = lanes_of.bracketed;
        Real theta = select(at, zero.theta, Real(0.0));
        Real low = select(bracketed, Real(0.0), zero.low), high = select(bracketed, Real(1.0), zero.high);
        Real of_low = span.v0, of_high = span.v1;
        auto wanted = at;
        Stepper part;
        for (int i = 0; i < 60 && any(wanted); ++i) {
            Real const here = value_after(pack, surface, part, attempt, theta, wanted);
            auto const below = here < Real(0.0), low_below = of_low < Real(0.0);
            auto const as_low = (below & low_below) | ((!below) & (!low_below));
            auto const is_low = wanted & bracketed & as_low, is_high = wanted & bracketed & !as_low;
            of_high = select(is_low, Real(0.5) * of_high, select(is_high, here, of_high));
            of_low = select(is_high, Real(0.5) * of_low, select(is_low, here, of_low));
            low = select(is_low, theta, low);
            high = select(is_high, theta, high);
            Real next = low - of_low * ((high - low) / (of_high - of_low));
            if (!Stepper::stiff && i < corrections) {
                Real const t = pack.state.course.t + attempt.step;
                Real const slope =
                    part.time_at_end(surface.stepper, surface.whole) * surface.slope(t, attempt.end, attempt.end_rates, here, attempt.step);
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
        value_after(pack, surface, part, attempt, theta, at);
    }

    /// The surface's value after a step of a fraction of the whole one.
    /// @param at lanes that need it: what it costs must not depend on what others need.
    SLIDEWAY_NOINLINE static Real value_after(Pack<Model, Real>& pack, Surface const& surface, Stepper& stepper,
                                              Attempt<Model, Real>& attempt, Real theta, Mask<Real> at) {
        attempt.step = select(at, surface.whole * theta, Real(0.0));
        stepper.go_as(surface.stepper, theta, at);
        auto from = pack.start();
        from.needs = {};
        stepper.attempt(pack, from, attempt);
        pack.template count_attempt<Stepper>(at);
        return surface.value(pack.state.course.t + attempt.step, attempt.end);
    }

    SLIDEWAY_FN static Real present(CubicZero<Real> const& zero) { return count<Real>(zero.theta <= Real(1.0)); }
};

}  // namespace slideway::inline SLIDEWAY_ISA
