// Distributions and correlated draws against OpenTURNS (Baudin, Dutfoy, Iooss & Popelin, Handbook of Uncertainty
// Quantification, 2016).
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <openturns/ComposedDistribution.hxx>
#include <openturns/LogNormalMuSigma.hxx>
#include <openturns/Normal.hxx>
#include <openturns/NormalCopula.hxx>
#include <openturns/ParametrizedDistribution.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/Triangular.hxx>
#include <openturns/TruncatedNormal.hxx>
#include <openturns/Uniform.hxx>
#include <openturns/WeibullMin.hxx>

#include "tests/unit/sampling/samples.hpp"

namespace slideway::openturns_sampling_test {
namespace {

using Kind = Distribution::Kind;

struct Pair {
    std::string name;
    Distribution ours;
    OT::Distribution theirs;
};

std::vector<Pair> pairs() {
    using OT::ParametrizedDistribution;
    return {{"uniform", {Kind::uniform, 0, 0, 2, 5}, OT::Uniform(2, 5)},
            {"normal", {Kind::normal, 20, 1.5}, OT::Normal(20, 1.5)},
            {"triangular", {Kind::triangular, 0, 0, 1, 4, 1.5}, OT::Triangular(1, 1.5, 4)},
            {"triangular, mode on its bound", {Kind::triangular, 0, 0, 1, 4, 4}, OT::Triangular(1, 4, 4)},
            {"lognormal", {Kind::lognormal, 5, 2}, ParametrizedDistribution(OT::LogNormalMuSigma(5, 2, 0))},
            {"lognormal, shifted", {Kind::lognormal, 5, 2, 1}, ParametrizedDistribution(OT::LogNormalMuSigma(5, 2, 1))},
            {"weibull", {Kind::weibull, 0, 0, 0, 0, 0, 2, 1.5}, OT::WeibullMin(2, 1.5, 0)},
            {"weibull, shifted", {Kind::weibull, 0, 0, 1, 0, 0, 2, 0.75}, OT::WeibullMin(2, 0.75, 1)},
            {"truncated normal", {Kind::truncated_normal, 5, 1, 3.5, 7}, OT::TruncatedNormal(5, 1, 3.5, 7)},
            {"truncated normal, a tail", {Kind::truncated_normal, 1, 1, 4, 9}, OT::TruncatedNormal(1, 1, 4, 9)}};
}

TEST(OpenTurns, QuantilesAgree) {
    for (auto const& [name, ours, theirs] : pairs()) {
        for (int i = 0; i < 200; ++i) {
            double const u = (i + 0.5) / 200;
            double const expected = theirs.computeQuantile(u)[0];
            EXPECT_NEAR(ours.quantile(u) / expected, 1, 1e-12) << name << " " << u;
        }
    }
}

TEST(OpenTurns, UpperTailsAgree) {
    // By the complement on both sides: from z through Φ(−z).
    for (auto const& [name, ours, theirs] : pairs()) {
        // OpenTURNS 1.20 takes the cut normal's tail from 1 − F and loses its digits;
        // Distribution.CutTailsKeepTheirDigits goes on.
        double const farthest = name == "truncated normal, a tail" ? 2.5 : 6;
        for (double z = 0.5; z <= farthest; z += 0.25) {
            double const expected = theirs.computeQuantile(testing::normal_cdf(-z), true)[0];
            EXPECT_NEAR(ours.from_standard_normal(z) / expected, 1, 1e-12) << name << " " << z;
        }
    }
}

TEST(OpenTurns, MomentsAgree) {
    for (auto const& [name, ours, theirs] : pairs()) {
        constexpr std::uint64_t members = 1 << 16;
        Design const design = testing::design_of(DesignKind::sobol);
        auto const x = testing::columns_of(design, testing::variations_of(1, ours), members)[0];
        double const mean = testing::mean_of(x), sd = theirs.getStandardDeviation()[0];
        double square = 0;
        for (double const value : x) square += (value - mean) * (value - mean);
        EXPECT_NEAR(mean, theirs.getMean()[0], 2e-4 * sd) << name;
        EXPECT_NEAR(std::sqrt(square / members), sd, 2e-3 * sd) << name;
    }
}

TEST(OpenTurns, CorrelatedDrawsAgree) {
    // Skewed marginals under a normal copula: Pearson's r is no longer the copula's, and differs between pairs.
    constexpr std::size_t draws = 100000;
    std::vector<double> const matrix = {1, 0.8, -0.5, 0.8, 1, -0.2, -0.5, -0.2, 1};
    auto const all = pairs();
    std::size_t const chosen[] = {4, 7, 2};  // lognormal, weibull, triangular
    auto variations = testing::variations_of(3, testing::unit_uniform());
    OT::Collection<OT::Distribution> marginals;
    OT::CorrelationMatrix correlation(3);
    for (std::size_t i = 0; i < 3; ++i) {
        variations[i].distribution = all[chosen[i]].ours;
        marginals.add(all[chosen[i]].theirs);
        for (std::size_t j = 0; j < i; ++j) correlation(i, j) = matrix[i * 3 + j];
    }
    OT::RandomGenerator::SetSeed(1);
    OT::Sample const sample = OT::ComposedDistribution(marginals, OT::NormalCopula(correlation))
                                  .getSample(static_cast<OT::UnsignedInteger>(draws));
    auto const theirs = sample.computeLinearCorrelation();
    Design design = testing::design_of(DesignKind::mc);
    design.correlation = {{0, 1, 2}, matrix};
    auto const ours = testing::columns_of(design, variations, draws);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            // Long tails: the deviation of r is some 2/√n, of the difference of two √2 more.
            EXPECT_NEAR(testing::correlation_of(ours[i], ours[j]), theirs(i, j), 5 * 2 * std::sqrt(2.0 / draws));
        }
    }
}

TEST(OpenTurns, CorrelatedLatinHypercubesFollowTheSameCopula) {
    // Shares of members below a point in three keys at once, and Spearman's ρ, which OpenTURNS knows of the copula.
    constexpr std::uint64_t members = 20000;
    std::vector<double> const matrix = {1, 0.8, -0.5, 0.8, 1, -0.2, -0.5, -0.2, 1};
    OT::CorrelationMatrix correlation(3);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < i; ++j) correlation(i, j) = matrix[i * 3 + j];
    }
    OT::NormalCopula const copula(correlation);
    Design design = testing::design_of(DesignKind::lhs);
    design.correlation = {{0, 1, 2}, matrix};
    auto const u = testing::columns_of(design, testing::variations_of(3, testing::unit_uniform()), members);
    for (double const a : {0.1, 0.5, 0.9}) {
        for (double const b : {0.2, 0.7}) {
            for (double const c : {0.3, 0.8}) {
                double below = 0;
                for (std::size_t m = 0; m < members; ++m)
                    below += u[0][m] < a && u[1][m] < b && u[2][m] < c ? 1.0 / members : 0.0;
                double const expected = copula.computeCDF(OT::Point({a, b, c}));
                EXPECT_NEAR(below, expected, 4 * std::sqrt(expected * (1 - expected) / members) + 1e-4)
                    << a << ' ' << b << ' ' << c;
            }
        }
    }
    auto const spearman = copula.getSpearmanCorrelation();
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NEAR(testing::correlation_of(u[i], u[j]), spearman(i, j), 4 * 0.4 / std::sqrt(members));
    }
}

}  // namespace
}  // namespace slideway::openturns_sampling_test
