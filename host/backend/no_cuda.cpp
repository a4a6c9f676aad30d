// A build without nvcc.
#include "host/backend/backend.hpp"

namespace slideway {

bool has_cuda() { return false; }

std::shared_ptr<Backend const> cuda_backend(int) {
    throw NoDevice("cuda: this build has no code for cards (nvcc was not found); use --backend cpu");
}

}  // namespace slideway
