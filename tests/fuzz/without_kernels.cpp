// In the place of host/backend: one instruction set, and kernels that take minutes to compile here replaced by ones whose members end at once,
// with numbers that follow from their inputs.  What the host makes of states, members and results is all there.
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>

#include "host/backend/backend.hpp"
#include "host/backend/own_modules.hpp"
#include "kernels/members/start.hpp"

namespace slideway {
namespace {

constexpr std::array isas = {Isa::scalar, Isa::avx512};

void probe_states(ProbeTable const& table, Parts const&, LawKernels const*) {
    for (std::size_t row = 0; row < table.rows; ++row) {
        ProbeResult result{};
        result.energy = table.times[row];
        // Some runs are refused, and some are not: joints of 0.2 mm and more start inside the way.
        double const clearance = table.inputs[row].clearance_y;
        if (clearance >= 2e-4) result.penetration_y[0] = clearance;
        result.status = Status::finished;
        table.results[row] = result;
    }
}

void end_members(Block& block, Parts const&, LawKernels const*) {
    for (std::size_t member = 0; member < block.members; ++member) {
        block.records[member].status = Status::finished;
        block.records[member].time = block.settings.end_time;
    }
}

constexpr MechanismKernels kernels = {nullptr, &end_members, &end_members, &probe_states};

class EndingBackend final : public Backend {
public:
    std::string_view name() const override { return "cpu"; }
    std::string isa() const override { return "scalar"; }
    std::string machine() const override { return "scalar, without kernels"; }
    std::string flags() const override { return {}; }
    int workers(int threads) const override { return threads; }
    BlockBounds bounds(BlockDemand const&) const override { return {1, 8, 64}; }
    double seconds_per_step(double members, int) const override { return 1e-9 * members; }
    BlockKernel kernel(Parts const& parts, bool shadows) const override {
        return [instance = find_instance(Isa::scalar, parts, shadows)](Block& block) { instance.run(block); };
    }
    double peak() const override { return 0; }
    std::string objection() const override { return {}; }
};

}  // namespace

std::string_view name_of(Isa isa) { return isa == Isa::scalar ? "scalar" : "avx512"; }
int lanes_of(Isa) { return 1; }
bool processor_has(Isa isa) { return is_built(isa); }
bool is_built(Isa isa) { return isa == Isa::scalar; }
bool is_supported(Isa isa) { return is_built(isa); }
Isa best_isa() { return Isa::scalar; }
Isa best_isa(Parts const&) { return Isa::scalar; }
std::span<Isa const> all_isas() { return isas; }
std::span<Isa const> built_isas() { return std::span(isas).first(1); }
Isa compiled_isa(Isa isa) { return isa; }
std::string flags_of(Isa) { return {}; }
KernelInstance find_instance(Isa, Parts const& parts, bool) { return {&kernels, nullptr, parts}; }

std::optional<std::size_t> find_own_module(ModuleKind, std::string_view, std::span<std::string const>, std::string (*)(ModuleKind, KernelModule const&)) { return std::nullopt; }
std::size_t own_module_count(ModuleKind) { return 0; }
OwnModule const& own_module(ModuleKind, std::size_t) { throw DeviceError("there are no modules"); }
std::vector<std::string> own_module_names(ModuleKind, std::span<std::string const>) { return {}; }
bool is_module_name(std::string_view) { return false; }

std::shared_ptr<Backend const> cpu_backend(Isa isa) {
    if (!is_built(isa)) throw DeviceError("this program has no kernels for " + std::string(name_of(isa)));
    return std::make_shared<EndingBackend>();
}
std::shared_ptr<Backend const> cuda_backend(CardShare const&) { throw NoDevice("there is no card"); }

}  // namespace slideway
