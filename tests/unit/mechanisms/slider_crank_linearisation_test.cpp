// The linear systems of an implicit step: eliminated to five equations, against all ten.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "tests/oracle/linear_solve.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/compiled_laws.hpp"
#include "tests/support/load_table.hpp"

namespace slideway::slider_crank_linearisation_test {
namespace {

constexpr Parts parts{Law::conservative, Damping::rate, true, true};
using Linearisation = SliderLinearisation<double>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Matrix10 = Eigen::Matrix<double, 10, 10>;
using Vector10 = Eigen::Matrix<double, 10, 1>;

// Where y z φ ϑ ψ and vy vz ωx ωy ωz lie in the state.
constexpr int position_at[5] = {0, 1, 4, 5, 6}, velocity_at[5] = {2, 3, 7, 8, 9};

Linearisation linearised(double t, double const* state, SliderParameters<double> const& p, Parts const& of) {
    ContactMemory<double> memory;
    start_memory(memory);
    Linearisation at;
    SliderCrank::linearise(t, state, p, memory, testing::conditions_of<double>(of), at);
    return at;
}
Linearisation linearised(oracle::Case const& c, Parts const& of = parts) {
    return linearised(c.t, c.state.data(), SliderCrank::parameters(c.inputs), of);
}

template <class Matrix> Matrix inverse(Matrix const& m) {
    return oracle::solution(m.template cast<long double>(), Matrix::Identity().template cast<long double>())
        .template cast<double>();
}

Matrix5 matrix(double const (&m)[5][5]) { return Eigen::Map<Eigen::Matrix<double, 5, 5, Eigen::RowMajor> const>(m[0]); }

Matrix5 mass_of(Linearisation const& at) {
    Matrix5 m = Matrix5::Zero();
    m(0, 0) = at.mass_y, m(1, 1) = at.mass_z, m(0, 1) = m(1, 0) = at.mass_yz;
    m(2, 2) = at.inertia.x, m(3, 3) = at.inertia.y, m(4, 4) = at.inertia.z;
    return m;
}

/// A of model.md's state, from the three rates of the angles along their axes.
Matrix10 jacobian(oracle::Case const& c, Linearisation const& at) {
    double const roll = c.state[4], yaw = c.state[5];
    // ω = e_x φ' + Rxᵀ e_y ϑ' + Rxᵀ Ryᵀ e_z ψ'
    Eigen::Matrix3d const rx = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()).toRotationMatrix();
    Eigen::Matrix3d const ry = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()).toRotationMatrix();
    Matrix5 inverse_g = Matrix5::Identity();
    inverse_g.block<3, 1>(2, 2) = Eigen::Vector3d::UnitX();
    inverse_g.block<3, 1>(2, 3) = rx.transpose() * Eigen::Vector3d::UnitY();
    inverse_g.block<3, 1>(2, 4) = rx.transpose() * ry.transpose() * Eigen::Vector3d::UnitZ();
    Matrix5 const inverse_mass = inverse(mass_of(at));
    Matrix5 const g = inverse(inverse_g);
    Matrix5 const by_q = inverse_mass * matrix(at.joint.by_place) * inverse_g;
    Matrix5 const by_v = inverse_mass * matrix(at.joint.by_rate);
    Matrix10 a = Matrix10::Zero();
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 5; ++j) {
            a(position_at[i], velocity_at[j]) = g(i, j);
            a(velocity_at[i], position_at[j]) = by_q(i, j);
            a(velocity_at[i], velocity_at[j]) = by_v(i, j);
        }
    }
    return a;
}

/// Sizes of a state in the joint's clearance and of its rates.
constexpr double size[10] = {1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 0.1, 0.1, 0.1};

Vector10 random_state(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    Vector10 r;
    for (int i = 0; i < 10; ++i) r(i) = size[i] * unit(random);
    return r;
}

TEST(SliderLinearisation, SolvesTheTenEquations) {
    std::mt19937_64 random(5);
    using Wide = Eigen::Matrix<long double, 10, 10>;
    int compared = 0;
    for (auto const& c : oracle::make_cases(31, 400)) {
        auto at = linearised(c);
        if (std::isnan(at.rate_squared())) continue;
        auto const a = jacobian(c, at);
        for (double const hg : {1e-7, 1e-5, 1e-3}) {
            auto const r = random_state(random);
            at.factor(hg);
            Vector10 u;
            at.solve(r.data(), u.data());
            Vector10 const want =
                oracle::solution(Wide::Identity() - hg * a.cast<long double>(), r.cast<long double>()).cast<double>();
            double largest = 1;
            for (int i = 0; i < 10; ++i) largest = std::max(largest, std::abs(want(i)) / size[i]);
            for (int i = 0; i < 10; ++i) {
                EXPECT_LE(std::abs(u(i) - want(i)) / size[i], 1e-9 * largest) << "component " << i << ", hγ " << hg;
            }
            EXPECT_LE(at.residual(r.data(), u.data()), 1e-13);
            ++compared;
        }
        if (HasFailure()) break;
    }
    EXPECT_GT(compared, 1000);
}

TEST(SliderLinearisation, SolvesInPlace) {
    std::mt19937_64 random(6);
    auto at = linearised(oracle::make_cases(31, 1)[0]);
    at.factor(1e-4);
    Vector10 r = random_state(random), u;
    at.solve(r.data(), u.data());
    at.solve(r.data(), r.data());
    EXPECT_EQ(r, u);
}

TEST(SliderLinearisation, ResidualTellsAWrongAnswer) {
    std::mt19937_64 random(7);
    for (auto const& c : oracle::make_cases(32, 50)) {
        auto at = linearised(c);
        if (std::isnan(at.rate_squared())) continue;
        at.factor(1e-4);
        auto const r = random_state(random);
        Vector10 u;
        at.solve(r.data(), u.data());
        for (int const i : velocity_at) {
            Vector10 wrong = u;
            wrong(i) *= 2;
            EXPECT_GT(at.residual(r.data(), wrong.data()), 1e-5);
            wrong(i) = std::numeric_limits<double>::quiet_NaN();
            EXPECT_TRUE(std::isnan(at.residual(r.data(), wrong.data())));
        }
    }
}

TEST(SliderLinearisation, RateSquaredIsTheSumOfTheSquaredFrequenciesAndTheSquaredDecay) {
    // Without friction −K is symmetric; where no term of the trace is negative it is the sum of the eigenvalues.
    Parts const smooth{Law::conservative, Damping::point, false, true};
    int compared = 0;
    for (auto const& c : oracle::make_cases(33, 800)) {
        auto const at = linearised(c, smooth);
        if (std::isnan(at.rate_squared()) || at.touching == 0) continue;
        Matrix5 const k = -matrix(at.joint.by_place);
        EXPECT_LE((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-9 * k.cwiseAbs().maxCoeff());
        auto const squares = (inverse(mass_of(at)) * k).eval();
        if ((squares.diagonal().array() < 0).any()) continue;
        double const sum = squares.trace();  // of the eigenvalues, the frequencies of k x = ω² M x
        auto const decay_rates = (inverse(mass_of(at)) * -matrix(at.joint.by_rate)).eval();
        double const decay = decay_rates.diagonal().cwiseMax(0).sum();
        EXPECT_NEAR(at.rate_squared(), sum + decay * decay, 1e-9 * (sum + decay * decay));
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST(SliderLinearisation, HasTheDampingOfAFilmToTheLastDigits) {
    // The film's forces are linear in ν where it does not break: what they add to M ν', by differences.
    Load film;
    film.kind = LoadKind::film;
    Parts filled = parts, dry = parts;
    filled.loads = {&film, 1};
    int compared = 0;
    for (auto c : oracle::make_cases(35, 200)) {
        int next = 0;
        film.viscosity = testing::put_load_number(c.inputs, next, 0.1), film.least_gap = testing::put_load_number(c.inputs, next, 0.3 * c.inputs.clearance_y);
        film.cavitation_pressure = testing::put_load_number(c.inputs, next, 1e30);
        auto const p = SliderCrank::parameters(c.inputs);
        auto const with = linearised(c, filled), without = linearised(c, dry);
        if (std::isnan(with.rate_squared())) continue;
        EXPECT_EQ(with.touching, without.touching + 1);
        ContactMemory<double> memory;
        start_memory(memory);
        auto const rates = [&](oracle::State const& state, Parts const& of) {
            Vector10 d;
            SliderCrank::derivative<false>(c.t, state.data(), p, memory, testing::conditions_of<double>(of), d.data(), static_cast<SliderReport<double>*>(nullptr));
            return d;
        };
        Matrix5 by_rate;
        for (int j = 0; j < 5; ++j) {
            auto const at = static_cast<std::size_t>(velocity_at[j]);
            oracle::State more = c.state, less = c.state;
            more[at] += size[at], less[at] -= size[at];
            Vector10 const change = (rates(more, filled) - rates(more, dry)) - (rates(less, filled) - rates(less, dry));
            for (int i = 0; i < 5; ++i) by_rate(i, j) = change(velocity_at[i]) / (2 * size[at]);
        }
        Matrix5 const want = mass_of(with) * by_rate, got = matrix(with.joint.by_rate) - matrix(without.joint.by_rate);
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) EXPECT_NEAR(got(i, j), want(i, j), 1e-6 * std::sqrt(got(i, i) * got(j, j))) << i << " " << j;
        }
        if (HasFailure()) break;
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST(SliderLinearisation, HasTheStiffnessOfAFilmThatIsSqueezed) {
    // Level, at the dead centre of a crank at rest, the film below pushes by c v/h³ and the one above is broken: 3 c v/h⁴.
    Inputs in = oracle::completed({});
    in.crank_speed = 0;
    int next = 0;
    Load film;
    film.kind = LoadKind::film;
    film.viscosity = testing::put_load_number(in, next, 0.1), film.least_gap = testing::put_load_number(in, next, 4e-5);
    Parts of{Law::conservative, Damping::point, false, false};
    of.loads = {&film, 1};
    double const squeeze = 0.1 * std::pow(in.way_depth, 3) * (in.slider_length - 0.63 * in.way_depth);
    for (double const y : {-7e-5, -5e-5, 0.0, 3e-5, 8e-5}) {
        for (double const speed : {0.01, -0.01}) {
            double state[10] = {};
            state[0] = y, state[2] = speed;
            auto const at = linearised(0, state, SliderCrank::parameters(in), of);
            double const gap = in.clearance_y + (speed < 0 ? y : -y), want = gap < 4e-5 ? 0 : 3 * squeeze * 0.01 / std::pow(gap, 4);
            EXPECT_NEAR(-at.joint.by_place[0][0], want, 1e-6 * want) << y << " " << speed;
            EXPECT_EQ(at.joint.by_place[1][1], 0) << "the sides are not squeezed";
        }
    }
}

TEST(SliderLinearisation, CountsTheTouchingPairs) {
    for (auto const& c : oracle::make_cases(34, 200)) {
        auto const depths = oracle::penetrations(c.inputs, c.parts, c.t, c.state);
        if (!c.parts.misaligned_way || std::isnan(depths[0])) continue;
        EXPECT_EQ(linearised(c).touching, std::count_if(depths.begin(), depths.end(), [](double d) { return d > 0; }));
    }
}

TEST(SliderLinearisation, IsNothingInFreeFlightAndNanOutOfReach) {
    auto const p = SliderCrank::parameters(oracle::completed({}));
    double state[10] = {};
    auto at = linearised(0.0, state, p, parts);
    EXPECT_EQ(at.touching, 0);
    EXPECT_EQ(at.rate_squared(), 0);
    EXPECT_EQ(matrix(at.joint.by_place), Matrix5::Zero());
    EXPECT_EQ(matrix(at.joint.by_rate), Matrix5::Zero());
    state[0] = 1;
    at = linearised(0.0, state, p, parts);
    EXPECT_TRUE(std::isnan(at.rate_squared()));
}

}  // namespace
}  // namespace slideway::slider_crank_linearisation_test
