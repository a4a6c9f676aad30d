// Which backend a run takes, and why.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"

namespace slideway {

struct BackendRequest {
    enum class Kind { automatic, cpu, cuda } kind = Kind::automatic;
    std::optional<Isa> isa;  // of the processor, if the user says which
    int threads = 1;
    std::size_t block_members = 0;  // 0: as many as suit the run
    CardShare share;
};

struct BackendChoice {
    std::shared_ptr<Backend const> backend;
    std::string reason;  // why `automatic` took it; "" where there is no other
};

/// "cuda (NVIDIA H100 80GB HBM3, sm_90)", "cpu (avx512, 8 lanes)"
std::string backend_text(Backend const& backend);

/// How many members it takes for a card to pay beside the processor's lanes: a thread of a card is about that much slower than a lane.
std::uint64_t pays_from(Isa isa, int threads);

/// `automatic` takes a card where there is one that has room for the scene's blocks, is much faster than the processor in double precision, and
/// has members enough.
/// @param members of the run that may be at work at once  @throws DeviceError if a card is asked for and none can be used;
/// SceneError if one is asked for a mechanism of which it has no kernels
BackendChoice choose_backend(BackendRequest const& request, Scene const& scene, std::uint64_t members);

}  // namespace slideway
