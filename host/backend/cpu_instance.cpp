// The machine code of one instruction set, law and damping: compiled once per combination with its own flags and
// names (see CMakeLists.txt here).  Nothing from the host is included, so that no unit shares code with another.
#include "host/backend/instance_table.hpp"
#include "host/backend/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/mechanisms/probe.hpp"
#include "kernels/models/slider_crank_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Real = IsaReal;

template <class Friction, class Way> constexpr KernelInstance instance() {
    using Model = SliderCrankModel<SLIDEWAY_LAW, Friction, Way, SLIDEWAY_DAMPING>;
    return {&integrate<Model, Real>, &probe<Model, Real>};
}

}  // namespace
}  // namespace slideway::inline SLIDEWAY_ISA

namespace slideway {

extern constinit InstanceTable const SLIDEWAY_TABLE = {{
    {instance<NoFriction, AlignedWay>(), instance<NoFriction, MisalignedWay>()},
    {instance<StickSlipFriction, AlignedWay>(), instance<StickSlipFriction, MisalignedWay>()},
}};

}  // namespace slideway
