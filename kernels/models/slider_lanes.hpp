#pragma once

#include "kernels/mechanisms/no_memory.hpp"
#include "kernels/mechanisms/slider_base.hpp"
#include "kernels/observers/acceleration_record.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/observers/slider_observer.hpp"
#include "kernels/steppers/mode_locator.hpp"
#include "kernels/steppers/no_watch.hpp"
#include "kernels/steppers/touch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the lanes need of every mechanism with a slider in a clearance joint beside its equations (kernels/integrate.hpp).
/// @tparam conserving of its law: it makes no energy.
template <bool conserving> struct SliderLanes {
    static constexpr int series = series_count;
    static constexpr int events = 0;
    static constexpr bool has_patterns = true;
    static constexpr bool has_shadows = false;
    static constexpr bool has_crossings = true;
    static constexpr bool has_linearisation = true;
    template <class Real> using Observer = SliderObserver<Real, conserving>;
    template <class Real> using Accelerations = AccelerationRecord<Real>;

    /// Largest of the squared velocities and rates, each in its scale.
    template <class Real> SLIDEWAY_HD static Real squared_speed(Real const* state, Real const* scale) {
        Real largest(0.0);
        for (int i : {2, 3, 7, 8, 9}) {
            Real const speed = state[i] / scale[i];
            largest = max(largest, speed * speed);
        }
        return largest;
    }

    /// An impact speed as it may be remembered: a shadow's is carried on from the member's.
    template <class Real> SLIDEWAY_HD static Real remembered(Real speed) {
        return max(speed, Real(least_impact_speed));
    }

    /// Members whose energy audit says that their method left its stable range.
    template <class Real>
    SLIDEWAY_HD static Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, SliderParameters<Real> const& p) {
        return slideway::left_stable_range(audit, SliderBase::energy_scale(p));
    }
};

/// What finds the events that a slider's memory records.
/// @tparam partings where the law switches at the partings that the memory does not record
template <class Memory, bool partings> struct SliderWatch;
template <class Real, bool partings> struct SliderWatch<ImpactMemory<Real>, partings> {
    using Type = TouchLocator<Real, partings>;
};
template <class Real, bool partings> struct SliderWatch<HeldContacts<Real>, partings> {
    using Type = ModeLocator<Real>;
};
template <class Real, bool partings> struct SliderWatch<NoMemory<Real>, partings> { using Type = NoWatch<Real>; };

/// A mechanism as the lanes integrate it: its equations and what they need beside them.
template <class Mechanism> struct SliderModel : Mechanism, SliderLanes<Mechanism::conserving> {
    template <class Real> using Watch = typename SliderWatch<typename Mechanism::template Memory<Real>, false>::Type;
    template <class Real>
    using ShadowWatch = typename SliderWatch<typename Mechanism::template Memory<Real>, !Mechanism::conserving>::Type;
};

}  // namespace slideway::inline SLIDEWAY_ISA
