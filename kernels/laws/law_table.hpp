#pragma once

#include "kernels/laws/law_info.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A law compiled: its functions with each of its dampings.
template <class Real> struct LawTable {
    LawFunctions<Real> with[damping_count];  // empty where the law has no such damping
    bool switches = false;

    template <class Law> static constexpr LawTable of() {
        LawTable table;
        if constexpr (Law::info.has(Damping::point)) {
            table.with[static_cast<int>(Damping::point)] = LawFunctions<Real>::template of<Law, PointDamping>();
        }
        if constexpr (Law::info.has(Damping::rate)) {
            table.with[static_cast<int>(Damping::rate)] = LawFunctions<Real>::template of<Law, RateDamping>();
        }
        if constexpr (Law::info.has(Damping::restitution)) {
            table.with[static_cast<int>(Damping::restitution)] = LawFunctions<Real>::template of<Law, RestitutionDamping>();
        }
        table.switches = Law::info.switches;
        return table;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
