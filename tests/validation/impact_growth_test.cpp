// Growth of the offsets of shadows through impacts: a ball over a vibrating table, whose periodic bounce has a closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/models/models.hpp"
#include "tests/support/table_bounce.hpp"

namespace slideway::impact_growth_test {
namespace {

using testing::Bounce;
using testing::Following;
using testing::TableBallInputs;

constexpr double period = Bounce::period, g = Bounce::g, omega = Bounce::omega;

IntegratorSettings settings() {
    IntegratorSettings s;
    s.method = Method::dopri5;
    s.rtol = s.atol = 1e-12;
    s.max_step = 0.05;
    s.max_steps = 1'000'000;
    return s;
}

/// A stop every period.
Following following(int transient, int recorded, int shadows) {
    Following f;
    auto const count = static_cast<std::size_t>(transient + recorded + 1);
    f.clocks = {{static_cast<double>(count) * period, period, period}};
    f.stops = {.count = count, .transient = static_cast<std::size_t>(transient)};
    f.shadows = shadows;
    f.d0 = 1e-8;
    return f;
}

/// How impacts come into the offsets: shadows meet theirs at times of their own, or offsets are carried through by saltation.
enum class Impacts { of_their_own, rigid };
constexpr Impacts both[] = {Impacts::of_their_own, Impacts::rigid};

testing::ModelResult run(Impacts impacts, std::vector<TableBallInputs> const& balls, Following const& f) {
    if (impacts == Impacts::of_their_own) return testing::run(best_isa(), settings(), balls, f);
    std::vector<testing::RigidBallInputs> rigid;
    for (auto const& ball : balls) rigid.push_back({ball});
    return testing::run(best_isa(), settings(), rigid, f);
}

void expect_exponents(Impacts impacts, Bounce const& bounce, int transient, int recorded, double tolerance) {
    auto const [first, second] = bounce.exponents();
    for (int const shadows : {1, 2}) {
        auto const f = following(transient, recorded, shadows);
        auto const r = run(impacts, {bounce.inputs}, f);
        ASSERT_EQ(r.records[0].status, Status::finished);
        // It is the orbit that was meant.
        EXPECT_NEAR(r.states[0], bounce.inputs.height, 1e-9);
        EXPECT_NEAR(r.states[1], bounce.inputs.speed, 1e-9);
        EXPECT_NEAR(mean_growth(r, f, 0, 0) / period, first, tolerance) << shadows;
        ::testing::Test::RecordProperty("first_off",
                                        std::to_string(1e9 * (mean_growth(r, f, 0, 0) / period - first)) + "e-9");
        if (shadows == 1) continue;
        EXPECT_NEAR(mean_growth(r, f, 0, 1) / period, second, tolerance);
        ::testing::Test::RecordProperty("second_off",
                                        std::to_string(1e9 * (mean_growth(r, f, 0, 1) / period - second)) + "e-9");
    }
}

TEST(TableBallShadows, GrowAtTheRealExponentsOfABounce) {
    // Without the jump's own term (a shadow reset when its member is) both would be ln e/T: off by 0.44.
    for (double const e : {0.5, 0.8}) {
        auto const bounce = Bounce::with(e, Bounce::acceleration_of(0.4 * (1 + e * e) + 0.6 * 2 * e, e));
        auto const [one, other] = bounce.eigenvalues();
        ASSERT_EQ(one.imag(), 0);
        ASSERT_GT(one.real(), other.real() + 0.1);
        ASSERT_LT(one.real(), 1);
        EXPECT_NEAR(std::abs(one * other), e * e, 1e-15);
        for (auto const impacts : both) expect_exponents(impacts, bounce, 120, 100, 1e-6);
    }
}

TEST(TableBallShadows, GrowAtTheCommonExponentOfComplexEigenvalues) {
    // Trace e: eigenvalues e exp(±iπ/3), so that offsets turn by 180° in three periods and their growth repeats.
    auto const bounce = Bounce::with(0.5, Bounce::acceleration_of(0.5, 0.5));
    auto const [one, other] = bounce.eigenvalues();
    ASSERT_NEAR(std::abs(std::arg(one)), std::numbers::pi / 3, 1e-12);
    EXPECT_NEAR(bounce.exponents().first, std::log(0.5) / period, 1e-12);
    EXPECT_NEAR(bounce.exponents().second, std::log(0.5) / period, 1e-12);
    for (auto const impacts : both) expect_exponents(impacts, bounce, 60, 90, 1e-6);
}

TEST(TableBallShadows, CarryWhatAnImpactLeavesBehind) {
    // The thrust follows the speed of the last impact; without the offset of that memory the exponents would be those of b = 0.
    for (auto const& [b, acceleration] : {std::pair{0.3, -0.8}, {-0.2, -1.1}}) {
        // Begun shortly before an impact: until there the ball remembers none.
        auto const bounce = Bounce::with(0.5, acceleration, b, 0.98);
        auto const [one, other] = bounce.eigenvalues();
        ASSERT_LT(std::max(std::abs(one), std::abs(other)), 0.9);
        ASSERT_GT(std::abs(std::abs(one) - std::abs(other)), 0.1);
        expect_exponents(Impacts::of_their_own, bounce, 150, 100, 2e-6);
    }
}

TEST(TableBallShadows, DepartFromAnUnstableBounce) {
    // Beyond trace 1 + e² one eigenvalue exceeds 1.  Rounding leaves the orbit too, at the same rate: 40 periods are few enough.
    double const e = 0.8;
    auto const bounce = Bounce::with(e, Bounce::acceleration_of(1.8, e));
    auto const [first, second] = bounce.exponents();
    ASSERT_GT(first, 0.1);
    auto const f = following(20, 20, 2);
    for (auto const impacts : both) {
        auto const r = run(impacts, {bounce.inputs}, f);
        EXPECT_NEAR(mean_growth(r, f, 0, 0) / period, first, 1e-5);
        EXPECT_NEAR(mean_growth(r, f, 0, 0) + mean_growth(r, f, 0, 1), 2 * std::log(e), 1e-6);
    }
}

TEST(TableBallShadows, OfAnElasticBallDepartLinearly) {
    // No drive, e = 1, from the apex: a period of the ball is M = Φ(T/2) S Φ(T/2) with double eigenvalue 1: Mⁿ = 1 + n (M − 1).
    double const half = 0.5, speed = g * half;  // V
    TableBallInputs in;
    in.height = g * half * half / 2;
    double const s21 = 2 * g / speed;  // −(1 + e) f/V
    // S Φ(T/2), then Φ(T/2) times it.
    double const a11 = -1, a12 = -half, a21 = s21, a22 = s21 * half - 1;
    double const m11 = a11 + half * a21, m12 = a12 + half * a22, m21 = a21, m22 = a22;
    ASSERT_NEAR(m11 + m22, 2, 1e-14);
    ASSERT_NEAR(m11 * m22 - m12 * m21, 1, 1e-14);
    for (auto const& [x, v] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.6, -0.8}}) {
        auto f = following(0, 60, 1);
        f.upper = 1e300;  // never put back
        f.directions = {x, v};
        for (auto const impacts : both) {
            auto const r = run(impacts, {in}, f);
            ASSERT_EQ(r.records[0].status, Status::finished);
            double distance = 0, exponent = 0;
            for (int n = 1; n <= 61; ++n) {
                double const dx = x + n * ((m11 - 1) * x + m12 * v), dv = v + n * (m21 * x + (m22 - 1) * v);
                double const former = distance;
                distance = std::hypot(dx, dv);
                if (n == 1) continue;  // from the first recorded stop on
                exponent += r.growth[static_cast<std::size_t>(n - 2)];
                EXPECT_NEAR(r.growth[static_cast<std::size_t>(n - 2)], std::log(distance / former), 2e-6) << n;
            }
            double const first = std::hypot(x + (m11 - 1) * x + m12 * v, v + m21 * x + (m22 - 1) * v);
            EXPECT_NEAR(exponent, std::log(distance / first), 2e-5) << "finite-time exponents fall like ln(t)/t";
        }
    }
}

TEST(TableBallShadows, TellTheSmallerErrorTheNearerTheyStart) {
    // What is left is the curvature of the offset's own path: of the first order in d0.
    double const e = 0.5;
    auto const bounce = Bounce::with(e, Bounce::acceleration_of(0.4 * (1 + e * e) + 0.6 * 2 * e, e));
    double const first = bounce.exponents().first;
    double former = 0;
    for (double const d0 : {1e-4, 1e-5, 1e-6, 1e-7}) {
        auto f = following(120, 100, 1);
        f.d0 = d0;
        auto const off = [&](Impacts impacts) {
            return mean_growth(run(impacts, {bounce.inputs}, f), f, 0, 0) / period - first;
        };
        double const own = off(Impacts::of_their_own);
        if (former != 0) {
            EXPECT_NEAR(own, former / 10, 0.3 * std::abs(former) / 10) << d0;
        }
        former = own;
        // Saltation leaves no curvature, and flights under a table's acceleration have none.
        EXPECT_NEAR(off(Impacts::rigid), 0, 1e-14 / d0) << d0;
    }
}

TEST(TableBallShadows, OfAChaoticBallContractAreasByEverySingleImpact) {
    // Areas shrink by e² at an impact and nowhere else: the sum of both growths is 2 ln e for each, a whole number of times between two
    // stops.  Only near a graze is an offset of 1e-8 too long for its linear law.
    TableBallInputs in;
    in.restitution = 0.9, in.amplitude = 3.9, in.frequency = omega, in.phase = 0.7, in.speed = 0.1;
    std::vector<TableBallInputs> members;
    for (int i = 0; i < 8; ++i) {
        members.push_back(in);
        members.back().height = 0.3 + 0.05 * i;
    }
    auto const f = following(50, 400, 2);
    for (auto const impacts : both) {
        auto const r = run(impacts, members, f);
        std::size_t const intervals = f.stops.growths();
        double exponent = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            ASSERT_EQ(r.records[i].status, Status::finished) << i;
            exponent += mean_growth(r, f, i, 0) / period / 8;
            std::size_t off = 0, impacts = 0;
            for (std::size_t k = 0; k < intervals; ++k) {
                double const* growth = &r.growth[(i * intervals + k) * 2];
                double const number = (growth[0] + growth[1]) / (2 * std::log(in.restitution));
                off += std::abs(number - std::round(number)) > 1e-3;
                impacts += static_cast<std::size_t>(std::round(number));
            }
            EXPECT_LE(off, 2u) << "of 400 intervals, member " << i;
            EXPECT_GT(impacts, 50u) << i;
        }
        EXPECT_GT(exponent, 0.2);
        RecordProperty("exponent", std::to_string(exponent));
    }
}

}  // namespace
}  // namespace slideway::impact_growth_test
