#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/pair_solver.hpp"
#include "kernels/rigid/rigid_memory.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Impulses of all pairs that meet at once: (M13.11) with Newton's restitution γ⁺ ≥ −e γ⁻ of those that come nearer, and Coulomb friction
/// against the slip that is left.
template <class Real> class JointImpact {
public:
    using Pairs = JointPairs<Real>;
    static constexpr double settled = 1e-15;  // of the speeds: what counts as no change of them
    static constexpr double bearable = 1e-13;
    static constexpr double resolved = 0.1;   // of the least speed

    PairSolver<Real> pairs;  // `before` and `after` are velocities, `normal` and `along` impulses

    /// @param coefficient μ, or nullptr without friction  @param least_speed of a pair that is not at rest [m/s]
    /// @param arrival velocity at which pairs come nearer, if it is another than impulses change
    SLIDEWAY_HD JointImpact(Pairs const& all, Twist<Real> const& velocity, Mask<Real> const (&near)[pair_count], Real const* coefficient,
                            Real least_speed, Twist<Real> const* arrival = nullptr)
        : pairs(all, velocity), all_(all), arrival_(arrival != nullptr ? *arrival : velocity), friction_(coefficient != nullptr) {
        Real const zero(0.0), rounding(2.220446049250313e-16);
        Real size = zero, slip = zero;
        for (int i = 0; i < pair_count; ++i) {
            if (none(near[i])) continue;
            auto& row = pairs.add(i);
            all.put_pair(i, row.pair);
            row.start(near[i], friction_ ? *coefficient : zero);
            row.weigh(dot(row.pair.normal, row.pushed));
            if (friction_) row.weigh_along();
            size = max(size, select(near[i], abs(approach(row)), zero));
            Real const slides = abs(dot(row.pair.slip[0], velocity)) + abs(dot(row.pair.slip[1], velocity));
            slip = max(slip, select(near[i], slides, zero));
        }
        enough_ = max(Real(settled) * size, rounding * slip);
        bearable_ = max(max(Real(bearable) * size, Real(16.0) * rounding * slip), Real(resolved) * least_speed);
    }

    /// @param restitution of each pair: only as much of it as makes no energy is left
    SLIDEWAY_HD void solve(Mask<Real> in, Real const (&restitution)[pair_count]) {
        find(in, restitution);
        auto const less = in & ((energy_made() > Real(1e-12) * energy_moved()) | pairs.failed);
        if (!friction_ || none(less)) return;
        limit_energy(less);
        capped_ = less;
    }

    /// What the impulses come to.
    SLIDEWAY_HD ImpactBooks<Real> books() const {
        auto books = ImpactBooks<Real>::none();
        books.capped = count<Real>(capped_);
        books.work = all_.impulse_work(pairs.load(), pairs.after - pairs.before);
        auto const mean = Real(0.5) * (arrival_ + pairs.after);
        for (int k = 0; k < pairs.count(); ++k) {
            auto const& row = pairs.row(k);
            books.damping = fnma(dot(row.pair.normal, mean), row.normal, books.damping);
            books.friction = fnma(dot(row.pair.slip[0], mean), row.along[0], fnma(dot(row.pair.slip[1], mean), row.along[1], books.friction));
            books.impulse = books.impulse + row.normal;
        }
        return books;
    }

private:
    SLIDEWAY_HD void find(Mask<Real> in, Real const (&restitution)[pair_count]) {
        for (int k = 0; k < pairs.count(); ++k) {
            auto& row = pairs.row(k);
            row.target = negated(restitution[row.number]) * min(dot(row.pair.normal, arrival_), Real(0.0));
            row.normal = row.along[0] = row.along[1] = Real(0.0);
        }
        pairs.solve(in, enough_, bearable_, friction_, false);
    }

    /// Takes as much from the impulses as it needs for them to make no energy: the largest κ ≤ 1 of Λ₀ + κ (Λ − Λ₀), Λ₀ being those without restitution
    /// (M13.7).  Λ₀ alone where there is no Λ: with e > 0 and friction there need not be one.
    SLIDEWAY_HD void limit_energy(Mask<Real> in) {
        Real const zero(0.0), one(1.0);
        Real whole[3][pair_count], no_restitution[pair_count];
        for (auto& e : no_restitution) e = zero;
        for (int k = 0; k < pairs.count(); ++k) {
            for (int j = 0; j < 3; ++j) whole[j][k] = impulse_of(pairs.row(k), j);
        }
        auto const full = pairs.after;
        auto const had_failed = pairs.failed;
        find(in, no_restitution);
        pairs.failed = pairs.failed & in;
        // E(κ) = a κ² + b κ + c of the impulses P₀ + κ ΔP: a = ½ Δu·ΔP, b = u₀·ΔP, c = E(0), u₀ the velocity after P₀.
        auto const dead = pairs.load();
        auto const stopped = pairs.after;
        auto more = Twist<Real>::zero();
        for (int k = 0; k < pairs.count(); ++k) {
            auto& row = pairs.row(k);
            auto const exceeding = [&](int j) { return Real(whole[j][k] - impulse_of(row, j)); };
            more = fma(exceeding(0), row.pair.normal, more);
            more = fma(exceeding(1), row.pair.slip[0], fma(exceeding(2), row.pair.slip[1], more));
        }
        Real const a = Real(0.5) * dot(full - stopped, more), b = dot(stopped, more), c = min(energy_made(), zero);
        Real const root = sqrt(max(fnma(Real(4.0) * a, c, b * b), zero));
        auto const curved = a > zero;
        Real const share = select(curved, (root - b) / select(curved, a + a, one), zero);
        Real const kept = select(had_failed, zero, min(max(share, zero), one));
        for (int k = 0; k < pairs.count(); ++k) {
            for (int j = 0; j < 3; ++j) {
                Real& least = impulse_of(pairs.row(k), j);
                least = select(in, fma(kept, whole[j][k] - least, least), whole[j][k]);
            }
        }
        pairs.after = select(in, pairs.before + all_.response(fma(kept, more, dead)), full);
    }

    /// ½ (u⁻ + u⁺) · P [J], and the size of what is moved.
    SLIDEWAY_HD Real energy_made() const { return Real(0.5) * dot(pairs.before + pairs.after, pairs.load()); }
    SLIDEWAY_HD Real energy_moved() const {
        Real sum(0.0);
        for (int k = 0; k < pairs.count(); ++k) sum = fma(abs(approach(pairs.row(k))), pairs.row(k).normal, sum);
        return sum;
    }

    SLIDEWAY_FN Real approach(TouchingPair<Real> const& row) const { return dot(row.pair.normal, pairs.before); }
    SLIDEWAY_FN static Real& impulse_of(TouchingPair<Real>& row, int j) { return j == 0 ? row.normal : row.along[j - 1]; }

    Pairs const& all_;
    Twist<Real> arrival_;
    bool friction_;
    Mask<Real> capped_ = mask_of<Real>(false);
    Real enough_, bearable_;  // change of a velocity that is none, or is where it cannot be made less [m/s]
};

}  // namespace slideway::inline SLIDEWAY_ISA
