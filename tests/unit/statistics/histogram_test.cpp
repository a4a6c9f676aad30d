#include "host/statistics/summary.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace slideway::histogram_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> ramp(std::size_t n) {
    std::vector<double> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0.0);
    return numbers;
}

TEST(Histogram, HasTheBinsOfFreedmanAndDiaconis) {
    // 0 … 1000: IQR 500, width 1000/1001^(1/3) = 99.97, so 11 bins of 1000/11.
    Histogram const h = histogram(ramp(1001));
    ASSERT_EQ(h.counts.size(), 11u);
    ASSERT_EQ(h.edges.size(), 12u);
    EXPECT_EQ(h.edges.front(), 0);
    EXPECT_EQ(h.edges.back(), 1000);
    EXPECT_NEAR(h.edges[3], 3000.0 / 11, 1e-10);
    // Whole numbers below 90.9, 181.8, …: 91 each, the last with its upper edge.
    for (std::size_t i = 0; i < 11; ++i) EXPECT_EQ(h.counts[i], 91u) << i;
}

TEST(Histogram, CountsEveryNumberOnce) {
    std::vector<double> const values{-3, -1, -1, 0, 0, 0.5, 2, 2, 2, 7};
    Histogram const h = histogram(values);
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0}), values.size());
    for (std::size_t i = 0; i < h.counts.size(); ++i) {
        std::uint64_t inside = 0;
        bool const last = i + 1 == h.counts.size();
        for (double const x : values)
            inside += x >= h.edges[i] && (x < h.edges[i + 1] || (last && x == h.edges[i + 1]));
        EXPECT_EQ(h.counts[i], inside) << i;
    }
}

TEST(Histogram, HasAtMostSixtyFourBins) {
    std::vector<double> values = ramp(1000);
    values.push_back(1e9);  // a range of far more widths
    EXPECT_EQ(histogram(values).counts.size(), 64u);
    std::vector<double> piled(100, 5.0);  // quartiles alike
    piled.push_back(6);
    Histogram const h = histogram(piled);
    ASSERT_EQ(h.counts.size(), 64u);
    EXPECT_EQ(h.counts.front(), 100u);
    EXPECT_EQ(h.counts.back(), 1u);
}

TEST(Histogram, OfOneValueHasOneBinOfNoWidth) {
    Histogram const h = histogram(std::vector<double>(7, 2.5));
    EXPECT_EQ(h.edges, (std::vector<double>{2.5, 2.5}));
    EXPECT_EQ(h.counts, (std::vector<std::uint64_t>{7}));
}

TEST(Histogram, CountsInfinitiesApart) {
    Histogram const h = histogram(std::vector<double>{-infinity, 1, 2, 3, 4, infinity, infinity});
    EXPECT_EQ(h.below, 1u);
    EXPECT_EQ(h.above, 2u);
    EXPECT_EQ(h.edges.front(), 1);
    EXPECT_EQ(h.edges.back(), 4);
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0}), 4u);
    Histogram const empty = histogram(std::vector<double>{infinity});
    EXPECT_TRUE(empty.edges.empty() && empty.counts.empty());
    EXPECT_EQ(empty.above, 1u);
}

TEST(Histogram, SpansTheRangeOfDoubles) {
    constexpr double largest = std::numeric_limits<double>::max();
    Histogram const h = histogram(std::vector<double>{-largest, 0, largest});
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0}), 3u);
    for (double const edge : h.edges) EXPECT_TRUE(std::isfinite(edge));
}

}  // namespace
}  // namespace slideway::histogram_test
