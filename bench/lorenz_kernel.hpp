// What the benchmark of the Lorenz equations asks of each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace slideway {

/// Members that differ in ρ, from x = y = z = 10 with σ = 10 and β = 8/3, by equal Runge–Kutta steps.
struct LorenzRun {
    double const* rho = nullptr;  // [members]
    std::size_t members = 0;
    double step = 0;
    std::uint64_t steps = 0;
    double* states = nullptr;  // [members][3], the result
};

/// Operations of a step as the equations and the textbook's method need them, a multiply-add counted as two: four derivatives of 8
/// (tests/models/lorenz.hpp), and per component three stages of 2 and y + h/6 (k₁ + 2k₂ + 2k₃ + k₄), which is 7.
/// That is 45 instructions, 11 of them additions.  Where additions have units of their own (Zen), 34 compete for the multiply-add
/// units, and 71/68 of their peak is the most there can be; where they have not (Intel), it is 71/90.
inline constexpr double lorenz_step_flops = 4 * 8 + 3 * (3 * 2 + 7);

/// Each instruction set's namespace has one, `integrate_lorenz`.
using LorenzIntegrator = void(LorenzRun const& run);

/// The peer: Boost.Odeint's runge_kutta4 on std::array<double, 3>, one member at a time.
void odeint_lorenz(LorenzRun const& run);

}  // namespace slideway
