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
};

/// The paper's own: C δ δ' on points (Qian et al. 2020, (18)), none on lines and surfaces.
struct PointDamping {
    static constexpr bool has_memory = false;

    template <class Real>
    SLIDEWAY_FN static Real point_force(Real elastic, Real depth, Real rate, Real, PointContact<Real> const& point,
                                        DampingParameters<Real> const&) {
        return clamped(fma(point.damping * depth, rate, elastic));
    }
    template <class Real> SLIDEWAY_FN static Real line_factor(Real, Real, DampingParameters<Real> const&) {
        return Real(1.0);
    }
    template <class Real> SLIDEWAY_FN static Real surface_factor(Real, Real, DampingParameters<Real> const&) {
        return Real(1.0);
    }
};

/// Points as above; line and surface forces times 1 + χ d(δ̄)/dt.
struct RateDamping : PointDamping {
    template <class Real> SLIDEWAY_FN static Real line_factor(Real rate, Real, DampingParameters<Real> const& d) {
        return clamped(fma(d.chi_line, rate, Real(1.0)));
    }
    template <class Real> SLIDEWAY_FN static Real surface_factor(Real rate, Real, DampingParameters<Real> const& d) {
        return clamped(fma(d.chi_surface, rate, Real(1.0)));
    }
};

/// Every contact's elastic force times 1 + a h'/v0, where v0 is the rate at its last touch: an isolated impact returns the
/// coefficient of restitution e exactly, whatever the elastic law and the speed (model.md 4).
struct RestitutionDamping {
    static constexpr bool has_memory = true;

    template <class Real> SLIDEWAY_FN static Real factor(Real rate, Real v0, DampingParameters<Real> const& d) {
        return clamped(fma(d.restitution_slope, rate / v0, Real(1.0)));
    }
    template <class Real>
    SLIDEWAY_FN static Real point_force(Real elastic, Real, Real rate, Real v0, PointContact<Real> const&,
                                        DampingParameters<Real> const& d) {
        return elastic * factor(rate, v0, d);
    }
    template <class Real> SLIDEWAY_FN static Real line_factor(Real rate, Real v0, DampingParameters<Real> const& d) {
        return factor(rate, v0, d);
    }
    template <class Real> SLIDEWAY_FN static Real surface_factor(Real rate, Real v0, DampingParameters<Real> const& d) {
        return factor(rate, v0, d);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
