// A sweep whose columns follow one another: each starts from the states in which the one before has ended.
#pragma once

#include "host/driver/ensemble.hpp"
#include "host/scene/scene.hpp"

namespace slideway {

/// Runs the columns of the plan, which holds all members, one after another; `plan.members` are whole columns.  A start whose
/// member has failed goes on from the scene's start.  @return totals over all columns.
EnsembleTotals run_continued(Scene const& scene, EnsemblePlan plan, KernelInstance const& kernel, BlockSink const& sink,
                             StopRequest const& stop, Progress& progress);

}  // namespace slideway
