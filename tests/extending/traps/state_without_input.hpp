// A mechanism with a component of its state that starts from no input.
#pragma once

#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

struct Forgotten {
    static constexpr int size = 11;
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "forgotten";
        info.states = size;
        info.state[10] = Series::rod_angle;
        return info;
    }();
};

}  // namespace slideway
