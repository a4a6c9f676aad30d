// The one function that libslideway_cuda.so exports.
#include "host/backend/cuda_module.hpp"

#include "host/backend/commit.hpp"

extern "C" __attribute__((visibility("default"))) slideway::CudaModule const* slideway_cuda_module() {
    static constexpr slideway::CudaModule module{slideway::cuda_interface, SLIDEWAY_BUILD, slideway::border_layout(),
                                                 &slideway::open_card};
    return &module;
}
