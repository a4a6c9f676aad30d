// What multiplies or adds to the elastic forces.  One of three kinds is compiled into a scene's kernel.
// Every contact's force is clamped at zero: none pulls.
#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct DampingParameters {
    Real chi_line;           // χ of line contacts [s/m]
    Real chi_surface;        // χ of surface contacts [s/m]
    Real restitution_slope;  // a(e), see restitution.hpp
    Real restitution;        // e, for laws with a slope of their own
};

/// Force of a point contact [N] with its derivatives by δ [N/m] and δ' [N s/m].  A contact whose force is clamped at zero has none.
template <class Real> struct PointSlopes { Real force, by_depth, by_rate; };

/// The factor on the force of a line or surface, with its derivative by the rate of the contact's penetration [s/m].
template <class Real> struct FactorSlope { Real factor, by_rate; };

/// 1 + slope·rate, clamped at zero.
template <class Real> SLIDEWAY_FN FactorSlope<Real> clamped_factor(Real slope, Real rate) {
    Real const factor = fma(slope, rate, Real(1.0));
    return {clamped(factor), select(factor > Real(0.0), slope, Real(0.0))};
}

/// The paper's own: C δ δ' on points (Qian et al. 2020, (18)), none on lines and surfaces.
/// Of each kind: `point_force`, `line_factor` and `surface_factor`, the same with their derivatives (`…_slopes`), `surface_slope`, the factor's
/// by the rate before it is clamped [s/m], `couples`, whether the rate of one apex changes the force of another, and `remembers`, whether v0
/// counts.
struct PointDamping {
    static constexpr bool remembers = false, couples = false;

    template <class Real>
    SLIDEWAY_FN static Real point_force(Real elastic, ApexMotion<Real> const& apex, PointContact<Real> const& point,
                                        DampingParameters<Real> const&) {
        return clamped(fma(point.damping * apex.depth, apex.rate, elastic));
    }
    template <class Real> SLIDEWAY_FN static Real line_factor(Real, Real, DampingParameters<Real> const&) {
        return Real(1.0);
    }
    template <class Real> SLIDEWAY_FN static Real surface_factor(Real, Real, DampingParameters<Real> const&) {
        return Real(1.0);
    }

    template <class Real>
    SLIDEWAY_FN static PointSlopes<Real> point_slopes(ElasticSlope<Real> const& elastic, ApexMotion<Real> const& apex,
                                                      PointContact<Real> const& contact, DampingParameters<Real> const&) {
        Real const zero(0.0);
        Real const viscosity = contact.damping * apex.depth;
        Real const force = fma(viscosity, apex.rate, elastic.load);
        auto const pushing = force > zero;
        return {clamped(force), select(pushing, fma(contact.damping, apex.rate, elastic.slope), zero),
                select(pushing, viscosity, zero)};
    }
    template <class Real> SLIDEWAY_FN static FactorSlope<Real> line_slopes(Real, Real, DampingParameters<Real> const&) {
        return {Real(1.0), Real(0.0)};
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> surface_slopes(Real, Real, DampingParameters<Real> const&) {
        return {Real(1.0), Real(0.0)};
    }
    template <class Real> SLIDEWAY_FN static Real surface_slope(Real, DampingParameters<Real> const&) { return Real(0.0); }
};

/// Points as above; line and surface forces times 1 + χ d(δ̄)/dt.
struct RateDamping : PointDamping {
    static constexpr bool couples = true;

    template <class Real> SLIDEWAY_FN static Real line_factor(Real rate, Real, DampingParameters<Real> const& d) {
        return clamped(fma(d.chi_line, rate, Real(1.0)));
    }
    template <class Real> SLIDEWAY_FN static Real surface_factor(Real rate, Real, DampingParameters<Real> const& d) {
        return clamped(fma(d.chi_surface, rate, Real(1.0)));
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> line_slopes(Real rate, Real, DampingParameters<Real> const& d) {
        return clamped_factor(d.chi_line, rate);
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> surface_slopes(Real rate, Real, DampingParameters<Real> const& d) {
        return clamped_factor(d.chi_surface, rate);
    }
    template <class Real> SLIDEWAY_FN static Real surface_slope(Real, DampingParameters<Real> const& d) { return d.chi_surface; }
};

/// Every contact's elastic force times 1 + a h'/v0, where v0 is the rate at its last touch: an isolated impact returns the
/// coefficient of restitution e exactly, whatever the elastic law and the speed (model.md 4).
struct RestitutionDamping {
    static constexpr bool remembers = true, couples = true;

    template <class Real> SLIDEWAY_FN static Real factor(Real rate, Real v0, DampingParameters<Real> const& d) {
        return clamped(fma(d.restitution_slope, rate / v0, Real(1.0)));
    }
    template <class Real>
    SLIDEWAY_FN static Real point_force(Real elastic, ApexMotion<Real> const& apex, PointContact<Real> const&,
                                        DampingParameters<Real> const& d) {
        return elastic * factor(apex.rate, apex.impact_speed, d);
    }
    template <class Real> SLIDEWAY_FN static Real line_factor(Real rate, Real v0, DampingParameters<Real> const& d) {
        return factor(rate, v0, d);
    }
    template <class Real> SLIDEWAY_FN static Real surface_factor(Real rate, Real v0, DampingParameters<Real> const& d) {
        return factor(rate, v0, d);
    }

    template <class Real>
    SLIDEWAY_FN static PointSlopes<Real> point_slopes(ElasticSlope<Real> const& elastic, ApexMotion<Real> const& apex,
                                                      PointContact<Real> const&, DampingParameters<Real> const& d) {
        auto const f = line_slopes(apex.rate, apex.impact_speed, d);
        return {elastic.load * f.factor, elastic.slope * f.factor, elastic.load * f.by_rate};
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> line_slopes(Real rate, Real v0, DampingParameters<Real> const& d) {
        return clamped_factor(surface_slope(v0, d), rate);
    }
    template <class Real>
    SLIDEWAY_FN static FactorSlope<Real> surface_slopes(Real rate, Real v0, DampingParameters<Real> const& d) {
        return line_slopes(rate, v0, d);
    }
    template <class Real> SLIDEWAY_FN static Real surface_slope(Real v0, DampingParameters<Real> const& d) { return d.restitution_slope / v0; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
