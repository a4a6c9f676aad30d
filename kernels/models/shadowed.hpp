#pragma once

namespace slideway::inline SLIDEWAY_ISA {

/// A model whose members have shadows (kernels/lanes/shadows.hpp).
template <class Model> struct Shadowed : Model { static constexpr bool has_shadows = true; };

}  // namespace slideway::inline SLIDEWAY_ISA
