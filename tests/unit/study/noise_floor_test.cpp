// Which columns of members vary by no more than the error of their numbers.
#include "host/study/tolerance_report.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::testing::noise_floor_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

QuantityColumn named(std::string quantity, std::string unit) {
    QuantityColumn column;
    column.quantity = std::move(quantity);
    column.unit = std::move(unit);
    return column;
}

/// A slider of 0.1 kg, of which a fall through 1 mm, and π rad/s, the default, give 0.1 (9.81e-3 + π² 1e-6) J = 9.81987e-4 J.
Scene falling(std::string const& law = "rigid") {
    return scene_of("schema = 1\n[mechanism]\nkind = \"free_slider\"\nslider_mass = 0.1\n[joint]\nclearance = \"1 mm\"\n[contact]\nlaw = \"" + law + (law == "rigid" ? "\"\nrestitution = 0.5" : "\"") +
                    "\n[study]\nkind = \"ensemble\"\nduration = 1\n");
}

/// mean (1 + relative · alternating sign): its standard deviation is that share of the mean.
std::vector<double> alternating(double mean, double amplitude, std::size_t count = 1000) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = mean + (i % 2 == 0 ? amplitude : -amplitude);
    return values;
}

TEST(NoiseFloor, IsAMillionthOfTheLargestNumberOrOfAFall) {
    QuantityColumn const force = named("peak_normal_force", "N");
    EXPECT_EQ(why_no_sensitivity(force, std::vector<double>(9, 3.25), falling()), "does not vary");
    EXPECT_NE(why_no_sensitivity(force, alternating(3, 1e-12), falling()), "");
    EXPECT_NE(why_no_sensitivity(force, alternating(3, 2.9e-6), falling()), "");
    EXPECT_EQ(why_no_sensitivity(force, alternating(3, 3.1e-6), falling()), "");
    // Numbers that are 0 but for rounding; of a fall through 1 mm 0.982 N, 9.82 m/s², 0.1 m/s, and angles by the length of the slider.
    double const length = falling().inputs.slider_length, speed = std::sqrt(9.81987e-3);
    struct Unit { char const* name; double floor; };
    for (Unit const& unit : {Unit{"N", 9.81987e-7}, {"N m", 9.81987e-10}, {"m", 1e-9}, {"rad", 1e-9 / length}, {"m s-1", 1e-6 * speed}, {"rad s-1", 1e-6 * speed / length},
                             {"m s-2", 9.81987e-6}}) {
        QuantityColumn const column = named("peak", unit.name);
        EXPECT_NE(why_no_sensitivity(column, alternating(0, 1e-17), falling()), "") << unit.name;
        EXPECT_NE(why_no_sensitivity(column, alternating(0, 0.99 * unit.floor), falling()), "") << unit.name;
        EXPECT_EQ(why_no_sensitivity(column, alternating(0, 1.01 * unit.floor), falling()), "") << unit.name;
    }
    EXPECT_EQ(why_no_sensitivity(named("mode_time", "s"), alternating(1e-5, 1e-6), falling()), "") << "a study is long";
    EXPECT_EQ(why_no_sensitivity(named("load", "Pa"), alternating(0, 1e-15), falling()), "") << "nothing says what size it has";
    EXPECT_EQ(why_no_sensitivity(named("contact_onsets", "1"), alternating(19, 1), falling()), "");
}

TEST(NoiseFloor, OfEnergiesIsAMillionthOfAFall) {
    QuantityColumn const loss = named("friction_loss", "J");
    EXPECT_NEAR(least_energy(falling()), 9.81987e-10, 1e-15);
    EXPECT_EQ(why_no_sensitivity(loss, alternating(0, 2e-19), falling()), "varies by 2e-19 J, no more than its error of 9.8e-10 J");
    EXPECT_NE(why_no_sensitivity(loss, alternating(-9.81e-4, 1.2e-12), falling()), "");
    EXPECT_EQ(why_no_sensitivity(loss, alternating(0, 1.1e-9), falling()), "");
    EXPECT_NE(why_no_sensitivity(loss, alternating(1, 9e-7), falling()), "") << "of larger numbers that of the numbers";
}

TEST(NoiseFloor, OfAResidualIsAllOfItWhereTheLawMakesNoEnergy) {
    QuantityColumn const residual = named("energy_residual", "J");
    EXPECT_EQ(why_no_sensitivity(residual, alternating(1e-6, 1e-6), falling()), "is the integration's error");
    EXPECT_EQ(why_no_sensitivity(residual, alternating(1e-6, 1e-6), falling("paper")), "");
}

TEST(NoiseFloor, LeavesWhatIsNotThereAlone) {
    QuantityColumn const force = named("peak_normal_force", "N");
    EXPECT_EQ(why_no_sensitivity(force, {}, falling()), "");
    EXPECT_EQ(why_no_sensitivity(force, std::vector<double>(5, nan), falling()), "");
    EXPECT_EQ(why_no_sensitivity(force, std::vector<double>{1, nan, 1}, falling()), "does not vary");
    EXPECT_EQ(why_no_sensitivity(force, std::vector<double>{1, std::numeric_limits<double>::infinity(), 2}, falling()), "");
}

}  // namespace
}  // namespace slideway::testing::noise_floor_test
