#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A number of the pair `number` of sixteen.
template <class Real> SLIDEWAY_FN Real& number_of(Quad<Real> (&of)[face_count], int number) {
    auto& quad = of[number / 4];
    int const place = number % 4;
    return place == 0 ? quad.a : place == 1 ? quad.b : place == 2 ? quad.c : quad.d;
}
template <class Real> SLIDEWAY_FN Real number_of(Quad<Real> const (&of)[face_count], int number) {
    auto const& quad = of[number / 4];
    int const place = number % 4;
    return place == 0 ? quad.a : place == 1 ? quad.b : place == 2 ? quad.c : quad.d;
}

/// Normal forces λ ≥ 0 of the pairs that last, so that none of them comes nearer (M13.10):
///   λ ≥ 0 ⊥ γ' + 2 β γ + β² g ≥ 0,
/// each with the friction μ(V) λ against its slip.  The terms in β take away what the steps leave of γ and of the gap g.  By projected
/// Gauss–Seidel steps, as many as a lane's own numbers ask for: apices that share a face leave open which of them carries what, and the
/// sum alone moves the slider.
template <class Guide, class Real> class LastingForces {
public:
    using Pairs = JointPairs<Guide, Real>;
    static constexpr int most_sweeps = 400, sweeps_to_leap = 32;
    /// Change of an acceleration, in units of what the slider would have without contact, that counts as none.
    static constexpr double settled = 1e-13;

    Real normal[pair_count];     // λ [N]
    Real gap_rate[pair_count];   // γ [m/s]
    Real acceleration[pair_count];  // γ' under all forces [m/s²]
    Twist<Real> force;              // of all of them on the slider
    Real friction_power, normal_power;  // −Σ f · v_t, Σ λ γ [W]
    Mask<Real> failed;

    /// @param asked pairs whose γ' is asked for  @param held those that may push  @param depth δ [m]
    SLIDEWAY_HD void solve(Pairs const& pairs, Twist<Real> const& velocity, Quad<Real> const (&depth)[face_count], Real beta,
                           Mask<Real> const (&asked)[pair_count], Mask<Real> const (&held)[pair_count],
                           FrictionParameters<Real> const* friction) {
        Real const zero(0.0), one(1.0);
        auto moving = pairs.acceleration(Twist<Real>::zero());
        Real size = zero;
        int count = 0;
        for (int i = 0; i < pair_count; ++i) {
            normal[i] = gap_rate[i] = acceleration[i] = zero;
            if (none(asked[i] | held[i])) continue;
            auto pair = pairs.pair(i);
            Real const rate = dot(pair.normal, velocity);
            auto& row = rows_[count];
            gap_rate[i] = rate;
            row.pair = i;
            row.normal = pair.normal;
            row.bias = pair.bias;
            Real const gap = negated(number_of(depth, i));
            row.target = fma(beta, fma(beta, gap, rate + rate), pair.bias);
            row.act = pair.normal;
            row.pushed = pair.pushed;
            row.slip_power = zero;
            if (friction != nullptr) drag(pair, velocity, *friction, row);
            Real const own = dot(row.normal, row.pushed);
            // Friction that outweighs the push would have to press harder the more it is pressed.
            auto const wedged = held[i] & (own <= Real(1e-3) * dot(pair.normal, pair.pushed));
            row.wedged = wedged;
            row.own = select(wedged, one, own);
            row.held = held[i];
            size = max(size, select(held[i], abs(row.target + dot(row.normal, moving)), zero));
            ++count;
        }
        failed = mask_of<Real>(false);
        for (int k = 0; k < count; ++k) failed = failed | rows_[k].wedged;
        auto active = size > zero;
        Real const enough = Real(settled) * size;
        for (int sweep = 0; sweep < most_sweeps && any(active); ++sweep) {
            Real change = zero, steps[pair_count];
            auto const start = moving;
            for (int k = 0; k < count; ++k) {
                auto const& row = rows_[k];
                Real& load = normal[row.pair];
                Real const wish = negated(row.target + dot(row.normal, moving)) / row.own;
                Real const step = select(active & row.held, max(wish, negated(load)), zero);
                steps[k] = step;
                load = load + step;
                moving = fma(step, row.pushed, moving);
                change = max(change, abs(step) * row.own);
            }
            active = active & (change > enough);
            if (sweep % sweeps_to_leap == sweeps_to_leap - 1) leap(active & (change > Real(1e2) * moved(moving - start, count)), steps, count, moving);
            // What comes to next to nothing within that many sweeps is a wedge.
            if (sweep + 1 == most_sweeps) failed = failed | (active & (change > Real(1e-6) * size));
        }
        force = Twist<Real>::zero();
        friction_power = normal_power = zero;
        for (int k = 0; k < count; ++k) {
            auto const& row = rows_[k];
            Real const load = normal[row.pair];
            force = fma(load, row.act, force);
            acceleration[row.pair] = row.bias + dot(row.normal, moving);
            friction_power = fma(load, row.slip_power, friction_power);
            normal_power = fma(load, gap_rate[row.pair], normal_power);
        }
    }

private:
    /// As of a JointImpact.
    SLIDEWAY_HD Real moved(Twist<Real> const& change, int count) const {
        Real most(0.0);
        for (int k = 0; k < count; ++k) most = max(most, select(rows_[k].held, abs(dot(rows_[k].normal, change)), Real(0.0)));
        return most;
    }
    SLIDEWAY_HD void leap(Mask<Real> in, Real const (&steps)[pair_count], int count, Twist<Real>& moving) {
        Real const zero(0.0), one(1.0), never(1e9);
        Real length = never;
        for (int k = 0; k < count; ++k) {
            auto const falls = steps[k] < zero;
            length = min(length, select(falls, normal[rows_[k].pair] / select(falls, negated(steps[k]), one), never));
        }
        length = select(in & (length < never), length, zero);
        for (int k = 0; k < count; ++k) {
            Real& load = normal[rows_[k].pair];
            Real const more = max(length * steps[k], negated(load));
            load = load + more;
            moving = fma(more, rows_[k].pushed, moving);
        }
    }

    struct Row {
        int pair;
        Twist<Real> normal;
        Twist<Real> act, pushed;  // force and acceleration for λ = 1, friction included
        Real bias, target, own, slip_power;
        Mask<Real> held, wedged;
    };

    SLIDEWAY_HD static void drag(JointPair<Real> const& pair, Twist<Real> const& velocity, FrictionParameters<Real> const& friction,
                                 Row& row) {
        Real const first = dot(pair.slip[0], velocity), second = dot(pair.slip[1], velocity);
        Real const square = fma(first, first, second * second), speed = sqrt(square);
        Real const grip = StickSlipFriction::coefficient(speed, friction);
        // μ vanishes with V: any floor keeps the quotient finite.
        Real const share = negated(grip) / max(speed, Real(1e-70));
        auto const add = [&](int i, Real slip) {
            Real const factor = share * slip;
            row.act = fma(factor, pair.slip[i], row.act);
            row.pushed = fma(factor, pair.dragged[i], row.pushed);
        };
        add(0, first);
        add(1, second);
        row.slip_power = grip * speed;
    }

    Row rows_[pair_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
