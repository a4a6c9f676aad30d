#include "host/backend/linkage_modules.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/own_modules.hpp"
#include "host/base/bytes.hpp"
#include "host/base/error.hpp"

namespace slideway {
namespace {

using Numbers = std::array<int, sizeof(LinkagePlan) / sizeof(int)>;

bool is_for(MechanismKernels const& kernels, Parts const& parts) {
    return std::memcmp(kernels.linkage, parts.linkage, sizeof(LinkagePlan)) == 0 && kernels.turns_freely == parts.drive.turns_freely();
}

}  // namespace

std::string linkage_module_name(LinkagePlan const& plan, bool turns_freely) {
    Fnv1a hash;
    hash.add(std::as_bytes(std::span(&plan, 1)));
    hash.add(std::uint64_t{turns_freely});
    return fmt::format("plan_{:016x}", hash.value());
}

std::string linkage_header(Parts const& parts) {
    return fmt::format(R"(// The plan of a linkage, as a scene has it: the numbers of a LinkagePlan, one after the other.
#include <array>
#include <bit>

#include "kernels/linkage/linkage_plan.hpp"

namespace slideway::inline SLIDEWAY_ISA {{
struct PlanOfScene {{
    static constexpr LinkagePlan plan = std::bit_cast<LinkagePlan>(std::array<int, {}>{{
        {}}});
    static constexpr bool turns_freely = {};
}};
}}
#define SLIDEWAY_LINKAGE PlanOfScene
)",
                       std::tuple_size_v<Numbers>, fmt::join(std::bit_cast<Numbers>(*parts.linkage), ", "), parts.drive.turns_freely());
}

MechanismKernels const* compiled_linkage(Parts const& parts, Isa isa) {
    try {
        std::string const name = linkage_module_name(*parts.linkage, parts.drive.turns_freely());
        auto const place = find_own_module(ModuleKind::linkage, name, {}, [](ModuleKind, KernelModule const&) { return std::string(); });
        if (!place || !has_own_kernels(ModuleKind::linkage, *place, isa)) return nullptr;
        MechanismKernels const* const kernels = own_kernels(ModuleKind::linkage, *place, isa).mechanism;
        return is_for(*kernels, parts) ? kernels : nullptr;
    } catch (DeviceError const&) {
        return nullptr;  // by the tables it runs, too
    }
}

}  // namespace slideway
