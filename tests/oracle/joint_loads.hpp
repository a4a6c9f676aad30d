// What the joint does to the slider at one instant, whatever drives it.
#pragma once

#include <array>

#include "mechanism.hpp"
#include "oracle.hpp"
#include "pairs.hpp"

namespace oracle::detail {

struct JointLoads {
    PairTable pairs;  // way coordinates
    int surfaces = 0, lines = 0, points = 0;
    std::array<FaceKind, face_count> faces{};
    Real potential = 0;  // U; NaN beyond a line's domain
    // Inertial frame; torques about the slider's centre.
    Vector3 normal, normal_torque;             // normal forces alone, without the way's X
    Vector3 force, torque;                     // with friction
    Real friction_loss = 0, damping_loss = 0;  // [W]
};

JointLoads joint_loads(Inputs const& in, Parts const& parts, SliderMotion const& slider, Pairs const* impact_speeds);

}  // namespace oracle::detail
