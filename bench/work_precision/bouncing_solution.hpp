// What a mass does between two springs, in closed form.
#pragma once

#include <cmath>
#include <numbers>

#include "bench/work_precision/problem.hpp"

namespace slideway::bench {

struct BounceEnd {
    long double y, v;
    int face = 0;        // ±1 where it ends on one
    long double margin;  // to the next event, or from the last one, whichever is nearer [units of 1/rate]
    int events = 0;
};

/// The state at time t [s] of tests/models/bouncing_mass.hpp, which begins in flight: parabolas, and on a spring arcs of a sine about the
/// place where it would rest.  A speed u at which a face is touched is that of the parting.  With Ω² = p the time on the upper one is
/// 2 atan(uΩ)/Ω, on the lower one, where weight presses, 2(π − atan(uΩ))/Ω.
inline BounceEnd bouncing_solution(BouncingMember const& member, double t) {
    using Real = long double;
    Real const omega = std::sqrt(static_cast<Real>(member.stiffness));
    Real y = member.y, v = member.v, left = static_cast<Real>(member.rate) * t;
    for (int events = 0;; ++events) {
        Real const above = v * v + 2 * (y - 1);
        bool const rises = v > 0 && above > 0;
        Real const flight = rises ? v - std::sqrt(above) : v + std::sqrt(v * v + 2 * (y + 1));
        if (left <= flight) {
            return {y + (v - left / 2) * left, v - left, 0, std::fmin(left, flight - left), events};
        }
        left -= flight;
        Real const face = rises ? 1 : -1, speed = std::fabs(v - flight);
        Real const half = std::atan(speed * omega);
        Real const contact = 2 * (rises ? half : std::numbers::pi_v<Real> - half) / omega;
        ++events;
        if (left <= contact) {
            // Depth d'' = −face − p d, from d = 0 with d' = speed.
            Real const rest = -face / (omega * omega), angle = omega * left;
            Real const depth = rest * (1 - std::cos(angle)) + speed / omega * std::sin(angle);
            Real const rate = rest * omega * std::sin(angle) + speed * std::cos(angle);
            return {face * (1 + depth), face * rate, static_cast<int>(face), std::fmin(left, contact - left), events};
        }
        left -= contact;
        y = face;
        v = -face * speed;
    }
}

}  // namespace slideway::bench
