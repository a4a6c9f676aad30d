// The equations of a mechanism: compiled once per instruction set for all laws, frictions and ways (CMakeLists.txt here).
#include "host/backend/cpu_lanes.hpp"
#include "host/backend/cpu_laws.hpp"
#include "host/backend/mechanism_kernels.hpp"
#include "kernels/models/planar_lanes.hpp"
#include SLIDEWAY_HEADER

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Base = SLIDEWAY_BASE;
using Table = IsaTable<Base>;

constexpr auto functions = MechanismFunctions<IsaReal, Base>::of<SLIDEWAY_MECHANISM>();

/// @param parts that it has
Table table_of(Parts const& parts) {
    auto const& law = law_table(parts.law);
    return {functions, {law.with[static_cast<int>(parts.damping)], law.switches, parts}};
}

bool has(Parts const& parts) { return law_table(parts.law).with[static_cast<int>(parts.damping)].normals != nullptr; }
void run(Block& block, Parts const& parts) { run_lanes<Base>(block, table_of(parts)); }
void run_shadowed(Block& block, Parts const& parts) {
    if constexpr (SLIDEWAY_MECHANISM::info.has_exponents) run_shadowed_lanes<Base>(block, table_of(parts));
}
void probe(ProbeTable const& states, Parts const& parts) { probe_states<Base>(states, table_of(parts)); }

}  // namespace

extern constinit MechanismKernels const SLIDEWAY_TABLE = {
    &has, &run, SLIDEWAY_MECHANISM::info.has_exponents ? &run_shadowed : nullptr, &probe};

}  // namespace slideway::inline SLIDEWAY_ISA
