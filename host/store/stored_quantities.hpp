// Which quantities a result file has.  It says so itself: a mechanism's own are known without the module that it came with.
#pragma once

#include <vector>

#include "host/store/result_layout.hpp"
#include "host/store/result_view.hpp"

namespace slideway {

/// Their columns, in the order of the file; `place` counts from the first column of each.
std::vector<QuantityColumn> stored_columns(ResultView const& results);

}  // namespace slideway
