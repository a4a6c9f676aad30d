// Compiled once, with the number that counts operations.
#include "bench/engine_flops.hpp"

#include "bench/counted_real.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/mechanisms/slider_crank.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

template <class Law, class Damping> void evaluate(Inputs const& member, double time) {
    using Model = SliderCrank<Law, StickSlipFriction, AlignedWay, Damping>;
    typename Model::template Parameters<Counted> parameters;
    load_lane(parameters, 0, Model::parameters(member));
    typename Model::template Memory<Counted> memory;
    start_memory(memory);
    double start[Model::size];
    Model::initial_state(member, start);
    Counted state[Model::size], rates[Model::size];
    for (int i = 0; i < Model::size; ++i) state[i] = Counted(start[i]);
    typename Model::template Report<Counted>* const none = nullptr;
    Model::template derivative<false>(Counted(time), state, parameters, memory, rates, none);
}

template <class Law> void evaluate(Damping damping, Inputs const& member, double time) {
    if (damping == Damping::rate) return evaluate<Law, RateDamping>(member, time);
    evaluate<Law, PointDamping>(member, time);
}

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

unsigned long long derivative_flops(Law law, Damping damping, Inputs const* members, double const* times,
                                    std::size_t count) {
    auto const before = Counted::operations;
    for (std::size_t i = 0; i < count; ++i) {
        law == Law::paper ? evaluate<PaperLaw>(damping, members[i], times[i])
                          : evaluate<ConservativeLaw>(damping, members[i], times[i]);
    }
    return Counted::operations - before;
}

}  // namespace slideway
