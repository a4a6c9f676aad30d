// Compiled once per instruction set, and once more with a number that counts operations.
#include "bench/rhs_kernel.hpp"

#include "host/backend/isa_real.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#if defined(SLIDEWAY_COUNTED)
#include "bench/counted_real.hpp"
#endif

namespace slideway::inline SLIDEWAY_ISA {
namespace {

#if defined(SLIDEWAY_COUNTED)
using Real = Counted;
#else
using Real = IsaReal;
#endif

template <class Model> struct Pack {
    typename Model::template Parameters<Real> parameters;
    typename Model::template Memory<Real> memory;
    Real time, state[Model::size], rates[Model::size];
    typename Model::template Report<Real> report;
};

template <class Model> void load(void* to, Inputs const* members, double const* times, std::size_t count) {
    auto* const packs = static_cast<Pack<Model>*>(to);
    for (std::size_t member = 0; member < count; ++member) {
        auto& pack = packs[member / lanes<Real>];
        int const index = static_cast<int>(member % lanes<Real>);
        load_lane(pack.parameters, index, Model::parameters(members[member]));
        double start[Model::size];
        Model::initial_state(members[member], start);
        for (int i = 0; i < Model::size; ++i) set_lane(pack.state[i], index, start[i]);
        set_lane(pack.time, index, times[member]);
        start_memory(pack.memory);
    }
}

template <class Model, bool full> void evaluate(void* at, std::size_t count, int in_a_row, int passes) {
    auto* const packs = static_cast<Pack<Model>*>(at);
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < count / lanes<Real>; ++i) {
            auto& pack = packs[i];
            for (int time = 0; time < in_a_row; ++time) {
                Model::template derivative<full>(pack.time, pack.state, pack.parameters, pack.memory, pack.rates,
                                                 &pack.report);
            }
        }
    }
}

template <class Law> RhsKernel kernel() {
    using Model = SliderCrank<Law, StickSlipFriction, AlignedWay, PointDamping>;
    return {lanes<Real>, sizeof(Pack<Model>), &load<Model>, {&evaluate<Model, false>, &evaluate<Model, true>}};
}

}  // namespace

RhsKernels rhs_kernels() { return {kernel<PaperLaw>(), kernel<ConservativeLaw>()}; }

#if defined(SLIDEWAY_COUNTED)
std::uint64_t operations() { return Counted::operations; }
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
