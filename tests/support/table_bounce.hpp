// A ball that bounces periodically on a vibrating table: starts, and the exponents of their offsets in closed form.
//
// Bounce of period T = 2π/ω at phase φ, with impact speed V before and e V after it, acceleration −g + b V + a cos(ω t + φ).
// Over a flight v: e V − (g − b V) T = −V  ⇒  V = g T/(1 + e + b T);  x: e V T − (g − b V) T²/2 − (a/ω) T sin φ = 0.
// Offsets (δx, δv, δu) over a flight: Φ = [1 T bT²/2; 0 1 bT; 0 0 1].  An offset δx comes to the table δx/V later and meets the
// reset (x, v, u) → (x, −e v, −v) there: with f the acceleration at the impact, the same before and after it,
//   S = DR + (f⁺ − DR f⁻) nᵀ/(nᵀ f⁻) = [−e 0 0; −(1 + e) f/V  −e 0; −f/V  −1 0].
// Sources of S: Aizerman & Gantmakher, Q. J. Mech. Appl. Math. 11 (1958) 52–75; di Bernardo et al., Piecewise-smooth Dynamical Systems
// (2008), 2.5.  Exponents are ln|μ|/T of the eigenvalues of S Φ.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "tests/models/models.hpp"

namespace slideway::testing {

/// Of period 1 under the gravity 1.
struct Bounce {
    static constexpr double period = 1, g = 1, omega = 2 * std::numbers::pi / period;
    double e, b, speed, f;  // V, acceleration at the impact
    TableBallInputs inputs;

    /// @param acceleration f at the impact.  @param share of the period since the last impact at t = 0 and at every stop
    static Bounce with(double e, double acceleration, double b = 0, double share = 0.5) {
        double const f = acceleration, speed = g * period / (1 + e + b * period), fall = g - b * speed;
        double const sine = (e * speed - fall * period / 2) * omega;  // a sin φ
        double const cosine = f + fall;                               // a cos φ
        double const a = std::hypot(sine, cosine), t = share * period, phase = std::atan2(sine, cosine) + omega * t;
        Bounce bounce{e, b, speed, f, {}};
        auto& in = bounce.inputs;
        in.gravity = g, in.amplitude = a, in.frequency = omega, in.restitution = e, in.thrust = b, in.phase = phase;
        in.height =
            e * speed * t - fall * t * t / 2 - (a * std::cos(phase) - cosine) / (omega * omega) - t * sine / omega;
        in.speed = e * speed - fall * t + (a * std::sin(phase) - sine) / omega;
        return bounce;
    }

    /// Eigenvalues of S Φ but the one that is 0 (u has no past): of a matrix of rank two, from trace and sum of its principal minors.
    std::pair<std::complex<double>, std::complex<double>> eigenvalues() const {
        double const t = period, s21 = -(1 + e) * f / speed, s31 = -f / speed;
        double const flight[3][3] = {{1, t, b * t * t / 2}, {0, 1, b * t}, {0, 0, 1}};
        double const impact[3][3] = {{-e, 0, 0}, {s21, -e, 0}, {s31, -1, 0}};
        double m[3][3] = {};
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                for (int k = 0; k < 3; ++k) m[i][j] += impact[i][k] * flight[k][j];
            }
        }
        double const trace = m[0][0] + m[1][1] + m[2][2];
        double minors = 0;
        for (int i = 0; i < 3; ++i) {
            for (int j = i + 1; j < 3; ++j) minors += m[i][i] * m[j][j] - m[i][j] * m[j][i];
        }
        auto const root = std::sqrt(std::complex<double>(trace * trace / 4 - minors));
        return {trace / 2 + root, trace / 2 - root};
    }

    /// ln|μ|/T, descending.
    std::pair<double, double> exponents() const {
        auto const [one, other] = eigenvalues();
        double const p = std::log(std::abs(one)) / period, q = std::log(std::abs(other)) / period;
        return {std::max(p, q), std::min(p, q)};
    }

    /// The f with which a bounce without thrust has the given trace: S Φ has −2e − (1 + e) f T/V.
    static double acceleration_of(double trace, double e) { return -(trace + 2 * e) * g / ((1 + e) * (1 + e)); }
};

}  // namespace slideway::testing
