#pragma once

#include "kernels/lanes/report_needs.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Where a step starts: a member, or a shadow of it.
template <class Model, class Real> struct StepStart {
    Real const& t;  // [s]
    Real const* y;
    Real const* rates;
    typename Model::template Memory<Real> const& memory;
    ReportNeeds needs;
};

/// What a step that was tried comes to.
template <class Model, class Real> struct Attempt {
    Real step;  // [s]
    Real end[Model::size], end_rates[Model::size];
    typename Model::template Report<Real> report;  // at the end, if needs.ends
    Faults<Real> faults;
};

/// What one of those who may shorten a step says of it.
template <class Real> struct Allowance {
    Mask<Real> accepted;
    Real next;  // the step to try next [s], of a method with clocks by the step's clock
};

/// Lanes whose numbers are all finite.
template <class Real> SLIDEWAY_HD Mask<Real> is_finite(Real const* a, Real const* b, int n) {
    Real sum(0.0);
    for (int i = 0; i < n; ++i) sum = fma(a[i], Real(0.0), fma(b[i], Real(0.0), sum));
    return sum == Real(0.0);
}

}  // namespace slideway::inline SLIDEWAY_ISA
