#pragma once

#include "kernels/math/trigonometry.hpp"
#include "tests/models/dense_linearisation.hpp"
#include "tests/models/models.hpp"
#include "tests/models/plain_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Has patterns, all alike, so that `auto` looks whether its members are stiff.
struct TrackerModel : PlainModel<2> {
    using Inputs = testing::TrackerInputs;
    static constexpr bool has_patterns = true;
    static constexpr bool has_linearisation = true;
    template <class Real> struct Parameters { Real rate, wall, solvable_below, by_time, bends; };
    template <class Real> using Linearisation = DenseLinearisation<2, Real>;

    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real t, Real const* s, Parameters<Real> const& p, Memory<Real> const&,
                                               Real* rates, Report<Real>*) {
        auto const track = sincos(select(p.by_time > Real(0.5), t, s[1]));
        rates[0] = select(s[0] > p.wall, Real(follows), fma(p.rate, s[0] - track.sin, track.cos));
        rates[1] = Real(1.0);
        return Faults<Real>::none();
    }

    template <class Real>
    SLIDEWAY_HD static void linearise(Real, Real const* s, Parameters<Real> const& p, Memory<Real> const&,
                                      Linearisation<Real>& out) {
        auto const track = sincos(s[1]);
        out.a[0][0] = p.rate;
        out.a[0][1] = select(p.by_time > Real(0.5), Real(0.0), fnma(p.rate, track.cos, negated(track.sin)));
        out.a[1][0] = out.a[1][1] = Real(0.0);
        out.solvable_below = p.solvable_below;
    }

    template <class Real> SLIDEWAY_FN static void bend(Real t, Real step, Real const*, Parameters<Real> const& p, Real* of_state) {
        of_state[0] = negated(p.bends * sincos(fma(Real(0.5), step, t)).sin);
    }

    template <class Real> SLIDEWAY_FN static Real contact_pattern(Real, Real const*, Parameters<Real> const&, Memory<Real> const&) {
        return Real(1.0);
    }

    template <class Real> SLIDEWAY_FN static Real energy_scale(Parameters<Real> const&) { return Real(1.0); }
    template <class Real> SLIDEWAY_FN static Real squared_speed(Real const*, Real const*) { return Real(0.0); }
    template <class Real>
    SLIDEWAY_FN static Real approach_speed(Real, Real const*, Real, Real const*, Parameters<Real> const&) {
        return Real(0.0);
    }

    static Parameters<double> parameters(Inputs const& in) { return {in.rate, in.wall, in.solvable_below, in.by_time, in.bends}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.y, s[1] = in.tau; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
