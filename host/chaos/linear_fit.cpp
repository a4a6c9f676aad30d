#include "host/chaos/linear_fit.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/numbers.hpp"

namespace slideway {
namespace {

struct Moments {
    double mean_x = 0, mean_y = 0;
    double xx = 0, xy = 0, yy = 0;  // about the means
};

/// Two passes: sums of squares about zero would cancel.
Moments moments(std::span<double const> x, std::span<double const> y) {
    Moments m;
    auto const n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        m.mean_x += x[i] / n;
        m.mean_y += y[i] / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        double const dx = x[i] - m.mean_x, dy = y[i] - m.mean_y;
        m.xx += dx * dx;
        m.xy += dx * dy;
        m.yy += dy * dy;
    }
    return m;
}

}  // namespace

LinearFit fit_line(std::span<double const> x, std::span<double const> y) {
    LinearFit fit{nan, nan, nan, nan, x.size()};
    if (x.size() != y.size() || x.size() < 2) return fit;
    Moments const m = moments(x, y);
    if (!(m.xx > 0) || !std::isfinite(m.xx + m.yy)) return fit;
    fit.slope = m.xy / m.xx;
    fit.intercept = m.mean_y - fit.slope * m.mean_x;
    double residual = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        double const r = (y[i] - m.mean_y) - fit.slope * (x[i] - m.mean_x);
        residual += r * r;
    }
    if (x.size() > 2) fit.slope_error = std::sqrt(residual / (static_cast<double>(x.size() - 2) * m.xx));
    if (m.yy > 0) fit.r_squared = std::clamp(1 - residual / m.yy, 0.0, 1.0);
    return fit;
}

}  // namespace slideway
