#pragma once

#include "kernels/block.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Records the first state component at a model's events: `transient` events are counted only, the next `kept` are recorded, and
/// then the member has come to its end.
template <class Real, int transient, int kept> class EventRecorder {
public:
    static constexpr int integrals = 0, audit_integrals = 0;
    static constexpr int columns = kept;

    static constexpr Selection audit_quantities = 0;
    SLIDEWAY_HD static constexpr bool needs_stages(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool audits(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool needs_reports(Selection) { return false; }
    template <class Report> SLIDEWAY_FN static void integrands(Report const&, Real*) {}
    SLIDEWAY_FN Real integral(int) const { return Real(0.0); }

    template <class Report> SLIDEWAY_FN void start(Mask<Real> fresh, Report const&, Real const*, bool) {
        count_ = select(fresh, Real(0.0), count_);
    }
    template <class Report>
    SLIDEWAY_FN void accept(Mask<Real>, Real, Real const*, Report const&, Real const*, bool) {}

    /// An event in the lanes of the mask.
    SLIDEWAY_HD void event(Mask<Real> at, int, Real, Real const* state) {
        auto const recorded = at & (count_ >= Real(static_cast<double>(transient)));
        if (any(recorded)) record(recorded, state[0]);
        count_ = count_ + slideway::count<Real>(at);
    }

    /// Lanes that have come to rest: every event still to come is at the present state.
    SLIDEWAY_HD void settle(Mask<Real> at, Real const* state) {
        if (none(at)) return;
        count_ = select(at, max(count_, Real(static_cast<double>(transient))), count_);
        for (auto left = at & !complete(); any(left); left = at & !complete()) event(left, 0, Real(0.0), state);
    }

    SLIDEWAY_FN Mask<Real> complete() const { return count_ >= Real(static_cast<double>(transient + kept)); }

    /// Writes what one lane has recorded; what it has not is NaN.
    SLIDEWAY_HD void finish(int index, double, Selection, double* row) const {
        auto const recorded = static_cast<int>(lane(count_, index)) - transient;
        for (int i = 0; i < kept; ++i) row[i] = i < recorded ? lane(value_[i], index) : not_a_number;
    }

private:
    SLIDEWAY_HD void record(Mask<Real> at, Real value) {
        for (int i = 0; i < lanes<Real>; ++i) {
            if (!holds(at, i)) continue;
            auto const place = static_cast<int>(lane(count_, i)) - transient;
            if (place < kept) set_lane(value_[place], i, lane(value, i));
        }
    }

    Real count_;
    Real value_[kept > 0 ? kept : 1];
};

}  // namespace slideway::inline SLIDEWAY_ISA
