// Linkages, equations and lanes, of members without shadows or with them: a unit each per instruction set (CMakeLists.txt here).  Their plans are looked up;
// that which SLIDEWAY_HEADER has as SLIDEWAY_LINKAGE the compiler knows (module_compiler.cpp).
#include "host/backend/kernel_tables.hpp"
#include "kernels/integrate.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/linkage/linkage_model.hpp"
#include "kernels/models/probe.hpp"
#include "kernels/models/shadowed.hpp"
#ifdef SLIDEWAY_HEADER
#include SLIDEWAY_HEADER
#endif

namespace slideway::inline SLIDEWAY_ISA {

#ifdef SLIDEWAY_HEADER
using Model = LinkageModel<PlanConstant<SLIDEWAY_LINKAGE>>;
static constexpr LinkagePlan const* known_plan = &SLIDEWAY_LINKAGE::plan;
#else
using Model = LinkageModel<PlanTable>;
static constexpr LinkagePlan const* known_plan = nullptr;
#define SLIDEWAY_TABLE linkage_kernels
#endif

#if SLIDEWAY_SHADOWED
void run_shadowed_linkages(Block& block, Parts const& parts, LawKernels const*) { integrate<Shadowed<Model>, IsaReal>(block, {Model(parts)}); }
#else
void run_shadowed_linkages(Block& block, Parts const& parts, LawKernels const*);

extern constinit MechanismKernels const SLIDEWAY_TABLE = {
    .run = [](Block& block, Parts const& parts, LawKernels const*) { integrate<Model, IsaReal>(block, Model(parts)); },
    .run_shadowed = &run_shadowed_linkages,
    .probe = [](ProbeTable const& states, Parts const& parts, LawKernels const*) { probe<Model, IsaReal>(states, Model(parts)); },
    .linkage = known_plan,
};
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
