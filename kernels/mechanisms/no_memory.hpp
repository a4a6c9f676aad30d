#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a model remembers beside its state, where that is nothing.
template <class Real> struct NoMemory { static constexpr int speeds = 0; };
template <class Real> SLIDEWAY_FN void start_memory(NoMemory<Real>&) {}

}  // namespace slideway::inline SLIDEWAY_ISA
