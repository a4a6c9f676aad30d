#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Impulses of all pairs that meet at once (M13.11): Λ ≥ 0 ⊥ γ⁺ + e γ⁻ ≥ 0, of the pairs that come nearer, with Coulomb friction |Λ_t| ≤ μ Λ against
/// the slip that is left.  By projected Gauss–Seidel steps, as many as a lane's own numbers ask for.
template <class Guide, class Real> class JointImpact {
public:
    using Pairs = JointPairs<Guide, Real>;
    static constexpr int most_sweeps = 1000, sweeps_to_leap = 32;
    static constexpr double settled = 1e-14;  // of the speeds, and what counts as no change of them

    Real normal[pair_count], along[2][pair_count];  // impulses [N s]
    Twist<Real> before, after;                      // velocity of the slider
    Mask<Real> failed;

    SLIDEWAY_HD JointImpact(Pairs const& pairs, Twist<Real> const& velocity, Mask<Real> const (&near)[pair_count]) : before(velocity) {
        Real const zero(0.0);
        size_ = rounding_ = zero;
        for (int i = 0; i < pair_count; ++i) {
            normal[i] = along[0][i] = along[1][i] = zero;
            if (none(near[i])) continue;
            auto& row = rows_[count_++];
            row.number = i;
            row.near = near[i];
            row.pair = pairs.pair(i);
            auto const& pair = row.pair;
            row.own = dot(pair.normal, pair.pushed);
            Real const first = dot(pair.slip[0], pair.dragged[0]), second = dot(pair.slip[1], pair.dragged[1]);
            row.across = max(first, second) + abs(dot(pair.slip[0], pair.dragged[1]));
            size_ = max(size_, select(near[i], abs(dot(pair.normal, velocity)), zero));
            Real const slip = abs(dot(pair.slip[0], velocity)) + abs(dot(pair.slip[1], velocity));
            rounding_ = max(rounding_, select(near[i], Real(2.220446049250313e-16) * slip, zero));
        }
    }

    /// @param restitution of each pair  @param coefficient μ, or nullptr without friction  @return energy that it makes [J], ≤ 0 but for rounding
    SLIDEWAY_HD Real solve(Mask<Real> in, Real const (&restitution)[pair_count], Real const* coefficient) {
        Real const zero(0.0);
        after = before;
        for (int k = 0; k < count_; ++k) {
            int const i = rows_[k].number;
            normal[i] = along[0][i] = along[1][i] = zero;
        }
        auto active = in & (size_ > zero);
        Real const enough = max(Real(settled) * size_, rounding_);
        failed = mask_of<Real>(false);
        for (int sweep = 0; sweep < most_sweeps && any(active); ++sweep) {
            Real change = zero, steps[pair_count];
            auto const start = after;
            for (int k = 0; k < count_; ++k) {
                auto const& row = rows_[k];
                auto const& pair = row.pair;
                int const i = row.number;
                auto const here = active & row.near;
                Real const target = negated(restitution[i]) * min(dot(pair.normal, before), zero);
                Real const wish = (target - dot(pair.normal, after)) / row.own;
                Real const step = select(here, max(wish, negated(normal[i])), zero);
                steps[k] = step;
                normal[i] = normal[i] + step;
                after = fma(step, pair.pushed, after);
                change = max(change, abs(step) * row.own);
                if (coefficient != nullptr) change = max(change, slide(row, here, *coefficient));
            }
            active = active & (change > enough);
            if (sweep % sweeps_to_leap == sweeps_to_leap - 1) leap(active & (change > Real(1e2) * moved(after - start)), steps);
            if (sweep + 1 == most_sweeps) failed = active & (change > Real(1e-8) * size_);
        }
        return energy_made();
    }

    /// Takes from pairs that rest what is left of their normal velocity, next to nothing, whichever way it goes.
    SLIDEWAY_HD void rest(Mask<Real> in, Mask<Real> const (&rests)[pair_count]) {
        Real const zero(0.0);
        Real size = zero;
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            size = max(size, select(rests[row.number], abs(dot(row.pair.normal, after)), zero));
        }
        auto active = in & (size > zero);
        for (int sweep = 0; sweep < most_sweeps && any(active); ++sweep) {
            Real change = zero;
            for (int k = 0; k < count_; ++k) {
                auto const& row = rows_[k];
                Real const rate = dot(row.pair.normal, after);
                Real const step = select(active & rests[row.number], negated(rate) / row.own, zero);
                normal[row.number] = normal[row.number] + step;
                after = fma(step, row.pair.pushed, after);
                change = max(change, abs(step) * row.own);
            }
            active = active & (change > Real(1e-10) * size);
        }
    }

    /// Takes as much from the impulses as it needs for them to make no energy: the largest κ ≤ 1 of Λ₀ + κ (Λ − Λ₀), Λ₀ being those without restitution
    /// (M13.7).
    SLIDEWAY_HD void limit_energy(Pairs const& pairs, Mask<Real> in, Real const* coefficient) {
        Real const zero(0.0), one(1.0);
        Real whole[3][pair_count], no_restitution[pair_count];
        for (int i = 0; i < pair_count; ++i) {
            whole[0][i] = normal[i], whole[1][i] = along[0][i], whole[2][i] = along[1][i];
            no_restitution[i] = zero;
        }
        auto const full = after;
        auto const had_failed = failed;
        solve(in, no_restitution, coefficient);
        failed = (failed & in) | had_failed;
        // E(κ) = a κ² + b κ + c of the impulses P₀ + κ ΔP: a = ½ Δu·ΔP, b = u₀·ΔP, c = E(0), u₀ the velocity after P₀.
        auto const dead = impulse();
        auto const stopped = after;
        auto more = Twist<Real>::zero();
        auto const exceeding = [&](int j, int i, Real least) { return Real(whole[j][i] - least); };
        for (int k = 0; k < count_; ++k) {
            auto const& pair = rows_[k].pair;
            int const i = rows_[k].number;
            more = fma(exceeding(0, i, normal[i]), pair.normal, more);
            more = fma(exceeding(1, i, along[0][i]), pair.slip[0], fma(exceeding(2, i, along[1][i]), pair.slip[1], more));
        }
        Real const a = Real(0.5) * dot(full - stopped, more), b = dot(stopped, more), c = min(energy_made(), zero);
        Real const root = sqrt(max(fnma(Real(4.0) * a, c, b * b), zero));
        auto const curved = a > zero;
        Real const share = select(curved, (root - b) / select(curved, a + a, one), zero);
        Real const kept = min(max(share, zero), one);
        for (int i = 0; i < pair_count; ++i) {
            auto const mix = [&](int j, Real& least) { least = select(in, fma(kept, exceeding(j, i, least), least), whole[j][i]); };
            mix(0, normal[i]), mix(1, along[0][i]), mix(2, along[1][i]);
        }
        after = select(in, before + pairs.response(fma(kept, more, dead)), full);
    }

    /// Of all pairs on the slider.
    SLIDEWAY_HD Twist<Real> impulse() const {
        auto sum = Twist<Real>::zero();
        for (int k = 0; k < count_; ++k) {
            auto const& pair = rows_[k].pair;
            int const i = rows_[k].number;
            sum = fma(normal[i], pair.normal, fma(along[0][i], pair.slip[0], fma(along[1][i], pair.slip[1], sum)));
        }
        return sum;
    }

    /// ½ (u⁻ + u⁺) · P [J], and the size of what is moved.
    SLIDEWAY_HD Real energy_made() const { return Real(0.5) * dot(before + after, impulse()); }
    SLIDEWAY_HD Real energy_moved() const {
        Real sum(0.0);
        for (int k = 0; k < count_; ++k) sum = fma(abs(dot(rows_[k].pair.normal, before)), normal[rows_[k].number], sum);
        return sum;
    }

    /// What friction takes, what restitution takes [J], and the sum of the normal impulses [N s].
    struct Taken { Real friction, damping, impulse; };
    SLIDEWAY_HD Taken taken() const {
        Real const zero(0.0), half(0.5);
        Taken t{zero, zero, zero};
        auto const mean = half * (before + after);
        for (int k = 0; k < count_; ++k) {
            auto const& pair = rows_[k].pair;
            int const i = rows_[k].number;
            t.damping = fnma(dot(pair.normal, mean), normal[i], t.damping);
            t.friction = fnma(dot(pair.slip[0], mean), along[0][i], fnma(dot(pair.slip[1], mean), along[1][i], t.friction));
            t.impulse = t.impulse + normal[i];
        }
        return t;
    }

    /// γ of a pair under a velocity; only of those that are near in some lane.
    template <class Function> SLIDEWAY_HD void each(Function const& see) const {
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            see(row.number, Real(dot(row.pair.normal, before)), Real(dot(row.pair.normal, after)));
        }
    }

private:
    /// The largest of the normal velocities that a change of the velocity comes to.
    SLIDEWAY_HD Real moved(Twist<Real> const& change) const {
        Real most(0.0);
        for (int k = 0; k < count_; ++k) most = max(most, select(rows_[k].near, abs(dot(rows_[k].pair.normal, change)), Real(0.0)));
        return most;
    }

    /// Four apices on one face leave open which of them carries what, and where their speeds do not belong to one plane the sweeps shift the load from apex to
    /// apex by equal steps until one of them bears nothing: it gets there at once.
    SLIDEWAY_HD void leap(Mask<Real> in, Real const (&steps)[pair_count]) {
        Real const zero(0.0), one(1.0), never(1e9);
        Real length = never;
        for (int k = 0; k < count_; ++k) {
            auto const falls = steps[k] < zero;
            length = min(length, select(falls, normal[rows_[k].number] / select(falls, negated(steps[k]), one), never));
        }
        length = select(in & (length < never), length, zero);
        for (int k = 0; k < count_; ++k) {
            Real& load = normal[rows_[k].number];
            Real const more = max(length * steps[k], negated(load));
            load = load + more;
            after = fma(more, rows_[k].pair.pushed, after);
        }
    }

    struct Row {
        int number;
        Mask<Real> near;
        JointPair<Real> pair;
        Real own, across;  // velocity for a unit impulse along itself; at most, of the slip
    };

    /// A step of the friction of one pair.  @return its largest change of a velocity
    SLIDEWAY_HD Real slide(Row const& row, Mask<Real> here, Real coefficient) {
        Real const zero(0.0), one(1.0);
        auto const& pair = row.pair;
        int const i = row.number;
        Real const first = along[0][i] - dot(pair.slip[0], after) / row.across;
        Real const second = along[1][i] - dot(pair.slip[1], after) / row.across;
        Real const bound = coefficient * normal[i], length = sqrt(fma(first, first, second * second));
        auto const outside = length > bound;
        Real const share = select(outside, bound / select(outside, length, one), one);
        Real const change[2] = {select(here, fms(share, first, along[0][i]), zero), select(here, fms(share, second, along[1][i]), zero)};
        for (int j = 0; j < 2; ++j) {
            along[j][i] = along[j][i] + change[j];
            after = fma(change[j], pair.dragged[j], after);
        }
        return max(abs(change[0]), abs(change[1])) * row.across;
    }

    Row rows_[pair_count];
    int count_ = 0;
    Real size_, rounding_;  // of the normal velocities before, and of what is no change of any [m/s]
};

}  // namespace slideway::inline SLIDEWAY_ISA
