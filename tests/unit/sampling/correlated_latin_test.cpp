// Latin hypercubes whose columns correlate: the strata stay, their order follows the matrix.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "tests/unit/sampling/samples.hpp"

namespace slideway::correlated_latin_test {
namespace {

using Kind = Distribution::Kind;
using testing::Columns;
using testing::columns_of;
using testing::correlation_of;
using testing::unit_uniform;
using testing::variations_of;

std::vector<double> const three = {1, 0.8, -0.3, 0.8, 1, 0.2, -0.3, 0.2, 1};

Design correlated(std::vector<std::size_t> variations, std::vector<double> matrix) {
    Design design = testing::design_of(DesignKind::lhs);
    design.correlation = {std::move(variations), std::move(matrix)};
    return design;
}

/// Which of so many strata of (0, 1) each value lies in.
std::vector<double> strata_of(std::vector<double> const& values) {
    std::vector<double> strata;
    for (double const u : values) strata.push_back(std::floor(u * static_cast<double>(values.size())));
    return strata;
}

/// Correlation of the normal scores of the strata, by bisection of Φ.
double score_correlation(std::vector<double> const& a, std::vector<double> const& b) {
    auto const scores = [](std::vector<double> const& values) {
        std::vector<double> found;
        for (double const stratum : strata_of(values)) {
            double low = -9, high = 9;
            while (high - low > 1e-12) {
                double const z = 0.5 * (low + high);
                (testing::normal_cdf(z) * static_cast<double>(values.size() + 1) < stratum + 1 ? low : high) = z;
            }
            found.push_back(low);
        }
        return found;
    };
    return correlation_of(scores(a), scores(b));
}

TEST(CorrelatedLatin, HypercubesHaveOneMemberPerStratumOfEveryKey) {
    for (std::uint64_t const members : {1u, 2u, 3u, 4u, 5u, 64u, 1000u, 10007u}) {
        for (std::uint64_t const seed : {1u, 2u, 3u}) {
            for (auto const& column :
                 columns_of(correlated({3, 0, 1}, three), variations_of(4, unit_uniform()), members, seed)) {
                auto strata = strata_of(column);
                std::sort(strata.begin(), strata.end());
                std::vector<double> each(members);
                std::iota(each.begin(), each.end(), 0.0);
                ASSERT_EQ(strata, each) << members;
            }
        }
    }
}

TEST(CorrelatedLatin, HypercubesHaveTheMatrixToWithinAFewPartsOfTheirMembers) {
    // Independent draws miss by 1/√members.  Beside the scores Spearman's ρ of a normal copula, 6/π asin(r/2) (Kruskal 1958): its
    // chance is not taken out, but what it shares with the scores is.
    for (std::uint64_t const members : {30u, 300u, 3000u}) {
        double squares = 0, rank_squares = 0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            auto const x = columns_of(correlated({3, 0, 1}, three), variations_of(4, unit_uniform()), members, seed);
            std::size_t const order[] = {3, 0, 1};
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    double const r = three[i * 3 + j];
                    double const miss = score_correlation(x[order[i]], x[order[j]]) - r;
                    double const rank_miss = correlation_of(strata_of(x[order[i]]), strata_of(x[order[j]])) -
                                             6 / std::numbers::pi * std::asin(r / 2);
                    EXPECT_LT(std::abs(miss), 10.0 / static_cast<double>(members))
                        << members << ' ' << seed << ' ' << r;
                    squares += miss * miss / 60;
                    rank_squares += rank_miss * rank_miss / 60;
                }
            }
        }
        EXPECT_LT(std::sqrt(squares), 1.5 / static_cast<double>(members)) << members;
        EXPECT_LT(std::sqrt(rank_squares), 0.4 / std::sqrt(static_cast<double>(members))) << members;
    }
}

TEST(CorrelatedLatin, AMatrixOfNoneTakesChanceOut) {
    auto const variations = variations_of(2, unit_uniform());
    double alone = 0, together = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        auto const a = columns_of(testing::design_of(DesignKind::lhs), variations, 100, seed);
        auto const b = columns_of(correlated({0, 1}, {1, 0, 0, 1}), variations, 100, seed);
        alone += std::abs(score_correlation(a[0], a[1])) / 20;
        together += std::abs(score_correlation(b[0], b[1])) / 20;
    }
    EXPECT_GT(alone, 0.04);  // √(2/π)/10 = 0.08
    EXPECT_LT(together, 0.02);
}

TEST(CorrelatedLatin, TheFirstAndTheOthersKeepTheirDraws) {
    auto const variations = variations_of(4, {Kind::normal, 3, 0.5});
    auto const alone = columns_of(testing::design_of(DesignKind::lhs), variations, 200);
    auto const together = columns_of(correlated({1, 3}, {1, -0.5, -0.5, 1}), variations, 200);
    EXPECT_EQ(alone[0], together[0]);
    EXPECT_EQ(alone[1], together[1]);
    EXPECT_EQ(alone[2], together[2]);
    EXPECT_NE(alone[3], together[3]);
}

TEST(CorrelatedLatin, AMemberIsTheSameAloneInAnyOrderAndOnAnyThread) {
    Design const design = correlated({0, 2, 1}, three);
    auto const variations = variations_of(3, {Kind::normal, 0, 1});
    auto const all = columns_of(design, variations, 500);
    for (std::uint64_t const member : {499u, 0u, 250u}) {
        std::vector<double> values(3);
        Sampler(design, variations, 1, 500).draw(member, values);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(values[i], all[i][member]);
    }
    Sampler const shared(design, variations, 1, 500);
    Columns found[4];
    std::vector<std::thread> threads;
    for (Columns& columns : found) threads.emplace_back([&] { columns = columns_of(shared, 3, 500); });
    for (std::thread& thread : threads) thread.join();
    for (Columns const& columns : found) EXPECT_EQ(columns, all);
    EXPECT_NE(columns_of(design, variations, 500, 2), all);
}

TEST(CorrelatedLatin, MeansOfSumsAreFarBetterThanThoseOfDraws) {
    // Where only the first kept its strata, x₁ would err like √(1 − r²) of independent draws: 0.07 of 100.
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        auto const x =
            columns_of(correlated({0, 1}, {1, 0.7, 0.7, 1}), variations_of(2, {Kind::normal, 0, 1}), 100, seed);
        double const mean = testing::mean_of(x[1]);
        squares += mean * mean / 50;
    }
    EXPECT_LT(std::sqrt(squares), 0.01);
}

TEST(CorrelatedLatin, MoreMembersThanAnOrderHasPlacesForAreRefused) {
    EXPECT_THROW(
        Sampler(correlated({0, 1}, {1, 0.5, 0.5, 1}), variations_of(2, unit_uniform()), 1, std::uint64_t{1} << 32),
        SceneError);
}

}  // namespace
}  // namespace slideway::correlated_latin_test
