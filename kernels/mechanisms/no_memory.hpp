#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a model remembers beside its state, where that is nothing.
template <class Real> struct NoMemory {};

}  // namespace slideway::inline SLIDEWAY_ISA
