// The equations of one instruction set, law and damping, as the lanes look them up: compiled once per combination with its own flags and
// names (see CMakeLists.txt here).
#include "host/backend/cpu_lanes.hpp"
#include "host/backend/instance_table.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/mechanisms/guided_slider.hpp"
#include "kernels/models/slider_crank_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

/// What a mechanism looks like to the host: its table behind three functions.
/// @tparam Base whose lanes integrate it  @tparam has_shadows whether its members may have some
template <class Model, class Base, bool has_shadows> struct Instance {
    // The class template, for an alias of it would be another argument.
    template <class> struct Looked;
    template <template <class> class Memory> struct Looked<Memory<IsaReal>> {
        using Up = IsaTable<Base, Memory, Model::conserving>;
    };
    using Table = typename Looked<typename Model::template Memory<IsaReal>>::Up;
    static constexpr Table table = Table::template of<Model>();

    static void run(Block& block) { integrate<Table, IsaReal>(block, table); }
    static void run_shadowed(Block& block) { integrate<Shadowed<Table>, IsaReal>(block, Shadowed<Table>{table}); }
    static void probe_states(ProbeTable const& states) { probe<Table, IsaReal>(states, table); }
    static constexpr KernelInstance functions() {
        if constexpr (has_shadows) {
            return {&run, &run_shadowed, &probe_states};
        } else {
            return {&run, nullptr, &probe_states};
        }
    }
};

template <class Friction, class Way> constexpr KernelInstance slider_crank() {
    return Instance<SliderCrankModel<SLIDEWAY_LAW, Friction, Way, SLIDEWAY_DAMPING>, SliderBase, true>::functions();
}
template <class Friction, class Way> constexpr KernelInstance carriage() {
    using Mechanism = GuidedSlider<CarriageDrive, SLIDEWAY_LAW, Friction, Way, SLIDEWAY_DAMPING>;
    return Instance<SliderModel<Mechanism>, SliderBase, true>::functions();
}
template <class Friction, class Way> constexpr KernelInstance free_slider() {
    using Mechanism = GuidedSlider<NoDrive, SLIDEWAY_LAW, Friction, Way, SLIDEWAY_DAMPING>;
    return Instance<SliderModel<Mechanism>, FreeSliderBase, false>::functions();
}

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

extern constinit InstanceTable const SLIDEWAY_TABLE = {{
    {{slider_crank<NoFriction, AlignedWay>(), slider_crank<NoFriction, MisalignedWay>()},
     {slider_crank<StickSlipFriction, AlignedWay>(), slider_crank<StickSlipFriction, MisalignedWay>()}},
    {{carriage<NoFriction, AlignedWay>(), carriage<NoFriction, MisalignedWay>()},
     {carriage<StickSlipFriction, AlignedWay>(), carriage<StickSlipFriction, MisalignedWay>()}},
    {{free_slider<NoFriction, AlignedWay>(), free_slider<NoFriction, MisalignedWay>()},
     {free_slider<StickSlipFriction, AlignedWay>(), free_slider<StickSlipFriction, MisalignedWay>()}},
}};

}  // namespace slideway
