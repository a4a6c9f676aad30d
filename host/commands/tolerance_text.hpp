// What the study `tolerance` prints to stdout, at the end of a run and by `info`.
#pragma once

#include "host/study/tolerance_report.hpp"

namespace slideway::cli {

/// Tables of moments and quantiles, yields, and what matters most for each quantity; lines of at most 120 columns.
void print_tolerance(ToleranceReport const& report);

}  // namespace slideway::cli
