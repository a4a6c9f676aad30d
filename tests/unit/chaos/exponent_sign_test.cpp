// Signs of exponents from made-up records of growth: powers of time have none, whatever swings or scatters on top of them.
#include "host/chaos/exponents.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "host/sampling/distribution.hpp"

namespace slideway::testing::exponent_sign_test {
namespace {

constexpr std::size_t intervals = 512;
constexpr int records = 1000;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Draws {
    std::mt19937_64 engine{1};
    double uniform() { return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53; }
    double normal() { return standard_normal_quantile(uniform()); }
};

/// ln of an offset: exponent · t + power · ln(1 + t/transient) + swing sin(ωt + φ) + noise, with steps of a random walk.
struct Growth {
    double exponent = 0;  // times the length of the record
    double power = 0, transient = 5, swing = 0, noise = 0, walk = 0;

    ExponentRecord record(Draws& draws) const {
        double const phase = 6.283 * draws.uniform(), rate = 0.05 + 2.95 * draws.uniform();
        double walked = 0, before = 0;
        std::vector<double> log;
        for (std::size_t i = 0; i <= intervals; ++i) {
            auto const t = static_cast<double>(i);
            double const now = exponent * t / intervals + power * std::log1p(t / transient) + swing * std::sin(rate * t + phase) +
                               noise * draws.normal() + walked;
            if (i > 0) log.push_back(now - before);
            before = now;
            walked += walk * draws.normal();
        }
        Exponents const e = exponents_of({log, 1, 1});
        return {e.value[0], e.half_width[0], e.late[0], static_cast<double>(intervals)};
    }
};

double share_above(Growth const& growth) {
    Draws draws;
    int above = 0;
    for (int i = 0; i < records; ++i) above += sign_of(growth.record(draws)) == ExponentSign::above_zero;
    return static_cast<double>(above) / records;
}

/// What intervals alone take for a sign.
double share_beyond_interval(Growth const& growth) {
    Draws draws;
    int beyond = 0;
    for (int i = 0; i < records; ++i) {
        ExponentRecord const record = growth.record(draws);
        beyond += record.rate > record.half_width && record.late > 0;
    }
    return static_cast<double>(beyond) / records;
}

TEST(ExponentSign, OfAPowerOfTimeIsNone) {
    for (double const power : {1.0, 2.0}) {
        for (Growth growth : {Growth{}, Growth{.transient = 30}, Growth{.swing = 0.3, .noise = 0.01}, Growth{.swing = 1, .noise = 0.1},
                              Growth{.swing = 3, .noise = 0.1}, Growth{.walk = 0.02}, Growth{.walk = 0.1}}) {
            growth.power = power;
            EXPECT_LE(share_above(growth), 0.015) << power << ' ' << growth.swing << ' ' << growth.walk;
        }
    }
    EXPECT_EQ(share_beyond_interval({.power = 1, .transient = 30}), 1) << "which is why";
    EXPECT_GT(share_beyond_interval({.power = 2, .walk = 0.02}), 0.9);
}

TEST(ExponentSign, OfNoGrowthIsRarelyTold) {
    for (double const walk : {0.02, 0.3, 1.0}) EXPECT_LE(share_above({.walk = walk}), 0.025) << walk;
}

TEST(ExponentSign, OfExponentialGrowthIsToldOnceItOutgrowsItsScatter) {
    // λT, scatter of λT by a random walk (√512 steps), and the least share of records that tell.
    struct Case {
        double growth, scatter, least, most;
    };
    for (auto const& [growth, scatter, least, most] : {Case{5, 0.45, 0.15, 0.4}, {10, 0.45, 0.999, 1}, {10, 2.26, 0.3, 0.6}, {20, 2.26, 0.97, 1},
                                                       {20, 6.8, 0.2, 0.5}, {50, 6.8, 0.97, 1}}) {
        double const share = share_above({.exponent = growth, .walk = scatter / std::sqrt(intervals)});
        EXPECT_GE(share, least) << growth << ' ' << scatter;
        EXPECT_LE(share, most) << growth << ' ' << scatter;
    }
}

TEST(ExponentSign, IsTheSameUpsideDown) {
    double const cubic = 3 * std::log(2.0);
    EXPECT_EQ(exponent_sign(1, 0.1, cubic + 0.3, 0.2), ExponentSign::above_zero);
    EXPECT_EQ(exponent_sign(-1, 0.1, -cubic - 0.3, 0.2), ExponentSign::below_zero);
    for (double const side : {1.0, -1.0}) {
        EXPECT_EQ(exponent_sign(side, 0.1, side * (cubic + 0.1), 0.2), ExponentSign::power_of_time);
        EXPECT_EQ(exponent_sign(side, 0.1, -9 * side, 0.2), ExponentSign::power_of_time) << "what grew early shrank";
        EXPECT_EQ(exponent_sign(side, 1.1, 9 * side, 0.2), ExponentSign::undecided);
        EXPECT_EQ(exponent_sign(side, nan, 9 * side, 0.2), ExponentSign::undecided);
        EXPECT_EQ(exponent_sign(side, 0.1, nan, 0.2), ExponentSign::undecided);
    }
}

TEST(ExponentOfMembers, HoldsWhatItsHalvesDifferBy) {
    // Rates 40, 41, 42 scatter by 1: Student's t(0.975, 2) = 4.302653 times 1/√3.  Second halves are slower by 1 and by 3.
    auto const members = [](double slower) {
        std::vector<ExponentRecord> all;
        for (double const rate : {40.0, 41.0, 42.0}) all.push_back({rate, 0.5, rate - slower, 100});
        return exponent_of_members(all, 0.25);
    };
    EXPECT_NEAR(members(1).mean.half_width, 4.302653 / std::sqrt(3) + 0.25, 1e-6);
    EXPECT_NEAR(members(3).mean.half_width, 3 + 0.25, 1e-12);
    EXPECT_EQ(members(1).mean.mean, 41);
    EXPECT_EQ(members(1).sign, ExponentSign::above_zero);
    EXPECT_EQ(members(1).above, 3u);
}

TEST(ExponentOfMembers, OfLinearGrowthReachesToZero) {
    // S = ln(t/t₀) of four members whose rates hardly differ: T = 50, S(T) about 4, of which ln 2 in the second half.
    std::vector<ExponentRecord> linear;
    for (double const s : {3.93, 3.95, 3.95, 4.0}) linear.push_back({s / 50, 0.03, std::log(2.0) / 25, 50});
    ExponentOfMembers const found = exponent_of_members(linear, 0);
    EXPECT_EQ(found.sign, ExponentSign::power_of_time);
    EXPECT_DOUBLE_EQ(found.mean.half_width, found.mean.mean);
    EXPECT_EQ(found.above + found.below, 0u);
    EXPECT_EQ(found.undecided, 4u);
    EXPECT_EQ(found.power_of_time, 4u);
}

TEST(ExponentOfMembers, IsNotDeceivedByMembersThatSwingTogether) {
    // All halves end at the top of the same swing, and the members' own intervals know of the swing.
    std::vector<ExponentRecord> const together(16, {0.1, 0.2, 0.1, 50});
    EXPECT_EQ(exponent_of_members(together, 0).sign, ExponentSign::power_of_time);
    std::vector<ExponentRecord> const sure(16, {0.1, 0.01, 0.1, 50});
    EXPECT_EQ(exponent_of_members(sure, 0).sign, ExponentSign::above_zero) << "2.5 in the second half is more than t³";
}

TEST(ExponentOfMembers, OfOneIsItsOwn) {
    ExponentRecord const one{1, 0.1, 1, 50};
    ExponentOfMembers const found = exponent_of_members({&one, 1}, 0);
    EXPECT_EQ(found.sign, ExponentSign::above_zero);
    EXPECT_TRUE(std::isnan(found.mean.half_width));
    EXPECT_EQ(exponent_of_members({}, 0).sign, ExponentSign::undecided);
}

}  // namespace
}  // namespace slideway::testing::exponent_sign_test
