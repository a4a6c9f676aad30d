#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"
#include "host/sampling/random.hpp"
#include "host/statistics/summary.hpp"
#include "host/store/result_layout.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/tolerance_report.hpp"
#include "host/study/verification.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

/// Numbers of the inputs, the largest weight first, NaN last; of equal weights the first input.
std::vector<std::size_t> ranking(std::size_t inputs, std::function<double(std::size_t)> const& weight) {
    std::vector<std::size_t> order(inputs);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        double const x = weight(a), y = weight(b);
        return std::isnan(y) ? !std::isnan(x) : x > y;
    });
    return order;
}

/// Where rows begin that have all their members, all of them finished.
std::vector<std::size_t> usable_rows(ToleranceMembers const& members, std::size_t width, IndexReport& report) {
    std::vector<std::size_t> usable;
    for (std::size_t first = 0; first < members.size();) {
        std::uint64_t const row = members.number(first) / width;
        std::size_t last = first, ran = 0, finished = 0;
        for (; last < members.size() && members.number(last) / width == row; ++last) {
            ran += members.ran(last);
            finished += members.finished(last);
        }
        ++report.rows;
        if (finished < ran) {
            ++report.failed;
        } else if (finished < width) {
            ++report.incomplete;
        } else {
            usable.push_back(first);
        }
        first = last;
    }
    return usable;
}

/// Members that take part: finished, and of more than `most` a random choice.  Any regular one could fall in with the
/// order of a grid or of Sobol's points, which begin every so many places alike.
std::vector<std::size_t> correlated_members(ToleranceMembers const& members, std::uint64_t seed, std::size_t most) {
    std::vector<std::size_t> finished;
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (members.finished(i)) finished.push_back(i);
    }
    if (finished.size() <= most) return finished;
    Permutation const order(finished.size(), {seed, name_hash("correlation_report.members")});
    std::vector<std::size_t> chosen;
    chosen.reserve(most);
    for (std::size_t i = 0; i < most; ++i) chosen.push_back(finished[order(i)]);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

std::vector<double> taken(std::vector<double> const& values, std::vector<std::size_t> const& which) {
    std::vector<double> chosen;
    chosen.reserve(which.size());
    for (std::size_t const i : which) chosen.push_back(values[i]);
    return chosen;
}

/// Numbers that are the same but for their error become so.  @return why; "" where they are not
std::string equal_within_error(std::vector<double>& values, QuantityColumn const& column, Scene const& scene) {
    std::string why = why_no_sensitivity(column, values, scene);
    if (!why.empty()) std::ranges::replace_if(values, [](double x) { return !std::isnan(x); }, 0.0);
    return why;
}

/// An input with the members' ranks, which all outputs without gaps share.
struct Input {
    std::vector<double> values, ranks;
};

ColumnCorrelations correlations_of(ColumnCorrelations result, std::vector<Input> const& inputs, std::vector<double> output, bool independent) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < output.size(); ++i) {
        if (!std::isnan(output[i])) numbers.push_back(i);
    }
    bool const gaps = numbers.size() < output.size();
    if (gaps) output = taken(output, numbers);
    result.members = output.size();
    std::vector<double> const output_ranks = midranks(output);
    std::vector<std::vector<double>> values;
    for (Input const& input : inputs) {
        values.push_back(gaps ? taken(input.values, numbers) : input.values);
        result.ranks.push_back(
            rank_correlation(gaps ? midranks(values.back()) : input.ranks, output_ranks, confidence_level));
        if (!independent) result.ranks.back().interval = Interval();
    }
    result.regression = standardised_regression(values, output);
    result.ranking = ranking(inputs.size(), [&](std::size_t i) { return std::abs(result.ranks[i].value); });
    return result;
}

}  // namespace

IndexReport index_report(ToleranceMembers const& members, Scene const& scene, std::span<QuantityColumn const> columns,
                         bool independent, ReportSettings const& settings) {
    std::size_t const inputs = scene.variations.size(), width = inputs + 2;
    IndexReport report;
    std::vector<std::size_t> const rows = usable_rows(members, width, report);
    for (QuantityColumn const& column : columns) {
        settings.pause();
        std::vector<double> radial;
        radial.reserve(rows.size() * width);
        {
            std::vector<double> const values = members.column(column.quantity, column.index);
            for (std::size_t const first : rows) {
                auto const from = values.begin() + static_cast<std::ptrdiff_t>(first);
                radial.insert(radial.end(), from, from + static_cast<std::ptrdiff_t>(width));
            }
        }
        std::string why_none = equal_within_error(radial, column, scene);
        BootstrapSettings bootstrap;
        bootstrap.level = confidence_level;
        bootstrap.seed = scene.seed;
        bootstrap.threads = settings.threads;
        if (!independent) bootstrap.replicates = 0;
        ColumnIndices result{column, std::move(why_none), sobol_indices({inputs, radial}, bootstrap), {}};
        result.ranking = ranking(inputs, [&](std::size_t i) { return result.indices.total[i].value; });
        report.columns.push_back(std::move(result));
    }
    return report;
}

std::vector<ColumnCorrelations> correlation_report(ToleranceMembers const& members, Scene const& scene,
                                                   std::span<QuantityColumn const> columns, bool independent,
                                                   ReportSettings const& settings) {
    std::vector<ColumnCorrelations> report;
    if (scene.variations.empty()) return report;
    std::vector<std::size_t> const used = correlated_members(members, scene.seed, settings.most_correlated);
    std::vector<Input> inputs;
    for (Variation const& variation : scene.variations) {
        Input input{taken(members.column(variable_name(variation.key->name)), used), {}};
        input.ranks = midranks(input.values);
        inputs.push_back(std::move(input));
    }
    for (QuantityColumn const& column : columns) {
        settings.pause();
        std::vector<double> output = taken(members.column(column.quantity, column.index), used);
        std::string why_none = equal_within_error(output, column, scene);
        report.push_back(correlations_of({column, std::move(why_none), 0, {}, {}, {}}, inputs, std::move(output), independent));
    }
    return report;
}

namespace {

constexpr double relative_error = 1e-6;  // the default rtol

}  // namespace

double least_energy(Scene const& scene) { return relative_error * fall_energy(scene); }

double natural_scale(std::string_view unit, Scene const& scene) {
    Inputs const in = complete_inputs(scene.inputs, info(scene.parts.mechanism));
    MemberSize const size = size_of(scene.parts.mechanism, in);
    double const clearance = size.most_play, energy = fall_energy(scene), speed = std::sqrt(energy / size.mass);
    if (unit == "s") return orbit_schedule(scene).end;
    if (unit == "J" || unit == "N m") return energy;
    if (unit == "m") return clearance;
    if (unit == "rad") return clearance / size.length;
    if (unit == "N") return energy / clearance;
    if (unit == "m/s" || unit == "m s-1") return speed;
    if (unit == "rad/s" || unit == "rad s-1") return speed / size.length;
    if (unit == "m/s2" || unit == "m s-2") return energy / (clearance * size.mass);
    return 0;
}

std::string why_no_sensitivity(QuantityColumn const& column, std::span<double const> values, Scene const& scene) {
    Summary const summary = summarise(values);
    if (summary.count < 2) return "";
    if (summary.min == summary.max) return "does not vary";
    if (column.quantity == "energy_residual" && !makes_energy(scene.parts)) return "is the integration's error";
    double const natural = column.unit == "s" ? 0 : natural_scale(column.unit, scene);  // that of times is the whole study
    double const error = relative_error * std::max({std::abs(summary.min), std::abs(summary.max), natural});
    if (!(summary.sd <= error)) return "";
    std::string const unit = column.unit == "1" ? "" : " " + column.unit;
    return fmt::format("varies by {:.2g}{}, no more than its error of {:.2g}{}", summary.sd, unit, error, unit);
}

}  // namespace slideway
