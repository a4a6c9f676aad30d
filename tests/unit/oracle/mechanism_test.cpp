// The mechanism of the oracle: its reach and the torque on its crank.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracle/oracle.hpp"

namespace mechanism_test {
namespace {

using oracle::Result;
using oracle::State;
using slideway::Inputs;

TEST(Oracle, FlagsARodThatDoesNotReach) {
    Inputs const in = oracle::completed({});
    State state{};
    state[1] = 1.001 * in.rod_length;
    Result const r = oracle::evaluate(in, {}, 0, state);
    EXPECT_TRUE(r.geometry);
    EXPECT_TRUE(std::isnan(r.derivative[2]));
    EXPECT_TRUE(std::isnan(oracle::penetrations(in, {}, 0, state)[0]));
}

TEST(Oracle, CrankTorqueCarriesItsOwnWeight) {
    Inputs in = oracle::completed({});
    in.inclination = 0.4;
    double const t = 0.3, angle = in.crank_speed * t;
    Result const r = oracle::evaluate(in, {}, t, {});
    double const crank_mass = 7800 * 5e-3 * 2.5e-3 * 0.05;
    EXPECT_NEAR(r.crank_torque_with_weight - r.crank_torque, crank_mass * 9.81 * 0.025 * std::cos(angle + 0.4), 1e-15);
    EXPECT_NEAR(r.crank_torque * in.crank_speed, r.power_crank, 1e-14);
    EXPECT_NEAR(r.ideal_x, r.x, 1e-15);  // centred
    // d/dt of L sin(rod angle) = -r sin θ
    double const rod_rate =
        -0.05 * in.crank_speed * std::cos(angle) / std::sqrt(0.1422 * 0.1422 - std::pow(0.05 * std::sin(angle), 2));
    EXPECT_NEAR(r.rod_angular_velocity[2], rod_rate, 1e-14);
}

}  // namespace
}  // namespace mechanism_test
