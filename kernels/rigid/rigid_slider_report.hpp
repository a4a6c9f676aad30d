#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_scales.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What touches of a slider whose joint is rigid.
template <class Real> struct RigidJointContact : ContactReport<Real> {
    Quad<Real> watched[face_count];  // depth of each pair that is not held [m]; of one that is, far below 0
    Quad<Real> slip[2][face_count];  // of each pair that is held, along both directions [slip units]
    Quad<Real> slides[face_count];   // 1 where it slips, −1 where it sticks, 0 where it is not held
    ApexLoads<Real> loads;
    ImpactBooks<Real> books;         // of the last impact

    /// Modes begin and end at the ends of steps.
    SLIDEWAY_FN static Real deepest() { return Real(0.0); }

    /// How long ago the slips of pairs that have just come to rest still were slips [s]; 0 where none has.  @param flow how they change with time
    template <class Numbers> SLIDEWAY_HD Real since_slip(Numbers const& flow) const {
        Real since(0.0);
        for (int i = 0; i < 4 * face_count; ++i) {
            Real const a[2] = {number_of(flow.slip[0], i).slope, number_of(flow.slip[1], i).slope}, rate = sqrt(fma(a[0], a[0], a[1] * a[1]));
            auto const stops = has_stopped(i) & (rate > Real(0.0));
            since = max(since, select(stops, Real(4 * slip_stops) / select(stops, rate, Real(1.0)), Real(0.0)));
        }
        return since;
    }

    /// Has a function see how the slips of pairs end a step: lanes where one has come to rest, and where one that stuck slips again, with the
    /// delay of those who are off [s].
    /// @param flow how slips change with time  @param change and along an offset
    template <class Numbers, class See> SLIDEWAY_HD void each_slip(Numbers const& flow, Numbers const& change, See const& see) const {
        Real const zero(0.0), one(1.0);
        for (int i = 0; i < 4 * face_count; ++i) {
            Real const kind = number_of(slides, i), v[2] = {number_of(slip[0], i), number_of(slip[1], i)};
            Real const a[2] = {number_of(flow.slip[0], i).slope, number_of(flow.slip[1], i).slope};
            Real const d[2] = {number_of(change.slip[0], i).slope, number_of(change.slip[1], i).slope};
            Real const square = fma(v[0], v[0], v[1] * v[1]), growth = fma(v[0], a[0], v[1] * a[1]), rates = fma(a[0], a[0], a[1] * a[1]);
            Mask<Real> const stops = has_stopped(i) & (rates > zero);
            Mask<Real> const starts = (kind < zero) & (square >= Real(slip_again * slip_again)) & (growth > zero);
            // One that stops is nearest to rest where it has no part along its acceleration.
            Real const part = select(stops, fma(a[0], d[0], a[1] * d[1]), fma(v[0], d[0], v[1] * d[1]));
            see(stops, starts, negated(part) / select(stops, rates, select(starts, growth, one)));
        }
    }

private:
    /// Whether a pair that slipped is at rest along its face.
    SLIDEWAY_FN Mask<Real> has_stopped(int pair) const {
        Real const first = number_of(slip[0], pair), second = number_of(slip[1], pair);
        return (number_of(slides, pair) > Real(0.0)) & (fma(first, first, second * second) <= Real(slip_stops * slip_stops));
    }
};

template <class Real> struct RigidSliderReport : SliderReportOf<Real, RigidJointContact<Real>> {};

}  // namespace slideway::inline SLIDEWAY_ISA
