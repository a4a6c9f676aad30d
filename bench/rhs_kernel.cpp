// Compiled once per instruction set, and once more with a number that counts operations.
#include "bench/rhs_kernel.hpp"

#include "kernels/isa_real.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/one_law.hpp"
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

using Model = SliderCrank;

struct Pack {
    SliderParameters<Real> parameters;
    ContactMemory<Real> memory;
    Real time, state[Model::size], rates[Model::size];
    SliderReport<Real> report;
};

void load(void* to, Inputs const* members, double const* times, std::size_t count) {
    auto* const packs = static_cast<Pack*>(to);
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

/// As the lanes call it: the law behind a pointer, friction and way by conditions.
template <class Law, bool full> void evaluate(void* at, std::size_t count, int in_a_row, int passes) {
    using Laws = LawFunctions<Real>;
    Conditions<Laws> const block(Laws::template of<Law, PointDamping>(), Law::info.switches, {.friction = true});
    auto* const packs = static_cast<Pack*>(at);
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < count / lanes<Real>; ++i) {
            auto& pack = packs[i];
            for (int time = 0; time < in_a_row; ++time) {
                Model::derivative<full>(pack.time, pack.state, pack.parameters, pack.memory, block, pack.rates, &pack.report);
            }
        }
    }
}

template <class Law> RhsKernel kernel() {
    return {lanes<Real>, sizeof(Pack), &load, {&evaluate<Law, false>, &evaluate<Law, true>}};
}

}  // namespace

RhsKernels rhs_kernels() { return {kernel<PaperLaw>(), kernel<ConservativeLaw>()}; }

#if defined(SLIDEWAY_COUNTED)
std::uint64_t operations() { return Counted::operations; }
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
