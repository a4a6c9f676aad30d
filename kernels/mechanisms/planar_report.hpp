#pragma once

#include "kernels/joint/contact_totals.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/mechanisms/mechanism_report.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Adds what the four corners of a block come to: a wall that both its corners touch is a surface, other touching corners are points.
/// @param potential_share 1/(n + 1)
template <class Real>
SLIDEWAY_FN void add_corners(ContactTotals<Real>& totals, Quad<Real> const& force, Quad<Real> const& elastic, Quad<Real> const& depth, Quad<Real> const& rate,
                             Real potential_share) {
    Real const zero(0.0);
    Real const stored = fma(elastic.a, max(depth.a, zero), elastic.b * max(depth.b, zero)) +
                        fma(elastic.c, max(depth.c, zero), elastic.d * max(depth.d, zero));
    totals.potential = fma(potential_share, stored, totals.potential);
    totals.damping_power = totals.damping_power + (fma(force.a - elastic.a, rate.a, (force.b - elastic.b) * rate.b) +
                                                   fma(force.c - elastic.c, rate.c, (force.d - elastic.d) * rate.d));
    totals.elastic_power = totals.elastic_power + (fma(elastic.a, rate.a, elastic.b * rate.b) + fma(elastic.c, rate.c, elastic.d * rate.d));
    auto const a = depth.a > zero, b = depth.b > zero, c = depth.c > zero, d = depth.d > zero;
    auto const upper = a & d, lower = b & c;
    totals.surfaces = totals.surfaces + (count<Real>(upper) + count<Real>(lower));
    totals.points =
        totals.points + ((count<Real>(a & !upper) + count<Real>(d & !upper)) + (count<Real>(b & !lower) + count<Real>(c & !lower)));
}

/// What touches of the planar slider.  Corners as (s3 along X, s1 along Y): a (+,+), b (+,−), c (−,−), d (−,+).
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
        normal_force[0] = force;
        add_corners(*this, force, elastic, penetration[0], rate[0], potential_share);
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
