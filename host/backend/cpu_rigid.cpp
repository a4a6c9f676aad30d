// The mechanisms of a base with rigid contacts, equations and lanes, of members without shadows or with them: a unit each per instruction set
// (CMakeLists.txt here).  The contacts of rigid joints are another, that of all mechanisms (cpu_rigid_joint.cpp).
#include <type_traits>

#include "host/backend/kernel_tables.hpp"
#include "kernels/all_mechanisms.hpp"
#include "kernels/integrate.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/models/probe.hpp"
#include "kernels/models/shadowed.hpp"
#include "kernels/rigid/joint_offset.hpp"
#include "kernels/rigid/planar_slider_crank.hpp"
#include "kernels/rigid/rigid_joint.hpp"
#include "kernels/rigid/rigid_slider.hpp"

namespace slideway::inline SLIDEWAY_ISA {

// Of cpu_rigid_joint.cpp.
extern template class JointPairs<IsaReal>;
extern template class JointPairs<Tangent<IsaReal>>;
extern template class RigidJoint<IsaReal>;
extern template class RigidJoint<Tangent<IsaReal>>;
extern template class JointOffset<IsaReal>;

namespace {
/// Of what guides a mechanism of this base; nullptr of others, and of the planar one, which has a model of its own.
template <class Real, class Mechanism, class Base> constexpr GuideFunctions<Real> const* guide_functions() {
    if constexpr (!std::is_same_v<Base, SLIDEWAY_BASE> || std::is_same_v<Base, PlanarBase>) {
        return nullptr;
    } else if constexpr (is_tangent<Real> && Mechanism::size > state_size) {
        return nullptr;  // of what no drive prescribes there are no exponents
    } else {
        static_assert(requires { typename Mechanism::Guide; },
                      "a mechanism of the tree has rigid contacts: a SpatialSlider<Guide> from its guide, another from a model that model_of names");
        return &RigidGuide<typename Mechanism::Guide>::template functions<Real>;
    }
}
#define SLIDEWAY_GUIDE(name, Type, Base) guide_functions<Real, Type, Base>(),
template <class Real> constexpr GuideFunctions<Real> const* guides[] = {SLIDEWAY_MECHANISMS(SLIDEWAY_GUIDE)};  // by Mechanism
#undef SLIDEWAY_GUIDE

template <class Base> auto model_of(Parts const& parts) {
    [[maybe_unused]] auto const place = static_cast<int>(parts.mechanism);
    if constexpr (std::is_same_v<Base, PlanarBase>) return RigidPlanarSliderCrank(parts);
    else if constexpr (SLIDEWAY_SHADOWED) return RigidSlider<IsaReal, Base>(parts, guides<IsaReal>[place], guides<Tangent<IsaReal>>[place]);
    else return RigidSlider<IsaReal, Base>(parts, guides<IsaReal>[place]);
}
using Model = decltype(model_of<SLIDEWAY_BASE>(Parts{}));
}  // namespace

extern constinit MechanismKernels const SLIDEWAY_TABLE = {
#if SLIDEWAY_SHADOWED
    .run_shadowed = [](Block& block, Parts const& parts, LawKernels const*) { integrate<Shadowed<Model>, IsaReal>(block, {model_of<SLIDEWAY_BASE>(parts)}); },
#else
    .run = [](Block& block, Parts const& parts, LawKernels const*) { integrate<Model, IsaReal>(block, model_of<SLIDEWAY_BASE>(parts)); },
    .probe = [](ProbeTable const& states, Parts const& parts, LawKernels const*) { probe<Model, IsaReal>(states, model_of<SLIDEWAY_BASE>(parts)); },
#endif
};

}  // namespace slideway::inline SLIDEWAY_ISA
