#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/pair_solver.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_scales.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Which pairs may push, and which of them stick.
template <class Real> struct LastingPairs {
    Mask<Real> held[pair_count], sticks[pair_count];

    /// Those that a member remembers.
    SLIDEWAY_FN static LastingPairs of(Mask<Real> in, RigidJointMemory<Real> const& memory) {
        Real const half(0.5);
        LastingPairs last;
        for (int i = 0; i < pair_count; ++i) {
            last.held[i] = in & (number_of(memory.held, i) > half);
            last.sticks[i] = last.held[i] & (number_of(memory.sticks, i) > half);
        }
        return last;
    }
    SLIDEWAY_FN Mask<Real> any() const {
        auto some = mask_of<Real>(false);
        for (auto const& each : held) some = some | each;
        return some;
    }
};

/// Forces of the pairs that last: (M13.11) for accelerations, so that none of them comes nearer,
///   λ ≥ 0 ⊥ γ' + 2 β γ + β² g ≥ 0,                                                                                        (M13.10)
/// with Coulomb friction μ λ against the slip of those that slip, and up to μ_s λ in those that stick (v' + 2 β v = 0).  The terms in β take
/// away what the steps leave of γ, v and of the gap g.
template <class Real> class LastingForces {
public:
    using Pairs = JointPairs<Real>;
    /// Change of an acceleration, in units of what the slider would have without contact, that counts as none, and one that does where it cannot be made less.
    static constexpr double settled = 1e-15, bearable = 1e-13;

    Real normal[pair_count];            // λ [N]
    Real along[2][pair_count];          // friction of pairs that stick [N]
    Real gap_rate[pair_count];          // γ [m/s]
    Real slip[2][pair_count];           // v along both directions [m/s]; 0 without friction
    Real acceleration[pair_count];      // γ' under all forces [m/s²]
    Twist<Real> force;                  // of all of them on the slider
    Real friction_power, normal_power;  // −Σ f · v_t, Σ λ γ [W]
    Mask<Real> failed;

    /// @param asked pairs whose γ' is asked for  @param last those that may push  @param depth δ [m]  @param start loads to begin with  @param friction nullptr without
    SLIDEWAY_HD void solve(Pairs const& all, Twist<Real> const& velocity, Quad<Real> const (&depth)[face_count], Real beta,
                           Mask<Real> const (&asked)[pair_count], LastingPairs<Real> const& last, ApexLoads<Real> const& start,
                           FrictionParameters<Real> const* friction) {
        Real const zero(0.0);
        PairSolver<Real> pairs(all, all.unloaded_acceleration());
        Real size = zero;
        auto sticking = mask_of<Real>(false), wedged = sticking;
        for (int i = 0; i < pair_count; ++i) {
            normal[i] = along[0][i] = along[1][i] = gap_rate[i] = acceleration[i] = slip[0][i] = slip[1][i] = zero;
            if (none(asked[i] | last.held[i])) continue;
            auto& row = pairs.add(i);
            auto const sticks = last.held[i] & last.sticks[i];
            all.put_pair(i, row.pair);
            row.start(last.held[i], friction != nullptr ? select(sticks, holding_coefficient(*friction), zero) : zero);
            row.normal = select(last.held[i], number_of(start.normal, i), zero);
            for (int j = 0; j < 2; ++j) row.along[j] = select(sticks, number_of(start.along[j], i), zero);
            Real const rate = dot(row.pair.normal, velocity), gap = negated(number_of(depth, i));
            gap_rate[i] = rate;
            row.target = negated(fma(beta, fma(beta, gap, rate + rate), row.pair.bias));
            if (friction != nullptr) {
                for (int j = 0; j < 2; ++j) slip[j][i] = dot(row.pair.slip[j], velocity);
                row.slide(last.held[i] & !last.sticks[i], friction->kinetic_coefficient, {slip[0][i], slip[1][i]});
                sticking = sticking | sticks;
                if (any(sticks)) hold(row, i, all, beta);
            }
            // Friction that outweighs the push would have to press harder the more it is pressed.
            Real const own = dot(row.pair.normal, row.pushed);
            auto const wedge = last.held[i] & (own <= Real(1e-3) * dot(row.pair.normal, row.pair.pushed));
            row.weigh(select(wedge, Real(1.0), own));
            wedged = wedged | wedge;
            size = max(size, select(last.held[i], abs(row.target - dot(row.pair.normal, pairs.before)), zero));
        }
        pairs.solve((size > zero) & !wedged, Real(settled) * size, Real(bearable) * size, any(sticking), true);
        failed = pairs.failed | wedged;
        take(pairs, velocity);
    }

private:
    SLIDEWAY_HD void take(PairSolver<Real> const& pairs, Twist<Real> const& velocity) {
        Real const zero(0.0);
        force = Twist<Real>::zero();
        friction_power = normal_power = zero;
        for (int k = 0; k < pairs.count(); ++k) {
            auto const& row = pairs.row(k);
            auto const load = row.load();
            force = force + load;
            normal[row.number] = row.normal;
            along[0][row.number] = row.along[0], along[1][row.number] = row.along[1];
            acceleration[row.number] = row.pair.bias + dot(row.pair.normal, pairs.after);
            Real const push = row.normal * gap_rate[row.number];
            normal_power = normal_power + push;
            friction_power = friction_power - (dot(load, velocity) - push);
        }
    }

    /// Of one that sticks, what its slip is to come to.
    SLIDEWAY_HD void hold(TouchingPair<Real>& row, int number, Pairs const& all, Real beta) const {
        Real bias[2];
        all.put_slip_bias(number, bias);
        for (int j = 0; j < 2; ++j) row.hold[j] = negated(fma(beta + beta, slip[j][number], bias[j]));
        row.weigh_along();
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
