// How the forces of one state come about, step by step: apices, depths, modes, normal forces, friction, what all of it does to the slider (docs/explanation/model.md 3 to 5).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "host/study/probe.hpp"

namespace slideway {

/// Apices a, b, c, d of the way's faces, around each.  Source: Qian et al. 2020, Table 2.
inline constexpr int face_apices[4][4] = {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}};

/// An apex against a face.  Of rigid contacts there is the depth alone, all else is NaN.
struct ApexPair {
    int apex, face;        // P1 is 0; in the order of `face_names`
    double depth, rate;    // δ [m], δ' [m/s]
    double normal_force;   // F [N]
    double sliding;        // V [m/s]
    double coefficient;    // μ(V), 0 without friction
    double friction;       // μ F [N]
    bool touches() const { return depth > 0; }
    std::string name() const;  // "P1 y_plus"
};

/// A contact of a face: a surface of four apices, a line of two, a point (M4.1).
struct FaceMode {
    int face;
    char const* kind;  // "surface", "line", "point"
    std::vector<int> apices;
};

struct Explanation {
    std::vector<ApexPair> pairs;  // all sixteen, those of a face one after the other
    std::vector<FaceMode> modes;
    std::array<double, 3> friction, force, torque;  // on the slider: along the way's axes, along the ground's two, the torque about the hole's centre [N, N m]
    double length, width, depth;  // of the joint along X, Y and Z [m]
    ApexPair const& nearest() const;  // the deepest
};

/// @throws SceneError for a mechanism whose slider has no eight apices
Explanation explain(StateTable const& table, std::size_t row, ProbeResult const& result);

}  // namespace slideway
