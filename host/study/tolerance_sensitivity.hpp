// The part of a tolerance report that tells which inputs matter.
#pragma once

#include <vector>

#include "host/study/tolerance_members.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway {

/// Sobol indices of each column, of a saltelli design.
/// @param independent whether the rows are random draws: only these have intervals.
IndexReport index_report(ToleranceMembers const& members, Scene const& scene, std::span<QuantityColumn const> columns,
                         bool independent, ReportSettings const& settings);

/// Rank correlations and regression of each column, of other designs.
/// @param independent whether the members are random draws: only these have intervals.
std::vector<ColumnCorrelations> correlation_report(ToleranceMembers const& members, Scene const& scene,
                                                   std::span<QuantityColumn const> columns, bool independent,
                                                   ReportSettings const& settings);

}  // namespace slideway
