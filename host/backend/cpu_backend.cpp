#include <algorithm>

#include "host/backend/backend.hpp"

namespace slideway {
namespace {

/// One step of one member on one core of a server of the 2020s [s], full packs, rejected steps and events shared out.
double seconds_per_member_step(Isa isa) {
    switch (isa) {
        case Isa::scalar:
            return 1.2e-6;
        case Isa::sse2:
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
    explicit CpuBackend(Isa isa) : isa_(isa) {}

    std::string_view name() const override { return "cpu"; }
    std::string isa() const override { return std::string(name_of(isa_)); }
    std::string machine() const override { return {}; }
    std::string flags() const override { return flags_of(isa_); }
    std::size_t lanes() const override { return static_cast<std::size_t>(lanes_of(isa_)); }
    std::size_t least_block() const override { return 8 * lanes(); }

    std::size_t largest_block(std::uint64_t bytes_per_member, int, std::size_t asked) const override {
        if (asked > 0) return asked;
        constexpr std::uint64_t memory = 64'000'000, least = 64, most = 4096;
        return static_cast<std::size_t>(std::clamp(memory / bytes_per_member, least, most));
    }

    std::uint64_t reserved_bytes() const override { return 0; }

    double seconds_per_step(double members, int workers) const override {
        // Packs are full except where a block has fewer members than lanes.
        double const filled = std::min(1.0, members / static_cast<double>(lanes()));
        return seconds_per_member_step(isa_) / filled / workers;
    }

    BlockKernel kernel(Parts const& parts, bool shadows) const override {
        KernelInstance const instance = find_instance(isa_, parts);
        return shadows ? instance.run_shadowed : instance.run;
    }

    double peak() const override { return 0; }

private:
    Isa const isa_;
};

}  // namespace

std::shared_ptr<Backend const> cpu_backend(Isa isa) { return std::make_shared<CpuBackend>(isa); }

}  // namespace slideway
