// The tables of a result that other programs read: members, time series, sections.
#pragma once

#include <string>
#include <vector>

#include "host/store/result_view.hpp"
#include "host/store/table_file.hpp"

namespace slideway {

// The view must outlive the tables, which read it when they are written.  Each throws SceneError where a result has no such table.

/// What a result says of each member: number, status, label, what varies under its key, quantities, and whatever else it has a number of.
ExportTable table_of_members(ResultView const& results);

/// @param names of series; none: all  @throws SceneError also for one that is not there
ExportTable table_of_series(ResultView const& results, std::vector<std::string> const& names);

ExportTable table_of_sections(ResultView const& results);

}  // namespace slideway
