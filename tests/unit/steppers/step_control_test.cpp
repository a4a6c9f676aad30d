// What the error control measures against, and how it chooses the next step.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/config/keys.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/steppers/step_control.hpp"

namespace slideway::observer_step_control_test {
namespace {

using Model = SliderCrank;

/// 0.9 e^(−0.17) m^0.04 with e the error and m the last accepted one: Gustafsson's control with β = 0.04 for order 5.
double wished(double error, double last) { return 0.9 * std::pow(error, -0.17) * std::pow(last, 0.04); }

double factor(double error, bool accepted, bool after_rejection, double& memory) {
    return StepControl(5).factor(error * error, accepted, after_rejection, memory);
}

constexpr double slack = 1.5e-4;  // logarithm and exponential are rough

TEST(StepControl, FollowsTheErrorAndItsMemory) {
    double memory = 2 * std::log2(0.5);
    EXPECT_NEAR(factor(0.1, true, false, memory), wished(0.1, 0.5), slack);
    EXPECT_NEAR(memory, 2 * std::log2(0.1), slack);
    EXPECT_NEAR(factor(0.8, true, false, memory), wished(0.8, 0.1), slack);
    EXPECT_NEAR(memory, 2 * std::log2(0.8), slack);
}

TEST(StepControl, ForgetsNothingWhenAStepFails) {
    double const before = 2 * std::log2(0.5);
    double memory = before;
    EXPECT_NEAR(factor(20, false, false, memory), 0.9 * std::pow(20, -0.17), slack)
        << "the memory has no say in a failure";
    EXPECT_EQ(memory, before);
}

TEST(StepControl, StaysWithinItsLimits) {
    double memory = step_control_start;
    EXPECT_EQ(factor(0, true, false, memory), 10) << "an error of zero";
    EXPECT_NEAR(memory, 2 * std::log2(1e-4), 1e-12) << "the memory has a floor";
    EXPECT_EQ(factor(0, true, true, memory), 1) << "no growth after a failure";
    EXPECT_NEAR(factor(1.0001, false, false, memory), 0.9 * std::pow(1.0001, -0.17), slack) << "a failed step shrinks";
    EXPECT_EQ(factor(1e9, false, false, memory), 0.2);
    for (double const error :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
        EXPECT_EQ(factor(error, false, false, memory), 0.1) << error;
        EXPECT_TRUE(std::isfinite(memory));
    }
}

TEST(ErrorScales, AreTheJointsOwn) {
    Inputs in;
    in.clearance_y = 1e-4;
    in.clearance_z = 3e-4;
    in.crank_speed = -20;
    in.slider_length = 0.05;
    in = complete_inputs(in);
    auto const p = Model::parameters(in);
    double scale[Model::size];
    Model::scales(p, scale);
    double const tilt = 2 * 1e-4 / 0.05;  // of the narrower clearance
    double const expected[] = {1e-4, 3e-4, 2e-3, 6e-3, tilt, tilt, tilt, 20 * tilt, 20 * tilt, 20 * tilt};
    for (int i = 0; i < Model::size; ++i) EXPECT_NEAR(scale[i], expected[i], 1e-15 * expected[i]) << i;
    EXPECT_NEAR(Model::energy_scale(p), in.slider_mass * 6e-3 * 6e-3, 1e-20);
}

TEST(ErrorScales, TakeACrankAtRestForOneRadianPerSecond) {
    for (double const speed : {0.0, 0.25, -0.5}) {
        Inputs in;
        in.crank_speed = speed;
        double scale[Model::size];
        Model::scales(Model::parameters(complete_inputs(in)), scale);
        EXPECT_EQ(scale[2], scale[0]);
        EXPECT_EQ(scale[7], scale[4]);
    }
}

}  // namespace
}  // namespace slideway::observer_step_control_test
