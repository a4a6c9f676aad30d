// A model whose samples hold more than its state, and that does not say where the state is among them.
#include "kernels/observers/sampler.hpp"

namespace slideway::inline SLIDEWAY_ISA {

struct Model {
    static constexpr int size = 2, series = 3;
};
static_assert(state_of_series(Model(), 0) == 0);

}  // namespace slideway::inline SLIDEWAY_ISA
