// The coefficients of the W-method against the theory: order conditions, stability, and the two forms of its stages.
#include "kernels/steppers/ros34pw2.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <string>

#include "tests/oracle/linear_solve.hpp"

namespace slideway::ros34pw2_test {
namespace {

using Matrix = Eigen::Matrix4d;
using Vector = Eigen::Vector4d;

Matrix matrix(double const (&m)[4][4]) { return Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor> const>(m[0]); }
Vector vector(double const (&v)[4]) { return Eigen::Map<Vector const>(v); }

template <int n>
Eigen::Matrix<double, n, 1> solution(Eigen::Matrix<double, n, n> const& m, Eigen::Matrix<double, n, 1> const& right) {
    return oracle::solution(m.template cast<long double>(), right.template cast<long double>()).template cast<double>();
}

constexpr Ros34pw2Tableau w{};
Matrix const alpha = matrix(w.alpha), gamma = matrix(w.gammas);
Vector const b = vector(w.b), b_second = vector(w.b_second), one = Vector::Ones();

/// Conditions of order 3 for any matrix in place of the Jacobian (Hairer & Wanner, Solving ODEs II (1996), IV.7): every chain in
/// which Γ takes the place of α vanishes.
TEST(Ros34pw2, SatisfiesTheOrderConditionsOfAWMethod) {
    Vector const a = alpha * one, g = gamma * one;
    EXPECT_NEAR(b.sum(), 1, 1e-14);
    EXPECT_NEAR(b.dot(a), 1.0 / 2, 1e-14);
    EXPECT_NEAR(b.dot(g), 0, 1e-14);
    EXPECT_NEAR(b.dot(a.cwiseAbs2()), 1.0 / 3, 1e-14);
    EXPECT_NEAR(b.dot(alpha * a), 1.0 / 6, 1e-14);
    EXPECT_NEAR(b.dot(alpha * g), 0, 1e-14);
    EXPECT_NEAR(b.dot(gamma * a), 0, 1e-14);
    EXPECT_NEAR(b.dot(gamma * g), 0, 1e-14);
}

TEST(Ros34pw2, HasACompanionOfOrderTwo) {
    EXPECT_NEAR(b_second.sum(), 1, 1e-14);
    EXPECT_NEAR(b_second.dot(alpha * one), 1.0 / 2, 1e-14);
    EXPECT_NEAR(b_second.dot(gamma * one), 0, 1e-14);
    // And of no more, else there would be no estimate.
    EXPECT_GT(std::abs(b_second.dot((alpha * one).cwiseAbs2()) - 1.0 / 3), 0.01);
}

TEST(Ros34pw2, IsStifflyAccurate) {
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(w.b[j], w.alpha[3][j] + w.gammas[3][j], 1e-15);
    EXPECT_NEAR((alpha * one)(3), 1, 1e-15) << "the last stage is at the end of the step";
    for (int i = 0; i < 4; ++i) EXPECT_EQ(w.gammas[i][i], w.gamma) << "one matrix for all stages";
}

/// R(z) = 1 + z bᵀ (I − z (α + Γ))⁻¹ 1; real and imaginary parts as eight real equations.
std::complex<double> stability(std::complex<double> z) {
    Matrix const stages = alpha + gamma;
    Eigen::Matrix<double, 8, 8> m;
    m.topLeftCorner<4, 4>() = m.bottomRightCorner<4, 4>() = Matrix::Identity() - z.real() * stages;
    m.topRightCorner<4, 4>() = z.imag() * stages;
    m.bottomLeftCorner<4, 4>() = -z.imag() * stages;
    Eigen::Matrix<double, 8, 1> right;
    right << one, Vector::Zero();
    auto const x = solution(m, right);
    return 1.0 + z * std::complex<double>(b.dot(x.head<4>()), b.dot(x.tail<4>()));
}

TEST(Ros34pw2, IsStableInTheLeftHalfPlaneAndForgetsWhatIsStiff) {
    for (double size = 1e-3; size < 1e8; size *= 1.3) {
        EXPECT_LE(std::abs(stability({0, size})), 1 + 1e-12) << "i " << size;
        EXPECT_LE(std::abs(stability(size * std::polar(1.0, 2.0))), 1) << size;
        EXPECT_LE(std::abs(stability(-size)), 1) << -size;
    }
    EXPECT_LT(std::abs(stability(-1e6)), 1e-5);
    EXPECT_LT(std::abs(stability({0, 1e6})), 1e-5);
    // R agrees with the exponential to order 3.
    for (double const z : {-0.1, -0.05}) EXPECT_NEAR(stability(z).real(), std::exp(z), 0.2 * z * z * z * z);
}

TEST(Ros34pw2, FormsWithAndWithoutProductsAgree) {
    // u = h Γ k: y + h Σ α k = y + Σ a u, and (I − hγA) u_i = hγ f_i + γ Σ c_ij u_j.
    Matrix const a = matrix(w.a), c = matrix(w.c);
    Vector const m = vector(w.m), error = vector(w.error);
    EXPECT_LE((a * gamma - alpha).norm(), 1e-14);
    EXPECT_LE((gamma.transpose() * m - b).norm(), 1e-14);
    EXPECT_LE((gamma.transpose() * error - (b - b_second)).norm(), 1e-14);
    // Γ⁻¹ = 1/γ − c, with nothing of c on the diagonal or above.
    EXPECT_LE(((Matrix::Identity() / w.gamma - c) * gamma - Matrix::Identity()).norm(), 1e-13);
    for (int i = 0; i < 4; ++i) {
        for (int j = i; j < 4; ++j) EXPECT_EQ(w.c[i][j], 0);
        EXPECT_NEAR(w.node[i], (alpha * one)(i), 1e-15);
        EXPECT_EQ(w.e[i], w.b[i] - w.b_second[i]);
    }
}

/// One step for y' = f(y) with any A, by the textbook's form of the stages.
template <class F> Eigen::Vector2d textbook_step(F const& f, Eigen::Matrix2d const& a, Eigen::Vector2d const& y, double h) {
    Eigen::Vector2d k[4], end = y;
    Eigen::Matrix2d const system = Eigen::Matrix2d::Identity() - h * w.gamma * a;
    for (int i = 0; i < 4; ++i) {
        Eigen::Vector2d at = y, coupling = Eigen::Vector2d::Zero();
        for (int j = 0; j < i; ++j) at += h * w.alpha[i][j] * k[j], coupling += w.gammas[i][j] * k[j];
        k[i] = solution<2>(system, f(at) + h * a * coupling);
        end += h * w.b[i] * k[i];
    }
    return end;
}

TEST(Ros34pw2, HasOrderThreeWithAnyMatrix) {
    // Two-body motion's radial cousin, x'' = −x³, from rest at 1; a reference by the same formulas at a hundredth of the step.
    auto const f = [](Eigen::Vector2d const& s) { return Eigen::Vector2d(s[1], -s[0] * s[0] * s[0]); };
    auto const run = [&](int steps, auto const& matrix_at) {
        Eigen::Vector2d y(1, 0);
        for (int i = 0; i < steps; ++i) y = textbook_step(f, matrix_at(y), y, 2.0 / steps);
        return y;
    };
    auto const exact = [](Eigen::Vector2d const& y) {
        Eigen::Matrix2d j;
        j << 0, 1, -3 * y[0] * y[0], 0;
        return j;
    };
    auto const reference = run(4000, exact);
    auto const order = [&](auto const& matrix_at) {
        return std::log2((run(40, matrix_at) - reference).norm() / (run(80, matrix_at) - reference).norm());
    };
    EXPECT_NEAR(order(exact), 3, 0.2);
    EXPECT_NEAR(order([](Eigen::Vector2d const&) { return Eigen::Matrix2d(Eigen::Matrix2d::Zero()); }), 3, 0.2);
    EXPECT_NEAR(order([&](Eigen::Vector2d const& y) { return Eigen::Matrix2d(0.6 * exact(y)); }), 3, 0.2);
    Eigen::Matrix2d wrong;
    wrong << 0.3, -1, 2, -0.7;
    EXPECT_NEAR(order([&](Eigen::Vector2d const&) { return wrong; }), 3, 0.2);
}

}  // namespace
}  // namespace slideway::ros34pw2_test
