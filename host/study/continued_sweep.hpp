// A sweep whose columns follow one another: each starts from the states in which the one before has ended.
#pragma once

#include "host/driver/ensemble.hpp"
#include "host/scene/scene.hpp"

namespace slideway {

/// Runs the members of the plan column by column, and before them, without a result, those of earlier columns that lead to them: a member
/// is the same whichever others are asked for.  A start whose member has failed goes on from the scene's start.
/// @return totals over the members of the plan.
EnsembleTotals run_continued(Scene const& scene, EnsemblePlan plan, KernelInstance const& kernel, BlockSink const& sink,
                             StopRequest const& stop, Progress& progress);

}  // namespace slideway
