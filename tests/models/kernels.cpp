// Compiled once per instruction set.
#include "kernels/isa_real.hpp"
#include "kernels/integrate.hpp"
#include "kernels/models/shadowed.hpp"
#include "tests/models/ball_model.hpp"
#include "tests/models/henon.hpp"
#include "tests/models/logistic.hpp"
#include "tests/models/lorenz.hpp"
#include "tests/models/map_orbit.hpp"
#include "tests/models/models.hpp"
#include "tests/models/oscillator_model.hpp"
#include "tests/models/relief_valve.hpp"
#include "tests/models/rigid_ball_model.hpp"
#include "tests/models/table_ball_model.hpp"
#include "tests/models/tracker_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

/// The valve with inputs that no instruction set owns.
struct ValveModel : ReliefValve {
    using Inputs = testing::ValveInputs;
    static Parameters<double> parameters(Inputs const& in) { return {in.inflow}; }
    static void initial_state(Inputs const& in, double* s) {
        ReliefValve::initial_state({.inflow = in.inflow}, s);
    }
};

struct PlainLorenzModel : LorenzModel {
    using Inputs = testing::LorenzInputs;
    static Parameters<double> parameters(Inputs const& in) { return {in.sigma, in.rho, in.beta}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.x, s[1] = in.y, s[2] = in.z; }
};

struct PlainLogistic : Logistic {
    using Inputs = testing::LogisticInputs;
    static Parameters<double> parameters(Inputs const& in) { return {in.r}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.x; }
};

struct PlainHenon : Henon {
    using Inputs = testing::HenonInputs;
    static Parameters<double> parameters(Inputs const& in) { return {in.a, in.b}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.x, s[1] = in.y; }
};

}  // namespace

extern testing::ModelKernels const model_kernels;
testing::ModelKernels const model_kernels{integrate<BallModel, IsaReal>,
                                          integrate<OscillatorModel, IsaReal>,
                                          integrate<TrackerModel, IsaReal>,
                                          integrate<ValveModel, IsaReal>,
                                          integrate<Shadowed<PlainLorenzModel>, IsaReal>,
                                          integrate<Shadowed<TableBallModel>, IsaReal>,
                                          integrate<Shadowed<RigidBallModel>, IsaReal>,
                                          map_orbit<PlainLogistic, IsaReal>,
                                          map_orbit<PlainHenon, IsaReal>};

}  // namespace slideway::inline SLIDEWAY_ISA
