// Linkages whose plan the compiler knew: modules beside the tables that run any of them (kernels/linkage/linkage_plans.hpp), with the same bits.
#pragma once

#include <string>

#include "host/backend/backend.hpp"
#include "host/backend/kernel_tables.hpp"

namespace slideway {

/// What the compiler is to know of these parts.
LinkagePlan compiled_plan(Parts const& parts);
/// What the module of such a plan is called.
std::string linkage_module_name(LinkagePlan const& plan);
/// The header that the module of these parts' linkage is compiled from (module_compiler.hpp).
std::string linkage_header(Parts const& parts);
/// Its kernels of an instruction set, where a folder of modules has them; else nullptr.
MechanismKernels const* compiled_linkage(Parts const& parts, Isa isa);

}  // namespace slideway
