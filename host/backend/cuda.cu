// The kernels on a card: each CUDA thread runs the lane program of one lane, and takes the next member from the block's queue when its
// own has ended.  One kernel serves members alone and one members with shadows, both of every law; cuda_backend.cpp launches.  No
// physics: that is the processor's.
#include "host/backend/cuda_kernels.hpp"
#include "kernels/grid_thread.hpp"
#include "kernels/integrate.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/models/every_law.hpp"
#include "kernels/models/mechanism_model.hpp"
#include "kernels/models/shadowed.hpp"

namespace slideway::inline SLIDEWAY_ISA {

using Cranks = MechanismModel<SliderCrank, SliderCrank::Base, EveryLaw>;

template <class Model> __global__ void __launch_bounds__(threads_per_block) integrate_members(GridTask task) {
    run_thread(task, [&](Block& block) {
        integrate<Model, double>(block, Model{Cranks(conditions_with_every_law(task.parts))});
    });
}

}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

CudaKernels cuda_kernels() {
    return {reinterpret_cast<void const*>(&integrate_members<Cranks>),
            reinterpret_cast<void const*>(&integrate_members<Shadowed<Cranks>>)};
}

}  // namespace slideway
