// Modules for cards that have no kernels: what a program finds where it looks for libslideway_cuda.so.  Compiled once per kind
// (tests/CMakeLists.txt).
#include "host/backend/commit.hpp"
#include "host/backend/cuda_module.hpp"

#if !defined(SLIDEWAY_MODULE_INTERFACE)
#define SLIDEWAY_MODULE_INTERFACE slideway::cuda_interface
#endif
#if !defined(SLIDEWAY_MODULE_BUILD)
#define SLIDEWAY_MODULE_BUILD SLIDEWAY_BUILD
#endif
#if !defined(SLIDEWAY_MODULE_LAYOUT)
#define SLIDEWAY_MODULE_LAYOUT slideway::border_layout()
#endif

namespace {

/// Rank 0 meets no card, rank 1 a broken one, and the others one that refuses every block.
class Refusing final : public slideway::Backend {
public:
    std::string_view name() const override { return "cuda"; }
    std::string isa() const override { return "sm_00"; }
    std::string machine() const override { return "no GPU, sm_00"; }
    std::string flags() const override { return ""; }
    int workers(int threads) const override { return threads; }
    slideway::BlockBounds bounds(slideway::BlockDemand const&) const override {
        throw slideway::DeviceError("cuda: no room; use --backend cpu");
    }
    double seconds_per_step(double, int) const override { return 1; }
    slideway::BlockKernel kernel(slideway::Parts const&, bool) const override {
        return [](slideway::Block&) { throw slideway::DeviceError("cuda: no kernel; use --backend cpu"); };
    }
    double peak() const override { return 1e15; }
    std::string objection() const override { return ""; }
};

[[maybe_unused]] std::shared_ptr<slideway::Backend const> open_card(slideway::CardShare const& share) {
    if (share.rank == 0) throw slideway::NoDevice("cuda: no card in this module; use --backend cpu");
    if (share.rank == 1) throw slideway::DeviceError("cuda: a broken card; use --backend cpu");
    return std::make_shared<Refusing>();
}

}  // namespace

#if !defined(SLIDEWAY_MODULE_IS_OF_OTHERS)
extern "C" __attribute__((visibility("default"))) slideway::CudaModule const* slideway_cuda_module() {
    static constexpr slideway::CudaModule module{SLIDEWAY_MODULE_INTERFACE, SLIDEWAY_MODULE_BUILD, SLIDEWAY_MODULE_LAYOUT,
                                                 &open_card};
    return &module;
}
#endif
