#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "host/backend/backend.hpp"
#include "host/backend/built_isas.hpp"
#include "host/backend/processor.hpp"
#include "kernels/rigid/list.hpp"

namespace slideway {

// Each instruction set has kernels of every mechanism.
#define SLIDEWAY_DECLARED(name, Type, Base) extern MechanismKernels const name##_kernels;
#define SLIDEWAY_ADDRESS(name, Type, Base) &name##_kernels,
#define SLIDEWAY_RIGID_DECLARED(name, Type) extern MechanismKernels const name##_rigid;
#define SLIDEWAY_RIGID_ADDRESS(name, Type) if (mechanism == Mechanism::name) return &name##_rigid;
#define SLIDEWAY_KERNELS_OF(isa)                                                                        \
    namespace isa {                                                                                     \
    SLIDEWAY_MECHANISMS(SLIDEWAY_DECLARED)                                                              \
    constexpr MechanismKernels const* kernels[] = {SLIDEWAY_MECHANISMS(SLIDEWAY_ADDRESS)};              \
    SLIDEWAY_RIGID(SLIDEWAY_RIGID_DECLARED)                                                             \
    MechanismKernels const* rigid_kernels(Mechanism mechanism) {                                        \
        SLIDEWAY_RIGID(SLIDEWAY_RIGID_ADDRESS)                                                          \
        return nullptr;                                                                                 \
    }                                                                                                   \
    }
SLIDEWAY_FOR_EACH_ISA(SLIDEWAY_KERNELS_OF)
#undef SLIDEWAY_DECLARED
#undef SLIDEWAY_ADDRESS
#undef SLIDEWAY_RIGID_DECLARED
#undef SLIDEWAY_RIGID_ADDRESS
#undef SLIDEWAY_KERNELS_OF

namespace {

struct IsaInfo {
    std::string_view name;
    int lanes;
};

constexpr std::array isa_table = {
    IsaInfo{"scalar", 1}, IsaInfo{"scalar_libm", 1}, IsaInfo{"avx2", 4}, IsaInfo{"avx512", 8}, IsaInfo{"neon", 2},
};
constexpr std::array known_isas = {Isa::scalar, Isa::scalar_libm, Isa::avx2, Isa::avx512, Isa::neon};

struct BuiltIsa {
    Isa isa;
    char const* flags;
    MechanismKernels const* const* kernels;              // [mechanism]
    MechanismKernels const* (*rigid)(Mechanism);  // nullptr of a mechanism that has none
};

#define SLIDEWAY_BUILT_ISA(isa) BuiltIsa{Isa::isa, SLIDEWAY_FLAGS_##isa, isa::kernels, &isa::rigid_kernels},
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

std::span<Isa const> all_isas() { return known_isas; }

std::span<Isa const> built_isas() {
    static constexpr auto isas = [] {
        std::array<Isa, std::size(built_table)> all{};
        std::ranges::transform(built_table, all.begin(), &BuiltIsa::isa);
        return all;
    }();
    return isas;
}

KernelInstance find_instance(Isa isa, Parts const& parts) {
    BuiltIsa const& built = built_table[place_of(compiled_isa(isa))];
    auto const* const kernels = parts.rigid ? built.rigid(parts.mechanism) : built.kernels[static_cast<int>(parts.mechanism)];
    if (kernels == nullptr) throw std::invalid_argument("find_instance: the mechanism of these parts has no rigid contacts");
    if (!kernels->has(parts)) throw std::invalid_argument("find_instance: the law of these parts has no such damping");
    return {kernels, parts};
}

}  // namespace slideway
