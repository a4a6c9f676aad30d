// The lanes of one instruction set, kind of memory and of law.
#include "host/backend/cpu_lanes.hpp"

namespace slideway::inline SLIDEWAY_ISA {

SLIDEWAY_LANES_OF(SLIDEWAY_MEMORY, SLIDEWAY_CONSERVING, )

}  // namespace slideway::inline SLIDEWAY_ISA
