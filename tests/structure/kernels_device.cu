// Compiled, never run here: the kernels as device code.  Each thread integrates a block of members of its own with
// Real = double, and one probes a table.
#include "all_kernels.hpp"

namespace slideway {

template <class Model> __global__ void integrate_blocks(Block* blocks, int count) {
    int const i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) integrate<Model, double>(blocks[i]);
}

template <class Map> __global__ void map_orbits(MapBlockOf<typename Map::Inputs>* blocks, int count) {
    int const i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) map_orbit<Map, double>(blocks[i]);
}
template __global__ void map_orbits<Henon>(MapBlockOf<Henon::Inputs>*, int);
template __global__ void map_orbits<Logistic>(MapBlockOf<Logistic::Inputs>*, int);

template <class Model> __global__ void probe_table(ProbeTable table) { probe<Model, double>(table); }

template <class Law, class Friction, class Way, class Damping> void launch(Block* blocks, ProbeTable const& table) {
    using Model = SliderCrankModel<Law, Friction, Way, Damping>;
    integrate_blocks<Model><<<1, 32>>>(blocks, 32);
    probe_table<Model><<<1, 1>>>(table);
}

template __global__ void integrate_blocks<
    Shadowed<SliderCrankModel<PaperLaw, StickSlipFriction, AlignedWay, PointDamping>>>(Block*, int);
template void launch<PaperLaw, StickSlipFriction, AlignedWay, PointDamping>(Block*, ProbeTable const&);
template void launch<ConservativeLaw, NoFriction, MisalignedWay, RateDamping>(Block*, ProbeTable const&);
template void launch<ConservativeLaw, StickSlipFriction, AlignedWay, RestitutionDamping>(Block*, ProbeTable const&);

}  // namespace slideway
