#pragma once

#include "kernels/mechanisms/planar_report.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/rigid_memory.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What touches of the planar slider where it is rigid: forces of lasting contact, and by how much its conditions hold.
template <class Real> struct RigidPlanarContact : PlanarContact<Real> {
    Quad<Real> watched[1];  // depth of each corner that is not held [m]; of one that is, far below 0
    Real pressure[2];       // of the contact held in front and behind over the force scale: it opens below 0; 1 without one
    Real grip[2];           // it slips the other way, or not at all, or does not stick any longer, below 0; 1 without one
    ImpactBooks<Real> books;  // of the last impact

    /// Modes begin and end at the ends of steps.
    SLIDEWAY_FN static Real deepest() { return Real(0.0); }
    /// @param closed whether the corner in front and the one behind last, each at the wall of its side
    SLIDEWAY_FN void count_modes(Mask<Real> const (&closed)[2], Real const (&side)[2]) {
        auto const both = closed[0] & closed[1] & (side[0] == side[1]);
        this->surfaces = slideway::count<Real>(both);
        this->points = slideway::count<Real>(closed[0] & !both) + slideway::count<Real>(closed[1] & !both);
    }
};

template <class Real> struct RigidPlanarReport : PlanarReportOf<Real, RigidPlanarContact<Real>> {};

}  // namespace slideway::inline SLIDEWAY_ISA
