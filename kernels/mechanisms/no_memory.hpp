#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A model whose derivative depends on time, state and parameters alone remembers nothing of its events.
template <class Real> struct NoMemory {};
template <class Real> SLIDEWAY_FN void start_memory(NoMemory<Real>&) {}

}  // namespace slideway::inline SLIDEWAY_ISA
