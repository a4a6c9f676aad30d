#pragma once

#include "kernels/block.hpp"

namespace slideway {

/// The machine code of a mechanism, of one instruction set, for all that a scene may choose.
struct MechanismKernels {
    bool (*has)(Parts const&) = nullptr;  // the law of the parts has their damping
    void (*run)(Block&, Parts const&) = nullptr;
    void (*run_shadowed)(Block&, Parts const&) = nullptr;  // members with shadows; none of a mechanism that has no exponents.  Of rigid contacts they have a table of their own, which has nothing else
    void (*probe)(ProbeTable const&, Parts const&) = nullptr;
};

/// The kernels of a scene's parts.
struct KernelInstance {
    MechanismKernels const* kernels = nullptr;
    Parts parts;

    void run(Block& block) const { kernels->run(block, parts); }
    void run_shadowed(Block& block) const { kernels->run_shadowed(block, parts); }
    void probe(ProbeTable const& states) const { kernels->probe(states, parts); }
};

}  // namespace slideway
