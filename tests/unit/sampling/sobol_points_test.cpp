#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "host/sampling/sobol_points.hpp"

namespace slideway::sobol_points_test {
namespace {

using Axes = std::vector<SobolAxis>;

Axes plain_axes(std::size_t dimensions) {
    Axes axes;
    for (auto const& directions : sobol_directions(dimensions)) axes.emplace_back(directions);
    return axes;
}

Axes scrambled_axes(std::size_t dimensions, std::uint64_t seed) {
    Axes axes;
    auto const directions = sobol_directions(dimensions);
    for (std::size_t i = 0; i < dimensions; ++i)
        axes.emplace_back(directions[i], StreamKey{seed, 100 + i}, Stream::scramble);
    return axes;
}

std::size_t cell(double u, int bits) { return static_cast<std::size_t>(std::ldexp(u, bits)); }

/// Points [0, 2^bits) in each elementary interval of sides 2^-a and 2^-(bits − a), [2^bits].
std::vector<int> occupancy(SobolAxis const& x, SobolAxis const& y, int bits, int a) {
    std::vector<int> counts(std::size_t(1) << bits);
    for (std::uint64_t i = 0; i < counts.size(); ++i) ++counts[(cell(x(i), a) << (bits - a)) + cell(y(i), bits - a)];
    return counts;
}

TEST(SobolPoints, BeginAsPublished) {
    // Joe & Kuo's first dimensions, in Gray-code order (their program's output, new-joe-kuo-6).
    double const expected[8][3] = {{0, 0, 0},
                                   {0.5, 0.5, 0.5},
                                   {0.75, 0.25, 0.25},
                                   {0.25, 0.75, 0.75},
                                   {0.375, 0.375, 0.625},
                                   {0.875, 0.875, 0.125},
                                   {0.625, 0.125, 0.875},
                                   {0.125, 0.625, 0.375}};
    auto const axes = plain_axes(3);
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(axes[d](i), expected[i][d] + 0x1p-53) << i << " " << d;
    }
}

TEST(SobolPoints, ScramblingKeepsOnePointPerInterval) {
    for (auto const& axis : scrambled_axes(40, 7)) {
        for (int bits = 0; bits <= 12; ++bits) {
            std::vector<int> counts(std::size_t(1) << bits);
            for (std::uint64_t i = 0; i < counts.size(); ++i) ++counts[cell(axis(i), bits)];
            for (int const count : counts) ASSERT_EQ(count, 1) << bits;
        }
    }
}

TEST(SobolPoints, AnyAlignedBlockIsANet) {
    auto const axes = scrambled_axes(2, 8);
    std::vector<int> counts(1 << 10);
    for (std::uint64_t i = 0; i < 1024; ++i) {
        std::uint64_t const member = 1024 * 12345 + i;
        ++counts[(cell(axes[0](member), 5) << 5) + cell(axes[1](member), 5)];
    }
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), 1024);
}

TEST(SobolPoints, TheFirstTwoDimensionsHaveOnePointPerRectangle) {
    // t = 0 for the pair: every rectangle of area 2^-k has one of 2^k points.
    auto const axes = scrambled_axes(2, 9);
    for (int a = 0; a <= 10; ++a) {
        auto const counts = occupancy(axes[0], axes[1], 10, a);
        EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), 1024) << a;
    }
}

TEST(SobolPoints, ScramblingKeepsTheStrataOfPairs) {
    auto const plain = plain_axes(8), scrambled = scrambled_axes(8, 10);
    for (std::size_t x = 0; x < 8; ++x) {
        for (std::size_t y = 0; y < x; ++y) {
            for (int a = 1; a < 8; ++a) {
                auto before = occupancy(plain[x], plain[y], 8, a);
                auto after = occupancy(scrambled[x], scrambled[y], 8, a);
                std::sort(before.begin(), before.end());
                std::sort(after.begin(), after.end());
                EXPECT_EQ(before, after) << x << " " << y << " " << a;
            }
        }
    }
}

TEST(SobolPoints, EachScrambledPointIsUniform) {
    // Over 4000 seeds, point 0 (which no matrix moves) and another.
    for (std::uint64_t const member : {0u, 37u}) {
        auto const directions = sobol_directions(3)[2];
        std::vector<int> counts(16);
        for (std::uint64_t seed = 0; seed < 4000; ++seed) {
            ++counts[cell(SobolAxis(directions, {seed, 1}, Stream::scramble)(member), 4)];
        }
        double chi2 = 0;
        for (int const count : counts) chi2 += (count - 250.0) * (count - 250.0) / 250.0;
        EXPECT_LT(chi2, 15 + 5 * std::sqrt(30.0));
    }
}

TEST(SobolPoints, ScramblesDifferBySeedNameAndStream) {
    auto const directions = sobol_directions(1)[0];
    auto const points = [&](StreamKey const& key, Stream stream) {
        SobolAxis const axis(directions, key, stream);
        std::vector<double> found;
        for (std::uint64_t i = 0; i < 64; ++i) found.push_back(axis(i));
        return found;
    };
    auto const one = points({1, 2}, Stream::scramble);
    EXPECT_EQ(one, points({1, 2}, Stream::scramble));
    EXPECT_NE(one, points({2, 2}, Stream::scramble));
    EXPECT_NE(one, points({1, 3}, Stream::scramble));
    EXPECT_NE(one, points({1, 2}, Stream::second_scramble));
}

TEST(SobolPoints, ScramblesMixTheDigitsBesidesShiftingThem) {
    // Against point 0 the shift cancels; what is left is L x.
    auto const digits = [](double u) { return static_cast<std::uint64_t>(std::ldexp(u, 52)); };
    auto const plain = plain_axes(2)[1];
    std::set<std::vector<std::uint64_t>> found;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        auto const axis = scrambled_axes(2, seed)[1];
        std::vector<std::uint64_t> moved;
        for (std::uint64_t i = 0; i < 16; ++i) moved.push_back(digits(axis(i)) ^ digits(axis(0)));
        for (std::size_t i = 0; i < 16; ++i) {
            std::uint64_t const before = digits(plain(i));
            EXPECT_EQ(std::bit_width(moved[i]), std::bit_width(before)) << i;  // triangular, ones on the diagonal
            for (std::size_t j = 0; j < i; ++j) {                              // linear
                std::uint64_t const both = (i ^ i >> 1) ^ (j ^ j >> 1);
                std::uint64_t const sum = both ^ both >> 1 ^ both >> 2 ^ both >> 3;  // whose Gray code is `both`
                EXPECT_EQ(moved[i] ^ moved[j], moved[sum]);
            }
        }
        found.insert(moved);
    }
    EXPECT_EQ(found.size(), 20u);
}

TEST(SobolPoints, HaveFiftyTwoBits) {
    auto const axes = scrambled_axes(3, 11);
    for (auto const& axis : axes) {
        // All 2^53 odd multiples of 2^-53 but for the bits beyond: the last bit of u 2^52 − ½ takes both values.
        int odd = 0;
        for (std::uint64_t i = 0; i < 1000; ++i) {
            double const scaled = std::ldexp(axis(i), 52) - 0.5;
            EXPECT_EQ(scaled, std::floor(scaled));
            odd += std::fmod(scaled, 2) == 1 ? 1 : 0;
        }
        EXPECT_GT(odd, 100);
        EXPECT_LT(odd, 900);
        double const last = axis(~std::uint64_t(0));
        EXPECT_TRUE(last > 0 && last < 1);
    }
}

}  // namespace
}  // namespace slideway::sobol_points_test
