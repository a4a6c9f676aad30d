// Sliders on their way with rigid contacts, and what a text book says of their impacts, in 80-bit numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/rigid.hpp"

namespace slideway::testing {

inline Parts rigid_joint_parts(bool friction, bool misaligned = false, Mechanism mechanism = Mechanism::free_slider) {
    Parts parts = rigid_planar_parts(friction, false);
    parts.mechanism = mechanism;
    parts.misaligned_way = misaligned;
    return parts;
}

/// Sliders of all proportions, gaps, starts, drives and restitutions, with friction up to `most_friction`.
inline std::vector<Inputs> random_rigid_sliders(std::size_t count, unsigned seed, double most_friction) {
    UniformDraws uniform(seed);
    std::vector<Inputs> members;
    members.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        Inputs in;
        in.crank_length = uniform(0.02, 0.06);
        in.rod_length = in.crank_length * uniform(2.5, 5);
        in.crank_speed = std::pow(10, uniform(0.3, 2));
        in.start_angle = uniform(0, 6.283);
        in.slider_length = uniform(0.01, 0.1);
        in.way_width = uniform(0.01, 0.05);
        in.way_depth = uniform(0.01, 0.05);
        in.slider_mass = std::pow(10, uniform(-1.5, 0.5));
        for (double* inertia : {&in.slider_inertia_x, &in.slider_inertia_y, &in.slider_inertia_z}) {
            *inertia = in.slider_mass * in.slider_length * in.slider_length * std::pow(10, uniform(-1.5, -0.3));
        }
        in.clearance_y = std::pow(10, uniform(-5.5, -3.2));
        in.clearance_z = in.clearance_y * uniform(0.5, 2);
        in.restitution = uniform(0.01, 1);
        in.friction_kinetic = uniform(0, most_friction);
        in.friction_static = in.friction_kinetic * uniform(1, 1.5);
        in.inclination = uniform(0, 0.5);
        double const gap = std::min(in.clearance_y, in.clearance_z), tilt = gap / (in.slider_length + in.way_width + in.way_depth);
        in.y = uniform(-0.4, 0.4) * gap, in.z = uniform(-0.4, 0.4) * gap;
        in.roll = uniform(-1, 1) * tilt, in.yaw = uniform(-1, 1) * tilt, in.pitch = uniform(-1, 1) * tilt;
        in.vy = uniform(-0.05, 0.05), in.vz = uniform(-0.05, 0.05);
        in.wx = uniform(-1, 1), in.wy = uniform(-1, 1), in.wz = uniform(-1, 1);
        members.push_back(complete_inputs(in));
    }
    return members;
}

/// Tilted, turning and drifting sliders of the paper's size in the middle of their way.
inline std::vector<Inputs> drifting_sliders(std::size_t count, unsigned seed, double e, double friction) {
    UniformDraws uniform(seed);
    std::vector<Inputs> members;
    for (std::size_t i = 0; i < count; ++i) {
        Inputs in;
        in.restitution = std::max(e, 1e-300);
        in.friction_static = in.friction_kinetic = friction;
        in.crank_speed = 10, in.start_angle = uniform(0, 6);
        in.roll = uniform(-1e-3, 1e-3), in.yaw = uniform(-1e-3, 1e-3), in.pitch = uniform(-1e-3, 1e-3);
        in.wx = uniform(-1, 1), in.wy = uniform(-1, 1), in.wz = uniform(-1, 1);
        in.vx = uniform(-0.1, 0.1), in.vz = uniform(-0.02, 0.02);
        in.y = uniform(-3e-5, 3e-5), in.z = uniform(-3e-5, 3e-5);
        members.push_back(complete_inputs(in));
    }
    return members;
}

/// Numbers of a state, by name.
struct JointState {
    long double y, z, vy, vz, roll, yaw, pitch, wx, wy, wz, x = 0, vx = 0;
};

template <class Numbers> JointState joint_state(Numbers const& s) {
    return {s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8], s[9], s[10], s[11]};
}

/// All of a free slider's states at the sample times: [member][sample].
inline std::vector<std::vector<JointState>> joint_samples(EnsembleResult const& r, std::size_t members, std::size_t samples) {
    std::vector<std::vector<JointState>> all(members);
    for (std::size_t m = 0; m < members; ++m) {
        for (std::size_t k = 0; k < samples; ++k) {
            std::array<double, 12> s{};
            for (std::size_t i = 0; i < s.size(); ++i) s[i] = r.series[(i * members + m) * samples + k];
            all[m].push_back(joint_state(s));
        }
    }
    return all;
}

/// Kinetic energy and that of weight [J].
inline long double energy_of(Inputs const& in, JointState const& s) {
    long double const slope = in.inclination;
    long double const height = s.x * std::sin(slope) + s.y * std::cos(slope);
    long double const turning = in.slider_inertia_x * s.wx * s.wx + in.slider_inertia_y * s.wy * s.wy + in.slider_inertia_z * s.wz * s.wz;
    return (in.slider_mass * (s.vx * s.vx + s.vy * s.vy + s.vz * s.vz) + turning) / 2 + static_cast<long double>(in.slider_mass) * in.gravity * height;
}

}  // namespace slideway::testing
