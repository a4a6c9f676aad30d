// Compiled once per instruction set.
#include "tests/parity/twin_functions.hpp"

#include "kernels/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "tests/models/relief_valve.hpp"
#include "tests/models/twin.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

struct ShortValve : ReliefValve {
    template <class Real> using Observer = EventRecorder<Real, 4, recorded_twin_events>;
};

template <class Real> void evaluate_vocabulary(VocabularyCase const& test) {
    for (std::size_t first = 0; first < vocabulary_lanes; first += lanes<Real>) {
        Real a(0.0), b(0.0), c(0.0);
        for (int i = 0; i < lanes<Real>; ++i) {
            auto const from = first + static_cast<std::size_t>(i);
            set_lane(a, i, test.a[from]);
            set_lane(b, i, test.b[from]);
            set_lane(c, i, test.c[from]);
        }
        double* row = test.results + first;
        auto const put = [&](Real value) {
            for (int i = 0; i < lanes<Real>; ++i) row[i] = lane(value, i);
            row += vocabulary_lanes;
        };
        auto const put_mask = [&](Mask<Real> mask) {
            for (int i = 0; i < lanes<Real>; ++i) row[i] = holds(mask, i) ? 1 : 0;
            row += vocabulary_lanes;
        };
        put(a + b);
        put(a - b);
        put(a * b);
        put(a / b);
        put(Real(0.7));
        put(min(a, b));
        put(max(a, b));
        put(abs(a));
        put(sqrt(abs(a)));
        put(negated(a));
        put(fma(a, b, c));
        put(fnma(a, b, c));
        put(fms(a, b, c));
        put(round_even(a));
        Real mantissa, exponent;
        split_exponent(abs(a) + Real(1e-3), mantissa, exponent);
        put(mantissa);
        put(exponent);
        put(power_of_two(round_even(b)));
        auto const less = a<b, more = a> c;
        put(select(less, a, c));
        put(count<Real>(more));
        put_mask(less);
        put_mask(more);
        put_mask(a <= b);
        put_mask(a >= b);
        put_mask(a == b);
        put_mask(a != b);
        put_mask(less & more);
        put_mask(less | more);
        put_mask(!less);
        put_mask(mask_of<Real>(true));
        put_mask(mask_of<Real>(false));
        put_mask(Mask<Real>(true) & !mask_of<Real>(false));
        for (int i = 0; i < lanes<Real>; ++i) row[i] = held_lanes(mask_of<Real>(true)) == lanes<Real>;
    }
}

void vocabulary(VocabularyCase const& test, bool twin) {
    twin ? evaluate_vocabulary<Twin<IsaReal>>(test) : evaluate_vocabulary<IsaReal>(test);
}

int truth(unsigned bits, unsigned& returned) {
    using Real = Twin<IsaReal>;
    Real marks(0.0);
    for (int i = 0; i < lanes<Real>; ++i) set_lane(marks, i, (bits >> i) & 1u ? 1.0 : 0.0);
    auto const mask = marks > Real(0.5);
    returned = mask_bits(mask);
    return (any(mask) ? 1 : 0) + (all(mask) ? 2 : 0);
}

void valves(TwinValves& test, bool twin) {
    auto const n = test.inflows.size();
    std::vector<ReliefValve::Inputs> inputs(n);
    for (std::size_t i = 0; i < n; ++i) inputs[i].inflow = test.inflows[i];
    test.records.resize(n);
    test.states.assign(n * ReliefValve::size, 0);
    test.lifts.assign(n * recorded_twin_events, 0);
    BlockOf<ReliefValve::Inputs> block;
    block.inputs = inputs.data();
    block.members = n;
    block.settings = test.settings;
    block.quantities = 1;
    block.records = test.records.data();
    block.final_states = test.states.data();
    block.quantity_values = test.lifts.data();
    twin ? integrate<ShortValve, Twin<IsaReal>>(block) : integrate<ShortValve, IsaReal>(block);
}

}  // namespace

extern TwinKernel const twin_kernel;
TwinKernel const twin_kernel{vocabulary, truth, lanes<Twin<IsaReal>>, valves};

}  // namespace slideway::inline SLIDEWAY_ISA
