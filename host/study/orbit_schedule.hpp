// When the members of a study of orbits stop: for a section, or to have their shadows rescaled.
#pragma once

#include <cstdint>

#include "host/config/scene.hpp"
#include "host/run/block_buffers.hpp"

namespace slideway {

/// A study's stops.  All members have as many, at times of their own: a revolution is the period of the member's drive.  How many
/// is decided by the drive of the scene.  By turns (Scene::goes_by_turns) stops are angles, and a revolution is 2π.
struct OrbitSchedule {
    StopPlan stops;
    MemberTiming timing;
    CrossingPlan crossings;  // of sections on a state or a gap
    bool sections = false;   // the states at the stops' sections are kept
    bool by_turns = false;   // stops are angles
    double end = 0;          // [s] of the scene's own member; by turns the time that it has
    double turns = 0;        // periods of the drive until then; 0 where nothing comes round

    /// Rows of a member in the file, at most.
    std::size_t section_rows() const { return !sections ? 0 : crossings.room > 0 ? crossings.room : stops.sections(); }
};

/// Of an ensemble its end alone, by revolutions that differ each member's own.
OrbitSchedule orbit_schedule(Scene const& scene);

/// Shadows as a study asks for them, without directions.
ShadowPlan shadow_plan(Scene const& scene);

/// Unit vectors [shadows][states], drawn by seed, member and shadow alone; 0 in what a drive prescribes.
void draw_directions(std::uint64_t seed, std::uint64_t member, int shadows, Parts const& parts, double* directions);

}  // namespace slideway
