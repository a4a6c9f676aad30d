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

/// Residual that a fixed step may leave at the 95th percentile to count as usable, relative: a hundredth, or under the paper's law,
/// which makes energy whatever the step, a tenth more than the reference at a tolerance of 1e-5.
double usable_residual(Law law, Outcome const& reference);

/// The largest fixed step of rk4, within an eighth of an octave, with which all members finish and the residual stays usable; searched between
/// a 64th and 8 times the linear limit.  NaN if none is.
double largest_usable_step(Point const& point, double bound);

}  // namespace slideway::bench
