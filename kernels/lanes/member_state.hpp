#pragma once

#include <cstddef>
#include <type_traits>

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Length of an array that may be empty, which C++ does not allow.
constexpr int room(int length) { return length > 0 ? length : 1; }

/// The resets of a model with events, of late.
template <class Real> struct ResetHistory {
    Real time;    // of the last one [s]
    Real in_row;  // how many followed one another at once
};
struct NoResets {};

/// All that a member takes along from one stint in the lanes to the next.  `Real = double` is one member's record, a pack is the
/// transpose of its lanes' records; both hold nothing but Reals, so that a record moves in and out number by number.
template <class Model, class Real> struct MemberState {
    using Observer = typename Model::template Observer<Real>;

    /// Given with the member, read only.
    struct Constants {
        typename Model::template Parameters<Real> parameters;
        Real scale[Model::size];  // what atol is relative to
    };

    struct Course {
        Real member;        // its number in the block
        Real sample;        // the next sample
        Real t, h;          // time, next step [s]
        Real error_memory;  // of the step control
        Real y[Model::size], rates[Model::size];
        Real accepted, rejected, evaluations, jacobians, stiff_steps;
        Real rejections;    // 1 after a rejected attempt, else 0
        Real stiff;         // 1 where the next stint is the stiff method's, else 0
        Real stiffness;     // explicit: looks that found the member stiff; stiff: calm steps in a row
        Real rate_squared;  // Ω² [1/s²] of its stiffest contacts, of late
        [[no_unique_address]] typename Model::template Memory<Real> memory;
        [[no_unique_address]] typename Model::template Watch<Real> watch;
        [[no_unique_address]] std::conditional_t<(Model::events > 0), ResetHistory<Real>, NoResets> resets;
    };

    /// Present where quantities are asked for.
    struct Observation {
        Observer observer;
        Real integrand[room(Observer::integrals)];  // at the start of the next step
    };

    Constants constants;
    Course course;
    Observation observation;
};

/// Moves one lane of a pack's part from or to a member's record.
template <int width, class PackPart, class Part>
SLIDEWAY_HD void load_lane(PackPart& pack, int index, Part const& record) {
    static_assert(sizeof(PackPart) == width * sizeof(Part) && sizeof(Part) % sizeof(double) == 0);
    auto const* from = reinterpret_cast<double const*>(&record);
    auto* to = reinterpret_cast<double*>(&pack) + index;
    for (std::size_t i = 0; i < sizeof(Part) / sizeof(double); ++i) to[i * width] = from[i];
}

template <int width, class PackPart, class Part>
SLIDEWAY_HD void store_lane(PackPart const& pack, int index, Part& record) {
    static_assert(sizeof(PackPart) == width * sizeof(Part) && sizeof(Part) % sizeof(double) == 0);
    auto const* from = reinterpret_cast<double const*>(&pack) + index;
    auto* to = reinterpret_cast<double*>(&record);
    for (std::size_t i = 0; i < sizeof(Part) / sizeof(double); ++i) to[i] = from[i * width];
}

}  // namespace slideway::inline SLIDEWAY_ISA
