// What is swept: one property at a time, from the standard mechanism out to its limits.
#pragma once

#include <string>
#include <vector>

#include "kernels/block.hpp"

namespace slideway::bench {

/// One ensemble, and how tightly to integrate it.
struct Point {
    double value;  // of the axis
    Parts parts;
    std::vector<Inputs> members;
    double tolerance = 1e-5;     // rtol and atol of the adaptive methods
    double step_fraction = 0.5;  // rk4: step over the linear limit
};

struct Axis {
    std::string name, title, unit;
    bool of_the_method = false;  // tolerances and steps: the same ensemble at every point
    std::vector<Point> points;
};

/// The laws that have every kind of damping, for the axes sweep them; those that keep energy first.
std::vector<Law> swept_laws();

/// @param quick fewer points and members.
std::vector<Axis> axes(Law law, bool quick);

inline constexpr double end_time = 0.1;  // [s]; the standard mechanism meets its way five times and comes to rest on it

/// Largest stable step of the classical Runge–Kutta method on an undamped oscillation: 2√2/Ω.
double linear_limit(std::vector<Inputs> const& members);

}  // namespace slideway::bench
