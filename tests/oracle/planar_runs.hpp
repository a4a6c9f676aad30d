// The planar mechanism over time: with its compliant corners, and in the rigid limit.
#pragma once

#include <vector>

#include "planar.hpp"

namespace oracle {

/// What model.md 7 tabulates.
struct PlanarSample {
    long double turns = 0;      // θ1/2π
    long double rod_angle = 0;  // θ2 [rad]
    long double offset = 0;     // y/c
};

/// Inputs of the check of model.md 7 with K = 1e11 N/m^1.5; a free crank with restitution, no friction.
slideway::Inputs planar_check_inputs();

struct CompliantSteps {
    long double near_wall = 4e-7L, in_flight = 2e-6L;  // [s]
};

/// By classical Runge-Kutta steps that end where a corner begins to touch, which sets its impact speed.
/// @param parts a free crank, with restitution  @return one sample at 0, every, 2 every ... up to `count` intervals
std::vector<PlanarSample> compliant_run(slideway::Inputs const& completed, slideway::Parts const& parts,
                                        long double every, int count, CompliantSteps const& steps = {});

struct RigidImpact {
    long double time = 0, speed = 0;  // [s], |y'| before it [m/s]
    int side = 0;                     // of the wall
};
struct RigidRun {
    std::vector<PlanarSample> samples;
    std::vector<RigidImpact> impacts;        // those that pile up included
    std::vector<long double> rests, leaves;  // when lasting contact begins and ends [s]
    long double energy_lost = 0;             // by impacts [J]
    long double energy_change = 0;           // over the run [J]
};

/// The rigid limit of a frictionless block with a free crank: impacts y'+ = -e y'-, which pile up to lasting contact.
/// @param step of the Runge-Kutta method [s]; its error is far below 1e-12 at the default
RigidRun rigid_run(slideway::Inputs const& completed, long double every, int count, long double step = 2e-6L);

}  // namespace oracle
