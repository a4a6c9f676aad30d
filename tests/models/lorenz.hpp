#pragma once

#include "tests/models/plain_model.hpp"
#include "tests/models/taylor_step.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The Lorenz equations, a small smooth model that tests and benchmarks of the steppers share:
///   x' = σ (y − x),   y' = x (ρ − z) − y,   z' = x y − β z.
/// Source: Lorenz, J. Atmos. Sci. 20 (1963) 130–141, equations 25–27.  Dimensionless; every state has a derivative.
struct Lorenz : Analytic<PlainModel<3>> {  // x y z
    struct Inputs {
        double sigma = 10;
        double rho = 28;
        double beta = 8.0 / 3.0;
        double x = 10, y = 10, z = 10;  // at the start
    };
    template <class Real> struct Parameters { Real sigma, rho, beta; };

    /// Operations of one derivative: x' subtracts and multiplies (2), y' subtracts, multiplies, subtracts (3), z' multiplies
    /// twice and subtracts (3).
    static constexpr int derivative_flops = 8;

    /// Time derivative of the state.  @param s, rates `size` values each.
    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real, Real const* s, Parameters<Real> const& p, Memory<Real> const&,
                                               Real* rates, Report<Real>*) {
        Real const x = s[0], y = s[1], z = s[2];
        rates[0] = p.sigma * (y - x);
        rates[1] = fms(x, p.rho - z, y);
        rates[2] = fms(x, y, p.beta * z);
        return Faults<Real>::none();
    }

    /// Maxima of z, the section that Lorenz plotted: z' = 0 from above.
    static constexpr int events = 1;
    static constexpr EventInfo event_table[events] = {{Direction::falling, false}};

    /// Functions whose zeros are the events, and their time derivatives.  @param rates the derivative at `s`.
    template <class Real>
    SLIDEWAY_FN static void event_values(Real, Real const* s, Real const* rates, Parameters<Real> const& p, Real* value,
                                         Real* slope) {
        value[0] = fms(s[0], s[1], p.beta * s[2]);
        slope[0] = fma(rates[0], s[1], fms(s[0], rates[1], p.beta * rates[2]));
    }

    SLIDEWAY_HD static Parameters<double> parameters(Inputs const& in) { return {in.sigma, in.rho, in.beta}; }

    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        s[0] = in.x;
        s[1] = in.y;
        s[2] = in.z;
    }
};

/// The Lorenz equations as the lanes integrate them: nothing is observed but the states.
struct LorenzModel : Lorenz {
    static constexpr int events = 0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
