#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "host/sampling/random.hpp"

namespace slideway::permutation_test {
namespace {

std::vector<std::uint64_t> order(std::uint64_t size, StreamKey const& key) {
    Permutation const permutation(size, key);
    std::vector<std::uint64_t> places(size);
    for (std::uint64_t i = 0; i < size; ++i) places[i] = permutation(i);
    return places;
}

TEST(Permutation, TakesEachPlaceOnce) {
    for (std::uint64_t const size : {1u, 2u, 3u, 7u, 8u, 9u, 100u, 255u, 256u, 257u, 511u, 513u, 4097u, 65537u}) {
        auto places = order(size, {3, 4});
        std::sort(places.begin(), places.end());
        for (std::uint64_t i = 0; i < size; ++i) ASSERT_EQ(places[i], i) << size;
    }
}

TEST(Permutation, DependsOnSeedAndName) {
    EXPECT_EQ(order(100, {1, 2}), order(100, {1, 2}));
    EXPECT_NE(order(100, {1, 2}), order(100, {2, 2}));
    EXPECT_NE(order(100, {1, 2}), order(100, {1, 3}));
}

TEST(Permutation, HugeSizesNeedNoMemory) {
    std::uint64_t const size = (std::uint64_t(1) << 62) + 5;
    Permutation const permutation(size, {1, 2});
    EXPECT_LT(permutation(size - 1), size);
    EXPECT_NE(permutation(0), permutation(1));
    EXPECT_LT(Permutation(~std::uint64_t(0), {1, 2})(7), ~std::uint64_t(0));
}

TEST(Permutation, RefusesIndicesBeyondItsSize) {
    EXPECT_THROW(Permutation(5, {1, 2})(5), std::out_of_range);
    EXPECT_THROW(Permutation(256, {1, 2})(256), std::out_of_range);
}

TEST(Permutation, OrdersAreEquallyLikely) {
    // Pearson's χ² over the n! orders; its standard score is beyond 5 once in millions of tries.
    for (std::uint64_t const size : {2u, 3u, 4u, 5u}) {
        double orders = 1;
        for (std::uint64_t i = 2; i <= size; ++i) orders *= static_cast<double>(i);
        std::uint64_t const keys = size < 5 ? 6000 : 24000;
        std::map<std::vector<std::uint64_t>, int> counts;
        for (std::uint64_t seed = 0; seed < keys; ++seed) ++counts[order(size, {seed, 77})];
        EXPECT_EQ(static_cast<double>(counts.size()), orders);
        double chi2 = 0;
        for (auto const& [places, count] : counts) {
            double const expected = static_cast<double>(keys) / orders;
            chi2 += (count - expected) * (count - expected) / expected;
        }
        EXPECT_LT(chi2, orders - 1 + 5 * std::sqrt(2 * (orders - 1))) << size;
    }
}

TEST(Permutation, PairsOfPlacesAreEquallyLikely) {
    // Sizes whose domain is walked little: where the neighbours 0 and 1 go, over the keys.
    constexpr std::uint64_t size = 250;
    constexpr int keys = 40000, cells = 25;
    std::vector<int> counts(cells * cells);
    for (std::uint64_t seed = 0; seed < keys; ++seed) {
        Permutation const permutation(size, {seed, 5});
        ++counts[permutation(0) / 10 * cells + permutation(1) / 10];
    }
    double chi2 = 0;
    for (int i = 0; i < cells * cells; ++i) {
        double const pairs = i / cells == i % cells ? 10 * 9 : 10 * 10;
        double const expected = keys * pairs / (250.0 * 249);
        chi2 += (counts[static_cast<std::size_t>(i)] - expected) * (counts[static_cast<std::size_t>(i)] - expected) /
                expected;
    }
    double const freedom = cells * cells - 1;
    EXPECT_NEAR(chi2, freedom, 5 * std::sqrt(2 * freedom));
}

}  // namespace
}  // namespace slideway::permutation_test
