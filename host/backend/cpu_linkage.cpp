// Linkages, equations and lanes, of members without shadows or with them: a unit each per instruction set (CMakeLists.txt here).
#include "host/backend/kernel_tables.hpp"
#include "kernels/integrate.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/linkage/linkage_model.hpp"
#include "kernels/models/probe.hpp"
#include "kernels/models/shadowed.hpp"

namespace slideway::inline SLIDEWAY_ISA {

#if SLIDEWAY_SHADOWED
void run_shadowed_linkages(Block& block, Parts const& parts, LawKernels const*) {
    using Model = Shadowed<LinkageModel>;
    integrate<Model, IsaReal>(block, Model{LinkageModel(parts)});
}
#else
void run_shadowed_linkages(Block& block, Parts const& parts, LawKernels const*);

extern constinit MechanismKernels const linkage_kernels = {
    .run = [](Block& block, Parts const& parts, LawKernels const*) { integrate<LinkageModel, IsaReal>(block, LinkageModel(parts)); },
    .run_shadowed = &run_shadowed_linkages,
    .probe = [](ProbeTable const& states, Parts const& parts, LawKernels const*) { probe<LinkageModel, IsaReal>(states, LinkageModel(parts)); },
};
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
