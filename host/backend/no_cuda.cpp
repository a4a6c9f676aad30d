// A build without nvcc.
#include "host/backend/backend.hpp"

namespace slideway {

std::shared_ptr<Backend const> cuda_backend(CardShare const&) {
    throw NoDevice("cuda: this build has no code for cards (nvcc was not found); use --backend cpu");
}

}  // namespace slideway
