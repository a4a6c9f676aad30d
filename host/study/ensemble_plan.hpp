// What the members of a scene, whatever its study, ask of the run and of the result file.
#pragma once

#include <cstdint>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/block_buffers.hpp"
#include "host/run/ensemble.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/run_identity.hpp"
#include "host/store/result_layout.hpp"

namespace slideway {

ResultLayout result_layout(Scene const& scene, MemberSet const& members);
/// Of a scene that keeps statistics in place of members.
StatisticsPlan statistics_plan(Scene const& scene);
/// What the blocks of a scene ask of a backend.
BlockDemand block_demand(Scene const& scene, Backend const& backend, int threads, std::size_t block_members = 0);
/// @param threads that the user allows  @param block_members 0: as many as suit the run.
EnsemblePlan ensemble_plan(Scene const& scene, MemberSet const& members, Backend const& backend, int threads,
                           std::size_t block_members = 0);
/// What the scene alone says, but for its text.
Provenance provenance_of(Scene const& scene);
Provenance provenance(Scene const& scene, Backend const& backend, int threads);
RunIdentity run_identity(Scene const& scene, MemberSet const& members, Backend const& backend);

// When the members of a study of orbits stop: for a section, or to have their shadows rescaled.

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
