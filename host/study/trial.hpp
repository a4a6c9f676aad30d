// What a study will cost, found out by running a few of its members.
#pragma once

#include <cstdint>
#include <optional>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"

namespace slideway {

/// A study's cost as a few of its members tell it; members that take very long are given up, and taken to go on as they began.
struct Trial {
    std::uint64_t members = 0;  // that were tried
    double steps = 0;           // of all members of the study, rejected ones included
    double seconds = 0;         // wall time on the threads that it was asked for, with the check of its resolution
};

/// Takes some seconds at most.  @return nothing where members cannot be tried alone (a sweep that continues), or do not run on the processor
std::optional<Trial> try_members(Scene const& scene, Backend const& backend, int threads);

}  // namespace slideway
