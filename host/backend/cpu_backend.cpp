#include <algorithm>

#include "host/backend/backend.hpp"

namespace slideway {
namespace {

class CpuBackend final : public Backend {
public:
    explicit CpuBackend(Isa isa) : isa_(isa) {}

    std::string_view name() const override { return "cpu"; }
    std::string isa() const override { return std::string(name_of(isa_)); }
    std::string machine() const override { return {}; }
    std::string flags() const override { return flags_of(isa_); }
    std::size_t lanes() const override { return static_cast<std::size_t>(lanes_of(isa_)); }
    std::size_t least_block() const override { return 8 * lanes(); }

    std::size_t largest_block(std::uint64_t bytes_per_member, int) const override {
        constexpr std::uint64_t memory = 64'000'000, least = 64, most = 4096;
        return static_cast<std::size_t>(std::clamp(memory / bytes_per_member, least, most));
    }

    BlockKernel kernel(Parts const& parts, bool shadows) const override {
        KernelInstance const instance = find_instance(isa_, parts);
        return shadows ? instance.run_shadowed : instance.run;
    }

private:
    Isa const isa_;
};

}  // namespace

std::shared_ptr<Backend const> cpu_backend(Isa isa) { return std::make_shared<CpuBackend>(isa); }

}  // namespace slideway
