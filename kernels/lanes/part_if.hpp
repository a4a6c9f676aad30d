#pragma once

#include <type_traits>

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// In the place of a part that is not there: a type of its own for each, for two members of one type have two places.
template <class Part> struct Nothing {};

/// A part that is there on a condition, to be declared with [[no_unique_address]].
template <bool is_there, class Part> using PartIf = std::conditional_t<is_there, Part, Nothing<Part>>;

}  // namespace slideway::inline SLIDEWAY_ISA
