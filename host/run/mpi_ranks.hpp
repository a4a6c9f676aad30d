// The ranks of an MPI job.  Compiled where MPI was found.
#pragma once

#include <memory>

#include "host/run/launcher.hpp"
#include "host/run/ranks.hpp"

namespace slideway {

/// Starts MPI; the returned object ends it.
/// @throws SceneError if MPI lets only its main thread make calls, or sees other processes than the launcher started.
std::unique_ptr<Ranks> join_mpi(Launch const& launch);

}  // namespace slideway
