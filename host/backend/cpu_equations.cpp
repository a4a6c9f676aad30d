// The equations of one instruction set, law and damping, as the lanes look them up: compiled once per combination with its own flags and
// names (see CMakeLists.txt here).
#include "host/backend/cpu_lanes.hpp"
#include "host/backend/instance_table.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

template <class Friction, class Way> struct Instance {
    using Model = SliderCrankModel<SLIDEWAY_LAW, Friction, Way, SLIDEWAY_DAMPING>;
    // The class template, for an alias of it would be another argument.
    template <class> struct Looked;
    template <template <class> class Memory> struct Looked<Memory<IsaReal>> {
        using Up = IsaTable<Memory, Model::conserving>;
    };
    using Table = typename Looked<typename Model::template Memory<IsaReal>>::Up;
    static constexpr Table table = Table::template of<Model>();

    static void run(Block& block) { integrate<Table, IsaReal>(block, table); }
    static void run_shadowed(Block& block) { integrate<Shadowed<Table>, IsaReal>(block, Shadowed<Table>{table}); }
    static void probe_states(ProbeTable const& states) { probe<Table, IsaReal>(states, table); }
    static constexpr KernelInstance functions() { return {&run, &run_shadowed, &probe_states}; }
};

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

extern constinit InstanceTable const SLIDEWAY_TABLE = {{
    {Instance<NoFriction, AlignedWay>::functions(), Instance<NoFriction, MisalignedWay>::functions()},
    {Instance<StickSlipFriction, AlignedWay>::functions(), Instance<StickSlipFriction, MisalignedWay>::functions()},
}};

}  // namespace slideway
