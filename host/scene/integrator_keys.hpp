// Which keys of [integrator] count with which method, and how many steps a fixed one makes.
#pragma once

#include <string_view>

#include "kernels/block.hpp"

namespace slideway {

/// Whether a method reads the key of [integrator] with this name.  The planar mechanism has no stiff method, which `auto` could
/// change over to, and no modes.
constexpr bool has_effect(std::string_view key, Method method, Mechanism mechanism) {
    if (mechanism == Mechanism::planar_slider_crank &&
        (key == "stiff_tolerance" || key == "stiff_max_step" || key == "locate_modes")) {
        return false;
    }
    bool const fixed = method == Method::rk4;
    if (key == "step") return fixed;
    if (key == "rtol" || key == "atol" || key == "max_step") return !fixed;
    if (key == "stiff_tolerance" || key == "stiff_max_step") {
        return method == Method::automatic || method == Method::ros34pw2;
    }
    if (key == "locate_modes") return !fixed && method != Method::ros34pw2;
    return true;
}

/// Steps of a member that reaches its end by `fixed_step`; a whole number.
double fixed_steps(IntegratorSettings const& settings);

}  // namespace slideway
