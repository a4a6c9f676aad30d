// Our statistics beside those of OpenTURNS, on the same numbers.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <openturns/OT.hxx>

#include "host/statistics/correlation.hpp"
#include "host/statistics/sobol_indices.hpp"
#include "host/statistics/summary.hpp"

namespace slideway::openturns_statistics_test {
namespace {

double uniform(std::mt19937_64& engine) { return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53; }

double ishigami(double const* u) {
    auto const angle = [&](int i) { return std::numbers::pi * (2 * u[i] - 1); };
    double const s = std::sin(angle(0)), t = std::sin(angle(1));
    return s + 7 * t * t + 0.1 * std::pow(angle(2), 4) * s;
}

/// Inputs and outputs as OpenTURNS wants them, all of A, then all of B, then all of AB_1 …; outputs as ours, row by
/// row.
struct RadialSample {
    static constexpr std::size_t rows = 4096, inputs = 3, blocks = inputs + 2;
    OT::Sample input{blocks * rows, inputs}, output{blocks * rows, 1};
    std::vector<double> values = std::vector<double>(blocks * rows);

    RadialSample() {
        std::mt19937_64 engine(11);
        for (std::size_t r = 0; r < rows; ++r) {
            double a[inputs], b[inputs];
            for (double& x : a) x = uniform(engine);
            for (double& x : b) x = uniform(engine);
            for (std::size_t block = 0; block < blocks; ++block) {
                double point[inputs];
                for (std::size_t i = 0; i < inputs; ++i) {
                    point[i] = block == 1 || block == i + 2 ? b[i] : a[i];
                    input(block * rows + r, i) = point[i];
                }
                values[r * blocks + block] = output(block * rows + r, 0) = ishigami(point);
            }
        }
    }
};

TEST(BesideOpenTurns, TotalIndicesAreThoseOfJansen) {
    // OpenTURNS divides by 2N - 1 and by the variance over A alone, of N - 1.
    RadialSample const sample;
    OT::Point const theirs =
        OT::JansenSensitivityAlgorithm(sample.input, sample.output, RadialSample::rows).getTotalOrderIndices();
    SobolIndices const ours = sobol_indices({RadialSample::inputs, sample.values}, {10, 0.95, 1});
    double const variance = OT::Sample(sample.output, 0, RadialSample::rows).computeVariance()[0];
    double const twice = 2.0 * RadialSample::rows;
    for (std::size_t i = 0; i < RadialSample::inputs; ++i) {
        double const expected = ours.total[i].value * (ours.variance / variance) * (twice / (twice - 1));
        EXPECT_NEAR(theirs[i], expected, 1e-12) << i;
    }
}

TEST(BesideOpenTurns, FirstIndicesAreNearThoseOfSaltelli) {
    // Another estimator of the same number (Saltelli 2002); theirs and ours scatter by about 0.01 with these rows.
    RadialSample const sample;
    OT::Point const theirs =
        OT::SaltelliSensitivityAlgorithm(sample.input, sample.output, RadialSample::rows).getFirstOrderIndices();
    SobolIndices const ours = sobol_indices({RadialSample::inputs, sample.values}, {500, 0.95, 1});
    for (std::size_t i = 0; i < RadialSample::inputs; ++i) {
        EXPECT_NEAR(theirs[i], ours.first[i].value, 0.02) << i;
        EXPECT_LT(ours.first[i].interval.low, theirs[i]) << i;
        EXPECT_GT(ours.first[i].interval.high, theirs[i]) << i;
    }
}

struct Draws {
    static constexpr std::size_t rows = 1000, inputs = 3;
    OT::Sample input{rows, inputs}, output{rows, 1};
    std::vector<std::vector<double>> columns{inputs, std::vector<double>(rows)};
    std::vector<double> values = std::vector<double>(rows);

    Draws() {
        std::mt19937_64 engine(12);
        for (std::size_t r = 0; r < rows; ++r) {
            for (std::size_t i = 0; i < inputs; ++i) input(r, i) = columns[i][r] = uniform(engine);
            // Ties in the output, and a negative effect.
            double const y = 2 * columns[0][r] - columns[1][r] + 0.2 * uniform(engine);
            output(r, 0) = values[r] = std::round(50 * y) / 50;
        }
    }
};

TEST(BesideOpenTurns, CorrelationsAndRegressionAreTheSame) {
    Draws const draws;
    OT::CorrelationAnalysis const theirs(draws.input, draws.output);
    OT::Point const ranks = theirs.computeSpearmanCorrelation(), regression = theirs.computeSRC();
    OT::Point const moments = theirs.computePearsonCorrelation();
    auto const ours = standardised_regression(draws.columns, draws.values);
    for (std::size_t i = 0; i < Draws::inputs; ++i) {
        EXPECT_NEAR(rank_correlation(midranks(draws.columns[i]), midranks(draws.values)).value, ranks[i], 1e-12) << i;
        EXPECT_NEAR(product_moment(draws.columns[i], draws.values), moments[i], 1e-12) << i;
        EXPECT_NEAR(ours.coefficients[i], regression[i], 1e-12) << i;
    }
}

TEST(BesideOpenTurns, MomentsAndQuantilesAreTheSame) {
    Draws const draws;
    Summary const ours = summarise(draws.values);
    EXPECT_NEAR(ours.mean, draws.output.computeMean()[0], 1e-13);
    EXPECT_NEAR(ours.sd, draws.output.computeStandardDeviation()[0], 1e-13);
    std::vector<double> sorted = draws.values;
    std::sort(sorted.begin(), sorted.end());
    // Theirs interpolates at h = n p - 1/2, ours (type 7) at h = (n-1) p.
    auto const n = static_cast<double>(Draws::rows);
    for (double const p : {0.001, 0.05, 0.31, 0.5, 0.75, 0.999}) {
        EXPECT_NEAR(quantile(sorted, p), draws.output.computeQuantile(((n - 1) * p + 0.5) / n)[0], 1e-12) << p;
    }
}

}  // namespace
}  // namespace slideway::openturns_statistics_test
