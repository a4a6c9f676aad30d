#include "host/statistics/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/QR>
#include "host/base/numbers.hpp"
#include "host/sampling/distribution.hpp"

namespace slideway {
namespace {

struct Scaling {
    double mean, spread;  // √Σ(x - mean)²
};

Scaling scaling_of(std::span<double const> values) {
    double sum = 0, squares = 0, residual = 0;
    for (double const x : values) sum += x;
    auto const n = static_cast<double>(values.size());
    double const mean = sum / n;
    for (double const x : values) {
        residual += x - mean;
        squares += (x - mean) * (x - mean);
    }
    // The mean's rounding: a constant leaves a residual of many units in the last place, but no spread about it.
    return {mean + residual / n, std::sqrt(std::max(0.0, squares - residual * residual / n))};
}

bool is_constant(std::span<double const> values) {
    return std::all_of(values.begin(), values.end(), [&](double x) { return x == values.front(); });
}

}  // namespace

std::vector<double> midranks(std::span<double const> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
        for (std::size_t i = first; i < last; ++i) ranks[order[i]] = 0.5 * static_cast<double>(first + 1 + last);
        first = last;
    }
    return ranks;
}

double product_moment(std::span<double const> x, std::span<double const> y) {
    if (x.empty() || is_constant(x) || is_constant(y)) return nan;
    Scaling const of_x = scaling_of(x), of_y = scaling_of(y);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sum += ((x[i] - of_x.mean) / of_x.spread) * ((y[i] - of_y.mean) / of_y.spread);
    }
    return std::isfinite(sum) ? std::clamp(sum, -1.0, 1.0) : nan;
}

Interval rank_correlation_interval(double r, std::size_t n, double level) {
    if (n < 4 || std::isnan(r)) return {};
    if (std::abs(r) == 1) return {r, r};
    double const z = standard_normal_quantile(0.5 + 0.5 * level);
    double const half = z * std::sqrt((1 + 0.5 * r * r) / (static_cast<double>(n) - 3));
    return {std::tanh(std::atanh(r) - half), std::tanh(std::atanh(r) + half)};
}

Estimate rank_correlation(std::span<double const> x, std::span<double const> y, double level) {
    double const r = product_moment(x, y);
    return {r, rank_correlation_interval(r, x.size(), level)};
}

StandardisedRegression standardised_regression(std::span<std::vector<double> const> inputs,
                                               std::span<double const> output) {
    std::size_t const d = inputs.size(), n = output.size();
    StandardisedRegression result{std::vector<double>(d, nan), nan};
    if (d == 0 || n <= d || is_constant(output)) return result;
    Scaling const of_output = scaling_of(output);
    if (!std::isfinite(of_output.spread)) return result;
    std::vector<Scaling> of_inputs;
    for (std::vector<double> const& input : inputs) {
        Scaling scaling = scaling_of(input);
        if (is_constant(input)) scaling.spread = std::numeric_limits<double>::infinity();  // its column is 0
        of_inputs.push_back(scaling);
    }

    // [X y] = Q R: the triangle of all rows is that of the triangle so far above the next block.
    constexpr std::size_t block_rows = 4096;
    auto const width = static_cast<Eigen::Index>(d + 1);
    Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(width, width);
    for (std::size_t first = 0; first < n; first += block_rows) {
        std::size_t const rows = std::min(block_rows, n - first);
        Eigen::MatrixXd stacked(width + static_cast<Eigen::Index>(rows), width);
        stacked.topRows(width) = triangle;
        for (std::size_t i = 0; i < rows; ++i) {
            Eigen::Index const row = width + static_cast<Eigen::Index>(i);
            for (std::size_t j = 0; j < d; ++j) {
                stacked(row, static_cast<Eigen::Index>(j)) =
                    (inputs[j][first + i] - of_inputs[j].mean) / of_inputs[j].spread;
            }
            stacked(row, width - 1) = (output[first + i] - of_output.mean) / of_output.spread;
        }
        Eigen::HouseholderQR<Eigen::MatrixXd> const decomposition(stacked);
        triangle = decomposition.matrixQR().topRows(width).triangularView<Eigen::Upper>();
    }
    Eigen::Index const inputs_width = width - 1;
    Eigen::MatrixXd const x = triangle.topLeftCorner(inputs_width, inputs_width);
    Eigen::VectorXd const y = triangle.topRightCorner(inputs_width, 1);
    Eigen::VectorXd const coefficients = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(x).solve(y);
    double const unexplained = (y - x * coefficients).squaredNorm() + std::pow(triangle(width - 1, width - 1), 2);
    // Through as many points as it has coefficients and a constant, a plane goes exactly, whatever they are.
    if (!coefficients.allFinite() || n <= d + 1) return result;
    for (std::size_t j = 0; j < d; ++j) result.coefficients[j] = coefficients(static_cast<Eigen::Index>(j));
    // The columns have length one each, so the total is 1 but for rounding.
    result.r_squared = std::max(0.0, 1 - unexplained);
    return result;
}

}  // namespace slideway
