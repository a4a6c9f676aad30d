// The border between the program and libslideway_cuda.so: the kernels for cards are a module of their own, which the program opens when
// a run may use a card (cuda_open.cpp), so that nobody else compiles, loads or ships them.
#pragma once

#include <cstddef>
#include <memory>

#include "host/backend/backend.hpp"

namespace slideway {

/// In the module: a card of this machine, on the CUDA runtime.  The program has it by `cuda_backend` (backend.hpp).
std::shared_ptr<Backend const> open_card(CardShare const& share);

/// What the module says of itself.  It exports one function, `cuda_module_entry`, which returns this.
struct CudaModule {
    // Of every version, so that a program can say why it refuses one.
    int interface = 0;            // cuda_interface of its sources
    char const* build = nullptr;  // version, commit, compiler
    // Of this interface.
    std::size_t layout = 0;  // border_layout of its sources
    /// As cuda_backend.  Its errors arrive as what they are: the C++ library compares types that cross a border by their names.
    std::shared_ptr<Backend const> (*open_card)(CardShare const& share) = nullptr;
};

inline constexpr int cuda_interface = 1;
inline constexpr char const* cuda_module_name = "libslideway_cuda.so";
inline constexpr char const* cuda_module_entry = "slideway_cuda_module";
using CudaModuleEntry = CudaModule const*();

/// Differs where two sources of the same commit, changed since, would not understand each other.
constexpr std::size_t border_layout() {
    std::size_t layout = 0;
    for (std::size_t const size : {sizeof(Block), sizeof(Inputs), sizeof(Parts), sizeof(MemberRecord), sizeof(BlockDemand),
                                   sizeof(BlockBounds), sizeof(CardShare)}) {
        layout = layout * 4099 + size;
    }
    return layout;
}

}  // namespace slideway
