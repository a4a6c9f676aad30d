#pragma once

#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/slider_base.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A slider whose crank turns as forces let it: behind the ten numbers of the state its angle θ and speed θ'.
struct CrankStateBase : SliderBase {
    static constexpr int size = 12;
    SLIDEWAY_HD static constexpr int state_of_series(int series) {
        if (series == static_cast<int>(Series::crank_angle)) return 10;
        if (series == static_cast<int>(Series::crank_angular_velocity)) return 11;
        return SliderBase::state_of_series(series);
    }
    template <class Real> SLIDEWAY_FN static void scales(SliderParameters<Real> const& p, Real* scale) {
        SliderBase::scales(p, scale);
        scale[10] = p.length_scale_y / p.crank_length;
        scale[11] = scale[10] * p.rate_scale;
    }
    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        SliderBase::initial_state(in, s);
        s[10] = in.start_angle;
        s[11] = in.crank_speed;
    }
};

/// What such a mechanism is, from the one whose crank is driven.
constexpr MechanismInfo crank_state_info(MechanismInfo info, char const* name) {
    info.driven_form = info.name;
    info.name = name;
    info.states = 12;
    info.state[10] = Series::crank_angle;
    info.state[11] = Series::crank_angular_velocity;
    info.series |= selections::of({Series::crank_angle, Series::crank_angular_velocity});
    info.always |= selections::of({Series::crank_angle, Series::crank_angular_velocity});
    info.keys |= groups_of(KeyGroup::turning);
    info.may_turn_freely = true;
    info.on_cards = false;
    return info;
}

}  // namespace slideway::inline SLIDEWAY_ISA
