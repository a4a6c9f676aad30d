#include "host/chaos/power_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/chaos/series.hpp"

namespace slideway::testing::power_spectrum_test {
namespace {

double integral(PowerSpectrum const& spectrum) {
    double sum = 0;
    for (double const density : spectrum.density) sum += density * spectrum.frequency[1];
    return sum;
}

double variance(std::vector<double> const& series) {
    double mean = 0, squares = 0;
    for (double const x : series) mean += x / static_cast<double>(series.size());
    for (double const x : series) squares += (x - mean) * (x - mean);
    return squares / static_cast<double>(series.size());
}

TEST(PowerSpectrum, IntegratesToTheVariance) {
    for (std::size_t const count : {4u, 7u, 256u, 1000u, 1009u}) {
        auto const series = white_series(count);
        EXPECT_NEAR(integral(power_spectrum(series, 0.02, Taper::none)), variance(series), 1e-12) << count;
    }
    // With a taper too, for a line far from zero.
    EXPECT_NEAR(integral(power_spectrum(sine_series(5000, 40, 3), 0.1)), 4.5, 0.001);
}

TEST(PowerSpectrum, EndsAtHalfTheSamplingRate) {
    PowerSpectrum const spectrum = power_spectrum(white_series(100), 0.25);
    EXPECT_EQ(spectrum.frequency.front(), 0);
    EXPECT_EQ(spectrum.frequency.back(), 2);
    EXPECT_EQ(spectrum.frequency.size(), spectrum.density.size());
}

TEST(PowerSpectrum, PeaksAtTheLine) {
    PowerSpectrum const spectrum = power_spectrum(sine_series(1000, 8), 0.5);
    auto const peak = std::max_element(spectrum.density.begin(), spectrum.density.end()) - spectrum.density.begin();
    EXPECT_NEAR(spectrum.frequency[static_cast<std::size_t>(peak)], 1 / (8 * 0.5), spectrum.frequency[1]);
}

TEST(PowerSpectrum, IsEmptyOutsideItsDomain) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(power_spectrum(white_series(3), 1).density.empty());
    EXPECT_TRUE(power_spectrum(white_series(100), 0).density.empty());
    EXPECT_TRUE(power_spectrum(white_series(100), nan).density.empty());
    auto series = white_series(100);
    series[50] = nan;
    EXPECT_TRUE(power_spectrum(series, 1).density.empty());
    EXPECT_TRUE(std::isnan(average_period(series, 1)));
}

TEST(AveragePeriod, OfASineIsItsPeriod) {
    for (std::size_t const count : {500u, 1009u, 5000u}) {
        for (double const period : {7.3, 20.0, 50.3}) {
            EXPECT_NEAR(average_period(sine_series(count, period), 1), period, 0.002 * period)
                << count << ' ' << period;
        }
    }
    EXPECT_NEAR(average_period(sine_series(5000, 50.3), 0.01), 0.503, 0.001);
    auto raised = sine_series(5000, 50.3, 1e-3);
    for (double& x : raised) x += 1000;
    EXPECT_NEAR(average_period(raised, 1), 50.3, 0.1);
}

TEST(AveragePeriod, OfTwoTonesWeighsTheirPower) {
    // (9·f₁ + 1·f₂)/10 with f₁ = 1/100, f₂ = 1/10.
    auto const series = sum(sine_series(8000, 100, 3), sine_series(8000, 10, 1));
    EXPECT_NEAR(average_period(series, 1), 1 / (0.9 * 0.01 + 0.1 * 0.1), 0.05);
}

TEST(AveragePeriod, OfWhiteNoiseIsFourSamples) {
    // A flat spectrum up to ½ has the mean frequency ¼.
    EXPECT_NEAR(average_period(white_series(20000), 1), 4, 0.1);
}

TEST(AveragePeriod, OfAConstantIsNone) {
    EXPECT_TRUE(std::isnan(average_period(std::vector<double>(100, 0.1), 1)));
    EXPECT_TRUE(std::isnan(average_period(std::vector<double>{}, 1)));
}

}  // namespace
}  // namespace slideway::testing::power_spectrum_test
