#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the crank has turned over a step: the cubic through values and slopes at both ends.
template <class Real> struct TurnedOver {
    Real v0, s0, v1, s1;  // [rad], slopes for the whole step

    /// Share of the step at which it has turned by `level`, between both ends: Newton's method, kept between what lies before and beyond.
    SLIDEWAY_HD Real share_at(Real level) const {
        Real const rise = v1 - v0, half(0.5), one(1.0), zero(0.0);
        Real low = zero, high = one, share = max(min(select(rise > zero, (level - v0) / rise, zero), one), zero);
        for (int i = 0; i < 8; ++i) {
            Real const here = value(share) - level;
            auto const before = here < zero;
            low = select(before, share, low);
            high = select(before, high, share);
            Real const moved = share - here / slope(share);
            share = select((moved >= low) & (moved <= high), moved, half * (low + high));
        }
        return share;
    }
    /// v0 + s0 x + a x² + b x³.
    SLIDEWAY_FN Real value(Real x) const { return fma(fma(fma(b(), x, a()), x, s0), x, v0); }
    SLIDEWAY_FN Real slope(Real x) const { return fma(fma(Real(3.0) * b(), x, Real(2.0) * a()), x, s0); }

private:
    SLIDEWAY_FN Real a() const { return Real(3.0) * (v1 - v0) - (s1 + Real(2.0) * s0); }
    SLIDEWAY_FN Real b() const { return (s0 + s1) - Real(2.0) * (v1 - v0); }
};

/// Members that end, stop and are sampled by what their crank has turned since the start (BlockBase::by_turns).  A step is to land where speed and
/// acceleration of the crank say that it comes to the next of these angles.  One that goes beyond tries again, to where the cubic through its ends has
/// it; one that ends before is followed by another.
template <class Model, class Real> class CrankTurns {
public:
    using Member = MemberState<Model, Real>;

    /// Time at which the next step ends at the latest.  @param at_samples whether those end steps too
    SLIDEWAY_HD Real landing(Member const& s, Results<Model> const& results, bool at_samples) {
        auto const& c = s.course;
        at_samples_ = at_samples;
        Real const side = side_of(s, c.y), here = results.turned(s, c.y);
        find_level(s, results, side, here);
        Real const speed = side * c.rates[angle], acceleration = side * c.rates[rate], way = level_ - here;
        // ½ a τ² + v τ = way, without loss next to v = 0, where a crank begins or turns back.
        Real const two(2.0), there = fma(two * acceleration, way, speed * speed), after = two * way / (speed + sqrt(max(there, Real(0.0))));
        auto const comes = (there >= Real(0.0)) & (after > Real(0.0)) & (after < Real(1e300));
        return min(select(c.aim > c.t, c.aim, select(comes, c.t + after, s.constants.end)), s.constants.end);
    }

    /// Has steps that went beyond their angle try again.  @return those
    template <class Step> SLIDEWAY_HD Mask<Real> cut(Step& step, Allowance<Real>& allowed) {
        auto const& s = step.pack.state;
        auto& c = step.pack.state.course;
        auto const& attempt = step.attempt;
        auto const way = over(s, attempt);
        // A crank may have turned back through its start, where the next angle is another.
        find_level(s, step.results, side_of(s, attempt.end), max(way.v0, Real(0.0)));
        Real const beyond = way.v1 - level_, speed = abs(attempt.end_rates[angle]);
        Real const tolerance = Real(8 * 2.220446049250313e-16) * fma(speed, c.t + attempt.step, abs(attempt.end[angle]));
        Mask<Real> const past = allowed.accepted & (beyond > tolerance);
        if (any(past)) {
            c.aim = select(past, fma(attempt.step, way.share_at(level_), c.t), c.aim);
            c.error_memory = select(past, step.former_memory, c.error_memory);
            allowed.accepted = allowed.accepted & !past;
        }
        reached_ = allowed.accepted & (beyond + tolerance >= Real(0.0));
        c.aim = select(allowed.accepted, Real(0.0), c.aim);
        return past;
    }

    /// Lanes whose accepted step has come to a stop; to the end, once that has been counted.
    SLIDEWAY_HD Mask<Real> at_stop(Mask<Real> accepted) const { return accepted & reached_ & (level_ >= stop_); }
    SLIDEWAY_HD Mask<Real> at_end(Mask<Real> accepted, Member const& s, std::size_t stops) const {
        Mask<Real> const last = (level_ >= s.constants.turns) | (s.course.stop >= Real(stops > 0 ? static_cast<double>(stops) : 1e300));
        return accepted & reached_ & last;
    }

    /// Where samples are within a step (Results::take_samples): angles.
    struct Samples {
        TurnedOver<Real> way;
        Real start, end;  // [rad]
        Real last;        // from there on they are at the end of the step, at t_end
        Real t_end;

        /// Newton's method on the continuous extension, with the slopes of the cubic.
        template <class Stepper>
        SLIDEWAY_HD Real share_of(Pack<Model, Real> const& pack, Stepper const& stepper, Attempt<Model, Real> const& attempt, Real wanted,
                                  Mask<Real> due) const {
            Real share = select(due, way.share_at(wanted), Real(0.0)), state[Model::size] = {};
            for (int i = 0; i < 3; ++i) {
                stepper.dense(pack.start(), attempt, share, state);
                Real const ahead = wanted - abs(state[angle] - pack.state.constants.start_angle), moved = share + ahead / way.slope(share);
                share = select((moved >= Real(0.0)) & (moved <= Real(1.0)), moved, share);
            }
            return select((wanted >= last) & (wanted > way.v0), Real(1.0), share);
        }
        SLIDEWAY_HD Real time_of(Real t, Real step, Real share, Real /*wanted*/) const { return select(share < Real(1.0), fma(share, step, t), t_end); }
    };
    /// A level that is reached counts as passed, a hair before it too.
    SLIDEWAY_HD Samples samples(Member const& s, Attempt<Model, Real> const& attempt, Real t_end) const {
        auto const way = over(s, attempt);
        return {way, way.v0, select(reached_, max(level_, way.v1), way.v1), select(reached_, min(level_, way.v1), way.v1), t_end};
    }

private:
    static constexpr int angle = crank_place<Model, 0>;
    static constexpr int rate = crank_place<Model, 1>;

    /// The angle that a step may go to from `here` on a side of the start.
    SLIDEWAY_HD void find_level(Member const& s, Results<Model> const& results, Real side, Real here) {
        stop_ = results.next_turn(s, side);
        level_ = min(s.constants.turns, stop_);
        if (at_samples_) level_ = results.next_sample_times(s.course.sample, here, level_);
    }

    /// 1 where the crank has turned forward, −1 where back; where it is at its start the way that it goes.
    SLIDEWAY_FN static Real side_of(Member const& s, Real const* state) {
        Real const from = state[angle] - s.constants.start_angle, zero(0.0), goes = select(s.course.rates[angle] < zero, Real(-1.0), Real(1.0));
        return select(from > zero, Real(1.0), select(from < zero, Real(-1.0), goes));
    }
    SLIDEWAY_FN static TurnedOver<Real> over(Member const& s, Attempt<Model, Real> const& attempt) {
        Real const side = side_of(s, attempt.end), start = s.constants.start_angle, of_step = side * attempt.step;
        return {side * (s.course.y[angle] - start), of_step * s.course.rates[angle], side * (attempt.end[angle] - start), of_step * attempt.end_rates[angle]};
    }

    bool at_samples_ = false;
    Real stop_, level_;   // the next stop, and what the attempt may go to [rad]
    Mask<Real> reached_;  // lanes whose attempt has come there
};

}  // namespace slideway::inline SLIDEWAY_ISA
