#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Coefficients of the W-method of order 3(2) with four stages, stiffly accurate and L-stable, whose order holds for any matrix A in
/// place of the Jacobian: (I − hγA) k_i = f(y + h Σ α_ij k_j) + hA Σ_{j<i} γ_ij k_j, y' = y + h Σ b_i k_i.
/// Source: Rang & Angermann, BIT Numer. Math. 45 (2005) 761–787, ROS34PW2.
///
/// In the unknowns u_i = h Σ_j γ_ij k_j no product with A is left (Hairer & Wanner, Solving Ordinary Differential Equations II (1996),
/// IV.7): (I − hγA) u_i = hγ (f(t + α_i h, y + Σ a_ij u_j) + hγ_i ∂f/∂t) + γ Σ_{j<i} c_ij u_j, y' = y + Σ m_i u_i with a = α Γ⁻¹,
/// c = diag(1/γ) − Γ⁻¹, m = b Γ⁻¹, α_i and γ_i the sums of the rows of α and Γ.
struct Ros34pw2Tableau {
    static constexpr int stages = 4;
    double gamma = 4.3586652150845900e-01;
    double alpha[4][4] = {{}, {8.7173304301691801e-01}, {8.4457060015369423e-01, -1.1299064236484185e-01}, {0, 0, 1}};
    double gammas[4][4] = {
        {4.3586652150845900e-01},
        {-8.7173304301691801e-01, 4.3586652150845900e-01},
        {-9.0338057013044082e-01, 5.4180672388095326e-02, 4.3586652150845900e-01},
        {2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01, 4.3586652150845900e-01}};
    double b[4] = {2.4212380706095346e-01, -1.2232505839045147e+00, 1.5452602553351020e+00, 4.3586652150845900e-01};
    double b_second[4] = {3.7810903145819369e-01, -9.6042292212423178e-02, 5.0000000000000000e-01,
                          2.1793326075422950e-01};
    // What follows from them.
    double a[4][4] = {}, c[4][4] = {}, m[4] = {}, error[4] = {}, node[4] = {}, drift[4] = {}, e[4] = {};

    constexpr Ros34pw2Tableau() {
        double inverse[4][4] = {};  // Γ⁻¹
        for (int i = 0; i < 4; ++i) {
            inverse[i][i] = 1 / gammas[i][i];
            for (int j = 0; j < i; ++j) {
                double sum = 0;
                for (int k = j; k < i; ++k) sum += gammas[i][k] * inverse[k][j];
                inverse[i][j] = -sum / gammas[i][i];
            }
        }
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                for (int k = 0; k < 4; ++k) a[i][j] += alpha[i][k] * inverse[k][j];
                m[i] += b[j] * inverse[j][i];
                error[i] += (b[j] - b_second[j]) * inverse[j][i];
                node[i] += alpha[i][j];
                drift[i] += gammas[i][j];
                c[i][j] = -inverse[i][j];
            }
            c[i][i] = 0;
            e[i] = b[i] - b_second[i];
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
