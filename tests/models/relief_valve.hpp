#pragma once

#include "tests/models/plain_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A spring-loaded relief valve on a vessel that is filled at a constant rate; the disc bounces on its seat:
///   x' = v,   v' = −κ v − (x + δ) + p,   p' = β (q − x √p);   at x = 0 with v < 0: v ← −e v.
/// x is the lift, p the overpressure, κ = 1.25, δ = 10, β = 20, e = 0.8.  Source: Hős & Champneys, Physica D 241 (2012)
/// 2068–2076; dimensionless.  What the equations leave open:
/// - √p is 0 for p < 0.  No orbit gets there (p' = β q > 0 at p = 0), but a stage of a step may.
/// - Below the opening pressure bounces come to an end: they pile up in finite time.  A rebound slower than `seat_speed`
///   whose remaining bounces raise p by little ends on the seat, x = v = 0 exactly, where v' = 0 until p > δ lifts the disc.
/// From q = 8.7 or so on orbits end in an equilibrium, at which extrema are but rounding errors: see `at_rest`.
struct ReliefValve : PlainModel<3> {  // x v p
    struct Inputs {
        double inflow = 5;                           // q
        double lift = 0.2, speed = 0, pressure = 0;  // x, v, p at the start
    };
    template <class Real> struct Parameters { Real inflow; };
    /// Of the impacts and the extrema of the lift 64 are recorded, after a transient of 2,048.
    template <class Real> using Observer = EventRecorder<Real, 2048, 64>;

    static constexpr double damping = 1.25;     // κ
    static constexpr double preload = 10;       // δ, the opening pressure
    static constexpr double stiffness = 20;     // β, of the vessel's contents
    static constexpr double restitution = 0.8;  // e
    static constexpr double seat_speed = 1e-6;  // what it cuts off moves p by seat_speed² or so
    static constexpr double rest_rate = 1e-7;

    /// Time derivative of the state.  @param s, rates `size` values each; NaN stays NaN.
    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real, Real const* s, Parameters<Real> const& p, Memory<Real> const&,
                                               Real* rates, Report<Real>*) {
        Real const x = s[0], v = s[1], pressure = s[2], zero(0.0);
        Real const push = fma(Real(-damping), v, pressure - (x + Real(preload)));
        auto const seated = (x == zero) & (v == zero) & (push < zero);
        Real const flow = x * sqrt(max(zero, pressure));  // max returns its second argument where that is NaN
        rates[0] = v;
        rates[1] = select(seated, zero, push);
        rates[2] = Real(stiffness) * (p.inflow - flow);
        return Faults<Real>::none();
    }

    enum Event { impact, extremum };
    static constexpr int events = 2;
    static constexpr EventInfo event_table[events] = {{Direction::falling, true}, {Direction::both, false}};

    /// Functions whose zeros are the events, and their time derivatives.  @param rates the derivative at `s`.
    template <class Real>
    SLIDEWAY_FN static void event_values(Real, Real const* s, Real const* rates, Parameters<Real> const&, Real* value,
                                         Real* slope) {
        value[impact] = s[0];
        slope[impact] = rates[0];
        value[extremum] = s[1];
        slope[extremum] = rates[1];
    }

    /// The state after an impact, in the lanes `at`.
    template <class Real> SLIDEWAY_FN static void reset(int event, Mask<Real> at, Real* s, Parameters<Real> const& p) {
        if (event != impact) return;
        Real const zero(0.0);
        Real const rebound = Real(-restitution) * s[1];
        // Bounces from speed u under g = δ − p last 2u/(g(1 − e)), and p rises by β q a unit of time: at most by g/2 if
        // 4 β q u ≤ (1 − e) g².
        Real const deceleration = Real(preload) - s[2];
        Real const allowed = Real(1 - restitution) * deceleration * deceleration;
        auto const ends = (rebound < Real(seat_speed)) & (deceleration > zero) &
                          (Real(4 * stiffness) * p.inflow * rebound <= allowed);
        s[0] = select(at, zero, s[0]);
        s[1] = select(at, select(ends, zero, rebound), s[1]);
    }

    /// Lanes whose orbit has come to its equilibrium: every extremum still to come is at the present x, within some 1e-8.
    template <class Real> SLIDEWAY_FN static Mask<Real> at_rest(Real const* rates) {
        return max(abs(rates[0]), max(abs(rates[1]), abs(rates[2]))) <= Real(rest_rate);
    }

    SLIDEWAY_HD static Parameters<double> parameters(Inputs const& in) { return {in.inflow}; }

    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        s[0] = in.lift;
        s[1] = in.speed;
        s[2] = in.pressure;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
