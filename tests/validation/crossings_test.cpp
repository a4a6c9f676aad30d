// Crossings of a section where a step, or the run, starts or ends on its surface.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/section_runs.hpp"

namespace slideway::crossings_test {
namespace {

using namespace testing::section_runs;

TEST(Crossings, AreNoneWhereTheTopOfEveryBounceTouchesTheSurface) {
    for (char const* const direction : {"both", "rising", "falling"}) {
        EXPECT_TRUE(rows_of(falling(fmt::format(R"(on = "y", value = 0.0, direction = "{}")", direction), "1.0", "y = 0.0")).empty()) << direction;
    }
}

TEST(Crossings, OfAVelocityAreTheTopsAfterTheStart) {
    auto const rows = rows_of(falling(R"(on = "vy", value = 0.0, direction = "falling")", "1.0", "y = 0.0"));
    ASSERT_EQ(rows.size(), 32u);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_NEAR(rows[k][0], static_cast<double>(k + 1) / 32, 1e-12);
        EXPECT_NEAR(rows[k][place_y], 0, 1e-13);
    }
}

// Thrown up from the surface at 2⁻⁶ m/s it comes back after 2⁻⁸ s, then rises through it with that speed after every bounce.
TEST(Crossings, OfAStartOnTheSurfaceAreTheReturnsAlone) {
    double const up = 0x1p-6, back = 2 * up / gravity, landing = std::sqrt(up * up + landing_speed * landing_speed);
    for (bool const first_up : {true, false}) {
        auto const rows = rows_of(falling(R"(on = "y", value = 0.0, direction = "both")", "1.0", fmt::format("vy = {:.17g}", first_up ? up : -up), 0.25));
        // It falls through the surface at t = 2⁻⁸ s, or starts to fall at 0: then down and up again.
        double const down_up = 2 * (landing - up) / gravity;
        double t = 0;
        std::size_t k = 0;
        if (first_up) {
            ASSERT_FALSE(rows.empty());
            EXPECT_NEAR(rows[k][0], back, 1e-12);
            EXPECT_NEAR(rows[k++][place_vy], -up, 1e-11);
            t = back;
        }
        for (; t + down_up < 0.25; t += down_up + back) {
            ASSERT_GT(rows.size(), k);
            EXPECT_NEAR(rows[k][0], t + down_up, 1e-11);
            EXPECT_NEAR(rows[k++][place_vy], up, 1e-10);
            if (t + down_up + back > 0.25) break;
            ASSERT_GT(rows.size(), k);
            EXPECT_NEAR(rows[k][0], t + down_up + back, 1e-11);
            EXPECT_NEAR(rows[k++][place_vy], -up, 1e-10);
        }
        EXPECT_EQ(rows.size(), k) << first_up;
        EXPECT_GT(k, 6u);
    }
}

/// A slider between two faces that it does not touch, by equal steps, whose heights are exact where 2⁻⁷ m outweigh what they change by.
constexpr double height = 0x1p-7;
std::string gliding(std::string_view on, std::string_view direction, double below, double speed, double pull, double seconds) {
    return fmt::format(R"(schema = 1
[mechanism]
kind = "free_slider"
gravity = {}
[joint]
clearance = "15.625 mm"
[contact]
law = "conservative"
[initial]
y = {:.17g}
vy = {:.17g}
[integrator]
method = "rk4"
step = 0.00390625
[study]
kind = "poincare"
members = 1
Ttr = 0.0
duration = {:.17g}
section = {{ on = "{}", value = {:.17g}, direction = "{}" }}
)",
                       pull, height - below, speed, seconds, on, on == "y" ? height : 0.0, direction);
}

TEST(Crossings, AtTheEndOfAStepAreCountedOnce) {
    for (double const sign : {1.0, -1.0}) {
        auto const rows = [&](char const* direction, double seconds) {
            return rows_of(gliding("y", direction, sign * 0x1p-10, sign * 0x1p-5, 0, seconds));
        };
        for (char const* const direction : {"both", sign > 0 ? "rising" : "falling"}) {
            auto const found = rows(direction, 0.125);
            ASSERT_EQ(found.size(), 1u) << direction << sign;
            EXPECT_EQ(found[0][place_y], height) << "exactly";
            EXPECT_EQ(found[0][0], 0x1p-5) << "eight steps";
        }
        EXPECT_TRUE(rows(sign > 0 ? "falling" : "rising", 0.125).empty()) << sign;
        EXPECT_TRUE(rows("both", 0x1p-5).empty()) << "who ends there has not left";
    }
}

TEST(Crossings, DoNotComeOfATouchAtTheEndOfAStep) {
    // 2⁻⁷ m ∓ 4 (t − 2⁻⁶)²: thrown up against its weight, or down against a pull upwards.
    for (double const sign : {1.0, -1.0}) {
        auto const rows = [&](char const* on) { return rows_of(gliding(on, "both", sign * 0x1p-10, sign * 0x1p-3, sign * gravity, 0x1p-5)); };
        EXPECT_TRUE(rows("y").empty()) << sign;
        auto const turns = rows("vy");
        ASSERT_EQ(turns.size(), 1u) << sign;
        EXPECT_NEAR(turns[0][0], 0x1p-6, 1e-15);
        EXPECT_EQ(turns[0][place_y], height) << "exactly";
    }
}

}  // namespace
}  // namespace slideway::crossings_test
