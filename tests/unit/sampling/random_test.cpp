#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "host/sampling/random.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::random_test {
namespace {

double uniform_draw(std::uint64_t seed, std::uint64_t member, std::string_view name) {
    return StreamKey{seed, name_hash(name)}.uniform(Stream::value, member);
}

using Words = std::array<std::uint64_t, 4>;

TEST(Philox, MeetsTheKnownAnswers) {
    // kat_vectors of Random123, philox4x64-10
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x16554d9eca36314cu, 0xdb20fe9d672d0fdcu, 0xd7e772cee186176bu,
                                                   0x7e68b68aec7ba23bu}));
    std::uint64_t const f = 0xffffffffffffffffu;
    EXPECT_EQ(philox({f, f, f, f}, {f, f}), (Words{0x87b092c3013fe90bu, 0x438c3c67be8d0224u, 0x9cc7d7c69cd777b6u,
                                                   0xa09caebf594f0ba0u}));
}

TEST(Philox, NamesHashByFnv1a) {
    EXPECT_EQ(name_hash(""), 0xcbf29ce484222325u);
    EXPECT_EQ(name_hash("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(name_hash("foobar"), 0x85944171f73967e8u);
}

TEST(Philox, DrawsDifferBySeedMemberAndName) {
    double const u = uniform_draw(1, 2, "initial.y");
    EXPECT_EQ(u, uniform_draw(1, 2, "initial.y"));
    EXPECT_NE(u, uniform_draw(2, 2, "initial.y"));
    EXPECT_NE(u, uniform_draw(1, 3, "initial.y"));
    EXPECT_NE(u, uniform_draw(1, 2, "initial.z"));
}

/// Largest distance of the sample's distribution from `cdf`.
double kolmogorov_distance(std::vector<double> values, std::function<double(double)> const& cdf) {
    std::sort(values.begin(), values.end());
    double distance = 0;
    double const n = static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        double const f = cdf(values[i]);
        distance = std::max({distance, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
    }
    return distance;
}

constexpr std::size_t draws = 20000;
/// Exceeded by one sample in ten thousand: √(ln(2/1e-4)/(2n)).
double const kolmogorov_limit = std::sqrt(std::log(2e4) / (2.0 * draws));

std::vector<double> sample(Distribution const& distribution) {
    std::vector<double> values(draws);
    for (std::size_t i = 0; i < draws; ++i) values[i] = distribution.quantile(uniform_draw(7, i, "joint.clearance"));
    return values;
}

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

TEST(Distribution, DrawsAreUniform) {
    Distribution const d{Distribution::Kind::uniform, 0, 0, -2, 3};
    auto const values = sample(d);
    EXPECT_LT(kolmogorov_distance(values, [](double x) { return (x + 2) / 5; }), kolmogorov_limit);
    EXPECT_GE(*std::min_element(values.begin(), values.end()), -2);
    EXPECT_LE(*std::max_element(values.begin(), values.end()), 3);
}

TEST(Distribution, DrawsAreNormal) {
    Distribution const d{Distribution::Kind::normal, 5, 2, 0, 0};
    EXPECT_LT(kolmogorov_distance(sample(d), [](double x) { return normal_cdf((x - 5) / 2); }), kolmogorov_limit);
}

TEST(Distribution, DrawsAreTruncatedNormal) {
    Distribution const d{Distribution::Kind::truncated_normal, 1, 2, 0, 2};
    double const low = normal_cdf(-0.5), high = normal_cdf(0.5);
    EXPECT_LT(kolmogorov_distance(sample(d), [&](double x) { return (normal_cdf((x - 1) / 2) - low) / (high - low); }),
              kolmogorov_limit);
}

TEST(Distribution, MomentsAreThoseOfTheTruncatedNormal) {
    // One-sided by 1 sd: mean = φ(1)/Q(1), variance = 1 + mean − mean² (Johnson, Kotz & Balakrishnan 1994).
    Distribution const d{Distribution::Kind::truncated_normal, 0, 1, 1, 1000};
    double const mean = std::exp(-0.5) / std::sqrt(2 * 3.141592653589793) / normal_cdf(-1);
    double const variance = 1 + mean - mean * mean;
    double sum = 0, squares = 0;
    for (double const x : sample(d)) {
        sum += x;
        squares += (x - mean) * (x - mean);
    }
    EXPECT_NEAR(sum / draws, mean, 4 * std::sqrt(variance / draws));
    EXPECT_NEAR(squares / draws, variance, 0.05 * variance);
}

TEST(Distribution, QuantilesAreKnownValues) {
    Distribution const normal{Distribution::Kind::normal, 0, 1, 0, 0};
    EXPECT_NEAR(normal.quantile(0.975), 1.959963984540054, 1e-14);
    EXPECT_NEAR(normal.quantile(0.5), 0, 1e-15);
    Distribution const constant{Distribution::Kind::constant, 4, 0, 0, 0};
    EXPECT_EQ(constant.quantile(0.3), 4);
    Distribution const uniform{Distribution::Kind::uniform, 0, 0, 2, 4};
    EXPECT_EQ(uniform.quantile(0.25), 2.5);
}

TEST(Distribution, TailsKeepTheirShape) {
    // Far out the normal's tail is exponential: P(X > 10 + s) ≈ P(X > 10) exp(−10 s − s²/2).
    Distribution const upper{Distribution::Kind::truncated_normal, 0, 1, 10, 12};
    Distribution const lower{Distribution::Kind::truncated_normal, 0, 1, -12, -10};
    double const median = upper.quantile(0.5);
    double const tail = std::erfc(median / std::sqrt(2.0)) / std::erfc(10 / std::sqrt(2.0));
    EXPECT_NEAR(tail, 0.5, 1e-9);
    EXPECT_NEAR(lower.quantile(0.5), -median, 1e-12);
    for (double const u : {0x1p-53, 1 - 0x1p-53}) {
        EXPECT_GE(upper.quantile(u), 10);
        EXPECT_LE(upper.quantile(u), 12);
    }
}

constexpr char varied_scene[] = R"(schema = 1
[study]
members = 10
seed = 5
[study.vary]
"joint.clearance" = { dist = "truncnorm", mean = "0.1 mm", sd = "0.01 mm", low = "0.05 mm", high = "0.15 mm" }
"initial.y" = { dist = "unif", low = "-0.05 mm", high = "0.05 mm" }
)";

TEST(Sampling, OrderAndOtherKeysDoNotMatter) {
    Scene const scene = testing::scene_of(varied_scene);
    Scene const other = testing::scene_of(R"(schema = 1
[study]
seed = 5
[study.vary]
"mechanism.crank_speed" = { dist = "norm", mean = "30 rpm", sd = "1 rpm" }
"initial.y" = { dist = "unif", low = -5e-5, high = 5e-5 }
"joint.clearance" = { dist = "truncnorm", mean = 1e-4, sd = 1e-5, low = 5e-5, high = 1.5e-4 }
)");
    for (std::uint64_t member : {0u, 1u, 999u}) {
        EXPECT_EQ(member_inputs(scene, member).y, member_inputs(other, member).y);
        EXPECT_EQ(member_inputs(scene, member).clearance_y, member_inputs(other, member).clearance_y);
    }
    EXPECT_NE(member_inputs(scene, 0).y, member_inputs(scene, 1).y);
}

TEST(Sampling, ATwinKeyVariesBothInputs) {
    Scene const scene = testing::scene_of(varied_scene);
    Inputs const in = member_inputs(scene, 3);
    EXPECT_EQ(in.clearance_y, in.clearance_z);
    EXPECT_NE(in.clearance_y, 1e-4);
    EXPECT_EQ(in.clearance_y, draw(scene, scene.variations[0], 3));
}

TEST(Sampling, MembersAreComplete) {
    Scene const scene = testing::scene_of("schema = 1\n[study.vary]\n"
                                          "\"mechanism.slider_mass\" = { dist = \"const\", value = \"374.4 g\" }\n"
                                          "\"joint.way_width\" = { dist = \"const\", value = \"50 mm\" }\n");
    Inputs const in = member_inputs(scene, 0);
    EXPECT_EQ(in.slider_mass, 0.3744);
    EXPECT_NEAR(in.slider_inertia_x, 0.3744 * (0.05 * 0.05 + 0.03 * 0.03) / 12, 1e-18);  // of what was drawn
    EXPECT_EQ(in.thickness_y, 0.05);
    EXPECT_EQ(defect(in), std::nullopt);
}

TEST(Sampling, UnboundedDrawsCanHaveDefects) {
    Scene const scene = testing::scene_of("schema = 1\n[study.vary]\n"
                                          "\"joint.clearance\" = { dist = \"norm\", mean = 1e-4, sd = 1e-4 }\n");
    int defects = 0;
    for (std::uint64_t member = 0; member < 1000; ++member) {
        Inputs const in = member_inputs(scene, member);
        EXPECT_EQ(defect(in).has_value(), !(in.clearance_y >= -1e-4));
        defects += defect(in).has_value() ? 1 : 0;
    }
    EXPECT_NEAR(defects, 23, 24);  // Φ(−2) = 0.0228; five standard deviations of a binomial
}

}  // namespace
}  // namespace slideway::random_test
