// Which keys of [integrator] count with which method, and how many steps a fixed one makes.
#pragma once

#include <string_view>

#include "host/scene/descriptors.hpp"
#include "kernels/block.hpp"

namespace slideway {

/// Whether a method reads the key of [integrator] with this name.  A mechanism without faces has no stiff method, which `auto` could
/// change over to, and no modes.
bool has_effect(std::string_view key, Method method, MechanismInfo const& mechanism);

/// Steps of a member that reaches its end by `fixed_step`; a whole number.
double fixed_steps(IntegratorSettings const& settings);

}  // namespace slideway
