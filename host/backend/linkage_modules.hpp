// Linkages whose plan the compiler knew: modules beside the tables that run any of them (kernels/linkage/linkage_plans.hpp), with the same bits.
#pragma once

#include <string>

#include "host/backend/backend.hpp"
#include "host/backend/kernel_tables.hpp"

namespace slideway {

/// What a module of these parts' linkage is called: by the plan, and whether its crank turns freely.
std::string linkage_module_name(LinkagePlan const& plan, bool turns_freely);
/// The header that it is compiled from (host/backend/module_compiler.hpp).
std::string linkage_header(Parts const& parts);
/// Its kernels of an instruction set, where a folder of modules has them; else nullptr.
MechanismKernels const* compiled_linkage(Parts const& parts, Isa isa);

}  // namespace slideway
