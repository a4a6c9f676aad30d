// Journals of linkages against closed forms, and against rigid ones that tests/golden/journals.py follows from impact to impact.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/library/slideway.hpp"
#include "tests/oracle/golden_table.hpp"

namespace slideway::linkage_journals_test {
namespace {

constexpr double gravity = 9.81, clearance = 1e-3, bearing = 0.02, radius = bearing - clearance;

std::vector<double> column(Result const& result, std::string const& name) { return result.column(name).values(); }

std::string journal(std::string_view name, std::string_view bodies, double gap, double hole, double stiffness) {
    return fmt::format("[link.{}]\nkind = \"journal\"\n{}clearance = {}\nradius = {}\nstiffness = {}\n", name, bodies, gap, hole, stiffness);
}

/// A wheel of 1 kg whose journal, at its mass centre, is loose in a bearing of the ground.
std::string wheel(double inertia, double speed, double stiffness, std::string_view rest) {
    return fmt::format("schema = 1\n[mechanism]\nkind = \"linkage\"\n[body.wheel]\nmass = 1\ninertia = {}\nspeed = {}\n", inertia, speed) +
           journal("pin", "first = \"wheel\"\nsecond = \"ground\"\n", clearance, bearing, stiffness) + std::string(rest);
}

/// Starts at an angle from the lowest point of its bearing.
std::string lying_at(double angle) { return fmt::format("offset_x = {}\noffset_y = {}\n", clearance * std::sin(angle), -clearance * std::cos(angle)); }
std::string watched(double duration, int samples) {
    return fmt::format("[integrator]\nrtol = 1e-9\natol = 1e-9\n[study]\nduration = {}\nsamples = {}\nquantities = [\"pin_x\", \"pin_y\", \"pin_force\"]\n", duration, samples + 1);
}

/// Height of what falls by `clearance` and bounces with e.
double bouncing(double t, double e) {
    double speed = std::sqrt(2 * gravity * clearance), flight = speed / gravity;
    if (t <= flight) return -gravity * t * t / 2;
    for (t -= flight;; t -= flight) {
        speed *= e;
        flight = 2 * speed / gravity;
        if (t <= flight) return -clearance + speed * t - gravity * t * t / 2;
    }
}

/// Largest difference of angles from those with rigid journals up to a time.
double from_rigid(golden::Table const& table, int journals, double friction, double until, Result const& result, std::vector<std::string> const& bodies) {
    double farthest = 0;
    std::size_t sample = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.number(row, "journals") != journals || table.number(row, "friction") != friction) continue;
        ++sample;
        if (table.number(row, "time") > until) continue;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            double const angle = column(result, bodies[i] + "_angle")[sample], want = table.number(row, fmt::format("angle{}", i + 1));
            farthest = std::max(farthest, std::abs(std::remainder(angle - want, 2 * std::numbers::pi)));
        }
    }
    EXPECT_GT(sample, 0u);
    return farthest;
}

std::string rubbing(double friction) {
    return friction > 0 ? fmt::format("[friction]\nstatic = {0}\nkinetic = {0}\nstick_speed = 1e-5\nslip_speed = 2e-5\n", friction) : std::string();
}

}  // namespace

TEST(LinkageJournals, FallFreelyAndReturnTheirRestitution) {
    for (double const e : {0.5, 0.9}) {
        Result const result = Ensemble::parse(wheel(1e-3, 0, 1e13, fmt::format("[contact]\nrestitution = {}\n", e) + watched(0.04, 80))).run();
        auto const y = column(result, "pin_y"), x = column(result, "pin_x");
        ASSERT_EQ(y.size(), 81u);
        for (std::size_t i = 0; i < y.size(); ++i) {
            double const t = 0.04 * double(i) / 80;
            // The first fall to rounding; then an impact of 1.6 µm and 30 µs each.
            EXPECT_NEAR(y[i], bouncing(t, e), t < 0.014 ? 1e-15 : 6e-6) << e << ' ' << t;
            EXPECT_EQ(x[i], 0);
        }
    }
}

/// Small swings of a journal that lies in its bearing: without friction it slides with g/c, with friction it rolls, which its inertia slows.
TEST(LinkageJournals, SlideOrRollInTheirBearingsAsPendulums) {
    constexpr double swing = 0.02, inertia = 2e-4;
    for (bool const rolls : {false, true}) {
        std::string const friction = rolls ? "[friction]\nstatic = 0.3\nkinetic = 0.3\nstick_speed = 1e-4\nslip_speed = 2e-4\n" : "";
        Result const result = Ensemble::parse(wheel(inertia, 0, 1e12, lying_at(swing) + "[contact]\nrestitution = 0.5\n" + friction + watched(0.2, 100))).run();
        double const rate = std::sqrt(gravity / clearance / (rolls ? 1 + inertia / (radius * radius) : 1));
        auto const x = column(result, "pin_x"), spin = column(result, "wheel_angular_velocity");
        for (std::size_t i = 0; i < x.size(); ++i) {
            double const t = 0.2 * double(i) / 100;
            EXPECT_NEAR(x[i], clearance * swing * std::cos(rate * t), 0.01 * clearance * swing) << rolls << ' ' << t;
            EXPECT_NEAR(spin[i], rolls ? clearance * swing * rate * std::sin(rate * t) / radius : 0, 0.02 * clearance * swing * rate / radius) << rolls << ' ' << t;
        }
    }
}

/// A wheel that spins stays where friction holds its weight, up the side of its bearing, and slows evenly.
TEST(LinkageJournals, SlipSteadilyAtTheAngleOfFriction) {
    constexpr double friction = 0.2, inertia = 5e-3, speed = 100, duration = 0.5;
    double const angle = std::atan(friction);
    for (int const way : {1, -1}) {
        Result const result = Ensemble::parse(wheel(inertia, way * speed, 1e12, lying_at(-way * angle) +
                                                    fmt::format("[contact]\nrestitution = 0.5\n[friction]\nstatic = {0}\nkinetic = {0}\n", friction) + watched(duration, 50))).run();
        auto const x = column(result, "pin_x"), y = column(result, "pin_y"), spin = column(result, "wheel_angular_velocity"), force = column(result, "pin_force");
        double const load = gravity * std::cos(angle), slowing = friction * load * radius / inertia;
        for (std::size_t i = 5; i < x.size(); ++i) {
            double const t = duration * double(i) / 50;
            EXPECT_NEAR(std::atan2(x[i], -y[i]), -way * angle, 1e-3) << t;
            EXPECT_NEAR(spin[i], way * (speed - slowing * t), 1e-4 * speed) << t;
            EXPECT_NEAR(force[i], load, 2e-3 * load) << t;
        }
        EXPECT_NEAR(column(result, "final_wheel_angular_velocity")[0], way * (speed - slowing * duration), 1e-4 * speed);
    }
}

/// The stiffer, the nearer, as long as impacts are apart: by stiffness^(-2/5), as the duration of a Hertz impact falls.
TEST(LinkageJournals, OfOneRodConvergeToARigidOne) {
    auto const table = golden::Table::read(SLIDEWAY_TEST_DATA "/golden/journals.csv");
    for (double const friction : {0.0, 0.1}) {
        double last = 0;
        for (double const stiffness : {1e10, 1e12, 1e14}) {
            Result const result = Ensemble::parse("schema = 1\n[mechanism]\nkind = \"linkage\"\n[body.rod]\nmass = 1\ninertia = 0.08\ncenter_x = 0.3\nangle = 0.3\nspeed = 2\n" +
                                                  journal("pin", "first = \"rod\"\nsecond = \"ground\"\n", 1e-3, 0.02, stiffness) + "[contact]\nrestitution = 0.9\n" + rubbing(friction) +
                                                  watched(0.12, 24)).run();
            double const distance = from_rigid(table, 1, friction, 0.12, result, {"rod"});
            if (last > 0) EXPECT_NEAR(last / distance, std::pow(100, 0.4), 1.0) << friction << ' ' << stiffness;
            last = distance;
        }
        EXPECT_LT(last, 1e-5) << friction;
    }
}

TEST(LinkageJournals, OfAFourBarConvergeToRigidOnes) {
    auto const table = golden::Table::read(SLIDEWAY_TEST_DATA "/golden/journals.csv");
    for (double const friction : {0.0, 0.1}) {
        double last = 0;
        for (std::string const stiffness : {"1e12", "1e14", "1e16"}) {
            Settings settings{{"integrator.rtol", "1e-9"}, {"integrator.atol", "1e-9"}, {"study.duration", "0.04"}, {"study.samples", "21"}};
            for (std::string const pin : {"crank_pin", "coupler_pin", "post"}) settings.push_back({"link." + pin + ".stiffness", stiffness});
            if (friction > 0) {
                for (auto const& [key, value] : {std::pair("static", "0.1"), {"kinetic", "0.1"}, {"stick_speed", "1e-5"}, {"slip_speed", "2e-5"}}) settings.push_back({std::string("friction.") + key, value});
                settings.push_back({"friction.enabled", "true"});
            }
            Result const result = Ensemble::read(SLIDEWAY_SCENES "/four_bar_loose.toml", settings).run();
            // The first nine impacts, or seven with friction.
            double const distance = from_rigid(table, 3, friction, 0.021, result, {"crank", "coupler", "rocker"});
            if (last > 0) EXPECT_NEAR(last / distance, std::pow(100, 0.4), 1.0) << friction << ' ' << stiffness;
            last = distance;
        }
        EXPECT_LT(last, 3e-6) << friction;
    }
}

}  // namespace slideway::linkage_journals_test
