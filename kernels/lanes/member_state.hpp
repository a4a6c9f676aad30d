#pragma once

#include <type_traits>

#include "kernels/block.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/lanes/model.hpp"
#include "kernels/observers/side_record.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Length of an array that may be empty, which C++ does not allow.
constexpr int room(int length) { return length > 0 ? length : 1; }

/// Empty, in the place of a part that is not there: a type of its own for each, for two members of one type have two places.
template <class Part> struct Nothing {};

/// A part that is there on a condition, to be declared with [[no_unique_address]].
template <bool is_there, class Part> using PartIf = std::conditional_t<is_there, Part, Nothing<Part>>;

/// The resets of a model with events, of late.
template <class Real> struct ResetHistory {
    Real time = Real(-1.0);   // of the last one [s]
    Real in_row = Real(0.0);  // how many followed one another at once
};

template <class Model, class Real> struct AccelerationsOf { using Type = NoRecord<Keeper::accelerations>; };
template <HasAccelerations Model, class Real> struct AccelerationsOf<Model, Real> { using Type = typename Model::template Accelerations<Real>; };
template <class Model, class Real> struct ForcesOf { using Type = NoRecord<Keeper::forces>; };
template <HasForces Model, class Real> struct ForcesOf<Model, Real> { using Type = typename Model::template Forces<Real>; };

/// What a member has on account of its shadows.
template <class Real> struct ShadowCourse {
    Real uncut;  // a step that was cut at an event, which the member is to go on with [s]
    Real lost;   // times that an offset had shrunk into rounding
    Real grown;  // times that one had grown to the size of the joint
    Real from;   // when their growth began to be recorded [s]
};

/// What a member remembers for its next impact, of a method with clocks.
template <class Real> struct ClockCourse {
    Real step;          // the next by its clock, 0 before there is one
    Real flight_step;   // that its impacts interrupt [s]
    Real alone, beside; // first step by the clock times √δ': of the last impact of a pair alone, and beside other pairs
    Real outer;         // by the clock, of the contact that a further pair has interrupted
};

/// All that a member takes along from one stint in the lanes to the next.  `Real = double` is one member's record, a pack is the
/// transpose of its lanes' records; both hold nothing but Reals, so that a record moves in and out number by number.
template <class Model, class Real> struct MemberState {
    using Observer = typename Model::template Observer<Real>;

    /// Given with the member, read only.
    struct Constants {
        typename Model::template Parameters<Real> parameters;
        Real scale[Model::size];  // what atol is relative to
        Real end;                 // [s]
        Real first_stop, stop_period;
        Real turns, first_back, start_angle;  // of who goes by turns (MemberClock) [rad]
    };

    struct Course {
        Real member;        // its number in the block
        Real sample;        // the next sample
        Real stop;          // the next stop
        Real crossings;     // so far
        Real side;          // of the section's surface that it was on last, 1 or −1; 0 where it has been on none
        Real t, h;          // time, next step [s]
        Real aim;           // by turns: when the crank comes to the next angle, of a step that went beyond; else 0 [s]
        Real fine_time;     // what t has rounded off [s] (FineTime), 0 where that is not kept
        Real error_memory;  // of the step control
        Real y[Model::size], rates[Model::size];
        Real accepted, rejected, evaluations, jacobians, stiff_steps;
        Real rejections;    // 1 after a rejected attempt, else 0
        Real stiff;         // 1 where the next stint is the stiff method's, else 0
        Real stiffness;     // explicit: looks that found the member stiff; stiff: calm steps in a row
        Real rate_squared;  // Ω² [1/s²] of its stiffest contacts, of late
        [[no_unique_address]] PartIf<Model::has_shadows, ShadowCourse<Real>> shadowed;
        [[no_unique_address]] PartIf<HasClocks<Model>, ClockCourse<Real>> clocked;
        [[no_unique_address]] PartIf<HasEvents<Model>, ResetHistory<Real>> resets;
    };

    /// What is remembered of the contacts, and where steps end because of them.  Moves only where steps do: elsewhere it stays as it
    /// starts.
    struct Contacts {
        [[no_unique_address]] typename Model::template Memory<Real> memory;
        [[no_unique_address]] typename Model::template Watch<Real> watch;
    };

    /// Present where quantities are asked for.
    struct Observation {
        Observer observer;
        Real integrand[room(Observer::integrals)];  // at the start of the next step
    };

    /// Present where accelerations are asked for, and forces.
    using Accelerations = typename AccelerationsOf<Model, Real>::Type;
    using Forces = typename ForcesOf<Model, Real>::Type;

    /// What of its course a copy of the member has for itself.  Rigid contacts are those of the member.
    struct Shadow {
        Real y[Model::size], rates[Model::size];
        Real distance;  // from the member, after the last stop; dimensionless
        Real growth;    // ln of it since the last record
        [[no_unique_address]] PartIf<!IsRigid<Model>, Contacts> contacts;
    };

    Constants constants;
    Course course;
    [[no_unique_address]] Contacts contacts;
    Observation observation;
    [[no_unique_address]] Accelerations accelerations;
    [[no_unique_address]] Forces forces;
    [[no_unique_address]] PartIf<Model::has_shadows, Shadow[most_shadows]> shadows;
};

/// Whether a member's record holds Reals only, so that it may be moved number by number.
template <class Model>
inline constexpr bool holds_reals_only = sizeof(MemberState<Model, ThreeNumbers>) ==
                                         3 * sizeof(MemberState<Model, double>);

}  // namespace slideway::inline SLIDEWAY_ISA
