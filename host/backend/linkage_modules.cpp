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

LinkagePlan compiled_plan(Parts const& parts) {
    LinkagePlan plan = *parts.linkage;
    plan.turns_freely = plan.is_driven != 0 && parts.drive.turns_freely();
    plan.is_loaded = parts.loads.count > 0;
    return plan;
}

std::string linkage_module_name(LinkagePlan const& plan) { return fmt::format("plan_{:016x}", fnv1a(std::as_bytes(std::span(&plan, 1)))); }

std::string linkage_header(Parts const& parts) {
    using Numbers = std::array<int, sizeof(LinkagePlan) / sizeof(int)>;
    return fmt::format(R"(// The plan of a linkage, as a scene has it: the numbers of a LinkagePlan, one after the other.
#include <array>
#include <bit>

#include "kernels/linkage/linkage_plan.hpp"

namespace slideway::inline SLIDEWAY_ISA {{
struct PlanOfScene {{
    static constexpr LinkagePlan plan = std::bit_cast<LinkagePlan>(std::array<int, {}>{{
        {}}});
}};
}}
#define SLIDEWAY_LINKAGE PlanOfScene
)",
                       std::tuple_size_v<Numbers>, fmt::join(std::bit_cast<Numbers>(compiled_plan(parts)), ", "));
}

MechanismKernels const* compiled_linkage(Parts const& parts, Isa isa) {
    try {
        LinkagePlan const plan = compiled_plan(parts);
        auto const place = find_own_module(ModuleKind::linkage, linkage_module_name(plan), {}, [](ModuleKind, KernelModule const&) { return std::string(); });
        if (!place || !has_own_kernels(ModuleKind::linkage, *place, isa)) return nullptr;
        MechanismKernels const* const kernels = own_kernels(ModuleKind::linkage, *place, isa).mechanism;
        return std::memcmp(kernels->linkage, &plan, sizeof plan) == 0 ? kernels : nullptr;
    } catch (DeviceError const&) {
        return nullptr;  // by the tables it runs, too
    }
}

}  // namespace slideway
