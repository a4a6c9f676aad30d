#include <algorithm>
#include <array>
#include <iterator>

#include "host/backend/backend.hpp"
#include "host/backend/built_isas.hpp"
#include "host/backend/instances.hpp"
#include "host/backend/processor.hpp"

namespace slideway {

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
};

// In the order of the tables of instances.
#define SLIDEWAY_BUILT_ISA(isa) BuiltIsa{Isa::isa, SLIDEWAY_FLAGS_##isa},
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
    auto const place = place_of(compiled_isa(isa));
    auto const mechanism = static_cast<int>(parts.mechanism);
    int const friction = parts.friction ? 1 : 0;
    if (!info(parts.mechanism).spatial) {
        return planar_tables[place]
            ->at[parts.damping == Damping::restitution ? 1 : 0][friction][parts.free_crank ? 1 : 0];
    }
    auto const& table = *instance_tables[place][static_cast<int>(parts.law)][static_cast<int>(parts.damping)];
    return table.at[mechanism][friction][parts.misaligned_way ? 1 : 0];
}

}  // namespace slideway
