// The contact laws of this tree, a row each, in the order of `Law`.  `name` is what contact.law says and names the header
// kernels/laws/<name>.hpp; `Type` is the struct in it.  CMake reads the rows too: a law is a unit of kernels per instruction set.
#pragma once

#include "kernels/inputs.hpp"

#define SLIDEWAY_LAWS(row)             \
    row(paper, PaperLaw)               \
    row(conservative, ConservativeLaw) \
    row(kelvin_voigt, KelvinVoigt)     \
    row(foundation, Foundation)

namespace slideway {

enum class Law : int {
#define SLIDEWAY_NAME(name, Type) name,
    SLIDEWAY_LAWS(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
};

}  // namespace slideway
