#include "bench/stability/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/ensemble.hpp"

namespace slideway::bench {
namespace {

/// Ten million a second, as many as a scene allows by default.
constexpr std::uint64_t most_steps = 1'000'000;

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
    options.settings.max_steps = most_steps;
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

double usable_residual(Law law, Outcome const& reference) {
    return law == Law::conservative ? 0.01 : reference.p95_relative + 0.1;
}

double largest_usable_step(Point const& point, double bound) {
    double const limit = linear_limit(point.members);
    auto const usable = [&](double step) {
        auto const outcome = measure(point, Method::rk4, step);
        return outcome.all_finished() && outcome.p95_relative <= bound;
    };
    // Upwards by octaves from what is surely stable, then by bisection in the logarithm.
    double good = std::numeric_limits<double>::quiet_NaN(), bad = limit / 64;
    for (; bad <= 8 * limit && usable(bad); bad *= 2) good = bad;
    if (std::isnan(good)) return good;
    for (int i = 0; i < 3 && bad <= 8 * limit; ++i) {
        double const middle = std::sqrt(good * bad);
        (usable(middle) ? good : bad) = middle;
    }
    return good;
}

}  // namespace slideway::bench
