#include "bench/work_precision/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/work_precision/references.hpp"

namespace slideway::bench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Largest difference between recorded extrema and a period of the reference's, started where they fit best: transients of other
/// length shift them.
double extrema_error(std::vector<double> const& recorded, std::vector<double> const& period) {
    double least = infinity;
    for (std::size_t shift = 0; shift < period.size(); ++shift) {
        double largest = 0;
        for (std::size_t i = 0; i < recorded.size(); ++i) {
            double const difference = std::abs(recorded[i] - period[(i + shift) % period.size()]);
            largest = difference <= largest ? largest : difference;  // keeps NaN
        }
        if (largest < least) least = largest;
    }
    return least;
}

double error_of(Problem const& problem, std::size_t member, MemberOutcome const& outcome) {
    if (!outcome.finished) return infinity;
    double error = 0;
    switch (problem.measure) {
        case Measure::energy:
            error = std::abs(outcome.audit.residual);
            break;
        case Measure::state:
            error = state_error(outcome.state, problem.reference[member], scales(problem.ensemble, member));
            break;
        case Measure::extrema:
            error = extrema_error(outcome.state, problem.reference[member]);
            break;
    }
    return std::isnan(error) ? infinity : error;
}

bool counts(Problem const& problem, std::size_t member) {
    return member < problem.shared && !(problem.measure == Measure::extrema && problem.reference[member].empty());
}

Row summary(Problem const& problem, Method const& method, double tolerance, Outcome const& outcome,
            std::vector<double> const& times) {
    std::vector<double> errors, friction, damping;
    Row row{.method = method.name, .code = method.code, .ours = method.ours, .tolerance = tolerance};
    row.ensemble = outcome.members.size();
    for (std::size_t i = 0; i < outcome.members.size(); ++i) {
        auto const& member = outcome.members[i];
        row.failures += member.finished ? 0 : 1;
        if (i < problem.shared) row.evaluations += static_cast<double>(member.evaluations);
        if (!counts(problem, i)) continue;
        errors.push_back(error_of(problem, i, member));
        friction.push_back(member.audit.friction_loss);
        damping.push_back(member.audit.damping_loss);
    }
    row.members = errors.size();
    row.evaluations /= static_cast<double>(std::min(problem.shared, row.ensemble));
    row.median_error = percentile(errors, 0.5);
    row.p95_error = percentile(errors, 0.95);
    row.friction_loss = percentile(friction, 0.5);
    row.damping_loss = percentile(damping, 0.5);
    row.seconds = percentile(times, 0.5);
    return row;
}

/// One method on its way through the tolerances.
struct Progress {
    bool in_time = true;
    std::size_t members = 0;  // of the present tolerance's runs
    Outcome last;
    std::vector<double> times;
    std::vector<Row> rows;
};

/// Ours take the whole ensemble, which fills their lanes, where the former tolerance says that there is time for it.
std::size_t members_for(Method const& method, Problem const& problem, Progress const& progress, double budget) {
    if (!method.ours || progress.last.members.empty()) return problem.shared;
    double const wanted = 2 * progress.last.seconds_per_member * static_cast<double>(problem.size());
    return wanted < budget ? problem.size() : problem.shared;
}

void run_once(Method const& method, Problem const& problem, double tolerance, Progress& progress,
              SweepOptions const& options) {
    progress.last = method.solve({problem, tolerance, progress.members, options.budget});
    if (4 * progress.last.members.size() < problem.shared) {
        progress.in_time = false;
    } else {
        progress.times.push_back(progress.last.seconds_per_member);
    }
}

}  // namespace

std::vector<Row> sweep(Problem const& problem, std::vector<Method> const& methods, SweepOptions const& options) {
    std::vector<Progress> progress(methods.size());
    auto const takes_part = [&](std::size_t m) { return progress[m].in_time && methods[m].solves(problem); };
    for (std::size_t m = 0; m < methods.size(); ++m) {
        if (!takes_part(m) || !methods[m].ours) continue;
        // A trial, for how many members there is time.
        progress[m].last = methods[m].solve({problem, problem.tolerances.front(), problem.shared, options.budget});
    }
    for (double const tolerance : problem.tolerances) {
        for (std::size_t m = 0; m < methods.size(); ++m) {
            progress[m].members = members_for(methods[m], problem, progress[m], options.budget);
            progress[m].times.clear();
        }
        for (int repeat = 0; repeat < options.repeats; ++repeat) {
            for (std::size_t m = 0; m < methods.size(); ++m) {
                if (!takes_part(m)) continue;
                auto& p = progress[m];
                auto const length = p.last.seconds_per_member * static_cast<double>(p.last.members.size());
                if (repeat == 0 || length <= options.long_run) run_once(methods[m], problem, tolerance, p, options);
            }
        }
        for (std::size_t m = 0; m < methods.size(); ++m) {
            auto& p = progress[m];
            if (!takes_part(m) || p.times.empty()) continue;
            p.rows.push_back(summary(problem, methods[m], tolerance, p.last, p.times));
        }
    }
    std::vector<Row> all;
    for (auto const& p : progress) all.insert(all.end(), p.rows.begin(), p.rows.end());
    return all;
}

}  // namespace slideway::bench
