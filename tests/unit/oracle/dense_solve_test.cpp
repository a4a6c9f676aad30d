#include "kernels/math/dense_solve.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "tests/oracle/linear_solve.hpp"

namespace slideway::dense_solve_test {
namespace {

template <int n> using Matrix = Eigen::Matrix<double, n, n>;
template <int n> using Vector = Eigen::Matrix<double, n, 1>;

template <int n> Vector<n> solved(Matrix<n> const& m, Vector<n> const& b) {
    double rows[n][n];
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) rows[i][j] = m(i, j);
    }
    LuFactors<n, double> lu;
    lu.factor(rows);
    Vector<n> x = b;
    lu.solve(x.data());
    return x;
}

/// Row by row |m x − b| against |m||x| + |b|.
template <int n> double backward_error(Matrix<n> const& m, Vector<n> const& x, Vector<n> const& b) {
    Eigen::Matrix<long double, n, 1> const rest =
        m.template cast<long double>() * x.template cast<long double>() - b.template cast<long double>();
    Vector<n> const scale = m.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs();
    return (rest.template cast<double>().cwiseAbs().array() / scale.array()).maxCoeff();
}

template <int n> void expect_eigens_answer(std::mt19937_64& random) {
    Matrix<n> m;
    Vector<n> b;
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < n; ++i) {
        b(i) = unit(random);
        for (int j = 0; j < n; ++j) m(i, j) = unit(random) + (i == j ? n : 0);
    }
    Vector<n> const want = oracle::solution(m.template cast<long double>(), b.template cast<long double>()).template cast<double>();
    Vector<n> const got = solved<n>(m, b);
    EXPECT_LE((want - got).norm(), 1e-14 * want.norm());
}

TEST(LuFactors, GiveEigensAnswerForDominantMatrices) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 200; ++i) {
        expect_eigens_answer<1>(random);
        expect_eigens_answer<2>(random);
        expect_eigens_answer<5>(random);
    }
}

// M + (hγ)² K as an implicit step makes it: masses of 0.2 kg and 2e-5 kg m², a few contacts of up to 1e10 N/m on 2 cm arms, and
// friction that makes K unsymmetric.
TEST(LuFactors, AreBackwardStableForStiffSteps) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        Matrix<5> m = Matrix<5>::Zero();
        for (int j = 0; j < 5; ++j) m(j, j) = j < 2 ? 0.2 : 2e-5 * (1.5 + unit(random));
        for (int contact = 0; contact < 1 + i % 6; ++contact) {
            Vector<5> g, left;
            for (int j = 0; j < 5; ++j) {
                g(j) = unit(random) * (j < 2 ? 1 : 0.02);
                left(j) = g(j) + 0.1 * unit(random) * (j < 2 ? 1 : 0.02);
            }
            m += std::pow(10.0, 5 * unit(random) + 1) * left * g.transpose();
        }
        Vector<5> b;
        for (int j = 0; j < 5; ++j) b(j) = unit(random) * (j < 2 ? 1e-3 : 1e-6);
        EXPECT_LE(backward_error<5>(m, solved<5>(m, b), b), 1e-10) << m;
    }
}

TEST(LuFactors, LeaveNoFiniteAnswerForAVanishingPivot) {
    Matrix<2> m;
    m << 0, 1, 1, 0;
    auto const x = solved<2>(m, Vector<2>(1, 2));
    EXPECT_FALSE(std::isfinite(x(0)) && std::isfinite(x(1)));
}

}  // namespace
}  // namespace slideway::dense_solve_test
