// Probing: what the kernels say about single states.
#pragma once

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

}  // namespace slideway
