#pragma once

#include "tests/models/plain_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A mass that bounces between two undamped linear springs: what is left of the slider on `kelvin_voigt` where it stays flat.  With the
/// clearance c as the unit of length and √(g c) as that of speed
///   y' = r v,   v' = −r (1 + p (y − f)),   r = √(g/c),
/// where f is ±1 on a face and p is 0 in flight.  The face is part of the state; touch and parting are events that set it.
struct BouncingMass : PlainModel<3> {  // y v f
    struct Inputs {
        double y = 0, v = 3;
        double stiffness = 1e5;  // p = k c/(M g) on a face, of all its springs
        double rate = 300;       // r [1/s]
    };
    template <class Real> struct Parameters { Real stiffness, rate; };
    /// Where at the first event, if quantities are asked for.
    template <class Real> using Observer = EventRecorder<Real, 0, 1>;

    /// Time derivative of the state.  @param s, rates `size` values each.
    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real, Real const* s, Parameters<Real> const& p, Memory<Real> const&,
                                               Real* rates, Report<Real>*) {
        Real const zero(0.0), one(1.0);
        Real const push = select(s[2] == zero, zero, p.stiffness * (s[0] - s[2]));
        rates[0] = p.rate * s[1];
        rates[1] = negated(p.rate * (one + push));
        rates[2] = zero;
        return Faults<Real>::none();
    }

    enum Event { upper_touch, lower_touch, parting };
    static constexpr int events = 3;
    static constexpr EventInfo event_table[events] = {
        {Direction::rising, true}, {Direction::rising, true}, {Direction::falling, true}};

    /// Functions whose zeros are the events, and their time derivatives.  Each is −1 throughout where another one is at work: a state
    /// that begins on an edge is so not taken for one that crosses it.  In flight they are parabolas, whose zeros the cubics of the search
    /// find whatever the step.  @param rates the derivative at `s`.
    template <class Real>
    SLIDEWAY_FN static void event_values(Real, Real const* s, Real const* rates, Parameters<Real> const&, Real* value,
                                         Real* slope) {
        Real const zero(0.0), one(1.0), never(-1.0);
        auto const flies = s[2] == zero;
        value[upper_touch] = select(flies, s[0] - one, never);
        slope[upper_touch] = select(flies, rates[0], zero);
        value[lower_touch] = select(flies, never - s[0], never);
        slope[lower_touch] = select(flies, negated(rates[0]), zero);
        value[parting] = select(flies, never, fms(s[0], s[2], one));
        slope[parting] = select(flies, zero, rates[0] * s[2]);
    }

    /// The state after an event, in the lanes `at`.
    template <class Real> SLIDEWAY_FN static void reset(int event, Mask<Real> at, Real* s, Parameters<Real> const&) {
        double const face = event == upper_touch ? 1 : event == lower_touch ? -1 : 0;
        s[2] = select(at, Real(face), s[2]);
    }

    /// It never is, with nothing that damps it.
    template <class Real> SLIDEWAY_FN static Mask<Real> at_rest(Real const*) { return mask_of<Real>(false); }

    SLIDEWAY_HD static Parameters<double> parameters(Inputs const& in) { return {in.stiffness, in.rate}; }

    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        s[0] = in.y;
        s[1] = in.v;
        s[2] = 0;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
