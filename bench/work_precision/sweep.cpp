#include "bench/work_precision/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/work_precision/references.hpp"

namespace slideway::bench {
namespace {

double error_of(Problem const& problem, std::size_t member, MemberOutcome const& outcome) {
    if (!outcome.finished) return std::numeric_limits<double>::infinity();
    double const error = problem.measure == Measure::energy
                             ? std::abs(outcome.audit.residual)
                             : state_error(outcome.state, problem.reference[member], scales(problem.ensemble, member));
    return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

Row summary(Problem const& problem, Method const& method, double tolerance, Outcome const& outcome,
            std::vector<double> const& times) {
    std::vector<double> errors, friction, damping;
    Row row{.method = method.name, .code = method.code, .ours = method.ours, .tolerance = tolerance};
    row.members = outcome.members.size();
    for (std::size_t i = 0; i < row.members; ++i) {
        auto const& member = outcome.members[i];
        errors.push_back(error_of(problem, i, member));
        row.failures += member.finished ? 0 : 1;
        row.evaluations += static_cast<double>(member.evaluations) / static_cast<double>(row.members);
        friction.push_back(member.audit.friction_loss);
        damping.push_back(member.audit.damping_loss);
    }
    row.median_error = percentile(errors, 0.5);
    row.p95_error = percentile(errors, 0.95);
    row.friction_loss = percentile(friction, 0.5);
    row.damping_loss = percentile(damping, 0.5);
    row.seconds = percentile(times, 0.5);
    return row;
}

}  // namespace

std::vector<Row> sweep(Problem const& problem, std::vector<Method> const& methods, SweepOptions const& options) {
    std::vector<std::vector<Row>> rows(methods.size());
    std::vector<bool> in_time(methods.size(), true);
    for (double const tolerance : problem.tolerances) {
        std::vector<std::vector<double>> times(methods.size());
        std::vector<Outcome> last(methods.size());
        for (int repeat = 0; repeat < options.repeats; ++repeat) {
            for (std::size_t m = 0; m < methods.size(); ++m) {
                if (!in_time[m] || !methods[m].solves(problem)) continue;
                if (repeat > 0 &&
                    last[m].seconds_per_member * static_cast<double>(last[m].members.size()) > options.long_run)
                    continue;
                last[m] = methods[m].solve({problem, tolerance, options.budget});
                if (4 * last[m].members.size() < problem.size()) {
                    in_time[m] = false;
                } else {
                    times[m].push_back(last[m].seconds_per_member);
                }
            }
        }
        for (std::size_t m = 0; m < methods.size(); ++m) {
            if (in_time[m] && !times[m].empty()) {
                rows[m].push_back(summary(problem, methods[m], tolerance, last[m], times[m]));
            }
        }
    }
    std::vector<Row> all;
    for (auto const& of_method : rows) all.insert(all.end(), of_method.begin(), of_method.end());
    return all;
}

}  // namespace slideway::bench
