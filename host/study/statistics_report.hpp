// A tolerance report of members that were not stored.
#pragma once

#include <cstdint>
#include <string>

#include "host/store/block_statistics.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway {

/// Moments, ends and yields are those of the members, without rounding but for their last; quantiles and histograms are
/// by the sketch (QuantileSketch::error), and there are no correlations.
/// @param left members of the run that did not run.  @param path of what the statistics are from, for messages.
/// @throws FileError if the statistics are not of the scene's quantities and limits.
ToleranceReport statistics_report(BlockStatistics const& statistics, std::uint64_t left, Scene const& scene,
                                  std::string const& path);

}  // namespace slideway
