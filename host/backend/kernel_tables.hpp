// The machine code of laws and mechanisms, of one instruction set each: linked in, or in a module (kernel_module.hpp).
#pragma once

#include "kernels/block.hpp"
#include "kernels/laws/law_info.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

/// A contact law.
struct LawKernels {
    LawInfo const* info = nullptr;      // its functions are of this instruction set
    bool with[damping_count] = {};      // which dampings it has
    void const* table = nullptr;        // LawTable<IsaReal> of the unit (kernels/laws/law_table.hpp)
};

/// A mechanism, for all that a scene may choose.  A law is not asked for where contacts are rigid.
struct MechanismKernels {
    MechanismInfo const* info = nullptr;  // its functions are of this instruction set; none of rigid contacts
    void (*run)(Block&, Parts const&, LawKernels const*) = nullptr;
    /// Members with shadows; none of a mechanism that has no exponents.  Of rigid contacts they have a table of their own, which has nothing else.
    void (*run_shadowed)(Block&, Parts const&, LawKernels const*) = nullptr;
    void (*probe)(ProbeTable const&, Parts const&, LawKernels const*) = nullptr;
    LinkagePlan const* linkage = nullptr;  // that the compiler knew
};

/// The kernels of a scene's parts.
struct KernelInstance {
    MechanismKernels const* kernels = nullptr;
    LawKernels const* law = nullptr;
    Parts parts;

    void run(Block& block) const { kernels->run(block, parts, law); }
    void run_shadowed(Block& block) const { kernels->run_shadowed(block, parts, law); }
    void probe(ProbeTable const& states) const { kernels->probe(states, parts, law); }
};

}  // namespace slideway
