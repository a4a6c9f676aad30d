// What the throughput benchmarks of functions and laws ask of each instruction set.  Plain data: units of different instruction sets share
// no code.
#pragma once

#include <cstddef>

#include "kernels/inputs.hpp"

namespace slideway {

/// A function of kernels/math over packs.
struct TimedFunction {
    char const* name;
    double from, to;  // its arguments' range, which the caller fills the array with
    void (*evaluate)(double const* arguments, double* values, std::size_t count);  // a multiple of the lanes
};

/// A contact law on one face: the derivative's part of it.
struct TimedLaw {
    char const* name;
    /// @param depths of the four apices [m], negative where one does not touch  @return the sum of the forces, of all calls [N]
    double (*evaluate)(Inputs const& member, double const depths[4], std::size_t calls);
};

template <class Timed> struct TimedList {
    Timed const* first;
    std::size_t count;
};

/// Each instruction set's namespace has both: `timed_functions` and `timed_laws`.
using TimedFunctions = TimedList<TimedFunction>();
using TimedLaws = TimedList<TimedLaw>();

}  // namespace slideway
