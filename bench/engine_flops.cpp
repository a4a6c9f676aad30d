// Compiled once, for members in double whose equations are evaluated a second time with the number that counts operations.
#include "bench/engine_flops.hpp"

#include <type_traits>

#include "bench/counted_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/models/slider_crank_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

/// The same structure, of numbers that count.
template <template <class> class Record> Record<Counted> counting(Record<double> const& record) {
    Record<Counted> copy;
    if constexpr (!std::is_empty_v<Record<double>>) load_lane(copy, 0, record);
    return copy;
}

template <class Crank> struct CountedCrank : Crank {
    template <class Real> using Memory = typename Crank::template Memory<Real>;

    template <bool Full>
    static Faults<double> derivative(double t, double const* s, SliderParameters<double> const& p,
                                     Memory<double> const& memory, double* rates, SliderReport<double>* report) {
        Counted state[Crank::size], unused[Crank::size];
        for (int i = 0; i < Crank::size; ++i) state[i] = Counted(s[i]);
        SliderReport<Counted>* const none = nullptr;
        Crank::template derivative<false>(Counted(t), state, counting(p), counting(memory), unused, none);
        return Crank::template derivative<Full>(t, s, p, memory, rates, report);
    }

    static void linearise(double t, double const* s, SliderParameters<double> const& p,
                          Memory<double> const& memory, SliderLinearisation<double>& out) {
        Counted state[Crank::size];
        for (int i = 0; i < Crank::size; ++i) state[i] = Counted(s[i]);
        SliderLinearisation<Counted> unused;
        Crank::linearise(Counted(t), state, counting(p), counting(memory), unused);
        Crank::linearise(t, s, p, memory, out);
    }
};

template <class Law, class Damping> void run(Block& block) {
    integrate<CountedCrank<SliderCrankModel<Law, StickSlipFriction, AlignedWay, Damping>>, double>(block);
}

template <class Law> void run(Damping damping, Block& block) {
    damping == Damping::rate ? run<Law, RateDamping>(block) : run<Law, PointDamping>(block);
}

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

unsigned long long counted_flops(Law law, Damping damping, Block& block) {
    auto const before = Counted::operations;
    law == Law::paper ? run<PaperLaw>(damping, block) : run<ConservativeLaw>(damping, block);
    return Counted::operations - before;
}

}  // namespace slideway
