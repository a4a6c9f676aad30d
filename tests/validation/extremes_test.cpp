// Extremes end with a status and finite numbers: never a hang, a crash or garbage.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include "tests/support/ensemble.hpp"

namespace slideway::extremes_test {
namespace {

struct Extreme {
    std::string name;
    std::function<void(Inputs&)> change;
    bool must_finish;
    Status otherwise = Status::finished;  // when it must not finish: the status it must have
    KeyGroup of = KeyGroup::slider;       // under laws that have it
};

std::vector<Extreme> extremes() {
    return {
        // Tolerances of 1e-13 m let the paper's law chatter between its modes: it may spend its steps.
        {"clearance 1e-7 m",
         [](Inputs& in) { in.clearance_y = in.clearance_z = 1e-7, in.z = in.y = in.roll = in.yaw = in.pitch = 0; },
         false},
        {"clearance 5 mm", [](Inputs& in) { in.clearance_y = in.clearance_z = 5e-3; }, true},
        {"crank at rest", [](Inputs& in) { in.crank_speed = 0; }, true},
        {"crank 500 rad/s", [](Inputs& in) { in.crank_speed = 500; }, true},
        {"crank -500 rad/s", [](Inputs& in) { in.crank_speed = -500; }, true},
        {"E 1e5 Pa", [](Inputs& in) { in.slider_young_modulus = in.way_young_modulus = 1e5; }, true},
        {"E 1e13 Pa", [](Inputs& in) { in.slider_young_modulus = in.way_young_modulus = 1e13; }, true},
        {"E 1e5 against 1e13 Pa",
         [](Inputs& in) {
             in.slider_young_modulus = 1e5;
             in.way_young_modulus = 1e13;
         },
         true},
        {"start 10 um inside the wall", [](Inputs& in) { in.y = -1.1e-4; }, true},
        {"start 1 mm inside the wall", [](Inputs& in) { in.y = -1.1e-3; }, false},
        {"start upside down", [](Inputs& in) { in.roll = 3.0; }, false},
        {"start beyond the rod's reach", [](Inputs& in) { in.y = 0.5; }, false, Status::geometry},
        {"no friction", [](Inputs& in) { in.friction_static = in.friction_kinetic = 0; }, true},
        {"friction 2", [](Inputs& in) { in.friction_static = in.friction_kinetic = 2; }, true},
        {"zero gravity", [](Inputs& in) { in.gravity = 0; }, true},
        {"NaN state", [](Inputs& in) { in.vz = NAN; }, false, Status::nonfinite},
        {"infinite state", [](Inputs& in) { in.wy = INFINITY; }, false, Status::nonfinite},
        {"NaN parameter",
         [](Inputs& in) {
             in.edge_radius = NAN;
             in.slider_mass = NAN;
         },
         false, Status::nonfinite},
        {"infinite speed", [](Inputs& in) { in.vy = 1e300; }, false},
        {"yaw at a right angle", [](Inputs& in) { in.yaw = 1.5707963267948966; }, false},
        {"line contact beyond its domain", [](Inputs& in) { in.edge_radius = 1e6, in.y = -1.2e-4, in.pitch = 2e-3; },
         false, Status::contact_domain, KeyGroup::edges},
    };
}

bool concerns(Extreme const& extreme, Law law) {
    return extreme.of == KeyGroup::slider || has_group(info(law).groups, extreme.of);
}

class Extremes : public ::testing::TestWithParam<Law> {};

TEST_P(Extremes, EndWithAStatus) {
    for (Isa const isa : {Isa::scalar, best_isa()}) {
        if (!is_supported(isa)) continue;
        for (auto const& extreme : extremes()) {
            testing::RunOptions options;
            options.parts = {GetParam(), Damping::point, true, false};
            options.settings.end_time = 0.02;
            options.settings.max_steps = 300'000;
            options.settings.max_step = 1e-4;
            for (int i = 0; i <= 20; ++i) options.sample_times.push_back(i * 1e-3);
            options.series = testing::state_selection;
            auto in = testing::golden_start(1e-4, 3.141592653589793, GetParam());
            extreme.change(in);
            auto const start = std::chrono::steady_clock::now();
            auto const r = testing::run(isa, options, {in});
            double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            EXPECT_LT(seconds, 20) << extreme.name;
            auto const status = r.records[0].status;
            EXPECT_NE(status, Status::not_run) << extreme.name;
            if (extreme.must_finish) {
                EXPECT_EQ(status, Status::finished) << extreme.name << ": " << static_cast<int>(status);
            } else if (extreme.otherwise != Status::finished && concerns(extreme, GetParam())) {
                EXPECT_EQ(status, extreme.otherwise) << extreme.name << ": " << static_cast<int>(status);
            }
            if (status != Status::finished) continue;
            for (double const value : r.states[0]) EXPECT_TRUE(std::isfinite(value)) << extreme.name;
            for (double const value : r.quantities[0]) EXPECT_TRUE(std::isfinite(value)) << extreme.name;
            for (double const value : r.series) EXPECT_TRUE(std::isfinite(value)) << extreme.name;
            EXPECT_DOUBLE_EQ(r.records[0].time, options.settings.end_time);
        }
    }
}

TEST_P(Extremes, StopAtTheStepLimit) {
    testing::RunOptions options;
    options.parts = {GetParam(), Damping::point, true, false};
    options.settings.end_time = 1.0;
    options.settings.max_steps = 1000;
    auto const r = testing::run(best_isa(), options, testing::scattered_starts(20, 1e-4, 3.141592653589793, GetParam()));
    for (auto const& record : r.records) {
        EXPECT_EQ(record.status, Status::max_steps);
        EXPECT_EQ(record.steps_accepted + record.steps_rejected, 1000u);
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, Extremes, ::testing::ValuesIn(testing::every_law()),
                         [](auto const& p) { return std::string(slideway::info(p.param).name); });

}  // namespace
}  // namespace slideway::extremes_test
