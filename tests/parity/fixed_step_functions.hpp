// Equal steps as each instruction set computes them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace slideway {

struct FixedStepCase {
    bool valve = false;              // the relief valve in flight, else the Lorenz equations
    double const* values = nullptr;  // [members]: q or ρ
    std::size_t members = 0;
    std::uint64_t steps = 0;   // of 1e-3
    double* states = nullptr;  // [members][3]
};

/// What the relief valve says of states at an event.
struct ValveCase {
    double const* inflows = nullptr;  // [members]
    double* states = nullptr;         // [members][3]; reset where x ≤ 0 and v < 0
    double* events = nullptr;         // [members][4], the result: both values, both slopes, before the reset
    double* at_rest = nullptr;        // [members], the result: 1 or 0, before the reset
    std::size_t members = 0;          // a multiple of 8
};

/// Each instruction set's namespace has one `fixed_step_kernel`.
struct FixedStepKernel {
    void (*run)(FixedStepCase const& c, int group);  // group 0: the default; 1, 2, 3: others
    void (*valve)(ValveCase const& c);
};

}  // namespace slideway
