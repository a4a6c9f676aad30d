// Compiled once per instruction set.
#include "host/backend/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/models/relief_valve_model.hpp"
#include "tests/models/ball_model.hpp"
#include "tests/models/models.hpp"
#include "tests/models/oscillator_model.hpp"
#include "tests/models/tracker_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

/// The valve with inputs that no instruction set owns.
struct ValveModel : ReliefValveModel {
    using Inputs = testing::ValveInputs;
    static Parameters<double> parameters(Inputs const& in) { return {in.inflow}; }
    static void initial_state(Inputs const& in, double* s) { ReliefValveModel::initial_state({.inflow = in.inflow}, s); }
};

}  // namespace

extern testing::ModelKernels const model_kernels;
testing::ModelKernels const model_kernels{integrate<BallModel, IsaReal>, integrate<OscillatorModel, IsaReal>,
                                          integrate<TrackerModel, IsaReal>, integrate<ValveModel, IsaReal>};

}  // namespace slideway::inline SLIDEWAY_ISA
