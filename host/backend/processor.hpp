// What the processor of this machine can do.
#pragma once

#include "host/backend/backend.hpp"

namespace slideway {

/// It has the instructions that kernels of this instruction set are compiled to.
bool processor_has(Isa isa);

}  // namespace slideway
