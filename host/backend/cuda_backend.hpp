#pragma once

#include <memory>

#include "host/backend/backend.hpp"

namespace slideway {

/// A card of this machine, on the CUDA runtime.  The program has it of the module: cuda_backend (backend.hpp).
std::shared_ptr<Backend const> open_card(CardShare const& share);

}  // namespace slideway
