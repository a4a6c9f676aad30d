#include "host/statistics/sobol_indices.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/normal.hpp>

#include "host/base/numbers.hpp"
#include "host/sampling/random.hpp"
#include "host/statistics/exact_sum.hpp"

namespace slideway {
namespace {

constexpr std::size_t most_groups = std::size_t{1} << 16;

/// Sums over rows from which all estimates follow: rows, a + b, a² + b², and for each input b (ab - a), ab - a, (ab -
/// a)².
struct Sums {
    static constexpr std::size_t common = 3, per_input = 3;
    static std::size_t size(std::size_t inputs) { return common + per_input * inputs; }
};

void add_row(std::span<double const> row, double mean, std::span<double> sums) {
    double const a = row[0] - mean, b = row[1] - mean;
    sums[0] += 1;
    sums[1] += a + b;
    sums[2] += a * a + b * b;
    for (std::size_t i = 0; i + 2 < row.size(); ++i) {
        double const change = row[i + 2] - row[0];
        double* const of_input = sums.data() + Sums::common + Sums::per_input * i;
        of_input[0] += b * change;
        of_input[1] += change;
        of_input[2] += change * change;
    }
}

/// first [d], total [d], sum of first, variance.
void estimate(std::span<double const> sums, std::span<double> out) {
    std::size_t const inputs = (sums.size() - Sums::common) / Sums::per_input;
    double const n = sums[0], mean = sums[1] / (2 * n);
    double const spread = sums[2] / (2 * n) - mean * mean;
    double const variance = spread > 0 && std::isfinite(spread) ? spread : nan;
    out[2 * inputs] = 0;
    for (std::size_t i = 0; i < inputs; ++i) {
        double const* const of_input = sums.data() + Sums::common + Sums::per_input * i;
        out[i] = (of_input[0] - mean * of_input[1]) / (n * variance);
        out[inputs + i] = of_input[2] / (2 * n * variance);
        for (double* const index : {&out[i], &out[inputs + i]}) *index = std::isfinite(*index) ? *index : nan;
        out[2 * inputs] += out[i];
    }
    out[2 * inputs + 1] = spread;
}

/// Rows without NaN, and their mean over A and B.
struct UsableRows {
    std::vector<std::size_t> rows;
    double mean = 0;
};

UsableRows usable_rows(RadialValues const& design) {
    UsableRows usable;
    std::size_t const width = design.inputs + 2;
    ExactSum sum;
    for (std::size_t r = 0; r < design.rows(); ++r) {
        auto const row = design.values.subspan(r * width, width);
        if (std::any_of(row.begin(), row.end(), [](double x) { return std::isnan(x); })) continue;
        usable.rows.push_back(r);
        sum.add(row[0]);
        sum.add(row[1]);
    }
    if (!usable.rows.empty()) usable.mean = sum.value() / (2 * static_cast<double>(usable.rows.size()));
    return usable;
}

/// Sums of each group of rows: [groups][size].
std::vector<double> group_sums(RadialValues const& design, UsableRows const& usable) {
    std::size_t const n = usable.rows.size(), groups = std::min(n, most_groups), size = Sums::size(design.inputs);
    std::size_t const width = design.inputs + 2;
    std::vector<double> sums(groups * size, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t const group = i * groups / n;
        add_row(design.values.subspan(usable.rows[i] * width, width), usable.mean,
                std::span(sums).subspan(group * size, size));
    }
    return sums;
}

/// Sums of one bootstrap replicate.
void resample(std::span<double const> groups, std::size_t size, std::uint64_t seed, std::uint64_t replicate,
              std::span<double> sums) {
    std::size_t const count = groups.size() / size;
    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::size_t drawn = 0; drawn < count; drawn += 4) {
        auto const words = philox({drawn / 4, replicate, 0, 0}, {seed, name_hash("sobol_indices.bootstrap")});
        for (std::size_t w = 0; w < std::min<std::size_t>(4, count - drawn); ++w) {
            // count <= 2^16, so the product of it and 32 bits fits, and no group is favoured by more than 2^-16.
            auto const group = static_cast<std::size_t>(((words[w] >> 32) * count) >> 32);
            double const* const from = groups.data() + group * size;
            for (std::size_t k = 0; k < size; ++k) sums[k] += from[k];
        }
    }
}

/// Tail of the percentiles: Student's, and wider by the shrinkage of a bootstrap's variance.
double tail_of(std::size_t rows, double level) {
    auto const n = static_cast<double>(rows);
    double const reach = student_quantile(rows, level) * std::sqrt(n / (n - 1));
    return boost::math::cdf(boost::math::normal(), -reach);
}

Interval percentile_interval(std::vector<double> replicates, double tail) {
    std::erase_if(replicates, [](double x) { return std::isnan(x); });  // all rows drawn were alike
    std::sort(replicates.begin(), replicates.end());
    if (replicates.size() < 2) return {};
    // Of B replicates the k-th is the k/(B+1) quantile: a new one falls below it that often.
    auto const count = static_cast<double>(replicates.size());
    double const p = std::clamp((tail * (count + 1) - 1) / (count - 1), 0.0, 0.5);
    return {quantile(replicates, p), quantile(replicates, 1 - p)};
}

}  // namespace

SobolIndices sobol_indices(RadialValues const& design, BootstrapSettings const& bootstrap) {
    std::size_t const d = design.inputs, estimates = 2 * d + 2, size = Sums::size(d);
    UsableRows const usable = usable_rows(design);
    SobolIndices result;
    result.rows = usable.rows.size();
    result.missing = design.rows() - result.rows;
    result.variance = nan;
    result.first.assign(d, {nan, {}});
    result.total.assign(d, {nan, {}});
    result.first_sum = {nan, {}};
    if (result.rows == 0) return result;

    std::vector<double> const groups = group_sums(design, usable);
    std::vector<double> sums(size, 0.0), values(estimates);
    for (std::size_t i = 0; i < groups.size(); ++i) sums[i % size] += groups[i];
    estimate(sums, values);
    for (std::size_t i = 0; i < d; ++i) {
        result.first[i].value = values[i];
        result.total[i].value = values[d + i];
    }
    result.first_sum.value = values[2 * d];
    result.variance = values[2 * d + 1];
    if (result.rows < 2 || std::isnan(values[2 * d])) return result;

    std::size_t const replicates = bootstrap.replicates;
    std::vector<double> drawn(replicates * estimates);
#pragma omp parallel for schedule(static) num_threads(bootstrap.threads)
    for (std::size_t b = 0; b < replicates; ++b) {
        std::vector<double> replicate(size);
        resample(groups, size, bootstrap.seed, b, replicate);
        estimate(replicate, std::span(drawn).subspan(b * estimates, estimates));
    }
    double const tail = tail_of(result.rows, bootstrap.level);
    auto const interval_of = [&](std::size_t k) {
        std::vector<double> column(replicates);
        for (std::size_t b = 0; b < replicates; ++b) column[b] = drawn[b * estimates + k];
        return percentile_interval(std::move(column), tail);
    };
    for (std::size_t i = 0; i < d; ++i) {
        result.first[i].interval = interval_of(i);
        result.total[i].interval = interval_of(d + i);
    }
    result.first_sum.interval = interval_of(2 * d);
    return result;
}

}  // namespace slideway
