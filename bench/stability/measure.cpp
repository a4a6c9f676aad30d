#include "bench/stability/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/support/ensemble.hpp"

namespace slideway::bench {
namespace {

/// Of an adaptive method: half of what a scene allows by default.
constexpr std::uint64_t most_steps = 500'000;

double percentile(std::vector<double>& values, double share) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    auto const rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    auto const at = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

Outcome measure(Point const& point, Method method, double fixed_step) {
    testing::RunOptions options;
    options.parts = point.parts;
    options.settings.method = method;
    options.settings.rtol = options.settings.atol = point.tolerance;
    options.settings.fixed_step = fixed_step;
    options.settings.end_time = end_time;
    // A fixed step costs what it costs.
    options.settings.max_steps = method == Method::rk4 ? std::numeric_limits<std::uint64_t>::max() : most_steps;
    options.quantities = selection_of(Quantity::energy_residual) | selection_of(Quantity::friction_loss) |
                         selection_of(Quantity::damping_loss);
    auto const r = testing::run(best_isa(), options, point.members);

    Outcome outcome;
    outcome.members = static_cast<int>(point.members.size());
    std::vector<double> residuals, relatives, steps;
    for (std::size_t i = 0; i < point.members.size(); ++i) {
        auto const& record = r.records[i];
        ++outcome.ended[static_cast<std::size_t>(record.status)];
        steps.push_back(static_cast<double>(record.steps_accepted + record.steps_rejected));
        if (record.status != Status::finished && record.status != Status::unstable) continue;
        double const residual = std::abs(r.value(i, Quantity::energy_residual));
        double const burnt = r.value(i, Quantity::friction_loss) + std::abs(r.value(i, Quantity::damping_loss));
        residuals.push_back(residual);
        relatives.push_back(residual / burnt);
    }
    outcome.median_residual = percentile(residuals, 0.5);
    outcome.median_relative = percentile(relatives, 0.5);
    outcome.p95_relative = percentile(relatives, 0.95);
    outcome.median_steps = percentile(steps, 0.5);
    return outcome;
}

double largest_usable_step(Point const& point, Outcome const& reference) {
    double const limit = linear_limit(point.members);
    bool const conserving = !info(point.parts.law).switches;
    auto const usable = [&](double step) {
        auto const outcome = measure(point, Method::rk4, step);
        return outcome.all_finished() &&
               (conserving ? outcome.p95_relative <= 0.01 : outcome.median_relative <= reference.median_relative + 0.2);
    };
    // By octaves to where it changes, then by bisection in the logarithm.
    double good = limit / 4, bad = limit / 2;
    if (usable(good)) {
        for (; usable(bad); bad *= 2) {
            if (bad > 8 * limit) return bad;
            good = bad;
        }
    } else {
        do {
            bad = good;
            good /= 2;
            if (good < limit / 300) return std::numeric_limits<double>::quiet_NaN();
        } while (!usable(good));
    }
    for (int i = 0; i < 3; ++i) {
        double const middle = std::sqrt(good * bad);
        (usable(middle) ? good : bad) = middle;
    }
    return good;
}

}  // namespace slideway::bench
