// The lanes of one instruction set and kind of memory.
#include "host/backend/cpu_lanes.hpp"

namespace slideway::inline SLIDEWAY_ISA {

SLIDEWAY_LANES_OF(SLIDEWAY_MEMORY, )

}  // namespace slideway::inline SLIDEWAY_ISA
