#include "host/chaos/delay_embedding.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/chaos/series.hpp"

namespace slideway::testing::nearest_neighbours_test {
namespace {

Neighbour brute_force(DelayEmbedding const& embedding, std::size_t points, std::size_t theiler, std::size_t i) {
    Neighbour best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points; ++j) {
        if ((i > j ? i - j : j - i) <= theiler) continue;
        double squared = 0;
        for (std::size_t k = 0; k < embedding.dimension(); ++k) {
            double const d = embedding(i, k) - embedding(j, k);
            squared += d * d;
        }
        if (squared > 0 && squared < least) {
            least = squared;
            best = {j, std::sqrt(squared)};
        }
    }
    return best;
}

void expect_brute_force(std::vector<double> const& series, DelayEmbedding const& embedding, std::size_t points,
                        std::size_t theiler) {
    auto const found = nearest_neighbours(embedding, points, theiler);
    ASSERT_EQ(found.size(), points);
    for (std::size_t i = 0; i < points; ++i) {
        Neighbour const expected = brute_force(embedding, points, theiler, i);
        ASSERT_EQ(found[i].index, expected.index) << i << " of " << series.size();
        ASSERT_DOUBLE_EQ(found[i].distance, expected.distance) << i;
    }
}

TEST(DelayEmbedding, TakesCoordinatesADelayApart) {
    std::vector<double> const series{0, 1, 2, 3, 4, 5, 6, 7};
    DelayEmbedding const embedding(series, 2, 3);
    EXPECT_EQ(embedding.size(), 4u);
    EXPECT_EQ(embedding.span(), 4u);
    EXPECT_EQ(embedding(3, 0), 3);
    EXPECT_EQ(embedding(3, 2), 7);
    EXPECT_EQ(embedding.squared_distance(0, 3), 27);
}

TEST(DelayEmbedding, HasNoPointsWhereTheSeriesIsTooShort) {
    std::vector<double> const series(5);
    EXPECT_EQ(DelayEmbedding(series, 2, 3).size(), 1u);
    EXPECT_EQ(DelayEmbedding(series, 3, 3).size(), 0u);
    EXPECT_EQ(DelayEmbedding(series, 0, 3).size(), 0u);
    EXPECT_EQ(DelayEmbedding(series, 1, 0).size(), 0u);
}

TEST(NearestNeighbours, AreThoseOfBruteForce) {
    auto const series = lorenz_series(800, 0.05);
    for (std::size_t const dimension : {1u, 3u, 6u}) {
        for (std::size_t const theiler : {0u, 20u}) {
            DelayEmbedding const embedding(series, 3, dimension);
            expect_brute_force(series, embedding, embedding.size() - 50, theiler);
        }
    }
}

TEST(NearestNeighbours, AreNeverTheSamePointAgain) {
    // Rounded numbers repeat and are equally far from many; of those the first counts.
    auto series = lorenz_series(600, 0.05);
    for (double& x : series) x = std::round(x / 2);
    DelayEmbedding const embedding(series, 2, 2);
    expect_brute_force(series, embedding, embedding.size(), 5);
    for (Neighbour const& neighbour : nearest_neighbours(embedding, embedding.size(), 5)) {
        EXPECT_GT(neighbour.distance, 0);
    }
}

TEST(NearestNeighbours, AreNoneWhereNoPointIsLeft) {
    auto const series = white_series(50);
    for (Neighbour const& n : nearest_neighbours(DelayEmbedding(series, 1, 2), 49, 49))
        EXPECT_EQ(n.index, Neighbour::none);
    std::vector<double> const constant(50, 1.0);
    for (Neighbour const& n : nearest_neighbours(DelayEmbedding(constant, 1, 2), 49, 0)) {
        EXPECT_EQ(n.index, Neighbour::none);
    }
}

}  // namespace
}  // namespace slideway::testing::nearest_neighbours_test
