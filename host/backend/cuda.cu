// The kernels on a card: each CUDA thread runs the lane program of one lane, and takes the next member from the block's queue when its
// own has ended.  Compiled once per list of slider-cranks (CMakeLists.txt here), for the assembler gives up sharing out registers
// between functions where a unit has many; cuda_backend.cpp launches.  No physics: that is the processor's.
#include "host/backend/cuda_kernels.hpp"
#include "kernels/grid_thread.hpp"
#include "kernels/integrate.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/models/shadowed.hpp"
#include "kernels/models/slider_crank_choice.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Cranks> __global__ void __launch_bounds__(threads_per_block) integrate_members(GridTask task) {
    run_thread(task, [&](Block& block) { integrate<Cranks, double>(block, chosen_of<Cranks>(task.parts)); });
}

template <class Cranks> __global__ void __launch_bounds__(threads_per_block) integrate_shadowed(GridTask task) {
    run_thread(task, [&](Block& block) {
        integrate<Shadowed<Cranks>, double>(block, Shadowed<Cranks>{chosen_of<Cranks>(task.parts)});
    });
}

using Cranks = SLIDEWAY_CRANKS_OF<SLIDEWAY_LAW>;  // one of the two lists of each law

}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

CudaKernels SLIDEWAY_KERNELS() {
    return {reinterpret_cast<void const*>(&integrate_members<Cranks>),
            reinterpret_cast<void const*>(&integrate_shadowed<Cranks>)};
}

}  // namespace slideway
