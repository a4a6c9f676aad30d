// Probing: what the kernels say about single states.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/study/state_table.hpp"

namespace slideway {

/// What the kernels say of states, packs of them at a time.  @param inputs complete, of members that start there  @param times [s]
std::vector<ProbeResult> probe(Isa isa, Parts const& parts, std::vector<Inputs> const& inputs, std::vector<double> const& times);

/// What acts on a mechanism beside weight, contact, friction and drive does or takes in a state [W]: where a scene has loads.
struct LoadPower {
    char const *name, *label;
    double ProbeResult::*value;
};
inline constexpr LoadPower load_powers[] = {{"power_load", "loads", &ProbeResult::power_load},
                                            {"power_ground", "moving ground", &ProbeResult::power_ground},
                                            {"loss_springs", "taken by springs", &ProbeResult::loss_springs},
                                            {"loss_film", "taken by the film", &ProbeResult::loss_film}};

/// One result per row.
std::vector<ProbeResult> probe(StateTable const& table, Isa isa);

/// The result columns of tests/golden/rhs_*.csv, in their order, and signals: the derivatives d_*, powers (load_powers too where the scene has
/// loads), penetrations, normal forces, mode triple, energies, the crank torque of a mechanism that has a crank, its own signals.  Of the planar
/// mechanism penetrations and forces are those of its corners, pen_C1 … fn_C4.
std::vector<std::pair<std::string, double>> result_columns(StateTable const& table, ProbeResult const& result);
/// The forces of faces and pins under the names of their series, of a mechanism that tells them.
std::vector<std::pair<std::string, double>> force_columns(MechanismInfo const& mechanism, ProbeResult const& result);

/// The table's parameters, t, the states, the result columns and the status; numbers with 17 digits.
void write_probe_csv(std::ostream& out, StateTable const& table, std::vector<ProbeResult> const& results);

// How the forces of one state come about, step by step: apices, depths, modes, normal forces, friction, what all of it does to the slider (docs/explanation/model.md 3 to 5).

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
    ApexPair const& nearest() const { return *std::ranges::max_element(pairs, {}, &ApexPair::depth); }  // the deepest
};

/// A joint of a linkage with clearance.
struct JointForce {
    std::string joint, first, second;  // "crank_pin", the bodies of journal or block and of bearing or walls
    double x, y, tilt;                 // the journal in its bearing, along the ground's axes [m]; of a block y across its walls and the tilt [rad], else NaN
    double depth, normal_force;        // of a block that of the deepest corner, and the sum of all [m], [N]
    double force_x, force_y;           // the normal force on the first body, along the ground's axes; of a block NaN [N]
    bool touches() const { return depth > 0; }
};
/// Of a linkage; empty for other mechanisms.
std::vector<JointForce> joint_forces(StateTable const& table, std::size_t row, ProbeResult const& result);

/// @throws SceneError for a mechanism whose slider has no eight apices
Explanation explain(StateTable const& table, std::size_t row, ProbeResult const& result);

}  // namespace slideway
