// Kernels of the tree that are modules: found, opened and, where the program lies in the folder it was built in, compiled when they are first asked for.
#pragma once

#include <string>

#include "host/backend/kernel_tables.hpp"

namespace slideway {

/// The kernels of a module, by the name of its file without `slideway_` and `.so`: `rigid_SliderBase_avx512`.  Opened once; from several threads.
/// @throws DeviceError if there is none of the program's own sources
MechanismKernels const& module_kernels(std::string const& name);

/// What is to hear of it, in a line, before kernels are compiled; nobody, unless this is called.
void on_compiling(void (*tell)(std::string const& line));

}  // namespace slideway
