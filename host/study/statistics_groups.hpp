// A tolerance report as groups of a result file.
#pragma once

#include "host/store/netcdf_file.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway {

/// Adds the groups `statistics`, `yield` (if there are limits) and `sensitivity` (if anything varies) to a file that is
/// open for writing, before it is closed.  Variables are named after their quantity (`crank_work_quantile`), lie along
/// its labels (if it has any, by the file's own dimension) and then along the group's: probability, bound, bin, edge,
/// input, limit.  Labels are texts in `<dimension>_name`.  The attributes `policy` and `intervals` say whom the numbers
/// are of.
/// @throws FileError.
void write_statistics(NetcdfFile& file, ToleranceReport const& report);

}  // namespace slideway
