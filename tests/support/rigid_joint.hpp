// Sliders on their way with rigid contacts, and what a text book says of their impacts, in 80-bit numbers.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/rigid.hpp"

namespace slideway::testing {

inline Parts rigid_joint_parts(bool friction, bool misaligned = false, Mechanism mechanism = Mechanism::free_slider) {
    Parts parts = rigid_planar_parts(friction, false);
    parts.mechanism = mechanism;
    parts.misaligned_way = misaligned;
    return parts;
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
