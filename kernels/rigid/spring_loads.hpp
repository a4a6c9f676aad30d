#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_motion.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of pairs as of equal, very stiff springs, whose compliance ε is then made up for:
///   Λ = max(0, Λ⁰ + (target − γ)/ε),   T = the part within μ Λ of T⁰ − (v − hold)/ε,                                        (M13.13)
/// first with Λ⁰ = T⁰ = 0 (but for Start::multipliers), then with what that gave, until (M13.11) holds (the method of multipliers).  Each is solved by
/// Newton's method with the pairs that push and stick as found so far.  Where (M13.11) leaves open which pair carries what, this is the share of equal
/// springs under a rigid slider.
template <class Real> class SpringLoads : PairMotion<Real> {
    using Base = PairMotion<Real>;
    using typename Base::Local;
    using Base::count_, Base::course_, Base::friction_, Base::rows_;

public:
    /// What the search begins with: the pairs that push by the loads of the rows; all of them, sticking where they can; or these loads as Λ⁰ and T⁰.
    enum class Start { loads, all, multipliers };
    static constexpr double hindered = 1e-11;  // of the motion: what may be missed where no step makes it less
    static constexpr double unchanged = 1e-5;  // of the motion: Λ is that of its springs

    using Base::Base;

    /// @param after the motion, changed in lanes that are solved  @return lanes that are not, whose loads are the nearest that were found
    SLIDEWAY_NOINLINE Mask<Real> solve(Mask<Real> in, Start start, int turns, LoadGoal<Real> const& goal, Twist<Real>& after) {
        begin(start);
        Real nearest[3][pair_count] = {};
        this->keep_loads(nearest);
        Real last(1e300), best(1e300);
        auto const all = in;
        auto found = mask_of<Real>(false);
        for (int turn = 0; turn <= turns; ++turn) {
            Real const missed = this->measure(in, this->moved());
            Real const borne = bearable_under<Real>(rows_, count_, [&](int k) { return rows_[k].normal; }, goal);
            // The loads at the start are never good enough: what they leave would add up over steps.
            auto const better = in & mask_of<Real>(turn > 0) & (missed < best);
            if (any(better)) this->keep_loads(nearest, better);
            best = select(better, missed, best);
            found = found | (better & (missed <= borne));
            // From within rounding of the loads a step may lead away from them again; where pairs hinder each other but for rounding none leads nearer.
            auto const stalls = in & (missed > Real(0.5) * last);
            found = found | (stalls & (best <= Real(hindered) * goal.size));
            in = in & !(found & (stalls | (best <= goal.enough)));
            last = missed;
            if (none(in)) break;
            Real const off = look(turn == 0, start == Start::all);
            take_multipliers(in & (off <= Real(unchanged) * goal.size));
            // Without friction to find, the equations change with the pairs that push alone.
            if (friction_ || any(in & changed_)) this->factor(local_);
            this->step(local_);
            for (int k = 0; k < count_; ++k) this->add_step(in, k, local_[k], Real(1.0));
        }
        this->put_loads(all, nearest);
        after = slideway::select(found, this->moved(), after);
        return all & !found;
    }

private:
    SLIDEWAY_HD void begin(Start start) {
        Real const zero(0.0);
        bool const given = start == Start::multipliers;
        for (int k = 0; k < count_; ++k) {
            normal_[k] = given ? rows_[k].normal : zero;
            for (int j = 0; j < 2; ++j) along_[j][k] = given ? rows_[k].along[j] : zero;
        }
        Real const own = this->largest_own([&](int k) { return rows_[k].here; });
        auto const some = own > zero;
        stiff_ = select(some, Real(Base::stiffness) / select(some, own, Real(1.0)), zero);
    }

    /// The linear equations of all pairs.  @return the largest change of a motion that the laws ask for at once
    SLIDEWAY_HD Real look(bool first, bool all) {
        Real const zero(0.0);
        Real off = zero;
        changed_ = mask_of<Real>(first);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const& c = course_[k];
            auto& l = local_[k];
            Real const spring = fma(stiff_, row.target - c.rate, normal_[k]);
            auto const pushes = row.here & (mask_of<Real>(first && all) | ((first ? row.normal : spring) > zero));
            Real const stiff = select(pushes, stiff_, zero);
            if (!first) changed_ = changed_ | (stiff != l.k);
            l.k = stiff;
            l.c_n = select(pushes, spring - row.normal, select(row.here, negated(row.normal), zero));
            off = max(off, select(row.here, abs(l.c_n) * row.own, zero));
            if (friction_) off = max(off, look_along(k, pushes, first && all));
        }
        return off;
    }

    /// Of friction, as Alart & Curnier 1991: what T − (v − hold)/own tells sticks, or slips that way.
    SLIDEWAY_HD Real look_along(int k, Mask<Real> pushes, bool all_stick) {
        Real const zero(0.0), one(1.0);
        auto const& row = rows_[k];
        auto const& c = course_[k];
        auto& l = local_[k];
        Real pull[2], spring[2];
        for (int j = 0; j < 2; ++j) {
            pull[j] = fnma(row.per_across, c.v[j], row.along[j]);
            spring[j] = fnma(stiff_, c.v[j], along_[j][k]) - row.along[j];
        }
        Real const bound = row.coefficient * max(row.normal, zero), length = sqrt(fma(pull[0], pull[0], pull[1] * pull[1]));
        auto const holds = pushes & (row.coefficient > zero);
        auto const sticks = holds & ((length <= bound) | mask_of<Real>(all_stick)), slips = holds & !sticks;
        Real const inverse = select(slips, one / select(slips, length, one), zero), share = bound * inverse;
        Real const rest = one / max(one - share, Real(1.0 / Base::stiffness)), damping = share * rest * row.per_across;
        Real const unit[2] = {pull[0] * inverse, pull[1] * inverse};
        Real const lies = fma(row.along[0], unit[0], row.along[1] * unit[1]);
        for (int i = 0; i < 2; ++i) {
            l.h[i] = row.coefficient * unit[i];
            Real const turn = rest * fnma(lies, unit[i], row.along[i]), wanted = fms(bound - lies, unit[i], turn);
            l.c_t[i] = select(sticks, spring[i], select(slips, wanted, select(row.here, negated(row.along[i]), zero)));
            for (int j = 0; j < 2; ++j) {
                Real const across = i == j ? fnma(unit[i], unit[j], one) : negated(unit[i] * unit[j]);
                l.K[i][j] = select(sticks, i == j ? stiff_ : zero, select(slips, damping * across, zero));
            }
        }
        return select(row.here, max(abs(l.c_t[0]), abs(l.c_t[1])) * row.across, zero);
    }

    /// From here on Λ⁰ and T⁰ are the loads of the moment, and their springs are as they are.
    SLIDEWAY_HD void take_multipliers(Mask<Real> in) {
        if (none(in)) return;
        Real const zero(0.0);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const& c = course_[k];
            auto& l = local_[k];
            auto const pushes = in & (l.k > zero);
            normal_[k] = select(pushes, row.normal, normal_[k]);
            l.c_n = select(pushes, stiff_ * (row.target - c.rate), l.c_n);
            if (!friction_) continue;
            // What slips has its direction from its slip alone, and has to be linearised anew.
            auto const sticks = pushes & (l.h[0] == zero) & (l.h[1] == zero) & (row.coefficient > zero);
            for (int j = 0; j < 2; ++j) {
                along_[j][k] = select(sticks, row.along[j], along_[j][k]);
                l.c_t[j] = select(sticks, negated(stiff_ * c.v[j]), l.c_t[j]);
            }
        }
    }

    Real stiff_;
    Mask<Real> changed_;
    Real normal_[pair_count], along_[2][pair_count];  // Λ⁰, T⁰
    Local local_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
