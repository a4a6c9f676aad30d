// Derivatives of the contact laws against central differences of the laws themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "kernels/all_laws.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "tests/oracle/oracle.hpp"

namespace slideway::face_stiffness_test {
namespace {

using Values = std::array<double, 4>;

SliderParameters<double> parameters(double exponent = 1.5) {
    Inputs in;
    in.hertz_exponent = exponent;
    in.chi_line = 3, in.chi_surface = 5;
    in.restitution = 0.6;
    in.law_a = follows, in.law_b = 50;
    return slider_parameters(oracle::completed(in));
}

FaceContact<double> y_face(SliderParameters<double> const& p) {
    auto const& c = p.joint.contact;
    return {c.surface_stiffness_y, c.across_y_face, c.along, c.area_y};
}

Values values(Quad<double> const& q) { return {q.a, q.b, q.c, q.d}; }

FaceMotion<double> motion(Values const& depth, Values const& rate) {
    FaceMotion<double> m;
    m.apex = {{depth[0], rate[0], 0.02}, {depth[1], rate[1], 0.03}, {depth[2], rate[2], 0.01}, {depth[3], rate[3], 0.025}};
    m.touching = {depth[0] > 0, depth[1] > 0, depth[2] > 0, depth[3] > 0};
    return m;
}

/// Row of the full matrix: derivatives by a, b, c, d.
Values by_apex(ApexSlopes<double> const& r, int apex) {
    switch (apex) {
        case 0:
            return {r.own, r.across, r.opposite, r.along};
        case 1:
            return {r.across, r.own, r.along, r.opposite};
        case 2:
            return {r.opposite, r.along, r.own, r.across};
        default:
            return {r.along, r.opposite, r.across, r.own};
    }
}

/// The changes of the four apices that a law is made for: each alone; of a bed, which takes them for a plane, those that leave it one.
template <class Law> std::vector<Values> directions() {
    if constexpr (std::is_same_v<Law, Foundation>) return {{1, 1, 1, 1}, {1, 1, -1, -1}, {1, -1, -1, 1}};
    return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
}

/// The part of it that these make up; they are orthogonal.
Values projected(Values const& v, std::vector<Values> const& directions) {
    Values sum{};
    for (Values const& direction : directions) {
        double share = 0, square = 0;
        for (std::size_t i = 0; i < 4; ++i) share += v[i] * direction[i], square += direction[i] * direction[i];
        for (std::size_t i = 0; i < 4; ++i) sum[i] += share / square * direction[i];
    }
    return sum;
}

/// Σ_j of the rows of the matrix times a direction.
Values product(Quad<ApexSlopes<double>> const& matrix, Values const& direction) {
    ApexSlopes<double> const rows[] = {matrix.a, matrix.b, matrix.c, matrix.d};
    Values product{};
    for (int i = 0; i < 4; ++i) {
        auto const row = by_apex(rows[i], i);
        for (std::size_t j = 0; j < 4; ++j) product[static_cast<std::size_t>(i)] += row[j] * direction[j];
    }
    return product;
}

template <class Law, class Damping> void expect_derivatives(double exponent) {
    auto const p = parameters(exponent);
    auto const face = y_face(p);
    auto const& contact = p.joint.contact;
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> unit(0, 1);
    auto const forces = [&](Values const& depth, Values const& rate) {
        return values(Law::template forces<Damping>(motion(depth, rate), face, contact).normal);
    };
    auto const ways = directions<Law>();
    for (int draw = 0; draw < 40; ++draw) {
        for (unsigned pattern = 0; pattern < 16; ++pattern) {
            Values depth, rate;
            double const size = std::pow(10.0, -9 + 3 * unit(random));
            for (unsigned i = 0; i < 4; ++i) {
                depth[i] = size * (0.3 + unit(random)) * ((pattern >> i & 1u) != 0 ? 1 : -1);
                rate[i] = 0.02 * (unit(random) - 0.5);
            }
            depth = projected(depth, ways), rate = projected(rate, ways);
            auto const got = Law::template stiffness<Damping>(motion(depth, rate), face, contact);
            auto const force = forces(depth, rate), normal = values(got.normal);
            double const load = *std::max_element(force.begin(), force.end());
            std::string const where = "pattern " + std::to_string(pattern) + " draw " + std::to_string(draw);
            for (unsigned i = 0; i < 4; ++i) EXPECT_NEAR(normal[i], force[i], 1e-13 * load) << where;
            for (std::size_t j = 0; j < ways.size(); ++j) {
                auto const difference = [&](double step, bool of_rate) {
                    Values d;
                    auto const moved = [&](double by) {
                        Values there = of_rate ? rate : depth;
                        for (std::size_t i = 0; i < 4; ++i) there[i] += by * ways[j][i];
                        return of_rate ? forces(depth, there) : forces(there, rate);
                    };
                    auto const up = moved(step), down = moved(-step);
                    for (std::size_t i = 0; i < 4; ++i) d[i] = (up[i] - down[i]) / (2 * step);
                    return d;
                };
                double const step = 1e-4 * size, rate_step = 1e-5;
                auto const by_depth = difference(step, false), by_rate = difference(rate_step, true);
                auto const got_depth = product(got.by_depth, ways[j]), got_rate = product(got.by_rate, ways[j]);
                for (std::size_t i = 0; i < 4; ++i) {
                    // A bed's load is cubic where a corner is in, and bends where another apex comes in (foundation_test has the digits).
                    double const close = std::is_same_v<Law, Foundation> ? 1e-5 * face.surface_stiffness : 2e-7 * load / size;
                    EXPECT_NEAR(got_depth[i], by_depth[i], close) << where << ' ' << i << j;
                    EXPECT_NEAR(got_rate[i], by_rate[i], 1e-9 * load / rate_step) << where << ' ' << i << j;
                }
            }
            if (::testing::Test::HasFailure()) return;
        }
    }
}

TEST(FaceStiffness, OfALawHasSixteenNumbersOfItsOwn) {
    Inputs in;
    for (int i = 0; i < most_own_numbers; ++i) in.*law_inputs[i] = i + 1;
    LawNumbers<double> const law = slider_parameters(oracle::completed(in)).joint.contact.of_law;
    EXPECT_EQ((std::bit_cast<std::array<double, 16>>(law)), (std::array<double, 16>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
    EXPECT_EQ(law.p, in.law_p);
}

template <class Law> void expect_derivatives_of_law() {
    expect_derivatives<Law, PointDamping>(1.5);
    expect_derivatives<Law, PointDamping>(1.4);
    if constexpr (Law::info.has(Damping::rate)) expect_derivatives<Law, RateDamping>(1.5);
    if constexpr (Law::info.has(Damping::restitution)) expect_derivatives<Law, RestitutionDamping>(1.3);
}

#define SLIDEWAY_TEST(name, Type) \
    TEST(FaceStiffness, IsTheDerivativeOf##Type) { expect_derivatives_of_law<Type>(); }
SLIDEWAY_LAWS(SLIDEWAY_TEST)
#undef SLIDEWAY_TEST

TEST(FaceStiffness, AContactThatDampingLiftsHasNone) {
    auto const p = parameters();
    // 1 + χ h' and 1 + a h'/v0 are negative, and so are K δ^(3/2) + η K δ δ' and k δ + c δ'.
    auto const m = motion({1e-8, 1.1e-8, 0.9e-8, 1e-8}, {-1, -1, -1, -1});
    auto const expect_nothing = [](FaceStiffness<double> const& f) {
        for (double const force : values(f.normal)) EXPECT_EQ(force, 0);
        for (auto const* rows : {&f.by_depth, &f.by_rate}) {
            for (auto const& r : {rows->a, rows->b, rows->c, rows->d}) {
                EXPECT_EQ(r.own, 0);
                EXPECT_EQ(r.across, 0);
                EXPECT_EQ(r.along, 0);
                EXPECT_EQ(r.opposite, 0);
            }
        }
    };
    expect_nothing(PaperLaw::stiffness<RateDamping>(m, y_face(p), p.joint.contact));
    expect_nothing(PaperLaw::stiffness<RestitutionDamping>(m, y_face(p), p.joint.contact));
    expect_nothing(ConservativeLaw::stiffness<RestitutionDamping>(m, y_face(p), p.joint.contact));
    expect_nothing(KelvinVoigt::stiffness<PointDamping>(m, y_face(p), p.joint.contact));
}

TEST(LineStiffness, IsOneOverTheSlopeOfTheApproach) {
    // δ = x (1 − ln(x R/l²)), P = scale·x: both known in closed form from x.
    LineContact<double> const line{2e10, 0.4};
    for (double x = 1e-12; x < 2; x *= 3) {
        double const logarithm = std::log(x * line.radius_rate);
        auto const at = line_slope(x * (1 - logarithm), line);
        EXPECT_NEAR(at.load, line.scale * x, 1e-14 * line.scale * x);
        EXPECT_NEAR(at.slope * -logarithm / line.scale, 1, 1e-13) << x;
    }
}

TEST(LineStiffness, StaysFiniteAtTheEndOfItsDomainAndIsNanBeyond) {
    LineContact<double> const line{2e10, 0.4};
    EXPECT_TRUE(std::isfinite(line_slope(2.5, line).slope));
    EXPECT_TRUE(std::isnan(line_slope(2.6, line).slope));
    EXPECT_TRUE(std::isnan(line_slope(2.6, line).load));
}

TEST(FrictionStiffness, IsTheDerivativeOfTheSlidingForce) {
    auto const f = parameters().joint.friction;
    auto const force = [&](double x, double z) {
        double const speed = std::hypot(x, z);
        double const mu = StickSlipFriction::coefficient(speed, f);
        return std::array<double, 2>{-mu * x / speed, -mu * z / speed};
    };
    for (double speed = 1e-5; speed < 0.05; speed *= 1.3) {
        double const x = 0.6 * speed, z = -0.8 * speed, h = 1e-5 * speed;
        auto const at = StickSlipStiffness::apex(x, z, f);
        auto const here = force(x, z);
        EXPECT_NEAR(at.push_x, here[0], 1e-15);
        EXPECT_NEAR(at.push_z, here[1], 1e-15);
        auto const right = force(x + h, z), left = force(x - h, z), up = force(x, z + h), down = force(x, z - h);
        double const close = 1e-7 * f.static_coefficient / std::min(speed, 1e-3);
        EXPECT_NEAR(at.xx, (left[0] - right[0]) / (2 * h), close) << speed;
        EXPECT_NEAR(at.xz, (left[1] - right[1]) / (2 * h), close) << speed;
        EXPECT_NEAR(at.xz, (down[0] - up[0]) / (2 * h), close) << speed;
        EXPECT_NEAR(at.zz, (down[1] - up[1]) / (2 * h), close) << speed;
    }
}

TEST(FrictionStiffness, IsIsotropicAtRest) {
    auto const f = parameters().joint.friction;
    auto const at = StickSlipStiffness::apex(0.0, 0.0, f);
    double const slope = f.static_coefficient * f.rise;  // μ'(0)
    EXPECT_EQ(at.push_x, 0);
    EXPECT_EQ(at.push_z, 0);
    EXPECT_NEAR(at.xx, slope, 1e-12 * slope);
    EXPECT_NEAR(at.zz, slope, 1e-12 * slope);
    EXPECT_EQ(at.xz, 0);
}

/// The largest jump of a face's forces where a plane of apices meets it or leaves it: all four, and one end beside another that is deep.
template <class Law, class Damping> double largest_jump(SliderParameters<double> const& p) {
    auto const at = [&](Values const& depth, double rate) {
        return values(Law::template forces<Damping>(motion(depth, {rate, rate, rate, rate}), y_face(p), p.joint.contact).normal);
    };
    constexpr double little = 1e-16, deep = 1e-7;
    double largest = 0;
    for (double const rate : {-0.1, 0.1}) {
        for (Values const& from : {Values{0, 0, 0, 0}, Values{0, 0, deep, deep}, Values{0, deep, deep, 0}, Values{0, deep, 2 * deep, deep}}) {
            auto const change = [&](double by) {
                Values depth = from;
                for (double& d : depth) d += d == 0 ? by : 0;
                return at(depth, rate);
            };
            Values const outside = change(-little), inside = change(little);
            for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::abs(inside[i] - outside[i]));
        }
    }
    return largest;
}

TEST(Laws, ThatAreContinuousHaveNoJumpsWhereApicesMeetOrLeave) {
    auto const p = parameters();
    auto const expect = [&]<class Law>(Law) {
        double jump = largest_jump<Law, PointDamping>(p);
        if constexpr (Law::info.has(Damping::rate)) jump = std::max(jump, largest_jump<Law, RateDamping>(p));
        // Of forces of some hundred newtons, where 1e-16 m are 1e-6 N and more.
        EXPECT_EQ(jump < 1e-3, Law::info.continuous) << Law::info.name << ": " << jump;
    };
#define SLIDEWAY_EXPECT_CONTINUOUS(name, Type) expect(Type{});
    SLIDEWAY_LAWS(SLIDEWAY_EXPECT_CONTINUOUS)
#undef SLIDEWAY_EXPECT_CONTINUOUS
}

}  // namespace
}  // namespace slideway::face_stiffness_test
