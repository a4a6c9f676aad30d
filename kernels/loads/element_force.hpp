#pragma once

#include "kernels/loads/element_pull.hpp"
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
        auto const pull = ElementPull<Real>::of_spring(stretch, rate, stiffness, damping, preload);
        return {negated(pull.force) * along, pull.potential, pull.loss};
    }

    SLIDEWAY_FN static ElementForce of_stop(Load const& load, LoadNumbers<Real> const& numbers, Real x, Real vx) {
        Real const zero(0.0), side(load.side);
        Real const depth = side * (x - numbers.as_given(load.anchor[0])), rate = side * vx;
        auto const pull = ElementPull<Real>::of_stop(depth, rate, numbers.as_given(load.stiffness), numbers.as_given(load.damping),
                                                     numbers.as_given(load.dissipation));
        return {{negated(side) * pull.force, zero, zero}, pull.potential, pull.loss};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
