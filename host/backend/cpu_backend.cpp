#include <algorithm>

#include "host/backend/backend.hpp"

namespace slideway {
namespace {

/// One step of one member on one core of a server of the 2020s [s], full packs, rejected steps and events shared out.
double seconds_per_member_step(Isa isa) {
    switch (isa) {
        case Isa::scalar:
            return 1.2e-6;
        case Isa::scalar_libm:
            return 1.6e-4;  // where the C library has no instruction either
        case Isa::neon:
            return 0.9e-6;
        case Isa::avx2:
            return 0.7e-6;
        case Isa::avx512:
            return 0.5e-6;
    }
    return 1e-6;
}

class CpuBackend final : public Backend {
public:
    explicit CpuBackend(Isa isa) : isa_(compiled_isa(isa)) {}

    std::string_view name() const override { return "cpu"; }
    // What results tell: both ways to compile scalar give the same.
    std::string isa() const override { return std::string(name_of(isa_ == Isa::scalar_libm ? Isa::scalar : isa_)); }
    std::string machine() const override {
        if (isa_ == Isa::scalar_libm) return "scalar, the C library's fused multiply-add: slow";
        return std::string(name_of(isa_)) + ", " + std::to_string(lanes_of(isa_)) + " lanes";
    }
    std::string flags() const override { return flags_of(isa_); }
    int workers(int threads) const override { return threads; }

    BlockBounds bounds(BlockDemand const& demand) const override {
        constexpr std::uint64_t memory = 64'000'000, small = 64, large = 4096;
        BlockBounds bounds;
        bounds.lanes = static_cast<std::size_t>(lanes_of(isa_));
        bounds.least = 8 * bounds.lanes;
        bounds.most = static_cast<std::size_t>(std::clamp(memory / demand.bytes_per_member, small, large));
        return bounds;
    }

    double seconds_per_step(double members, int workers) const override {
        // Packs are full except where a block has fewer members than lanes.
        double const filled = std::min(1.0, members / lanes_of(isa_));
        return seconds_per_member_step(isa_) / filled / workers;
    }

    BlockKernel kernel(Parts const& parts, bool shadows) const override {
        return [instance = find_instance(isa_, parts), shadows](Block& block) {
            shadows ? instance.run_shadowed(block) : instance.run(block);
        };
    }

    double peak() const override { return 0; }
    std::string objection() const override { return {}; }

private:
    Isa const isa_;
};

}  // namespace

std::shared_ptr<Backend const> cpu_backend(Isa isa) {
    if (!is_supported(isa)) {
        throw DeviceError(std::string(name_of(isa)) +
                          ": this machine has no processor for the kernels of this program; " +
                          "build it with -DSLIDEWAY_ISAS=all");
    }
    return std::make_shared<CpuBackend>(isa);
}

}  // namespace slideway
