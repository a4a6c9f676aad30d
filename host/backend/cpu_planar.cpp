// The planar slider-crank of one instruction set: its equations, small as they are, and the lanes of both kinds of memory.
#include "host/backend/instance_table.hpp"
#include "host/backend/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/planar_model.hpp"
#include "kernels/models/shadowed.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

template <template <class> class Memory, class Friction, class Damping, bool free_crank> struct Instance {
    using Table = PlanarTable<IsaReal, Memory>;
    static constexpr Table table = Table::template of<PlanarSliderCrank<Friction, Damping, free_crank>>();

    static void run(Block& block) { integrate<Table, IsaReal>(block, table); }
    static void run_shadowed(Block& block) { integrate<Shadowed<Table>, IsaReal>(block, Shadowed<Table>{table}); }
    static void probe_states(ProbeTable const& states) { probe<Table, IsaReal>(states, table); }
    static constexpr KernelInstance functions() { return {&run, &run_shadowed, &probe_states}; }
};

template <class Friction, bool free_crank> using Damped = Instance<NoMemory, Friction, PointDamping, free_crank>;
template <class Friction, bool free_crank>
using Restored = Instance<CornerMemory, Friction, RestitutionDamping, free_crank>;

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

extern constinit PlanarInstances const SLIDEWAY_TABLE = {{
    {{Damped<NoFriction, false>::functions(), Damped<NoFriction, true>::functions()},
     {Damped<StickSlipFriction, false>::functions(), Damped<StickSlipFriction, true>::functions()}},
    {{Restored<NoFriction, false>::functions(), Restored<NoFriction, true>::functions()},
     {Restored<StickSlipFriction, false>::functions(), Restored<StickSlipFriction, true>::functions()}},
}};

}  // namespace slideway
