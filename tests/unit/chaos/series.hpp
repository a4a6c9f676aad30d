// Series whose statistics are known.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace slideway::testing {

/// x of the Lorenz equations (10, 28, 8/3) after a transient of 50, by RK4 with steps of at most 0.002.
/// Largest Lyapunov exponent 0.9056 (Viswanath 1998; Sprott 2003).
inline std::vector<double> lorenz_series(std::size_t count, double spacing, double start = 1) {
    using State = std::array<double, 3>;
    auto const rate = [](State const& u) {
        return State{10 * (u[1] - u[0]), u[0] * (28 - u[2]) - u[1], u[0] * u[1] - 8.0 / 3 * u[2]};
    };
    auto const moved = [](State const& u, State const& k, double h) {
        return State{u[0] + h * k[0], u[1] + h * k[1], u[2] + h * k[2]};
    };
    State u{start, 1, 20};
    auto const advance = [&](double time) {
        auto const steps = static_cast<int>(std::ceil(time / 0.002 - 1e-9));
        double const h = time / steps;
        for (int i = 0; i < steps; ++i) {
            State const a = rate(u), b = rate(moved(u, a, h / 2)), c = rate(moved(u, b, h / 2)),
                        d = rate(moved(u, c, h));
            for (std::size_t j = 0; j < 3; ++j) u[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
        }
    };
    advance(50);
    std::vector<double> x(count);
    for (double& value : x) {
        value = u[0];
        advance(spacing);
    }
    return x;
}

/// xₙ₊₁ = r x (1 - x) after a transient; exponent ln 2 at r = 4, period 8 at r = 3.55.
inline std::vector<double> logistic_series(std::size_t count, double r, double x = 0.1) {
    for (int i = 0; i < 2000; ++i) x = r * x * (1 - x);
    std::vector<double> out(count);
    for (double& value : out) value = x = r * x * (1 - x);
    return out;
}

/// x of Hénon's map (1.4, 0.3); exponent 0.419 (Wolf et al. 1985: 0.603 bits = 0.418).
inline std::vector<double> henon_series(std::size_t count) {
    double x = 0.1, y = 0;
    std::vector<double> out;
    for (std::size_t i = 0; i < count + 100; ++i) {
        double const next = 1 - 1.4 * x * x + y;
        y = 0.3 * x;
        x = next;
        if (i >= 100) out.push_back(x);
    }
    return out;
}

inline std::vector<double> sine_series(std::size_t count, double period, double amplitude = 1) {
    std::vector<double> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = amplitude * std::sin(2 * std::numbers::pi * static_cast<double>(i) / period);
    }
    return out;
}

/// A tone whose frequency drifts: phase ωt + drift t²/2.  What starts alike at different times parts like t.
inline std::vector<double> drifting_series(std::size_t count, double frequency, double drift) {
    std::vector<double> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        auto const t = static_cast<double>(i);
        out[i] = std::cos((frequency + drift * t / 2) * t);
    }
    return out;
}

inline std::vector<double> sum(std::vector<double> a, std::vector<double> const& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
}

/// Independent numbers, uniform in [-½, ½).
inline std::vector<double> white_series(std::size_t count, std::uint64_t seed = 1) {
    std::vector<double> out(count);
    for (double& value : out) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        value = static_cast<double>(seed >> 11) * 0x1p-53 - 0.5;
    }
    return out;
}

}  // namespace slideway::testing
