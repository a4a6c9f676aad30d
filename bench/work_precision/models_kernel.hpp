// What the benchmark asks of each instruction set beside the slider-cranks of the backend.
#pragma once

#include <vector>

#include "bench/work_precision/problem.hpp"
#include "kernels/block.hpp"

namespace slideway {

/// Each instruction set's namespace has one of each: `integrate_lorenz_members`, `integrate_valve_members`, `integrate_bouncing_members`.  They
/// integrate a block whose inputs are the members.
using LorenzMembersRun = void(bench::LorenzMember const* members, BlockBase const& block);
using ValveMembersRun = void(bench::ValveMember const* members, BlockBase const& block);
using BouncingMembersRun = void(bench::BouncingMember const* members, BlockBase const& block);

}  // namespace slideway
