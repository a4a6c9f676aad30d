// What the host asks of a linkage before it runs: whether and how it goes together, and its sizes.
#pragma once

#include <array>

#include "kernels/inputs.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/members/start.hpp"

namespace slideway {

/// How a member's linkage goes together at the start (kernels/linkage/linkage_start.hpp); of a state that is given, how far its loops close.
struct LinkageAssembly {
    AssemblyFault fault;
    int worst;            // the closure that stays open, or holds what others hold
    double distance;      // by which it stays open [m]
    double rate;          // of a state that is given: how fast it opens [m/s]
    StateNumbers state;   // as far as it goes together
};
/// Whether inputs have a state in the place of the start.
inline bool is_given(Inputs const& in) { return in.mechanism_a == in.mechanism_a; }
/// @param in complete, here and below
LinkageAssembly assembled(LinkagePlan const& plan, Inputs const& in);
/// Of a state that is given: where the journal of a closure is in its bearing along the ground's axes [m], or a block across its walls [m] and its tilt [rad].
std::array<double, 2> place_in_joint(LinkagePlan const& plan, Inputs const& in, int closure);
/// The state in which a member starts; NaN where it does not go together.
StateNumbers start_of(LinkagePlan const& plan, Inputs const& in);

/// Clearances [m], how far a body reaches [m], and the mass of all [kg].
struct LinkageSize { double least_play, most_play, reach, mass; };
LinkageSize size_of(LinkagePlan const& plan, Inputs const& in);
/// Rate [rad/s] at which the stiffest joint with clearance rings in an impact at the speed of the drive.
double stiffest_rate(LinkagePlan const& plan, Inputs const& in);

/// Rate [rad/s] at which the lightest body bounces on a stop.
double rate_on_stop(LinkagePlan const& plan, Load const& stop, Inputs const& in);

}  // namespace slideway
