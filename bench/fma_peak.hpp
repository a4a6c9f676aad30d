// The machine's multiply-add rate per instruction set: the yardstick for the kernels' flops.
#pragma once

#include <cstdint>

namespace slideway {

/// Runs `rounds` rounds of independent multiply-adds on packs of the unit's instruction set.  Each instruction set's namespace has
/// one, `fma_peak_rounds`.  @return floating-point operations done, two per lane of a multiply-add.
using FmaPeakRounds = std::uint64_t(std::uint64_t rounds);

}  // namespace slideway
