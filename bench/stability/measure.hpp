// One method on one ensemble: how much energy went astray, and who failed.
#pragma once

#include <array>
#include <cstdint>

#include "bench/stability/axes.hpp"

namespace slideway::bench {

struct Outcome {
    std::array<int, status_count> ended{};
    int members = 0;
    /// Of the members that reached the end, stable or not; NaN if none did.  Relative: to what friction and damping burnt,
    /// D_f + |D_d|; the crank's work serves mostly to lift the rod and says nothing of the joint.
    double median_residual = 0;  // |ε| [J]
    double median_relative = 0, p95_relative = 0;
    double median_steps = 0;

    int finished() const { return ended[static_cast<int>(Status::finished)]; }
    bool all_finished() const { return finished() == members; }
};

Outcome measure(Point const& point, Method method, double fixed_step);

/// The largest fixed step of rk4, within an eighth of an octave, with which all members finish and the residual is what it should be:
/// under a law that keeps energy at most a hundredth at the 95th percentile; under one that makes it whatever the step, a median at most 0.2 above that of `reference`.  Searched from 1/256 to 8 linear limits; NaN if there is none.
double largest_usable_step(Point const& point, Outcome const& reference);

}  // namespace slideway::bench
