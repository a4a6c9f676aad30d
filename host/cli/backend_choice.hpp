// Which backend a run takes, and why.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "host/backend/backend.hpp"

namespace slideway::cli {

struct BackendChoice {
    std::shared_ptr<Backend const> backend;
    std::string reason;  // why `auto` took it; "" where there is no other
};

/// "NVIDIA H100 80GB HBM3, sm_90", "avx512, 8 lanes"
std::string machine_text(Backend const& backend);
/// "cuda (NVIDIA H100 80GB HBM3, sm_90)", "cpu (avx512, 8 lanes)"
std::string backend_text(Backend const& backend);

/// What the user says: `--backend`, `--isa`, as `require_backend` lets them pass.
struct BackendWords {
    std::string backend = "auto";
    std::string isa = "auto";
};

/// How many members it takes for a card to pay beside the processor's lanes: a thread of a card is about that much slower than a lane.
std::uint64_t pays_from(Isa isa, int threads);

/// `auto` takes a card where there is one that this build has kernels for and the members are enough for it to pay.
/// @param rank of this process, which shares the machine's cards with others in turn
/// @throws SceneError if this machine does not have the instruction set; DeviceError if a card is asked for and none can be used
BackendChoice choose_backend(BackendWords const& words, std::uint64_t members, int threads, int rank);

}  // namespace slideway::cli
