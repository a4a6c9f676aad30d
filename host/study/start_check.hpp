// Whether members start where a mechanism can be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"

namespace slideway {

/// Members may start inside the way by this share of their smaller clearance: contacts press in by less than a hundredth of it, and what starts
/// deeper starts with energy that nothing has given it.
inline constexpr double deepest_start = 0.1;

/// Looks at no more members than this, evenly over all.
inline constexpr std::uint64_t most_looked_at = 10'000;

/// What is wrong with the starts, in words, or nothing: "3 of 10 members start inside the way, …".  Members that fail at once for another
/// reason (a draw that breaks a rule, a pose that the rod does not reach) are not counted: their status says so.
std::optional<std::string> impossible_starts(Scene const& scene, Isa isa);

}  // namespace slideway
