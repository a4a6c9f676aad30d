// Probing: what the kernels say about single states, and whether members start where a mechanism can be.
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

/// One result per row.
std::vector<ProbeResult> probe(StateTable const& table, Isa isa);

/// The result columns of tests/golden/rhs_*.csv, in their order: the derivatives d_*, powers, penetrations, normal
/// forces, mode triple, energies and the crank torque of a mechanism that has a crank.  Of the planar mechanism penetrations and forces are
/// those of its corners, pen_C1 … fn_C4.
std::vector<std::pair<std::string, double>> result_columns(Mechanism mechanism, ProbeResult const& result);

/// The table's parameters, t, the states, the result columns and the status; numbers with 17 digits.
void write_probe_csv(std::ostream& out, StateTable const& table, std::vector<ProbeResult> const& results);

/// Members may start inside the way by this share of their smaller clearance: contacts press in by less than a hundredth of it, and what starts
/// deeper starts with energy that nothing has given it.
inline constexpr double deepest_start = 0.1;

/// Looks at no more members than this, evenly over all.
inline constexpr std::uint64_t most_looked_at = 10'000;

/// What is wrong with the starts, in words, or nothing: "3 of 10 members start inside the way, …".  Members that fail at once for another
/// reason (a draw that breaks a rule, a pose that the rod does not reach) are not counted: their status says so.
std::optional<std::string> impossible_starts(Scene const& scene, Isa isa);

}  // namespace slideway
