// The lanes of one instruction set, kind of memory and of law, for members with shadows or without.
#include "host/backend/cpu_lanes.hpp"

namespace slideway::inline SLIDEWAY_ISA {

SLIDEWAY_LANES_OF(SLIDEWAY_BASE, SLIDEWAY_MEMORY, SLIDEWAY_CONSERVING, )  // plain or shadowed

}  // namespace slideway::inline SLIDEWAY_ISA
