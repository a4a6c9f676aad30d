// Which machine code runs a block: the kernels are compiled once per instruction set, and a scene picks its
// instance once, before the run.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/backend/instance_table.hpp"
#include "kernels/block.hpp"

namespace slideway {

/// scalar is one member at a time with fused multiply-add; sse2 runs on every x86-64 machine and has no FMA, so its
/// bits differ from the others', which all agree.
enum class Isa { scalar, sse2, avx2, avx512 };

std::string_view name_of(Isa isa);
int lanes_of(Isa isa);
bool is_supported(Isa isa);  // by this machine
Isa best_isa();              // the widest that this machine supports
std::span<Isa const> all_isas();
std::string flags_of(Isa isa);  // compiler flags the unit was built with

/// @throws std::out_of_range never: every combination of parts exists for every ISA.
KernelInstance find_instance(Isa isa, Parts const& parts);

}  // namespace slideway
