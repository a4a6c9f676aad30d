#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/rigid_memory.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What touches of a slider whose joint is rigid.
template <class Real> struct RigidJointContact : ContactReport<Real> {
    Quad<Real> watched[face_count];  // depth of each pair that is not held [m]; of one that is, far below 0
    Quad<Real> slip[2][face_count];  // of each pair that is held, along both directions [slip scales]
    Quad<Real> slides[face_count];   // 1 where it slips, −1 where it sticks, 0 where it is not held
    ApexLoads<Real> loads;
    ImpactBooks<Real> books;         // of the last impact
};

template <class Real> struct RigidSliderReport : SliderReportOf<Real, RigidJointContact<Real>> {};

}  // namespace slideway::inline SLIDEWAY_ISA
