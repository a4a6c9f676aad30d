#pragma once

#include "kernels/joint/contact_totals.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/mechanisms/mechanism_report.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What touches of the planar slider.  Corners as (s3 along X, s1 along Y): a (+,+), b (+,−), c (−,−), d (−,+).  Of the totals a wall
/// that both its corners touch is a surface, other touching corners are points.
template <class Real> struct PlanarContact : ContactTotals<Real> {
    Quad<Real> penetration[1];   // [m]
    Quad<Real> rate[1];          // [m/s]
    Quad<Real> normal_force[1];  // [N]

    /// Depth of the corner that is deepest within its wall [m], negative in flight.
    SLIDEWAY_FN Real deepest() const { return largest(penetration[0]); }
    /// Sum of all normal forces [N].
    SLIDEWAY_FN Real total_force() const { return sum(normal_force[0]); }
    /// Nothing switches.
    SLIDEWAY_FN Real pattern() const { return Real(0.0); }

    /// Without forces.
    SLIDEWAY_FN void start(Quad<Real> const& depth, Quad<Real> const& rate_of) {
        Real const zero(0.0);
        penetration[0] = depth;
        rate[0] = rate_of;
        normal_force[0] = {zero, zero, zero, zero};
        this->clear_totals();
    }

    /// @param potential_share 1/(n + 1)
    SLIDEWAY_FN void tell(Quad<Real> const& force, Quad<Real> const& elastic, Real potential_share) {
        Real const zero(0.0);
        auto const& depth = penetration[0];
        auto const& v = rate[0];
        normal_force[0] = force;
        Real const stored = fma(elastic.a, max(depth.a, zero), elastic.b * max(depth.b, zero)) +
                            fma(elastic.c, max(depth.c, zero), elastic.d * max(depth.d, zero));
        this->potential = potential_share * stored;
        this->damping_power = fma(force.a - elastic.a, v.a, (force.b - elastic.b) * v.b) +
                              fma(force.c - elastic.c, v.c, (force.d - elastic.d) * v.d);
        this->elastic_power = fma(elastic.a, v.a, elastic.b * v.b) + fma(elastic.c, v.c, elastic.d * v.d);
        auto const a = depth.a > zero, b = depth.b > zero, c = depth.c > zero, d = depth.d > zero;
        auto const upper = a & d, lower = b & c;
        this->surfaces = count<Real>(upper) + count<Real>(lower);
        this->points =
            (count<Real>(a & !upper) + count<Real>(d & !upper)) + (count<Real>(b & !lower) + count<Real>(c & !lower));
    }
};

/// All that a state of the planar slider-crank tells beside its derivative.
/// @tparam Contact a PlanarContact, or more
template <class Real, class Contact> struct PlanarReportOf : MechanismReport<Real> {
    static constexpr int apices = 0;  // corners, of which no quantity tells one by one
    Contact contact;
    Real y, vy;  // slider's centre

    /// The pitch is the only angle that is not 0 [rad].
    SLIDEWAY_FN static Real tilt(Real const* state, int axis) { return axis == 2 ? state[2] : Real(0.0); }

    /// Value of an entry of `series_table` beyond the state.
    SLIDEWAY_FN Real series_value(int entry) const {
        auto const series = static_cast<Series>(entry);
        return series == Series::y ? y : series == Series::vy ? vy : this->common_series(series, contact);
    }

    SLIDEWAY_FN static Real distance_error(Real d, Real ya, Real y, Real rod_length) {
        return MechanismReport<Real>::error_of(d, ya, y, Real(0.0), rod_length);
    }
};

template <class Real> struct PlanarReport : PlanarReportOf<Real, PlanarContact<Real>> {};

}  // namespace slideway::inline SLIDEWAY_ISA
