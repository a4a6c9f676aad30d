#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_motion.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Takes from pairs that rest what is left of their normal motion, with the friction of the bounces that would have done so, and from those that are
/// still what is left of their slip: equations, whatever the sign of their loads, which are those of (M13.13).  A slip that the drive has in hand stays: the
/// loads against it are next to nothing.  Loads that pull, or turn a slip round, have friction that drives, and equations of several pairs with friction may have
/// next to no inverse: where all loads together would make energy, or slips run away, it is done without the friction.
template <class Real> class PairRest : PairMotion<Real> {
    using Base = PairMotion<Real>;
    using typename Base::Local;
    using Base::count_, Base::course_, Base::rows_;

public:
    static constexpr int turns = 3;  // what a spring leaves, 1e-7 of it, is left to the next turn
    static constexpr double stiffness_along = 100;
    static constexpr double most = 1e3;       // of a slip's change, in units of the motion that is to be taken away
    static constexpr double rounding = 1e-9;  // of a slip
    static constexpr double no_work = 1e-13;  // of what the loads do, and of the slips' energy

    using Base::Base;

    /// @param coefficient μ, or nullptr without friction  @param after the motion so far  @return the motion then
    SLIDEWAY_HD Twist<Real> solve(Mask<Real> in, Mask<Real> const (&rests)[pair_count], Mask<Real> const (&still)[pair_count],
                                  Real const* coefficient, Twist<Real> const& after) {
        Real const zero(0.0), one(1.0);
        Real const own = this->largest_own([&](int k) { return rows_[k].here & rests[rows_[k].number]; });
        in = in & (own > zero);
        if (none(in)) return after;
        Real const per_own = one / select(in, own, one), stiff = Real(Base::stiffness) * per_own, stiff_along = Real(stiffness_along) * per_own;
        Mask<Real> rest[pair_count], stays[pair_count];
        for (int k = 0; k < count_; ++k) {
            rest[k] = in & rows_[k].here & rests[rows_[k].number];
            stays[k] = rest[k] & still[rows_[k].number];
            local_[k] = spring(stiff, stiff_along, rest[k], stays[k], coefficient != nullptr);
            if (coefficient != nullptr) find_drag(rest[k] & !stays[k], *coefficient, after, rows_[k], local_[k]);
        }
        Real kept[3][pair_count] = {};
        this->keep_loads(kept);
        auto motion = stop(rest, stays, stiff, stiff_along, coefficient != nullptr, after);
        if (coefficient == nullptr) return select(in, motion, after);
        auto const wild = in & (makes_energy(motion) | runs_away(rest, stays, after, motion));
        if (any(wild)) {
            this->put_loads(wild, kept);
            for (int k = 0; k < count_; ++k) {
                rest[k] = rest[k] & wild;
                for (auto& drag : local_[k].h) drag = zero;
            }
            motion = slideway::select(wild, stop(rest, stays, stiff, stiff_along, true, after), motion);
        }
        return select(in, motion, after);
    }

private:
    /// With the springs of the moment.  @return the motion then
    SLIDEWAY_HD Twist<Real> stop(Mask<Real> const (&rest)[pair_count], Mask<Real> const (&stays)[pair_count], Real stiff, Real stiff_along, bool friction,
                                 Twist<Real> motion) {
        Real const zero(0.0);
        this->factor(local_);
        for (int turn = 0; turn < turns; ++turn) {
            for (int k = 0; k < count_; ++k) {
                auto const& pair = rows_[k].pair;
                local_[k].c_n = select(rest[k], negated(stiff * dot(pair.normal, motion)), zero);
                if (!friction) continue;
                for (int j = 0; j < 2; ++j) local_[k].c_t[j] = select(stays[k], negated(stiff_along * dot(pair.slip[j], motion)), zero);
            }
            this->step(local_);
            for (int k = 0; k < count_; ++k) this->add_step(rest[k], k, local_[k], Real(1.0));
            motion = this->moved();
        }
        return motion;
    }

    /// Whether all loads together make energy, ½ (u⁻ + u⁺) · P, when the motion has become `motion`.
    SLIDEWAY_HD Mask<Real> makes_energy(Twist<Real> const& motion) const {
        Real const zero(0.0);
        auto const twice = this->before_ + motion;
        Real made = zero, moved = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            Real const work = dot(twice, row.load());
            made = made + work;
            moved = moved + abs(work);
            // What rounding leaves of a rate is no reason: loads against it work on the slip.
            Real const slip[2] = {dot(row.pair.slip[0], twice), dot(row.pair.slip[1], twice)};
            moved = fma(fma(slip[0], slip[0], slip[1] * slip[1]), row.per_across, moved);
        }
        return !(made <= Real(no_work) * moved);
    }

    /// Whether slips change by far more than there was to take away.
    SLIDEWAY_HD Mask<Real> runs_away(Mask<Real> const (&rest)[pair_count], Mask<Real> const (&stays)[pair_count], Twist<Real> const& from,
                                     Twist<Real> const& to) const {
        Real const zero(0.0);
        auto const by = to - from;
        Real taken = zero, change = zero, speed = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& pair = rows_[k].pair;
            taken = max(taken, select(rest[k], abs(dot(pair.normal, from)), zero));
            for (auto const& along : pair.slip) {
                taken = max(taken, select(stays[k], abs(dot(along, from)), zero));
                change = max(change, select(rest[k], abs(dot(along, by)), zero));
                speed = max(speed, select(rest[k], abs(dot(along, from)), zero));
            }
        }
        return !(change <= max(Real(most) * taken, Real(rounding) * speed));
    }

    SLIDEWAY_FN static Local spring(Real stiff, Real stiff_along, Mask<Real> rests, Mask<Real> stays, bool friction) {
        Real const zero(0.0);
        Local l;
        l.k = select(rests, stiff, zero);
        if (!friction) return l;
        for (int i = 0; i < 2; ++i) {
            l.h[i] = zero;
            for (int j = 0; j < 2; ++j) l.K[i][j] = i == j ? select(stays, stiff_along, zero) : zero;
        }
        return l;
    }

    /// Friction per unit load of a pair that slips; none where it outweighs the push.
    SLIDEWAY_HD static void find_drag(Mask<Real> slips, Real coefficient, Twist<Real> const& after, TouchingPair<Real> const& row, Local& l) {
        Real const zero(0.0), one(1.0);
        Real const slip[2] = {dot(row.pair.slip[0], after), dot(row.pair.slip[1], after)};
        Real const square = fma(slip[0], slip[0], slip[1] * slip[1]);
        auto const moves = slips & (square > zero);
        Real const share = select(moves, negated(coefficient) / sqrt(select(moves, square, one)), zero);
        Real const by_friction = share * fma(slip[0], dot(row.pair.normal, row.pair.dragged[0]), slip[1] * dot(row.pair.normal, row.pair.dragged[1]));
        Real const own = dot(row.pair.normal, row.pair.pushed);
        auto const tame = own + by_friction > Real(0.1) * own;
        for (int i = 0; i < 2; ++i) l.h[i] = select(tame, share * slip[i], zero);
    }

    Local local_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
