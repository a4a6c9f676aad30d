#pragma once

#include "kernels/math/trigonometry.hpp"
#include "tests/models/dense_linearisation.hpp"
#include "tests/models/models.hpp"
#include "tests/models/plain_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

struct OscillatorModel : PlainModel<2> {
    using Inputs = testing::OscillatorInputs;
    static constexpr bool has_linearisation = true;
    template <class Real> struct Parameters { Real stiffness, force, jacobian; };
    template <class Real> using Linearisation = DenseLinearisation<2, Real>;

    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real t, Real const* s, Parameters<Real> const& p, Memory<Real> const&,
                                               Real* rates, Report<Real>*) {
        rates[0] = s[1];
        rates[1] = fms(p.force, sincos(t).cos, p.stiffness * s[0]);
        return Faults<Real>::none();
    }

    template <class Real>
    SLIDEWAY_HD static void linearise(Real, Real const*, Parameters<Real> const& p, Memory<Real> const&,
                                      Linearisation<Real>& out) {
        out.a[0][0] = out.a[1][1] = Real(0.0);
        out.a[0][1] = p.jacobian;
        out.a[1][0] = negated(p.jacobian * p.stiffness);
        out.solvable_below = Real(testing::never);
    }

    static Parameters<double> parameters(Inputs const& in) {
        return {in.frequency * in.frequency, in.force, in.jacobian};
    }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.x, s[1] = in.v; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
