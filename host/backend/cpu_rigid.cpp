// A mechanism with rigid contacts: equations and lanes in one unit, compiled once per instruction set (CMakeLists.txt here); and its lanes of
// members with shadows in another.  The contacts of rigid joints are a third, that of all mechanisms (cpu_rigid_joint.cpp).
#include "host/backend/kernel_tables.hpp"
#include "kernels/integrate.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/shadowed.hpp"
#include "kernels/rigid/joint_offset.hpp"
#include "kernels/rigid/rigid_joint.hpp"
#include SLIDEWAY_HEADER

namespace slideway::inline SLIDEWAY_ISA {

// Of cpu_rigid_joint.cpp.
extern template class RigidJoint<IsaReal>;
extern template class RigidJoint<Tangent<IsaReal>>;
extern template class JointOffset<IsaReal>;

using Model = SLIDEWAY_MECHANISM;

namespace {

#if SLIDEWAY_SHADOWED
void run_shadowed(Block& block, Parts const& parts, LawKernels const*) { integrate<Shadowed<Model>, IsaReal>(block, Shadowed<Model>{Model(parts)}); }
#else
void run(Block& block, Parts const& parts, LawKernels const*) { integrate<Model, IsaReal>(block, Model(parts)); }
void probe_states(ProbeTable const& states, Parts const& parts, LawKernels const*) { probe<Model, IsaReal>(states, Model(parts)); }

#endif

}  // namespace

#if SLIDEWAY_SHADOWED
extern constinit MechanismKernels const SLIDEWAY_TABLE = {.run_shadowed = &run_shadowed};
#else
extern constinit MechanismKernels const SLIDEWAY_TABLE = {.run = &run, .probe = &probe_states};
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
