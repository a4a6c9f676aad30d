#pragma once

#include "kernels/block.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What an observer of events alone leaves at its plainest: it looks at no accepted step and asks for no integral.
template <class Real> struct PlainObserver {
    static constexpr int integrals = 0, first_audited = 0, audit_integrals = 0, of_loads = 0, powers = 0, peaks = 0;
    static constexpr Selection audit_quantities = 0;

    SLIDEWAY_HD static constexpr bool needs_stages(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool audits(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool needs_reports(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool needs_peaks(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool integrates_more(Selection) { return true; }
    template <class Report> SLIDEWAY_FN static void integrands(Report const&, Real*) {}
    template <class Report> SLIDEWAY_FN static void powers_of(Report const&, Real*) {}
    SLIDEWAY_FN Real integral(int) const { return Real(0.0); }
    template <class Report> SLIDEWAY_FN static void take_impulses(Mask<Real>, Report const&) {}
    template <class Report>
    SLIDEWAY_FN void accept(Mask<Real>, Real, Real const*, Report const&, Real const*, bool) {}
};

}  // namespace slideway::inline SLIDEWAY_ISA
