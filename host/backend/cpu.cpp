#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "host/backend/backend.hpp"
#include "host/backend/built_isas.hpp"
#include "host/backend/kernel_modules.hpp"
#include "host/backend/linkage_modules.hpp"
#include "host/backend/own_modules.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"

namespace slideway {

// Each instruction set has kernels of every law and mechanism of the tree.
#define SLIDEWAY_LAW_DECLARED(name, Type) extern LawKernels const name##_law_kernels;
#define SLIDEWAY_LAW_ADDRESS(name, Type) &name##_law_kernels,
#define SLIDEWAY_DECLARED(name, Type, Base) extern MechanismKernels const name##_kernels;
#define SLIDEWAY_ADDRESS(name, Type, Base) &name##_kernels,
#define SLIDEWAY_KERNELS_OF(isa)                                                                        \
    namespace isa {                                                                                     \
    SLIDEWAY_LAWS(SLIDEWAY_LAW_DECLARED)                                                                \
    SLIDEWAY_MECHANISMS(SLIDEWAY_DECLARED)                                                              \
    extern MechanismKernels const linkage_kernels;                                                      \
    constexpr LawKernels const* laws[] = {SLIDEWAY_LAWS(SLIDEWAY_LAW_ADDRESS)};                         \
    constexpr MechanismKernels const* kernels[] = {SLIDEWAY_MECHANISMS(SLIDEWAY_ADDRESS)};              \
    }
SLIDEWAY_FOR_EACH_ISA(SLIDEWAY_KERNELS_OF)
#undef SLIDEWAY_LAW_DECLARED
#undef SLIDEWAY_LAW_ADDRESS
#undef SLIDEWAY_DECLARED
#undef SLIDEWAY_ADDRESS
#undef SLIDEWAY_KERNELS_OF

namespace {

struct IsaInfo {
    std::string_view name;
    int lanes;
    double seconds;  // one step of one member on one core of a server of the 2020s, full packs, rejected steps and events shared out
};
// scalar_libm: where the C library has no instruction either.
constexpr IsaInfo isa_table[] = {{"scalar", 1, 1.2e-6}, {"scalar_libm", 1, 1.6e-4}, {"avx2", 4, 0.7e-6}, {"avx512", 8, 0.5e-6}, {"neon", 2, 0.9e-6}};
constexpr std::array known_isas = {Isa::scalar, Isa::scalar_libm, Isa::avx2, Isa::avx512, Isa::neon};

struct BuiltIsa {
    Isa isa;
    char const* flags;
    std::span<LawKernels const* const> laws;           // by Law
    std::span<MechanismKernels const* const> kernels;  // by Mechanism
    MechanismKernels const* linkages;
};

#define SLIDEWAY_BUILT_ISA(isa) BuiltIsa{Isa::isa, SLIDEWAY_FLAGS_##isa, isa::laws, isa::kernels, &isa::linkage_kernels},
constexpr BuiltIsa built_table[] = {SLIDEWAY_FOR_EACH_ISA(SLIDEWAY_BUILT_ISA)};
#undef SLIDEWAY_BUILT_ISA

IsaInfo const& info(Isa isa) { return isa_table[static_cast<std::size_t>(isa)]; }

std::size_t place_of(Isa isa) {
    return static_cast<std::size_t>(std::ranges::find(built_table, isa, &BuiltIsa::isa) - std::begin(built_table));
}

bool runs_here(Isa isa) { return is_built(isa) && processor_has(isa); }

}  // namespace

std::string_view name_of(Isa isa) { return info(isa).name; }

int lanes_of(Isa isa) { return info(isa).lanes; }

bool is_built(Isa isa) { return place_of(isa) < std::size(built_table); }

std::string flags_of(Isa isa) { return is_built(isa) ? built_table[place_of(compiled_isa(isa))].flags : ""; }

Isa compiled_isa(Isa isa) {
    bool const replaced = isa == Isa::scalar && !runs_here(isa) && runs_here(Isa::scalar_libm);
    return replaced ? Isa::scalar_libm : isa;
}

bool is_supported(Isa isa) { return runs_here(compiled_isa(isa)); }

Isa best_isa() {
    Isa best = Isa::scalar;
    for (Isa const isa : built_isas()) {
        if (lanes_of(isa) > lanes_of(best) && is_supported(isa)) best = isa;
    }
    return best;
}

Isa best_isa(Parts const& parts) {
    if (parts.linkage != nullptr) return best_isa();
    auto const law = static_cast<std::size_t>(parts.law), mechanism = static_cast<std::size_t>(parts.mechanism);
    auto const laws = built_table[0].laws.size(), mechanisms = built_table[0].kernels.size();
    Isa best = Isa::scalar;
    bool found = false;
    for (Isa const isa : built_isas()) {
        bool const has = is_supported(isa) && (law < laws || has_own_kernels(ModuleKind::law, law - laws, compiled_isa(isa))) &&
                         (mechanism < mechanisms || has_own_kernels(ModuleKind::mechanism, mechanism - mechanisms, compiled_isa(isa)));
        if (has && (!found || lanes_of(isa) > lanes_of(best))) best = isa, found = true;
    }
    return found ? best : best_isa();
}

std::span<Isa const> all_isas() { return known_isas; }

std::span<Isa const> built_isas() {
    static constexpr auto isas = [] {
        std::array<Isa, std::size(built_table)> all{};
        std::ranges::transform(built_table, all.begin(), &BuiltIsa::isa);
        return all;
    }();
    return isas;
}

namespace {

/// Of rigid contacts the mechanisms of a base are a module, and their members with shadows are another: nothing else takes as long to compile.
MechanismKernels const& rigid_kernels(Isa isa, Mechanism mechanism, bool shadows) {
    std::string base;
#define SLIDEWAY_BASE_OF(name, Type, Base) if (mechanism == Mechanism::name) base = #Base;
    SLIDEWAY_MECHANISMS(SLIDEWAY_BASE_OF)
#undef SLIDEWAY_BASE_OF
    if (base.empty()) throw std::invalid_argument("find_instance: the mechanism of these parts has no rigid contacts");
    return module_kernels("rigid_" + base + (shadows ? "_shadowed_" : "_") + std::string(name_of(isa)));
}

}  // namespace

KernelInstance find_instance(Isa isa, Parts const& parts, bool shadows) {
    BuiltIsa const& built = built_table[place_of(compiled_isa(isa))];
    if (parts.linkage != nullptr) {
        MechanismKernels const* const compiled = compiled_linkage(parts, built.isa);
        return {compiled != nullptr ? compiled : built.linkages, nullptr, parts};
    }
    if (parts.rigid) return {&rigid_kernels(built.isa, parts.mechanism, shadows), nullptr, parts};
    auto const law_place = static_cast<std::size_t>(parts.law), place = static_cast<std::size_t>(parts.mechanism);
    KernelInstance const instance{
        place < built.kernels.size() ? built.kernels[place] : own_kernels(ModuleKind::mechanism, place - built.kernels.size(), built.isa).mechanism,
        law_place < built.laws.size() ? built.laws[law_place] : own_kernels(ModuleKind::law, law_place - built.laws.size(), built.isa).law, parts};
    if (!instance.law->with[static_cast<int>(parts.damping)]) throw std::invalid_argument("find_instance: the law of these parts has no such damping");
    return instance;
}

namespace {

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
        return info(isa_).seconds / filled / workers;
    }

    BlockKernel kernel(Parts const& parts, bool shadows) const override {
        return [instance = find_instance(isa_, parts, shadows), shadows](Block& block) { shadows ? instance.run_shadowed(block) : instance.run(block); };
    }

    double peak() const override { return 0; }
    std::string objection() const override { return {}; }

private:
    Isa const isa_;
};

}  // namespace

std::shared_ptr<Backend const> cpu_backend(Isa isa) {
    if (!is_supported(isa))
        throw DeviceError(std::string(name_of(isa)) + ": this machine has no processor for the kernels of this program; build it with -DSLIDEWAY_ISAS=all");
    return std::make_shared<CpuBackend>(isa);
}

}  // namespace slideway
