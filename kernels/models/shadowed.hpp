#pragma once

namespace slideway::inline SLIDEWAY_ISA {

/// A model whose members have shadows (kernels/lanes/shadows.hpp).  Where the model has a `ShadowWatch` their steps end at what that finds.
template <class Model> struct Shadowed : Model { static constexpr bool has_shadows = true; };

template <class Model>
requires requires { typename Model::template ShadowWatch<double>; }
struct Shadowed<Model> : Model {
    static constexpr bool has_shadows = true;
    template <class Real> using Watch = typename Model::template ShadowWatch<Real>;
};

}  // namespace slideway::inline SLIDEWAY_ISA
