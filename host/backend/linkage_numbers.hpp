// What the host asks of a linkage before it runs: whether and how it goes together, and its sizes.
#pragma once

#include "kernels/inputs.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/members/start.hpp"

namespace slideway {

/// How a member's linkage goes together at the start (kernels/linkage/linkage_start.hpp).
struct LinkageAssembly {
    AssemblyFault fault;
    int worst;            // the closure that stays open, or holds what others hold
    double distance;      // by which it stays open [m]
};
/// @param in complete, here and below
LinkageAssembly assembled(LinkagePlan const& plan, Inputs const& in);
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
