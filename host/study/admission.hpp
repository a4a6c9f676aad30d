// What a scene that was read must meet before its members run: check, run and the library ask here, and refuse the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"

namespace slideway {

/// Members may start inside the way by this share of their smaller clearance, or of their preload deeper than that: contacts press in by less than a hundredth of it, and what starts
/// deeper starts with energy that nothing has given it.
inline constexpr double deepest_start = 0.1;

/// Looks at no more members than this, evenly over all.
inline constexpr std::uint64_t most_looked_at = 10'000;

/// What is wrong with the starts, in words, or nothing: "it starts inside the way, …", "members.csv:4: …".  Members of draws that fail at once (a draw
/// that breaks a rule, a pose that the rod does not reach) are left to their status, unless all of those looked at do.
std::optional<std::string> impossible_starts(Scene const& scene, Isa isa);

/// @param any_start whether starts that no mechanism has are taken all the same
/// @return what is wrong with those that are taken, or with draws that will fail alone, for a warning  @throws SceneError
std::optional<std::string> admit(Scene const& scene, bool any_start);

}  // namespace slideway
