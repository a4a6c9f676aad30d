// Compiled once per instruction set.
#include "bench/work_precision/models_kernel.hpp"

#include "kernels/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "tests/models/bouncing_mass.hpp"
#include "tests/models/lorenz.hpp"
#include "tests/models/relief_valve.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

template <class Model>
void integrate_inputs(std::vector<typename Model::Inputs> const& inputs, BlockBase const& settings) {
    BlockOf<typename Model::Inputs> block{settings, inputs.data()};
    integrate<Model, IsaReal>(block);
}

}  // namespace

void integrate_lorenz_members(bench::LorenzMember const* members, BlockBase const& block) {
    std::vector<Lorenz::Inputs> inputs;
    for (std::size_t i = 0; i < block.members; ++i) {
        auto const& m = members[i];
        inputs.push_back({m.sigma, m.rho, m.beta, m.start[0], m.start[1], m.start[2]});
    }
    integrate_inputs<LorenzModel>(inputs, block);
}

void integrate_valve_members(bench::ValveMember const* members, BlockBase const& block) {
    std::vector<ReliefValve::Inputs> inputs;
    for (std::size_t i = 0; i < block.members; ++i) inputs.push_back({.inflow = members[i].inflow});
    integrate_inputs<ReliefValve>(inputs, block);
}

void integrate_bouncing_members(bench::BouncingMember const* members, BlockBase const& block) {
    std::vector<BouncingMass::Inputs> inputs;
    for (std::size_t i = 0; i < block.members; ++i) {
        auto const& m = members[i];
        inputs.push_back({m.y, m.v, m.stiffness, m.rate});
    }
    integrate_inputs<BouncingMass>(inputs, block);
}

}  // namespace slideway::inline SLIDEWAY_ISA
