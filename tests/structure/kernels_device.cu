// Compiled, never run here: every header of kernels/ and of the tests' models as device code, and what of them host/backend/cuda.cu
// does not hold, with Real = double: the equations of every mechanism, with every law.  Each thread has a block of members of its own;
// one probes a table.
#include "all_kernels.hpp"
#include "kernels/all_mechanisms.hpp"
#include "kernels/mechanisms/list.hpp"

namespace slideway {

template <class Model> __global__ void integrate_blocks(BlockOf<typename Model::Inputs>* blocks, int count) {
    int const i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) integrate<Model, double>(blocks[i]);
}
template __global__ void integrate_blocks<LorenzModel>(BlockOf<Lorenz::Inputs>*, int);
template __global__ void integrate_blocks<ReliefValve>(BlockOf<ReliefValve::Inputs>*, int);

template <class Model> __global__ void fixed_steps(FixedStepBlock<Model> const* blocks, int count) {
    int const i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) fixed_step<Model, double>(blocks[i]);
}
template __global__ void fixed_steps<Lorenz>(FixedStepBlock<Lorenz> const*, int);

template <class Map> __global__ void map_orbits(MapBlockOf<typename Map::Inputs>* blocks, int count) {
    int const i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) map_orbit<Map, double>(blocks[i]);
}
template __global__ void map_orbits<Henon>(MapBlockOf<Henon::Inputs>*, int);
template __global__ void map_orbits<Logistic>(MapBlockOf<Logistic::Inputs>*, int);

template <class Mechanism, class Base> __global__ void probe_table(ProbeTable table, Parts parts) {
    using Model = MechanismModel<Mechanism, Base, EveryLaw>;
    probe<Model, double>(table, Model(conditions_with_every_law(parts)));
}
#define SLIDEWAY_PROBED(name, Type, Base) template __global__ void probe_table<Type, Base>(ProbeTable, Parts);
SLIDEWAY_MECHANISMS(SLIDEWAY_PROBED)
#undef SLIDEWAY_PROBED

}  // namespace slideway
