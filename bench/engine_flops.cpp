// Compiled once, for members in double whose equations are evaluated a second time with the number that counts operations.
#include "bench/engine_flops.hpp"

#include <type_traits>

#include "bench/counted_real.hpp"
#include "kernels/all_laws.hpp"
#include "kernels/integrate.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/models/mechanism_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

/// The same structure, of numbers that count.
template <template <class> class Record> Record<Counted> counting(Record<double> const& record) {
    Record<Counted> copy;
    if constexpr (!std::is_empty_v<Record<double>>) load_lane(copy, 0, record);
    return copy;
}

template <class Law, class Damping>
using CrankOf = MechanismModel<SliderCrank, SliderBase, OneLaw<Law, Damping>>;

template <class Crank> struct CountedCrank : Crank {
    using Crank::Crank;

    template <bool Full>
    Faults<double> derivative(double t, double const* s, SliderParameters<double> const& p,
                              ContactMemory<double> const& memory, double* rates, SliderReport<double>* report) const {
        Counted state[Crank::size], unused[Crank::size];
        for (int i = 0; i < Crank::size; ++i) state[i] = Counted(s[i]);
        SliderReport<Counted>* const none = nullptr;
        Crank::template derivative<false>(Counted(t), state, counting(p), counting(memory), unused, none);
        return Crank::template derivative<Full>(t, s, p, memory, rates, report);
    }

    void linearise(double t, double const* s, SliderParameters<double> const& p, ContactMemory<double> const& memory,
                   SliderLinearisation<double>& out) const {
        Counted state[Crank::size];
        for (int i = 0; i < Crank::size; ++i) state[i] = Counted(s[i]);
        SliderLinearisation<Counted> unused;
        Crank::linearise(Counted(t), state, counting(p), counting(memory), unused);
        Crank::linearise(t, s, p, memory, out);
    }
};

template <class Law, class Damping> void run(Parts const& parts, Block& block) {
    using Crank = CountedCrank<CrankOf<Law, Damping>>;
    integrate<Crank, double>(block, Crank({{}, Law::info.switches, parts}));
}

template <class Law> void run_law(Parts const& parts, Block& block) {
    if constexpr (Law::info.has(Damping::rate)) {
        if (parts.damping == Damping::rate) return run<Law, RateDamping>(parts, block);
    }
    run<Law, PointDamping>(parts, block);
}

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

unsigned long long counted_flops(Law law, Damping damping, Block& block) {
    auto const before = Counted::operations;
    Parts const parts{law, damping, true, false};
    switch (law) {
#define SLIDEWAY_RUN(name, Type) \
    case Law::name:              \
        run_law<Type>(parts, block); \
        break;
        SLIDEWAY_LAWS(SLIDEWAY_RUN)
#undef SLIDEWAY_RUN
    }
    return Counted::operations - before;
}

}  // namespace slideway
