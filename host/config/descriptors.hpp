// What the mechanisms and contact laws of the kernels say of themselves: each in its own header, here in the order of their lists.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/laws/law_info.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/rigid/rigid_info.hpp"

namespace slideway {

std::span<MechanismInfo const> mechanisms();
std::span<LawInfo const> laws();

/// What a scene calls them.
std::span<std::string_view const> mechanism_names();
std::span<std::string_view const> law_names();

MechanismInfo const& info(Mechanism mechanism);
LawInfo const& info(Law law);
/// What says how contacts push: the law, or `rigid_contact` where nothing gives way.
LawInfo const& contact_info(Parts const& parts);
/// What contact.law may say: the laws, and "rigid" behind them.
std::span<std::string_view const> contact_law_names();
/// Whether contact.law means anything to a mechanism.
bool has_contact_law(Mechanism mechanism);

/// Whether the contact law makes energy where its modes switch (model.md 8); a mechanism whose corners are points has none.
bool makes_energy(Parts const& parts);

/// Whether a drive prescribes a component of the state, so that neighbours cannot differ in it.
bool is_prescribed(Parts const& parts, int component);
/// How many components neighbours may differ in.
int free_states(Parts const& parts);

/// T [s]: 2π/|ω| of a driven crank, 2 (stroke/v + t_r) of the carriage (model.md 7); infinite where the crank rests or nothing drives.
double drive_period(Parts const& parts, Inputs const& inputs);
/// First time in (0, T] at which the drive has this phase [s]: the crank an angle, the carriage a share phase/2π of its period.
/// @param phase [rad], any turn of it  @param inputs whose drive has a period
double first_time_at(double phase, Parts const& parts, Inputs const& inputs);
/// Why there is no period: "mechanism.crank_speed is 0", "nothing drives a free_slider", "nothing drives a free crank".
std::string why_no_period(Parts const& parts);

/// Labels along a dimension of the quantity table: "P1" … "P8", the mode classes, "roll" "yaw" "pitch",
/// "x" "y" "z" of a direction, "top" "front" of a channel (a sensor of the experiment).
/// Empty for an unknown dimension.
std::vector<std::string> labels_of(std::string_view dimension);

/// Number i of a mechanism's state.
template <class Index> constexpr SeriesInfo const& state_info(MechanismInfo const& mechanism, Index i) {
    return series_table[static_cast<int>(mechanism.state[i])];
}

}  // namespace slideway
