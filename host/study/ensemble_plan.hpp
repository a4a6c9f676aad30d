// What the members of a scene, whatever its study, ask of the run and of the result file.
#pragma once

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/ensemble.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/provenance.hpp"
#include "host/store/result_layout.hpp"
#include "host/store/run_identity.hpp"

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

}  // namespace slideway
