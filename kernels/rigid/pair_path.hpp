#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_motion.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of pairs by Newton's method for (M13.11) with normals as of PairNewton and smooth friction,
///   T = −μ Λ v/√(|v|² + ε²),                                                                                              (M13.14)
/// followed from an ε above all slips, where friction is next to linear, to one that is rounding, in ever finer steps until it arrives.  An
/// apex that wedges in an edge between two faces has loads a thousand times those that stop its approach, and a slip that they have all but
/// ended: no step from pair to pair and none of Newton's from nothing finds these.
template <class Guide, class Real> class PairPath : PairMotion<Guide, Real> {
    using Base = PairMotion<Guide, Real>;
    using Base::count_, Base::course_, Base::friction_, Base::rows_;
    using typename Base::Local;

public:
    static constexpr double first = 8, last = 1e-12;                  // ε, of the largest slip
    static constexpr double shares[] = {0.5, 0.7, 0.84, 0.92, 0.96};  // of the ε before, attempt by attempt
    static constexpr int most_steps = 12, last_turns = 3;             // for one ε; of multipliers at its end
    static constexpr double settled = 1e-9, rounding = 1e-14;  // of ε, of the largest slip: a change that is none

    using Base::Base;

    /// @param size of the motion  @param enough how far from (M13.11) it may be  @param after the motion, changed in lanes that are solved, as their
    /// loads are  @return lanes that are not
    SLIDEWAY_HD Mask<Real> solve(Mask<Real> in, Real size, Real enough, Twist<Real>& after) {
        begin(size);
        Real kept[3][pair_count];
        for (int k = 0; k < count_; ++k)
            kept[0][k] = rows_[k].normal, kept[1][k] = rows_[k].along[0], kept[2][k] = rows_[k].along[1];
        auto const put = [&](Mask<Real> lanes, int k, Real normal, Real first_along, Real second_along) {
            rows_[k].normal = select(lanes, normal, rows_[k].normal);
            rows_[k].along[0] = select(lanes, first_along, rows_[k].along[0]);
            rows_[k].along[1] = select(lanes, second_along, rows_[k].along[1]);
        };
        Real const zero(0.0);
        auto left = in;
        for (double const share : shares) {
            for (int k = 0; k < count_; ++k) put(in, k, zero, zero, zero);
            go_along(in, share);
            auto const motion = this->moved();
            Real const missed = this->measure(in, motion), whole = dot(motion, motion);
            // Of numbers that are none the largest may be one.
            auto const solved = in & (missed <= enough) & (whole - whole == zero);
            after = slideway::select(solved, motion, after);
            left = left & !solved;
            in = left & holds_;
            if (none(in)) break;
        }
        for (int k = 0; k < count_; ++k) put(left, k, kept[0][k], kept[1][k], kept[2][k]);
        return left;
    }

private:
    SLIDEWAY_HD void begin(Real size) {
        Real const zero(0.0);
        Real const own = this->largest_own([&](int k) { return rows_[k].here; });
        auto const some = own > zero;
        stiff_ = select(some, Real(Base::stiffness) / select(some, own, Real(1.0)), zero);
        reach_ = size;
        holds_ = mask_of<Real>(false);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const holds = row.here & (row.coefficient > zero);
            holds_ = holds_ | holds;
            for (int j = 0; j < 2; ++j) {
                reach_ = max(reach_, select(holds, abs(dot(row.pair.slip[j], this->before_) - row.hold[j]), zero));
            }
        }
    }

    SLIDEWAY_HD void go_along(Mask<Real> in, double share) {
        for (int k = 0; k < count_; ++k) normal_[k] = Real(0.0);
        auto const holds = in & holds_;
        for (double length = first; length > last && any(holds); length *= share) settle(holds, Real(length) * reach_);
        for (int turn = 0; turn < last_turns; ++turn) {
            settle(in, Real(last) * reach_);
            for (int k = 0; k < count_; ++k) normal_[k] = rows_[k].normal;
        }
    }

    /// Loads for one ε.
    SLIDEWAY_HD void settle(Mask<Real> in, Real smooth) {
        Real const none_left = max(Real(settled) * smooth, Real(rounding) * reach_);
        for (int step = 0; step < most_steps && any(in); ++step) {
            this->measure(in, this->moved());
            for (int k = 0; k < count_; ++k) local_[k] = local(k, smooth);
            this->factor(local_);
            this->step(local_);
            Real change(0.0);
            for (int k = 0; k < count_; ++k) change = max(change, go(in, k));
            in = in & (change > none_left);
        }
    }

    SLIDEWAY_HD Local local(int k, Real smooth) const {
        Real const zero(0.0), one(1.0);
        auto const& row = rows_[k];
        auto const& c = course_[k];
        Local l;
        Real const spring = fma(stiff_, row.target - c.rate, normal_[k]);
        auto const pushes = row.here & (spring > zero);
        l.k = select(pushes, stiff_, zero);
        l.c_n = select(pushes, spring - row.normal, select(row.here, negated(row.normal), zero));
        if (!friction_) return l;
        Real const square = fma(c.v[0], c.v[0], fma(c.v[1], c.v[1], smooth * smooth));
        Real const inverse_speed = select(row.here, one / sqrt(select(row.here, square, one)), zero);
        Real const drag = row.coefficient * inverse_speed, damping = drag * row.normal,
                   turn = damping * (inverse_speed * inverse_speed);
        for (int i = 0; i < 2; ++i) {
            l.h[i] = negated(drag) * c.v[i];
            l.c_t[i] = select(row.here, fms(l.h[i], row.normal, row.along[i]), zero);
            for (int j = 0; j < 2; ++j) l.K[i][j] = fnma(turn * c.v[i], c.v[j], i == j ? damping : zero);
        }
        return l;
    }

    /// @return the largest change of a motion
    SLIDEWAY_HD Real go(Mask<Real> in, int k) {
        auto& row = rows_[k];
        auto const here = in & row.here;
        Real const push = select(here, Base::push(local_[k], course_[k]), Real(0.0));
        row.normal = row.normal + push;
        Real change = abs(push) * row.own;
        if (!friction_) return change;
        for (int i = 0; i < 2; ++i) {
            Real const drag = select(here, Base::drag(local_[k], course_[k], push, i), Real(0.0));
            row.along[i] = row.along[i] + drag;
            change = max(change, abs(drag) * row.across);
        }
        return change;
    }

    Real stiff_, reach_;
    Mask<Real> holds_;         // lanes with friction to find: no other may depend on whether its neighbours have
    Real normal_[pair_count];  // Λ⁰
    Local local_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
