#pragma once

#include "kernels/mechanisms/planar_slider_crank.hpp"
#include "kernels/observers/acceleration_record.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/observers/slider_observer.hpp"
#include "kernels/steppers/no_watch.hpp"
#include "kernels/steppers/touch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the lanes need of the planar slider-crank beside its equations.  Its contacts are points, which no stiff method need serve, and
/// all four cost less than to group members by them.
struct PlanarLanes {
    static constexpr int series = series_count;
    static constexpr int events = 0;
    static constexpr bool has_patterns = false;
    static constexpr bool has_shadows = false;
    static constexpr bool has_crossings = true;
    static constexpr bool has_linearisation = false;
    template <class Real> using Observer = SliderObserver<Real, true, PlanarReport>;
    template <class Real> using Accelerations = AccelerationRecord<Real>;

    /// Members whose energy audit says that their method left its stable range.
    template <class Real>
    SLIDEWAY_HD static Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, PlanarParameters<Real> const& p) {
        return slideway::left_stable_range(audit, PlanarBase::energy_scale(p));
    }
};

/// A planar slider-crank whose equations are looked up: the lanes are compiled once for all that leave the same memory.
template <class Real, template <class> class Memory_> struct PlanarTable : PlanarBase, PlanarLanes {
    template <class Number> using Memory = Memory_<Number>;
    static constexpr bool has_memory = std::is_same_v<Memory<Real>, CornerMemory<Real>>;
    template <class Number>
    using Watch = std::conditional_t<has_memory, TouchLocator<Number, false, 1>, NoWatch<Number>>;

    using Derivative = Faults<Real>(Real, Real const*, PlanarParameters<Real> const&, Memory<Real> const&, Real*,
                                    PlanarReport<Real>*);
    Derivative* lean;
    Derivative* full;
    Real (*corner_gap)(Real, Real const*, PlanarParameters<Real> const&, bool, int);

    /// The table of one `PlanarSliderCrank`.
    template <class Mechanism> static constexpr PlanarTable of() {
        PlanarTable table{};
        table.lean = &Mechanism::template derivative<false, Real>;
        table.full = &Mechanism::template derivative<true, Real>;
        table.corner_gap = &Mechanism::template gap<Real>;
        return table;
    }

    template <bool Full>
    Faults<Real> derivative(Real t, Real const* state, PlanarParameters<Real> const& p, Memory<Real> const& memory,
                            Real* rates, PlanarReport<Real>* report) const {
        return (Full ? full : lean)(t, state, p, memory, rates, report);
    }
    Real gap(Real t, Real const* state, PlanarParameters<Real> const& p, bool z_faces, int corner) const {
        return corner_gap(t, state, p, z_faces, corner);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
