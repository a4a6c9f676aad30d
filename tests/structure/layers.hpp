// The order of the layers and what a layer may know, as rules over a file's text.  ARCHITECTURE.md draws them.
#pragma once

#include <string>
#include <vector>

#include "tests/structure/source_tree.hpp"

namespace slideway::structure {

/// One sentence per broken rule, naming the file; empty when all hold.
using Violations = std::vector<std::string>;

/// Includes that point upward, to a file outside the layers, or from the host past the backend into physics.
Violations include_violations(SourceFile const& file);

/// Folders that include each other in a circle (folders of the same rank may include one another, but one way only).
Violations circle_violations(std::vector<SourceFile> const& files);

/// Instruction sets and CUDA macros named outside kernels/real.hpp, kernels/simd and host/backend, and instructions outside kernels/simd.
Violations backend_violations(SourceFile const& file);

/// Physics beside the kernels: files for nvcc other than host/backend/cuda.cu, and what that file or those that launch it compute, define
/// or know beyond the programs of kernels/.
Violations card_violations(SourceFile const& file);

/// Exceptions, allocation and anything but headers in kernels/.
Violations kernel_violations(SourceFile const& file);

}  // namespace slideway::structure
