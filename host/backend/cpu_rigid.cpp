// Mechanisms of a base with rigid contacts, SLIDEWAY_BASE: equations and lanes in one unit, compiled once per instruction set (CMakeLists.txt
// here); and their lanes of members with shadows in another.  The contacts of rigid joints are a third, that of all mechanisms (cpu_rigid_joint.cpp).
#include <type_traits>

#include "host/backend/kernel_tables.hpp"
#include "kernels/all_mechanisms.hpp"
#include "kernels/integrate.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/shadowed.hpp"
#include "kernels/rigid/joint_offset.hpp"
#include "kernels/rigid/planar_slider_crank.hpp"
#include "kernels/rigid/rigid_joint.hpp"
#include "kernels/rigid/rigid_slider.hpp"

namespace slideway::inline SLIDEWAY_ISA {

// Of cpu_rigid_joint.cpp.
extern template class RigidJoint<IsaReal>;
extern template class RigidJoint<Tangent<IsaReal>>;
extern template class JointOffset<IsaReal>;

namespace {

template <class Mechanism> concept IsGuided = requires { typename Mechanism::Guide; };

/// Nothing of mechanisms of another base.
template <class Real, class Mechanism, class Base> constexpr GuideFunctions<Real> const* guide_functions() {
    if constexpr (std::is_same_v<Base, SLIDEWAY_BASE>) {
        static_assert(IsGuided<Mechanism>, "a mechanism of this base is a SpatialSlider<Guide>: rigid contacts ask its guide (kernels/rigid/guide_functions.hpp)");
        return &RigidGuide<typename Mechanism::Guide>::template functions<Real>;
    } else {
        return nullptr;
    }
}
/// @param mechanism of this base
template <class Real> GuideFunctions<Real> const& guide_of(Mechanism mechanism) {
#define SLIDEWAY_GUIDE(name, Type, Base) guide_functions<Real, Type, Base>(),
    static constexpr GuideFunctions<Real> const* of[] = {SLIDEWAY_MECHANISMS(SLIDEWAY_GUIDE)};
#undef SLIDEWAY_GUIDE
    return *of[static_cast<int>(mechanism)];
}

template <class Base> auto model_of(Parts const& parts) {
    if constexpr (std::is_same_v<Base, PlanarBase>) return RigidPlanarSliderCrank(parts);
    else if constexpr (SLIDEWAY_SHADOWED) return RigidSlider<IsaReal, Base>(parts, guide_of<IsaReal>(parts.mechanism), &guide_of<Tangent<IsaReal>>(parts.mechanism));
    else return RigidSlider<IsaReal, Base>(parts, guide_of<IsaReal>(parts.mechanism));
}
using Model = decltype(model_of<SLIDEWAY_BASE>(Parts{}));

#if SLIDEWAY_SHADOWED
void run_shadowed(Block& block, Parts const& parts, LawKernels const*) { integrate<Shadowed<Model>, IsaReal>(block, Shadowed<Model>{model_of<SLIDEWAY_BASE>(parts)}); }
#else
void run(Block& block, Parts const& parts, LawKernels const*) { integrate<Model, IsaReal>(block, model_of<SLIDEWAY_BASE>(parts)); }
void probe_states(ProbeTable const& states, Parts const& parts, LawKernels const*) { probe<Model, IsaReal>(states, model_of<SLIDEWAY_BASE>(parts)); }
#endif

}  // namespace

#if SLIDEWAY_SHADOWED
extern constinit MechanismKernels const SLIDEWAY_TABLE = {.run_shadowed = &run_shadowed};
#else
extern constinit MechanismKernels const SLIDEWAY_TABLE = {.run = &run, .probe = &probe_states};
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
