#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A model whose steps need not end at events watches for none.
template <class Real> struct NoWatch {};

}  // namespace slideway::inline SLIDEWAY_ISA
