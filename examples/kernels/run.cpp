#include <slideway/kernels.hpp>

namespace slideway::inline SLIDEWAY_ISA {

/// Slider-cranks under the conservative law, as many at once as a register holds.
void run(Block& block) {
    using Laws = OneLaw<ConservativeLaw, PointDamping>;
    using Model = MechanismModel<SliderCrank, SliderBase, Laws>;
    integrate<Model, IsaReal>(block, Model{Conditions<Laws>{{}, ConservativeLaw::info.switches, Parts{}}});
}

}  // namespace slideway::inline SLIDEWAY_ISA
