#include "host/study/series_analysis.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "tests/unit/chaos/series.hpp"

namespace slideway::testing::series_analysis_test {
namespace {

bool contains(std::vector<std::string> const& lines, std::string const& part) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](std::string const& line) { return line.find(part) != std::string::npos; });
}

void expect_refusal(std::vector<double> const& series, SeriesOptions const& options, std::string const& part) {
    try {
        analyse_series(series, 1, options);
        ADD_FAILURE() << "no refusal: " << part;
    } catch (SceneError const& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(SeriesAnalysis, OfLorenzFindsItsWay) {
    SeriesAnalysis const a = analyse_series(lorenz_series(5000, 0.01), 0.01);
    EXPECT_FALSE(a.from_map);
    EXPECT_GE(a.delay, 16u);
    EXPECT_LE(a.delay, 20u);
    EXPECT_GE(a.dimension, 3u);
    EXPECT_EQ(a.window, (a.dimension - 1) * a.delay);
    EXPECT_EQ(a.theiler, static_cast<std::size_t>(std::ceil(a.average_period / 0.01)));
    ASSERT_TRUE(a.growth);
    EXPECT_NEAR(a.growth->exponent, 0.9056, 3 * a.growth->error);
    EXPECT_TRUE(a.growth_is_exponential());
    // 5,000 samples, thinned to four a period, are 130.
    EXPECT_TRUE(verdict(a).starts_with("neighbours part exponentially")) << verdict(a);
    EXPECT_TRUE(verdict(a).ends_with("the 0–1 test has too few samples")) << verdict(a);
    EXPECT_TRUE(contains(reservations(a), "it needs 300"));
    EXPECT_TRUE(contains(reservations(a), "surrogate"));
    SeriesAnalysis const longer = analyse_series(lorenz_series(5000, 0.03), 0.03);
    EXPECT_TRUE(verdict(longer).starts_with("consistent with chaos")) << verdict(longer);
}

TEST(SeriesAnalysis, OfAMapTakesSuccessiveSamples) {
    SeriesAnalysis const a = analyse_series(logistic_series(2000, 4), 1);
    EXPECT_TRUE(a.from_map);
    EXPECT_EQ(a.delay, 1u);
    EXPECT_EQ(a.dimension, 3u);
    EXPECT_EQ(a.stride, 1u);
    ASSERT_TRUE(a.growth);
    EXPECT_NEAR(a.growth->exponent, std::log(2), 0.02);
    EXPECT_TRUE(verdict(a).starts_with("consistent with chaos")) << verdict(a);
}

TEST(SeriesAnalysis, ClaimsNoChaosForRegularMotion) {
    for (auto const& series : {sine_series(3000, 62.83), sine_series(3000, 50),
                               sum(sine_series(3000, 62.83), sine_series(3000, 62.83 / std::numbers::sqrt2, 0.5)),
                               sum(sine_series(3000, 62.83, 20), white_series(3000)), logistic_series(3000, 3.55)}) {
        SeriesAnalysis const a = analyse_series(series, 1);
        EXPECT_FALSE(a.growth_is_seen());
        EXPECT_EQ(verdict(a).find("chaos,"), std::string::npos) << verdict(a);
    }
    EXPECT_TRUE(verdict(analyse_series(sine_series(6000, 62.83), 1)).starts_with("no sign of chaos"));
    EXPECT_TRUE(verdict(analyse_series(sine_series(3000, 62.83), 1)).ends_with("the 0–1 test has too few samples"));
}

TEST(SeriesAnalysis, ClaimsNoExponentWhereNeighboursPartLikeAPowerOfTime) {
    for (std::size_t const count : {1000u, 3000u, 6000u}) {
        for (double const drift : {2e-5, 6e-5}) {
            SeriesAnalysis const a = analyse_series(drifting_series(count, 0.1, drift), 1);
            ASSERT_TRUE(a.growth) << count;
            EXPECT_FALSE(a.growth->is_beyond_a_power()) << count << ' ' << drift;
            EXPECT_GE(a.growth->half_width(), a.growth->exponent) << count << ' ' << drift;
            EXPECT_EQ(verdict(a).find("exponentially"), std::string::npos) << verdict(a);
            EXPECT_EQ(verdict(a).find("consistent"), std::string::npos) << verdict(a);
            EXPECT_TRUE(contains(reservations(a), "a power of time fits the curve"));
        }
    }
    SeriesAnalysis const chaos = analyse_series(lorenz_series(3000, 0.05), 0.05);
    EXPECT_TRUE(chaos.growth->is_beyond_a_power());
    EXPECT_FALSE(contains(reservations(chaos), "power of time"));
}

TEST(SeriesAnalysis, ClaimsNoChaosForNoise) {
    std::vector<double> coloured = white_series(5000);
    for (std::size_t i = 1; i < coloured.size(); ++i) coloured[i] += 0.95 * coloured[i - 1];
    for (auto const& series : {white_series(3000), coloured}) {
        SeriesAnalysis const a = analyse_series(series, 1);
        EXPECT_FALSE(a.growth_is_exponential());
        EXPECT_FALSE(verdict(a).starts_with("consistent")) << verdict(a);
    }
}

TEST(SeriesAnalysis, KeepsWhatIsGiven) {
    SeriesOptions options{.delay = 9, .dimension = 4, .theiler = 33, .fit = FitWindow{40, 160}};
    SeriesAnalysis const a = analyse_series(lorenz_series(4000, 0.01), 0.01, options);
    EXPECT_EQ(a.delay, 9u);
    EXPECT_EQ(a.dimension, 4u);
    EXPECT_EQ(a.window, 27u);
    EXPECT_EQ(a.theiler, 33u);
    ASSERT_TRUE(a.growth);
    EXPECT_EQ(a.growth->window.first, 40u);
    EXPECT_EQ(a.growth->window.last, 160u);
    EXPECT_EQ(a.growth->line.points, 121u);
}

TEST(SeriesAnalysis, SaysWhenPointsAreFew) {
    auto const series = lorenz_series(2000, 0.01);
    auto const lines = reservations(analyse_series(series, 0.01, {.delay = 5, .dimension = 8}));
    EXPECT_TRUE(contains(lines, "2000 points are few for dimension 8: at least 10^(m/2) = 10000"));
    EXPECT_TRUE(contains(lines, "average periods long"));
    EXPECT_TRUE(contains(lines, "one of every"));
}

TEST(SeriesAnalysis, RefusesWhatItCannotUse) {
    auto series = white_series(500);
    expect_refusal(std::vector<double>(500, 3.0), {}, "constant");
    expect_refusal(white_series(99), {}, "99 samples; at least 100");
    expect_refusal(series, {.delay = 100, .dimension = 6}, "delay 100 and dimension 6");
    expect_refusal(series, {.delay = 1, .dimension = 2, .fit = FitWindow{0, 400}}, "--fit ends at sample 400");
    series[123] = std::nan("");
    expect_refusal(series, {}, "1 of the 500 samples are no finite numbers, sample 123");
}

}  // namespace
}  // namespace slideway::testing::series_analysis_test
