// Derivatives of what damping.hpp adds to the elastic forces.  A contact whose force is clamped at zero has none.
#pragma once

#include "kernels/laws/damping.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Force of a point contact [N] with its derivatives by δ [N/m] and δ' [N s/m].
template <class Real> struct PointSlopes { Real force, by_depth, by_rate; };

/// The factor on the force of a line or surface, with its derivative by the rate of the contact's penetration [s/m].
template <class Real> struct FactorSlope { Real factor, by_rate; };

namespace detail {

/// 1 + slope·rate, clamped at zero.
template <class Real> SLIDEWAY_FN FactorSlope<Real> clamped_factor(Real slope, Real rate) {
    Real const factor = fma(slope, rate, Real(1.0));
    return {clamped(factor), select(factor > Real(0.0), slope, Real(0.0))};
}

}  // namespace detail

/// Derivatives of one kind of `Damping`.  `couples`: whether the rate of one apex changes the force of another.
template <class Damping> struct DampingStiffness;

template <> struct DampingStiffness<PointDamping> {
    static constexpr bool couples = false;

    template <class Real>
    SLIDEWAY_FN static PointSlopes<Real> point(Real elastic, Real elastic_slope, Real depth, Real rate, Real,
                                               PointContact<Real> const& contact, DampingParameters<Real> const&) {
        Real const zero(0.0);
        Real const viscosity = contact.damping * depth;
        Real const force = fma(viscosity, rate, elastic);
        auto const pushing = force > zero;
        return {clamped(force), select(pushing, fma(contact.damping, rate, elastic_slope), zero),
                select(pushing, viscosity, zero)};
    }
    template <class Real> SLIDEWAY_FN static FactorSlope<Real> line(Real, Real, DampingParameters<Real> const&) {
        return {Real(1.0), Real(0.0)};
    }
    template <class Real> SLIDEWAY_FN static FactorSlope<Real> surface(Real, Real, DampingParameters<Real> const&) {
        return {Real(1.0), Real(0.0)};
    }
};

template <> struct DampingStiffness<RateDamping> : DampingStiffness<PointDamping> {
    static constexpr bool couples = true;

    template <class Real> SLIDEWAY_FN static FactorSlope<Real> line(Real rate, Real, DampingParameters<Real> const& d) {
        return detail::clamped_factor(d.chi_line, rate);
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> surface(Real rate, Real, DampingParameters<Real> const& d) {
        return detail::clamped_factor(d.chi_surface, rate);
    }
};

template <> struct DampingStiffness<RestitutionDamping> {
    static constexpr bool couples = true;

    template <class Real>
    SLIDEWAY_FN static PointSlopes<Real> point(Real elastic, Real elastic_slope, Real, Real rate, Real v0,
                                               PointContact<Real> const&, DampingParameters<Real> const& d) {
        auto const f = line(rate, v0, d);
        return {elastic * f.factor, elastic_slope * f.factor, elastic * f.by_rate};
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> line(Real rate, Real v0, DampingParameters<Real> const& d) {
        return detail::clamped_factor(d.restitution_slope / v0, rate);
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> surface(Real rate, Real v0, DampingParameters<Real> const& d) {
        return line(rate, v0, d);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
