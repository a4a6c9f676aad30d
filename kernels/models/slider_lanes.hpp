#pragma once

#include "kernels/mechanisms/slider_base.hpp"
#include "kernels/observers/acceleration_record.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/observers/signal_observer.hpp"
#include "kernels/observers/slider_observer.hpp"
#include "kernels/steppers/contact_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the lanes need of a mechanism beside its equations (kernels/lanes/model.hpp): of all that share a base.
template <class Base> struct LanesOf;

/// What is alike in the lanes of all mechanisms with a slider.  @tparam Base has an `energy_scale`
template <class Base> struct ContactLanes {
    static constexpr int series = series_count;
    static constexpr bool has_contacts = true;
    static constexpr bool has_shadows = false;
    static constexpr bool has_crossings = true;
    static constexpr bool tells_forces = false;  // of faces and pins
    template <class Real> using Accelerations = AccelerationRecord<Real>;

    /// An impact speed as it may be remembered: a shadow's is carried on from the member's.
    template <class Real> SLIDEWAY_HD static Real remembered(Real speed) { return max(speed, Real(least_impact_speed)); }

    /// Members whose energy audit says that their method left its stable range.
    template <class Parameters, class Real>
    SLIDEWAY_HD static Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, Parameters const& p) {
        return slideway::left_stable_range(audit, Base::energy_scale(p));
    }
};

/// Of a slider with eight apices.
template <class Base> struct SpatialLanes : ContactLanes<Base> {
    static constexpr bool has_patterns = true;
    static constexpr bool has_linearisation = true;
    static constexpr bool tells_forces = true;
    template <class Real> using Observer = SliderObserver<Real>;
    template <class Real> using Memory = ContactMemory<Real>;
    template <class Real> using Watch = ContactWatch<Real>;

    /// Largest of the squared velocities and rates, each in its scale.
    template <class Real> SLIDEWAY_HD static Real squared_speed(Real const* state, Real const* scale) {
        Real largest(0.0);
        for (int i : {2, 3, 7, 8, 9}) {
            Real const speed = state[i] / scale[i];
            largest = max(largest, speed * speed);
        }
        return largest;
    }
};

template <> struct LanesOf<SliderBase> : SpatialLanes<SliderBase> {};

/// What the lanes need of a mechanism that has signals of its own, or NoSignals.
template <class Base, class Signals> struct SignalLanes : LanesOf<Base> {
    static constexpr int series = LanesOf<Base>::series + Signals::count;
    template <class Real> using Report = SignalReport<Real, typename Base::template Report<Real>, Signals::count>;
    template <class Real> using Observer = SignalObserver<Real, typename LanesOf<Base>::template Observer<Real>, Signals>;
};
template <class Base> struct SignalLanes<Base, NoSignals> : LanesOf<Base> {
    template <class Real> using Report = typename Base::template Report<Real>;
};

}  // namespace slideway::inline SLIDEWAY_ISA
