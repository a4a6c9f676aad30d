// What studies of orbits print to stdout, at the end of a run and by `info`.
#pragma once

#include "host/commands/text.hpp"
#include "host/store/result_view.hpp"

namespace slideway::cli {

/// Distribution and mean of the exponents and how the largest converged; nothing where there are none.
void print_exponents(ResultReader const& results);

/// How many sections there are, and a warning where members have none.
void print_sections(ResultReader const& results);

}  // namespace slideway::cli
