// The contact laws of this tree, a row each, in the order of `Law`.  `name` is what contact.law says and names the header
// kernels/laws/<name>.hpp; `Type` is the struct in it.  CMake reads the rows too: a law is a unit of kernels per instruction set.
#pragma once

#define SLIDEWAY_LAWS(row)             \
    row(paper, PaperLaw)               \
    row(conservative, ConservativeLaw) \
    row(kelvin_voigt, KelvinVoigt)     \
    row(foundation, Foundation)
