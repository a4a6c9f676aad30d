#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <thread>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "host/config/units.hpp"

namespace slideway::units_test {
namespace {

double value_of(std::string_view text, std::string_view unit) {
    auto const result = to_si(text, unit);
    if (auto const* problem = std::get_if<Problem>(&result)) {
        ADD_FAILURE() << text << " in " << unit << ": " << problem->reason;
        return std::numeric_limits<double>::quiet_NaN();
    }
    return std::get<double>(result);
}

bool is_refused(std::string_view text, std::string_view unit) {
    auto const result = to_si(text, unit);
    auto const* problem = std::get_if<Problem>(&result);
    return problem != nullptr && !problem->reason.empty() && !problem->advice.empty();
}

constexpr double pi = std::numbers::pi;

TEST(Units, PowersOfTenMoveTheDecimalPoint) {
    EXPECT_EQ(value_of("0.1 mm", "m"), 1e-4);
    EXPECT_EQ(value_of("142.2 mm", "m"), 0.1422);
    EXPECT_EQ(value_of("0.3 mm", "m"), 3e-4);
    EXPECT_EQ(value_of("207 GPa", "Pa"), 2.07e11);
    EXPECT_EQ(value_of("2.07e2 GPa", "Pa"), 2.07e11);
    EXPECT_EQ(value_of("2.07e+2GPa", "Pa"), 2.07e11);
    EXPECT_EQ(value_of("187.2 g", "kg"), 0.1872);
    EXPECT_EQ(value_of("100 \u00b5m", "m"), 1e-4);
    EXPECT_EQ(value_of("-5e-3 mm", "m"), -5e-6);
    EXPECT_EQ(value_of("+1 m", "m"), 1);
    EXPECT_EQ(value_of("  7 m ", "m"), 7);
}

TEST(Units, ThatNeedNoDatabaseAreThoseOfIt) {
    // The long names are in it alone.
    constexpr struct { std::string_view usual, name, unit; } units[] = {
        {" mm", " millimeter", "m"}, {" um", " micrometer", "m"},        {" ms", " millisecond", "s"},    {" us", " microsecond", "s"},
        {" g", " gram", "kg"},       {" mm/s", " millimeter/s", "m/s"}, {" MPa", " megapascal", "Pa"}, {" GPa", " gigapascal", "Pa"},
        {" N s/m", " newton second/meter", "N s/m"}};
    for (auto const& [usual, name, unit] : units) {
        for (std::string const number : {"0.37", "-142.2", "7e-3", "1e290"})
            EXPECT_EQ(value_of(number + std::string(usual), unit), value_of(number + std::string(name), unit)) << number << usual;
        EXPECT_TRUE(is_refused("1" + std::string(usual), "rad")) << usual;
    }
}

TEST(Units, OtherFactorsMultiply) {
    EXPECT_DOUBLE_EQ(value_of("2 inch", "m"), 0.0508);
    EXPECT_DOUBLE_EQ(value_of("3 N/mm2", "Pa"), 3e6);
    EXPECT_DOUBLE_EQ(value_of("36 km/h", "m/s"), 10);
    EXPECT_DOUBLE_EQ(value_of("9.81 m/s2", "m/s2"), 9.81);
    EXPECT_DOUBLE_EQ(value_of("2 min", "s"), 120);
}

TEST(Units, AnglesConvert) {
    EXPECT_DOUBLE_EQ(value_of("30 deg", "rad"), pi / 6);
    EXPECT_DOUBLE_EQ(value_of("30 degree", "rad"), pi / 6);
    EXPECT_DOUBLE_EQ(value_of("30 \u00b0", "rad"), pi / 6);
    EXPECT_DOUBLE_EQ(value_of("60 arcmin", "rad"), pi / 180);
    EXPECT_DOUBLE_EQ(value_of("1 mrad", "rad"), 1e-3);
    EXPECT_DOUBLE_EQ(value_of("0.5 rev", "rad"), pi);
}

TEST(Units, AngularSpeedsConvert) {
    EXPECT_DOUBLE_EQ(value_of("30 rpm", "rad/s"), pi);
    EXPECT_DOUBLE_EQ(value_of("0.5 rev/s", "rad/s"), pi);
    EXPECT_DOUBLE_EQ(value_of("180 deg/s", "rad/s"), pi);
    EXPECT_EQ(value_of("3.141592653589793 rad/s", "rad/s"), 3.141592653589793);
}

TEST(Units, RadiansAreNotPlainNumbers) {
    EXPECT_TRUE(is_refused("5 Hz", "rad/s"));
    EXPECT_TRUE(is_refused("5 1/s", "rad/s"));
    EXPECT_TRUE(is_refused("5 s-1", "rad/s"));
    EXPECT_TRUE(is_refused("0.1 1", "rad"));
    EXPECT_TRUE(is_refused("10 %", "rad"));
    EXPECT_TRUE(is_refused("0.1 rad", "1"));
    EXPECT_TRUE(is_refused("0.1 deg", "1"));
    EXPECT_TRUE(is_refused("1 rad", "m"));
    EXPECT_TRUE(is_refused("1 rad m", "m"));
    EXPECT_TRUE(is_refused("1 sr", "rad"));
}

TEST(Units, PlainNumbersMayBePercentOrBare) {
    EXPECT_DOUBLE_EQ(value_of("15 %", "1"), 0.15);
    EXPECT_EQ(value_of("0.15", "1"), 0.15);
}

TEST(Units, RefusesWhatDoesNotConvert) {
    EXPECT_TRUE(is_refused("1 kg", "m"));
    EXPECT_TRUE(is_refused("1 furlongs_of_cheese", "m"));
    EXPECT_TRUE(is_refused("1 m @ 5", "m"));
    EXPECT_TRUE(is_refused("1 lg(re 1 mm)", "m"));
    EXPECT_TRUE(is_refused("1 s since 2000-01-01", "s"));
    EXPECT_TRUE(is_refused("1 m m", "m"));
    EXPECT_TRUE(is_refused("1 (((", "m"));
    EXPECT_TRUE(is_refused("1 " + std::string(100000, '('), "m"));
    EXPECT_TRUE(is_refused(std::string_view("1 m\0m", 5), "m"));
    EXPECT_TRUE(is_refused("1 -5 m", "m"));
}

TEST(Units, TakesNoNumbersInAUnitForFactors) {
    for (char const* const text : {"1 500 rpm", "0.1.5 rad/s", "1.5.5 rad/s", "2 3 rad/s", "1+1 rad/s", "1e rad/s", "0x10 rad/s", "\u0661 rad/s",
                                   "1,5 rad/s", "1/2 rad/s", "rad/s", "", "5 rad/s 3", "5 rad 3/s", "5 rad*3/s", "5 rad/0.5 s", "5 .5 rad/s"}) {
        EXPECT_TRUE(is_refused(text, "rad/s")) << text;
    }
    for (char const* const text : {"5 m2", "5 m^2", "5 m**2", "5 m2.s0", "5 m3 m-1", "5 m^3/m^+1"}) EXPECT_DOUBLE_EQ(value_of(text, "m2"), 5) << text;
    EXPECT_DOUBLE_EQ(value_of("5 1/s", "1/s"), 5);
    EXPECT_TRUE(is_refused("5 1/2 s", "1/s"));
    auto const advice = [](char const* text) { return std::get<Problem>(to_si(text, "rad/s")).advice; };
    EXPECT_EQ(advice("1 500 rpm"), "write \"1500 rpm\"");
    EXPECT_EQ(advice("1,5 rpm"), "write a point: \"1.5 rpm\"");
    EXPECT_FALSE(std::holds_alternative<UnitFactor>(unit_factor("3 rad/s", "rad/s")));
}

TEST(Units, RefusesTextsWithoutNumberOrUnit) {
    EXPECT_TRUE(is_refused("0.1", "m"));
    EXPECT_TRUE(is_refused("mm", "m"));
    EXPECT_TRUE(is_refused("", "m"));
    EXPECT_TRUE(is_refused("  ", "1"));
    EXPECT_TRUE(is_refused("- 1 m", "m"));
    EXPECT_TRUE(is_refused("0x10 m", "m"));
}

TEST(Units, RefusesSeveralLinesAndWritesNothing) {
    ::testing::internal::CaptureStdout();
    for (std::string_view const text : {"1 m\n", "1 \nm", "1 m\ns", "1 kg\n\nm"}) EXPECT_TRUE(is_refused(text, "m")) << text;
    EXPECT_TRUE(std::holds_alternative<Problem>(unit_factor("m\n", "m")));
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(Units, RefusesWhatIsNotFinite) {
    EXPECT_TRUE(is_refused("nan m", "m"));
    EXPECT_TRUE(is_refused("inf m", "m"));
    EXPECT_TRUE(is_refused("-inf m", "m"));
    EXPECT_TRUE(is_refused("1e400 m", "m"));
    EXPECT_TRUE(is_refused("1e308 km", "m"));
    EXPECT_TRUE(is_refused("1e308 inch km/m", "m"));
}

TEST(Units, AFactorConvertsToTheSameBits) {
    for (char const* unit : {"mm", "m", "inch", "um", "km"}) {
        auto const factor = unit_factor(unit, "m");
        ASSERT_TRUE(std::holds_alternative<UnitFactor>(factor)) << unit;
        for (char const* number : {"0.1", "-3", "7e-3", "1.25e+2", "0", "-0.3333333333333333"}) {
            double const value = std::strtod(number, nullptr);
            EXPECT_EQ(std::get<UnitFactor>(factor)(number, value),
                      std::get<double>(to_si(std::string(number) + " " + unit, "m")))
                << number << " " << unit;
        }
    }
    UnitFactor const km = std::get<UnitFactor>(unit_factor("km", "m")),
                     mm = std::get<UnitFactor>(unit_factor("mm", "m"));
    EXPECT_EQ(km("1e308", 1e308), std::numeric_limits<double>::infinity());
    EXPECT_EQ(mm("1e-400", 0.0), 0.0);
    EXPECT_TRUE(std::isnan(mm("nan", std::nan(""))));
    for (char const* unit : {"kg", "bogus", "", "rad"}) {
        EXPECT_TRUE(std::holds_alternative<Problem>(unit_factor(unit, "m"))) << unit;
    }
    EXPECT_TRUE(std::holds_alternative<Problem>(unit_factor(std::string(101, 'm'), "m")));
}

TEST(Units, ZeroHasAnyExponent) {
    EXPECT_EQ(std::get<double>(to_si("0e2147483647 km", "m")), 0.0);
    EXPECT_EQ(std::get<double>(to_si("0e-2147483648 mm", "m")), 0.0);
}

TEST(Units, ThreadsMayConvertAtOnce) {
    std::vector<std::thread> threads;
    std::vector<int> wrong(4, 0);
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([t, &wrong] {
            for (int i = 1; i < 500; ++i) {
                auto const result = to_si(std::to_string(i) + (i % 3 == 0 ? " bogus" : " mm"), "m");
                bool const good = std::holds_alternative<double>(result);
                bool const right = i % 3 == 0 ? !good : good && std::abs(std::get<double>(result) - i * 1e-3) < 1e-15;
                wrong[static_cast<std::size_t>(t)] += right ? 0 : 1;
            }
        });
    }
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace slideway::units_test
