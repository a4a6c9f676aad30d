// A mechanism with rigid contacts: equations, impacts and lanes in one unit, compiled once per instruction set (CMakeLists.txt here).
#include "host/backend/mechanism_kernels.hpp"
#include "kernels/integrate.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/mechanisms/probe.hpp"
#include SLIDEWAY_HEADER

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Model = SLIDEWAY_MECHANISM;

bool has(Parts const& parts) { return parts.rigid; }
void run(Block& block, Parts const& parts) { integrate<Model, IsaReal>(block, Model(parts)); }
void probe_states(ProbeTable const& states, Parts const& parts) { probe<Model, IsaReal>(states, Model(parts)); }

}  // namespace

extern constinit MechanismKernels const SLIDEWAY_TABLE = {&has, &run, nullptr, &probe_states};

}  // namespace slideway::inline SLIDEWAY_ISA
