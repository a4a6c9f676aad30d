#include <array>

#include "host/backend/backend.hpp"
#include "host/backend/instances.hpp"

namespace slideway {

namespace {

struct IsaInfo {
    std::string_view name;
    int lanes;
    char const* flags;
};

constexpr std::array isa_table = {
    IsaInfo{"scalar", 1, SLIDEWAY_FLAGS_scalar},
    IsaInfo{"sse2", 2, SLIDEWAY_FLAGS_sse2},
    IsaInfo{"avx2", 4, SLIDEWAY_FLAGS_avx2},
    IsaInfo{"avx512", 8, SLIDEWAY_FLAGS_avx512},
};

IsaInfo const& info(Isa isa) { return isa_table[static_cast<std::size_t>(isa)]; }

}  // namespace

std::string_view name_of(Isa isa) { return info(isa).name; }

int lanes_of(Isa isa) { return info(isa).lanes; }

std::string flags_of(Isa isa) { return info(isa).flags; }

bool is_supported(Isa isa) {
    switch (isa) {
        case Isa::sse2:
            return true;
        case Isa::scalar:
        case Isa::avx2:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
        case Isa::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
    }
    return false;
}

Isa best_isa() {
    for (Isa const isa : {Isa::avx512, Isa::avx2}) {
        if (is_supported(isa)) return isa;
    }
    return Isa::sse2;
}

std::span<Isa const> all_isas() {
    static constexpr std::array isas = {Isa::scalar, Isa::sse2, Isa::avx2, Isa::avx512};
    return isas;
}

KernelInstance find_instance(Isa isa, Parts const& parts) {
    auto const place = static_cast<int>(isa), mechanism = static_cast<int>(parts.mechanism);
    int const friction = parts.friction ? 1 : 0;
    if (!info(parts.mechanism).spatial) {
        return planar_tables[place]
            ->at[parts.damping == Damping::restitution ? 1 : 0][friction][parts.free_crank ? 1 : 0];
    }
    auto const& table = *instance_tables[place][static_cast<int>(parts.law)][static_cast<int>(parts.damping)];
    return table.at[mechanism][friction][parts.misaligned_way ? 1 : 0];
}

}  // namespace slideway
