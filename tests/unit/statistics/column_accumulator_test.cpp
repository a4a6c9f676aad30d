// Accumulators against whole numbers, quad precision and the statistics of numbers that are all kept.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "host/statistics/column_accumulator.hpp"

namespace slideway::column_accumulator_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<400>>;  // digits

ColumnAccumulator accumulated(std::vector<double> const& values) {
    ColumnAccumulator column;
    for (double const value : values) column.add(value);
    return column;
}

std::vector<double> scattered(std::size_t count, double centre, double spread) {
    std::mt19937_64 engine(7);
    std::vector<double> values;
    // Two draws' average: no distribution of the library, whose numbers vary between libraries.
    for (std::size_t i = 0; i < count; ++i) {
        double const a = static_cast<double>(engine() >> 11) * 0x1p-53,
                     b = static_cast<double>(engine() >> 11) * 0x1p-53;
        values.push_back(centre + spread * (a + b - 1));
    }
    return values;
}

/// Relative to the two-pass formula in 400 digits.
void expect_moments(std::vector<double> const& values) {
    Wide sum = 0, squares = 0;
    for (double const value : values) sum += value;
    Wide const mean = sum / values.size();
    for (double const value : values) squares += (value - mean) * (value - mean);
    double const sd = static_cast<double>(sqrt(Wide(squares / (values.size() - 1))));
    ColumnAccumulator const column = accumulated(values);
    EXPECT_NEAR(column.mean(), static_cast<double>(mean), 3e-16 * std::abs(static_cast<double>(mean)));
    EXPECT_NEAR(column.sd(), sd, 1e-15 * sd);
}

TEST(ColumnAccumulator, MomentsAreThoseOfManyDigits) {
    expect_moments(scattered(5000, 0, 1));
    expect_moments(scattered(5000, 100, 1e-3));
    expect_moments(scattered(100, -3e-9, 1e-12));
    expect_moments({1e150, -1e150, 3e149});
    expect_moments({1e-140, 2e-140, 5e-140});
}

TEST(ColumnAccumulator, SpreadSurvivesALargeMean) {
    // 10^15 + {0, 1, 2}: sd is 1, and squares of the numbers do not fit a double's digits.
    EXPECT_EQ(accumulated({1e15, 1e15 + 1, 1e15 + 2}).sd(), 1);
    EXPECT_EQ(accumulated({1e15, 1e15 + 1, 1e15 + 2}).mean(), 1e15 + 1);
    // Neighbouring doubles.
    EXPECT_DOUBLE_EQ(accumulated({1, 1 + 0x1p-52}).sd(), 0x1p-52 / std::sqrt(2.0));
    EXPECT_EQ(accumulated(std::vector<double>(1000, 0.1)).sd(), 0);
}

TEST(ColumnAccumulator, OrderAndPartsLeaveNoTrace) {
    std::vector<double> values = scattered(4000, 1, 10);
    values.insert(values.end(), {0.0, -0.0, nan, infinity, 1e-310, -1e300, 1e300, -infinity});
    auto const whole = accumulated(values).bytes();
    std::mt19937_64 engine(11);
    for (int round = 0; round < 5; ++round) {
        for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[engine() % i]);
        ColumnAccumulator merged;
        for (std::size_t from = 0; from < values.size();) {
            std::size_t const to = std::min(values.size(), from + 1 + engine() % 900);
            ColumnAccumulator const part = accumulated(
                {values.begin() + static_cast<std::ptrdiff_t>(from), values.begin() + static_cast<std::ptrdiff_t>(to)});
            // Through bytes, as a shard goes.
            auto const read = ColumnAccumulator::from_bytes(part.bytes());
            ASSERT_TRUE(read.has_value());
            merged.merge(*read);
            from = to;
        }
        EXPECT_EQ(merged.bytes(), whole);
    }
}

TEST(ColumnAccumulator, CountsAndEndsAreExact) {
    ColumnAccumulator const column = accumulated({3, nan, -7.25, 0.1, nan, 1e-320});
    EXPECT_EQ(column.count(), 4u);
    EXPECT_EQ(column.missing(), 2u);
    EXPECT_EQ(column.min(), -7.25);
    EXPECT_EQ(column.max(), 3);
    EXPECT_EQ(accumulated({-infinity, 2}).min(), -infinity);
    EXPECT_EQ(accumulated({-infinity, 2}).max(), 2);
    EXPECT_EQ(accumulated({infinity}).min(), infinity);
    EXPECT_FALSE(std::signbit(accumulated({0.0, -0.0}).min()));
    EXPECT_FALSE(std::signbit(accumulated({-0.0}).max()));
}

TEST(ColumnAccumulator, NothingAndInfinityAreAsInASummary) {
    ColumnAccumulator const nothing;
    for (double const value : {nothing.mean(), nothing.sd(), nothing.min(), nothing.max(), nothing.quantile(0.5)}) {
        EXPECT_TRUE(std::isnan(value));
    }
    EXPECT_TRUE(std::isnan(nothing.quantile_interval(0.5).low));
    EXPECT_TRUE(std::isnan(accumulated({4}).sd()));
    EXPECT_EQ(accumulated({1, infinity}).mean(), infinity);
    EXPECT_TRUE(std::isnan(accumulated({1, infinity}).sd()));
    EXPECT_TRUE(std::isnan(accumulated({-infinity, infinity}).mean()));
    EXPECT_EQ(accumulated({1e200, -1e200}).sd(), infinity);
}

TEST(ColumnAccumulator, QuantilesAreNearThoseOfTheNumbers) {
    for (double const spread : {0.1, 3.0, 1000.0}) {
        std::vector<double> values = scattered(3001, 1, spread);
        ColumnAccumulator const column = accumulated(values);
        std::sort(values.begin(), values.end());
        for (double const p : {0.0, 0.001, 0.05, 0.25, 0.5, 0.77, 0.999, 1.0}) {
            double const h = 3000 * p;
            double const size = std::max(std::abs(values[static_cast<std::size_t>(std::floor(h))]),
                                         std::abs(values[static_cast<std::size_t>(std::ceil(h))]));
            EXPECT_NEAR(column.quantile(p), quantile(values, p), 0x1p-10 * size) << p;
            if (p == 0 || p == 1) continue;
            Interval const exact = quantile_interval(values, p), sketched = column.quantile_interval(p);
            for (auto const& [a, b] : {std::pair(exact.low, sketched.low), std::pair(exact.high, sketched.high)}) {
                EXPECT_EQ(std::isnan(a), std::isnan(b));
                if (std::isnan(a)) continue;
                EXPECT_NEAR(b, a, 0x1p-10 * std::abs(a));
            }
        }
        EXPECT_EQ(column.quantile(0), values.front());
        EXPECT_EQ(column.quantile(1), values.back());
    }
}

TEST(ColumnAccumulator, HistogramHoldsEveryFiniteNumber) {
    std::vector<double> values = scattered(2000, 5, 4);
    values.insert(values.end(), {infinity, infinity, -infinity});
    Histogram const sketched = accumulated(values).histogram();
    std::sort(values.begin(), values.end());
    Histogram const exact = histogram(values);
    EXPECT_EQ(sketched.below, 1u);
    EXPECT_EQ(sketched.above, 2u);
    EXPECT_EQ(sketched.edges, exact.edges);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < sketched.counts.size(); ++i) {
        sum += sketched.counts[i];
        // Buckets are at most 2^-9 of the numbers wide; so many numbers lie near the bin's two edges at most.
        std::uint64_t near = 0;
        for (double const value : values) {
            for (double const edge : {exact.edges[i], exact.edges[i + 1]})
                near += std::abs(value - edge) <= 0x1p-9 * edge;
        }
        EXPECT_LE(std::abs(static_cast<double>(sketched.counts[i]) - static_cast<double>(exact.counts[i])),
                  static_cast<double>(near));
    }
    EXPECT_EQ(sum, 2000u);
    EXPECT_EQ(accumulated({2, 2, 2}).histogram().counts, std::vector<std::uint64_t>{3});
}

TEST(ColumnAccumulator, BytesOfNoAccumulatorAreRefused) {
    auto bytes = accumulated({1, 2, 3}).bytes();
    EXPECT_TRUE(ColumnAccumulator::from_bytes(bytes).has_value());
    for (std::size_t const length : {std::size_t{0}, std::size_t{40}, bytes.size() - 1}) {
        EXPECT_FALSE(ColumnAccumulator::from_bytes(std::span(bytes).first(length)).has_value()) << length;
    }
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(ColumnAccumulator::from_bytes(bytes).has_value());
}

TEST(ColumnAccumulator, BytesThatContradictThemselvesAreRefused) {
    // The ends, the numbers of either infinity, and behind the sums the sketch, which has the infinities too.
    enum : std::size_t { least = 0, largest = 8, negative = 16, positive = 24 };
    auto const with = [](std::vector<double> const& numbers, std::size_t at, auto value) {
        auto bytes = accumulated(numbers).bytes();
        std::memcpy(bytes.data() + at, &value, sizeof value);
        return ColumnAccumulator::from_bytes(bytes).has_value();
    };
    std::vector<double> const mixed = {1, 2, infinity, infinity, -infinity};
    EXPECT_TRUE(with(mixed, negative, std::uint64_t{1}));
    EXPECT_FALSE(with(mixed, negative, std::uint64_t{0}));
    EXPECT_FALSE(with(mixed, positive, std::uint64_t{3}));
    EXPECT_FALSE(with({1, 2}, positive, std::uint64_t{1}));
    EXPECT_TRUE(with(mixed, least, 1.0));
    EXPECT_FALSE(with(mixed, least, -infinity));
    EXPECT_FALSE(with(mixed, largest, infinity));
    EXPECT_FALSE(with(mixed, largest, 0.5));
    EXPECT_FALSE(with(mixed, least, nan));
    EXPECT_TRUE(with({infinity}, least, infinity));
    EXPECT_FALSE(with({infinity}, least, 3.0));
}

}  // namespace
}  // namespace slideway::column_accumulator_test
