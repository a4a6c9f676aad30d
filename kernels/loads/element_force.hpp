#pragma once

#include "kernels/loads/load_list.hpp"
#include "kernels/loads/load_numbers.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A spring or a stop between a point of the slider and the ground (model.md 14).
template <class Real> struct ElementForce {
    Vec3<Real> force;  // on the point, along the axes of the ground [N]
    Real potential;    // what it stores [J]
    Real loss;         // power of its damper [W]

    /// @param place, velocity of the point
    SLIDEWAY_FN static ElementForce of(Load const& load, LoadNumbers<Real> const& numbers, Vec3<Real> const& place, Vec3<Real> const& velocity) {
        return load.kind == LoadKind::stop ? of_stop(load, numbers, place.x, velocity.x) : of_spring(load, numbers, place, velocity);
    }

private:
    /// Tension T0 + k (ℓ − ℓ0) + c ℓ'.
    SLIDEWAY_FN static ElementForce of_spring(Load const& load, LoadNumbers<Real> const& numbers, Vec3<Real> const& place, Vec3<Real> const& velocity) {
        Real const zero(0.0), one(1.0), least_square(1e-30);  // where its ends meet it has no direction
        auto const span = place - numbers.as_given(load.anchor);
        Real length = span.x;
        Vec3<Real> along{one, zero, zero};
        if (!load.along) {
            length = sqrt(max(dot(span, span), least_square));
            along = (one / length) * span;
        }
        Real const stretch = length - numbers.as_given(load.rest_length), rate = dot(along, velocity);
        Real const stiffness = numbers.as_given(load.stiffness), preload = numbers.as_given(load.preload), damping = numbers.as_given(load.damping);
        Real const tension = fma(damping, rate, fma(stiffness, stretch, preload));
        return {negated(tension) * along, stretch * fma(Real(0.5) * stiffness, stretch, preload), damping * (rate * rate)};
    }

    /// k δ (1 + χ δ') + c δ' where it is touched, and never a pull.
    SLIDEWAY_FN static ElementForce of_stop(Load const& load, LoadNumbers<Real> const& numbers, Real x, Real vx) {
        Real const zero(0.0), one(1.0), side(load.side);
        Real const depth = side * (x - numbers.as_given(load.anchor[0])), rate = side * vx;
        auto const touches = depth > zero;
        Real const elastic = numbers.as_given(load.stiffness) * depth;
        Real const damped = fma(elastic, fma(numbers.as_given(load.dissipation), rate, one), numbers.as_given(load.damping) * rate);
        Real const push = select(touches, max(damped, zero), zero);
        return {{negated(side) * push, zero, zero}, select(touches, Real(0.5) * elastic * depth, zero), select(touches, (push - elastic) * rate, zero)};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
