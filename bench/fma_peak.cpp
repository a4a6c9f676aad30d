// Compiled once per instruction set.
#include "bench/fma_peak.hpp"

#include "kernels/isa_real.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Real = IsaReal;

/// Ends the compiler's knowledge of a value, which stays in its register.
void forget(Real& x) {
#if defined(__aarch64__)
#define SLIDEWAY_REGISTER "+w"
#else
#define SLIDEWAY_REGISTER "+x"
#endif
#if SLIDEWAY_LANES > 1
    asm volatile("" : SLIDEWAY_REGISTER(x.data));
#else
    asm volatile("" : SLIDEWAY_REGISTER(x));
#endif
}

}  // namespace

/// Twelve chains: more than two units of four cycles' latency can hold, and few enough for sixteen registers.
std::uint64_t fma_peak_rounds(std::uint64_t rounds) {
    Real factor(0.999), addend(1e-3);
    forget(factor);
    forget(addend);
    auto const step = [&](Real & chain) __attribute__((always_inline)) {
        chain = fma(chain, factor, addend);
        forget(chain);
    };
    Real a(0.0), b(0.1), c(0.2), d(0.3), e(0.4), f(0.5), g(0.6), h(0.7), i(0.8), j(0.9), k(1.0), l(1.1);
    for (std::uint64_t n = 0; n < rounds; ++n) {
        step(a), step(b), step(c), step(d), step(e), step(f);
        step(g), step(h), step(i), step(j), step(k), step(l);
    }
    return rounds * 12 * 2 * lanes<Real>;
}

}  // namespace slideway::inline SLIDEWAY_ISA
