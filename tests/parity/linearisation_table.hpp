// The linearised slider-crank, one state at a time over a table, as each instruction set computes it.
#pragma once

#include <cstddef>

#include "host/backend/kernel_tables.hpp"

namespace slideway {

struct LinearisationRow {
    Inputs inputs;  // complete, the state in its initial values
    double time;    // [s]
    double hg;      // hγ [s]
};

/// K, D, touching, Ω², the solution of (I − hγ A) u = state, and its residual.
inline constexpr int linearisation_values = 25 + 25 + 1 + 1 + 10 + 1;

/// result[row · linearisation_values + i]; rows is a multiple of 8.  Each instruction set's namespace has one,
/// `linearise_table`, for parts and their law.
using TableLineariser = void(Parts const& parts, LawKernels const& law, LinearisationRow const* rows, std::size_t count, double* result);

}  // namespace slideway
