#include "host/statistics/column_accumulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::quantile_sketch_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

QuantileSketch sketch_of(std::vector<double> const& values) {
    QuantileSketch sketch;
    for (double const x : values) sketch.add(x);
    return sketch;
}

/// The number of rank ⌊p (count-1)⌋.
double quantile_of(QuantileSketch const& sketch, double p) {
    return sketch.count() == 0 ? sketch.at_rank(0) : sketch.at_rank(static_cast<std::uint64_t>(p * static_cast<double>(sketch.count() - 1)));
}

/// Magnitudes over many orders, both signs, some zeros.
std::vector<double> mixed_numbers(std::mt19937_64& engine, std::size_t n) {
    std::vector<double> numbers(n);
    for (double& x : numbers) {
        double const u = static_cast<double>(engine() >> 11) * 0x1p-53;
        x = (engine() % 3 == 0 ? -1 : 1) * std::exp(60 * (u - 0.5));
        if (engine() % 20 == 0) x = 0;
    }
    return numbers;
}

TEST(QuantileSketch, IsWithinItsErrorOfTheOrderStatistic) {
    std::mt19937_64 engine(3);
    auto values = mixed_numbers(engine, 20001);
    QuantileSketch const sketch = sketch_of(values);
    std::sort(values.begin(), values.end());
    for (int i = 0; i <= 1000; ++i) {
        double const p = i / 1000.0;
        double const exact = values[static_cast<std::size_t>(p * 20000)];
        EXPECT_LE(std::abs(quantile_of(sketch, p) - exact), QuantileSketch::error * std::abs(exact)) << p;
    }
}

TEST(QuantileSketch, HoldsItsErrorOverTheWholeRange) {
    for (double const base : {0x1p-1022, 1e-300, 1.0, 0x1.fffffffffffffp0, 1e300, std::numeric_limits<double>::max()}) {
        for (double const x : {base, -base}) {
            QuantileSketch const sketch = sketch_of({x});
            EXPECT_LE(std::abs(quantile_of(sketch, 0.5) - x), QuantileSketch::error * std::abs(x)) << x;
        }
    }
    // Nine bits of the fraction make the bins: the widest relative distance is at the start of an octave.
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
        double const x = 1 + i / 5000.0;
        worst = std::max(worst, std::abs(quantile_of(sketch_of({x}), 0) / x - 1));
    }
    EXPECT_LE(worst, QuantileSketch::error);
    EXPECT_GT(worst, 0.9 * QuantileSketch::error);
}

TEST(QuantileSketch, KeepsZerosAndInfinities) {
    QuantileSketch const sketch = sketch_of({-infinity, 0, -0.0, std::numeric_limits<double>::denorm_min(), infinity});
    EXPECT_EQ(quantile_of(sketch, 0), -infinity);
    EXPECT_EQ(quantile_of(sketch, 0.25), 0);
    EXPECT_EQ(quantile_of(sketch, 0.75), 0);
    EXPECT_EQ(quantile_of(sketch, 1), infinity);
}

TEST(QuantileSketch, LeavesNanOutAndCountsIt) {
    QuantileSketch const sketch = sketch_of({std::nan(""), 2, -std::nan("")});
    EXPECT_EQ(sketch.count(), 1u);
    EXPECT_EQ(sketch.missing(), 2u);
    EXPECT_NEAR(quantile_of(sketch, 0.5), 2, 2 * QuantileSketch::error);
    EXPECT_TRUE(std::isnan(quantile_of(QuantileSketch(), 0.5)));
}

TEST(QuantileSketch, OfPartsIsThatOfTheWhole) {
    std::mt19937_64 engine(4);
    auto const values = mixed_numbers(engine, 5000);
    QuantileSketch const whole = sketch_of(values);
    std::vector<QuantileSketch> parts(5);
    for (double const x : values) parts[engine() % 5].add(x);
    QuantileSketch forward, backward;
    for (std::size_t i = 0; i < 5; ++i) forward.merge(parts[i]), backward.merge(parts[4 - i]);
    EXPECT_TRUE(forward == whole);
    EXPECT_TRUE(backward == whole);
    EXPECT_EQ(forward.count(), 5000u);
    EXPECT_EQ(quantile_of(forward, 0.3), quantile_of(whole, 0.3));
}

TEST(QuantileSketch, ComesBackFromItsBytes) {
    std::mt19937_64 engine(5);
    auto values = mixed_numbers(engine, 300);
    values.push_back(std::nan(""));
    QuantileSketch const sketch = sketch_of(values);
    auto const bytes = sketch.bytes();
    auto const back = QuantileSketch::from_bytes(bytes);
    ASSERT_TRUE(back.has_value());
    EXPECT_TRUE(*back == sketch);
    EXPECT_EQ(back->count(), sketch.count());
    EXPECT_EQ(back->missing(), 1u);
    EXPECT_EQ(quantile_of(*back, 0.7), quantile_of(sketch, 0.7));
}

TEST(QuantileSketch, RefusesOtherBytes) {
    auto const bytes = sketch_of({1, 2, -3}).bytes();
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_FALSE(QuantileSketch::from_bytes(std::span(bytes).first(length)).has_value()) << length;
    }
    auto longer = bytes, other = bytes, bad_bin = bytes;
    longer.push_back(std::byte{0});
    other[0] ^= std::byte{1};
    bad_bin[32 + 7] = std::byte{0xff};  // behind mark, zeros, missing and the number of negative bins
    EXPECT_FALSE(QuantileSketch::from_bytes(longer).has_value());
    EXPECT_FALSE(QuantileSketch::from_bytes(other).has_value());
    EXPECT_FALSE(QuantileSketch::from_bytes(bad_bin).has_value());
    auto too_many = bytes;
    for (std::size_t i = 8; i < 16; ++i) too_many[i] = std::byte{0xff};  // zeros: with the other three more than a count holds
    EXPECT_FALSE(QuantileSketch::from_bytes(too_many).has_value());
}

}  // namespace
}  // namespace slideway::quantile_sketch_test
