// A slider that nothing drives: free flight, bounces and its energy.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::free_slider_test {
namespace {

testing::RunOptions options(Law law, Damping damping, bool friction, double seconds) {
    testing::RunOptions o;
    o.parts = {law, damping, friction, false, Mechanism::free_slider};
    o.settings.rtol = o.settings.atol = 1e-9;
    o.settings.end_time = seconds;
    return o;
}

TEST(FreeSlider, FliesAParabolaDownAnInclinedWay) {
    Inputs in;
    in.inclination = 0.3;
    in.vx = 0.2;
    in.x = 0.01;
    in.vy = 0.03;
    in.clearance_y = in.clearance_z = 5e-4;
    in = complete_inputs(in);
    double const t = 4e-3;
    auto o = options(Law::conservative, Damping::point, true, t);
    o.series = info(Mechanism::free_slider).always;
    o.sample_times = {0, t};
    auto const r = testing::run(best_isa(), o, {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    auto const at = [&](Series s) { return r.series[2 * static_cast<std::size_t>(s) + 1]; };
    double const gx = -in.gravity * std::sin(in.inclination), gy = -in.gravity * std::cos(in.inclination);
    EXPECT_NEAR(at(Series::x), in.x + in.vx * t + 0.5 * gx * t * t, 1e-12);
    EXPECT_NEAR(at(Series::vx), in.vx + gx * t, 1e-12);
    EXPECT_NEAR(at(Series::y), in.vy * t + 0.5 * gy * t * t, 1e-12);
    EXPECT_NEAR(at(Series::vy), in.vy + gy * t, 1e-12);
    EXPECT_NEAR(r.value(0, Quantity::energy_change), 0, 1e-12);
    EXPECT_EQ(r.value(0, Quantity::contact_onsets), 0);
}

TEST(FreeSlider, BouncesBackAsOftenAndHighAsRestitutionSays) {
    // Dropped flat from a clearance above its way: impacts at speeds v0 eⁿ, with flights of 2 v0 eⁿ/g between them.  Under the paper's
    // law, for a flat impact of the conservative one is a saddle: within four of them roundings have tilted the slider.
    Inputs in;
    in.clearance_y = in.clearance_z = 1e-3;
    in.restitution = 0.6;
    in = complete_inputs(in);
    double const v0 = std::sqrt(2 * in.gravity * in.clearance_y), e = in.restitution;
    double const first = v0 / in.gravity;
    // Between the fourth and the fifth impact, in the middle of the flight: at rest at the height v²/2g.
    double time = first;
    for (int n = 1; n < 4; ++n) time += 2 * v0 * std::pow(e, n) / in.gravity;
    double const v4 = v0 * std::pow(e, 4);
    time += v4 / in.gravity;
    auto const r = testing::run(best_isa(), options(Law::paper, Damping::restitution, false, time), {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    EXPECT_EQ(r.value(0, Quantity::contact_onsets), 4);
    double const height = v4 * v4 / (2 * in.gravity);
    EXPECT_NEAR(r.states[0][0] + in.clearance_y, height, 2e-2 * height);
    EXPECT_NEAR(r.states[0][2], 0, 2e-2 * v4);
    double const kinetic = 0.5 * in.slider_mass * v0 * v0;
    EXPECT_NEAR(r.value(0, Quantity::damping_loss), kinetic * (1 - std::pow(e, 8)), 1e-3 * kinetic);
}

TEST(FreeSlider, KeepsItsEnergyWithoutLosses) {
    // Tumbles between its walls for a hundred impacts.
    Inputs in;
    in.eta = 0;
    in.gravity = 0;
    in.vy = 0.05;
    in.vz = 0.03;
    in.wx = 1, in.wy = -2, in.wz = 3;
    in = complete_inputs(in);
    double const energy = 0.5 * in.slider_mass * (in.vy * in.vy + in.vz * in.vz) +
                          0.5 * (in.slider_inertia_x + 4 * in.slider_inertia_y + 9 * in.slider_inertia_z);
    double worst[2];
    int i = 0;
    for (double const tolerance : {1e-7, 1e-9}) {
        auto o = options(Law::conservative, Damping::point, false, 0.1);
        o.settings.rtol = o.settings.atol = tolerance;
        auto const r = testing::run(best_isa(), o, {in});
        ASSERT_EQ(r.records[0].status, Status::finished);
        EXPECT_GT(r.value(0, Quantity::contact_onsets), 50);
        worst[i++] = std::abs(r.value(0, Quantity::energy_change)) / energy;
    }
    EXPECT_LT(worst[0], 1e-3);
    EXPECT_LT(worst[1], 1e-5);
    EXPECT_LT(worst[1], 0.1 * worst[0]);
}

TEST(FreeSlider, IsBrakedByFrictionAlongItsWay) {
    // Glides on its way at v: kinetic friction brakes it at μd g.
    Inputs in;
    in.vx = 0.5;
    in.y = -1e-4 - 1e-9;
    in.chi_line = in.chi_surface = 1e3;
    in = complete_inputs(in);
    double const t = 0.2;
    auto const r = testing::run(best_isa(), options(Law::conservative, Damping::rate, true, t), {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    double const g = in.friction_kinetic * in.gravity;
    double const gone = in.vx * t - 0.5 * g * t * t;
    EXPECT_NEAR(r.quantities[0][static_cast<std::size_t>(quantity_column(Quantity::friction_loss))],
                in.slider_mass * g * gone, 2e-3 * in.slider_mass * g * gone);
}

}  // namespace
}  // namespace slideway::free_slider_test
