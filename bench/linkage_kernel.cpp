// Compiled once per instruction set.
#include "bench/linkage_kernel.hpp"

#include "kernels/isa_real.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/linkage/linkage_model.hpp"
#include "kernels/mechanisms/planar_slider_crank.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Real = IsaReal;

/// The plan that a scene has of a crank, a rod and a slider between walls on the ground.
struct SliderCrankPlan {
    static constexpr LinkagePlan plan = [] {
        LinkagePlan plan;
        plan.bodies = plan.coordinates = 3;
        plan.closures = plan.is_driven = plan.turns_freely = 1;
        int number = 0;
        for (int i = 0; i < 3; ++i) {
            LinkageBody& body = plan.body[i];
            body.parent = i - 1;
            body.joint = TreeJoint::revolute;
            body.coordinate = plan.owner[i] = i;
            body.mass = number++;
            body.inertia = number++;
            if (i < 2) body.center[0] = number++;
            body.arm = i == 0 ? Arm::none : Arm::along_x;
            body.moment = i < 2 ? Arm::along_x : Arm::none;
            plan.above[i] = i - 1;
        }
        plan.body[2].is_point = 1;
        plan.body[1].on_parent[0] = number++;
        plan.body[2].on_parent[0] = number++;
        LinkageClosure& walls = plan.closure[0];
        walls.kind = ClosureKind::block;
        walls.body[0] = 2;
        walls.arm[0] = walls.arm[1] = Arm::none;
        walls.is_level = 1;
        walls.pair = 4;
        for (int* const place : {&walls.clearance, &walls.length, &walls.height, &walls.stiffness}) *place = number++;
        return plan;
    }();
};

struct Planar : PlanarSliderCrank {
    Conditions<LawOfPoints> block;
    explicit Planar(Parts const& parts) : block({}, false, parts) {}
    void derivative(Real t, Real const* s, PlanarParameters<Real> const& p, Memory<Real> const& memory, Real* rates) const {
        PlanarSliderCrank::derivative<false>(t, s, p, memory, block, rates, static_cast<PlanarReport<Real>*>(nullptr));
    }
};
template <class Plan> struct Described : LinkageModel<Plan> {
    using Model = LinkageModel<Plan>;
    using Model::Model;
    template <class P, class M> void derivative(Real t, Real const* s, P const& p, M const& memory, Real* rates) const {
        Model::template derivative<false>(t, s, p, memory, rates, static_cast<LinkageReport<Real>*>(nullptr));
    }
};

template <class Model> struct Kernel {
    struct Pack {
        typename Model::template Parameters<Real> parameters;
        typename Model::template Memory<Real> memory;
        Real state[Model::size], rates[Model::size];
    };
    static void load(void* to, Parts const& parts, Inputs const* members, double const* states, std::size_t count) {
        auto* const packs = static_cast<Pack*>(to);
        for (std::size_t member = 0; member < count; ++member) {
            Pack& pack = packs[member / lanes<Real>];
            int const index = static_cast<int>(member % lanes<Real>);
            load_lane(pack.parameters, index, Model(parts).parameters(members[member]));
            for (std::size_t i = 0; i < 6; ++i) set_lane(pack.state[i], index, states[6 * member + i]);
            start_memory(pack.memory);
        }
    }
    static void evaluate(void* at, Parts const& parts, std::size_t count, int in_a_row) {
        Model const model(parts);
        auto* const packs = static_cast<Pack*>(at);
        for (std::size_t i = 0; i < count / lanes<Real>; ++i) {
            Pack& pack = packs[i];
            for (int time = 0; time < in_a_row; ++time) model.derivative(Real(0.0), pack.state, pack.parameters, pack.memory, pack.rates);
        }
    }
    static constexpr LinkageKernel kernel{lanes<Real>, sizeof(Pack), &load, &evaluate};
};

}  // namespace

LinkageKernels linkage_kernels_of_bench() {
    return {Kernel<Planar>::kernel, Kernel<Described<PlanTable>>::kernel, Kernel<Described<PlanConstant<SliderCrankPlan>>>::kernel, &SliderCrankPlan::plan};
}

}  // namespace slideway::inline SLIDEWAY_ISA
