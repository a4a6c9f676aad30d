#pragma once

#include "kernels/mechanisms/drive.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Nothing drives the slider: x and vx join the state, behind the ten.
struct NoDrive : DrivenGuide<NoDrive> {
    using Base = FreeSliderBase;
    static constexpr bool is_free = true;
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "free_slider";
        info.meaning = "slider that nothing drives, free along the way too";
        info.states = 12;
        info.state[10] = Series::x;
        info.state[11] = Series::vx;
        info.always = selections::twelve_states;
        info.quantities &= ~selection_of(Quantity::drive_work);
        info.keys |= groups_of(KeyGroup::along, KeyGroup::body);
        info.has_exponents = false;  // nothing repeats itself
        return info;
    }();

    /// Without the acceleration, which the forces give.
    template <class Real> SLIDEWAY_FN static AlongWay<Real> motion(Real, Real const* s, SliderParameters<Real> const&, DrivePlan const&) {
        return {s[10], s[11], Real(0.0)};
    }
};

using FreeSlider = SpatialSlider<NoDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA
