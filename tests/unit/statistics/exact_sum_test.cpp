#include "host/statistics/exact_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace slideway::exact_sum_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();

double sum_of(std::vector<double> const& values) {
    ExactSum sum;
    for (double const x : values) sum.add(x);
    return sum.value();
}

/// Any sign, exponents of the whole range.
std::vector<double> wild_numbers(std::mt19937_64& engine, std::size_t n, int exponents) {
    std::vector<double> numbers(n);
    for (double& x : numbers) {
        double const fraction = static_cast<double>(static_cast<std::int64_t>(engine())) * 0x1p-63;
        x = std::ldexp(fraction, static_cast<int>(engine() % static_cast<unsigned>(2 * exponents)) - exponents);
    }
    return numbers;
}

TEST(ExactSum, LosesNothingToCancellation) {
    EXPECT_EQ(sum_of({1e308, 1, -1e308}), 1);
    EXPECT_EQ(sum_of({largest, largest, -largest, 3, -largest}), 3);  // beyond the range on the way
    EXPECT_EQ(sum_of({1, 1e-300, -1}), 1e-300);
    EXPECT_EQ(sum_of({least, 1e308, -1e308}), least);
    EXPECT_EQ(sum_of({-least, -1e308, 1e308}), -least);
    EXPECT_EQ(sum_of({0.1, -0.1}), 0);
    EXPECT_FALSE(std::signbit(sum_of({0.1, -0.1})));
    EXPECT_FALSE(std::signbit(sum_of({-0.0})));
    EXPECT_EQ(sum_of({}), 0);
}

TEST(ExactSum, RoundsToTheNearestAndTiesToEven) {
    EXPECT_EQ(sum_of({1, 0x1p-53}), 1);                              // a tie, 1 is even
    EXPECT_EQ(sum_of({1, 0x1p-53, least}), 1 + 0x1p-52);             // just above the tie
    EXPECT_EQ(sum_of({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);          // a tie, up to even
    EXPECT_EQ(sum_of({1 + 0x1p-52, 0x1p-53, -least}), 1 + 0x1p-52);  // just below
    EXPECT_EQ(sum_of({-1, -0x1p-53, -least}), -1 - 0x1p-52);
    EXPECT_EQ(sum_of({0x1.fffffffffffffp0, 0x1p-53}), 2);  // the carry lengthens the significand
    EXPECT_EQ(sum_of({least, least, least}), 3 * least);
    EXPECT_EQ(sum_of({0x1p-1022, -least}), 0x1p-1022 - least);  // into the subnormals
}

TEST(ExactSum, OverflowsWhereRoundingDoes) {
    EXPECT_EQ(sum_of({largest, 0x1p970, -least}), largest);  // below the tie
    EXPECT_EQ(sum_of({largest, 0x1p970}), infinity);         // the tie: 2^1024 would be even
    EXPECT_EQ(sum_of({-largest, -largest}), -infinity);
}

TEST(ExactSum, DoesNotDependOnOrderOrParts) {
    std::mt19937_64 engine(1);
    std::vector<double> numbers = wild_numbers(engine, 3000, 1000);
    for (std::size_t i = 0; i < 1000; ++i) numbers.push_back(-numbers[i]);
    double const whole = sum_of(numbers);
    for (int trial = 0; trial < 20; ++trial) {
        std::shuffle(numbers.begin(), numbers.end(), engine);
        EXPECT_EQ(sum_of(numbers), whole);
        std::vector<ExactSum> parts(7);
        for (double const x : numbers) parts[engine() % 7].add(x);
        std::shuffle(parts.begin(), parts.end(), engine);
        ExactSum sum;
        for (ExactSum const& part : parts) sum.add(part);
        EXPECT_EQ(sum.value(), whole);
    }
}

TEST(ExactSum, IsTheRoundedSumOfManyMoreDigits) {
    using Wide =
        boost::multiprecision::number<boost::multiprecision::cpp_bin_float<2400, boost::multiprecision::digit_base_2>>;
    std::mt19937_64 engine(2);
    for (int const exponents : {2, 60, 300, 950}) {
        for (int trial = 0; trial < 20; ++trial) {
            auto const numbers = wild_numbers(engine, 100, exponents);
            Wide sum = 0;
            for (double const x : numbers) sum += x;
            EXPECT_EQ(sum_of(numbers), static_cast<double>(sum)) << exponents;
        }
    }
}

TEST(ExactSum, CarriesThroughEveryLimb) {
    ExactSum sum;
    for (int i = 0; i < 100000; ++i) sum.add(largest);
    for (int i = 0; i < 100000; ++i) sum.add(-largest);
    EXPECT_EQ(sum, ExactSum());
    sum.add(-least);  // borrows from the sign down
    sum.add(least);
    EXPECT_EQ(sum, ExactSum());
}

TEST(ExactSum, HasTheRulesOfInfinitiesAndNan) {
    EXPECT_EQ(sum_of({1, infinity, -largest}), infinity);
    EXPECT_EQ(sum_of({-infinity, 5}), -infinity);
    EXPECT_TRUE(std::isnan(sum_of({infinity, -infinity})));
    EXPECT_TRUE(std::isnan(sum_of({1, std::numeric_limits<double>::quiet_NaN(), infinity})));
    ExactSum up, down;
    up.add(infinity);
    down.add(-infinity);
    up.add(down);
    EXPECT_TRUE(std::isnan(up.value()));
}

}  // namespace
}  // namespace slideway::exact_sum_test
