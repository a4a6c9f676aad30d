#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/touching_pair.hpp"
#include "kernels/rigid/twist.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Loads of pairs that all push and of which none sticks: γ = target of each is one linear system, W Λ = target − γ₀ with W_ij what a unit load of
/// pair j makes of γ_i.  Where all four apices of a face push, their loads are those of equal springs (M13.13): these vary linearly over the
/// face, λ_a − λ_b + λ_c − λ_d = 0, which takes the place of the fourth equation, for that follows from the other three.
template <class Real> class DirectLoads {
public:
    /// @param rows `count` pairs in the order of their numbers
    SLIDEWAY_HD DirectLoads(TouchingPair<Real>* rows, int count, Twist<Real> const& before) : rows_(rows), count_(count), before_(before) {}

    /// @param after the motion, changed in lanes that are solved; so are the loads of the rows  @return lanes that are not
    SLIDEWAY_NOINLINE Mask<Real> solve(Mask<Real> in, LoadGoal<Real> const& goal, Twist<Real>& after) {
        Real const zero(0.0);
        auto sound = in & suits();
        if (none(sound)) return in;
        fill();
        sound = sound & factor();
        for (int k = 0; k < count_; ++k) load_[k] = zero;
        auto motion = before_;
        // Once more with what rounding has left.
        for (int turn = 0; turn < 2; ++turn) {
            for (int k = 0; k < count_; ++k) change_[k] = lack(k, motion);
            substitute();
            motion = before_;
            for (int k = 0; k < count_; ++k) {
                load_[k] = load_[k] + change_[k];
                motion = fma(load_[k], rows_[k].pushed, motion);
            }
        }
        Real const bearable = bearable_under<Real>(rows_, count_, [&](int k) { return load_[k]; }, goal);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const right = (load_[k] >= zero) & (abs(row.target - dot(row.pair.normal, motion)) <= bearable);
            sound = sound & (right | !row.here);
        }
        for (int k = 0; k < count_; ++k) {
            rows_[k].normal = select(sound, load_[k], rows_[k].normal);
            for (Real& along : rows_[k].along) along = select(sound, zero, along);
        }
        after = select(sound, motion, after);
        return in & !sound;
    }

private:
    static constexpr double most_pairs = 6;        // of a member: the free velocities
    static constexpr double least_pivot = 1e-9;    // of what a load makes of its own pair's motion: below it pairs are next to dependent

    SLIDEWAY_HD Mask<Real> suits() const {
        Real pairs(0.0);
        auto sticks = mask_of<Real>(false);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            pairs = pairs + slideway::count<Real>(row.here);
            sticks = sticks | (row.here & (row.coefficient > Real(0.0)));
        }
        return (pairs <= Real(most_pairs)) & !sticks;
    }

    /// Loads that are not asked for are 0.
    SLIDEWAY_HD void fill() {
        Real const zero(0.0), one(1.0);
        for (int i = 0; i < count_; ++i) {
            fourth_[i] = ends_whole_face(rows_, i);
            for (int j = 0; j < count_; ++j) {
                auto const both = rows_[i].here & rows_[j].here;
                w_[i][j] = select(both, dot(rows_[i].pair.normal, rows_[j].pushed), i == j ? one : zero);
            }
        }
        for (int i = 3; i < count_; ++i) {
            if (none(fourth_[i])) continue;
            for (int j = 0; j < count_; ++j) {
                Real const sign(j < i - 3 || j > i ? 0.0 : (j - i) % 2 == 0 ? -1.0 : 1.0);
                w_[i][j] = select(fourth_[i], sign, w_[i][j]);
            }
        }
    }

    /// LU factors without pivoting, reciprocals of the pivots on the diagonal.  @return lanes whose pivots keep away from zero
    SLIDEWAY_HD Mask<Real> factor() {
        auto sound = mask_of<Real>(true);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            Real const pivot = w_[k][k];
            sound = sound & ((!row.here) | fourth_[k] | (pivot >= Real(least_pivot) * dot(row.pair.normal, row.pair.pushed)));
            Real const inverse = Real(1.0) / pivot;
            w_[k][k] = inverse;
            for (int i = k + 1; i < count_; ++i) {
                Real const factor = w_[i][k] * inverse;
                w_[i][k] = factor;
                for (int j = k + 1; j < count_; ++j) w_[i][j] = fnma(factor, w_[k][j], w_[i][j]);
            }
        }
        return sound;
    }

    /// What the loads do not yet give.
    SLIDEWAY_HD Real lack(int k, Twist<Real> const& motion) const {
        auto const& row = rows_[k];
        Real const rate = row.target - dot(row.pair.normal, motion);
        Real missing = select(row.here, rate, Real(0.0));
        if (any(fourth_[k])) missing = select(fourth_[k], (load_[k] - load_[k - 1]) + (load_[k - 2] - load_[k - 3]), missing);
        return missing;
    }

    SLIDEWAY_HD void substitute() {
        for (int i = 1; i < count_; ++i) {
            for (int j = 0; j < i; ++j) change_[i] = fnma(w_[i][j], change_[j], change_[i]);
        }
        for (int i = count_ - 1; i >= 0; --i) {
            for (int j = i + 1; j < count_; ++j) change_[i] = fnma(w_[i][j], change_[j], change_[i]);
            change_[i] = change_[i] * w_[i][i];
        }
    }

    TouchingPair<Real>* const rows_;
    int const count_;
    Twist<Real> const before_;
    Mask<Real> fourth_[pair_count];  // lanes in which a row stands for the share of its face
    Real w_[pair_count][pair_count];
    Real load_[pair_count], change_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
