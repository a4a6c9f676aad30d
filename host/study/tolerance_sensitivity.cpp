#include "host/study/tolerance_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

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

std::string variable_name(Key const& key) {
    std::string name(key.name);
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

/// Members that take part: finished, not more than most_correlated.
std::vector<std::size_t> correlated_members(ToleranceMembers const& members) {
    std::vector<std::size_t> finished;
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (members.finished(i)) finished.push_back(i);
    }
    std::size_t const every = (finished.size() + most_correlated - 1) / most_correlated;
    if (every <= 1) return finished;
    std::vector<std::size_t> thinned;
    for (std::size_t i = 0; i < finished.size(); i += every) thinned.push_back(finished[i]);
    return thinned;
}

std::vector<double> taken(std::vector<double> const& values, std::vector<std::size_t> const& which) {
    std::vector<double> chosen;
    chosen.reserve(which.size());
    for (std::size_t const i : which) chosen.push_back(values[i]);
    return chosen;
}

/// An input with the members' ranks, which all outputs without gaps share.
struct Input {
    std::vector<double> values, ranks;
};

ColumnCorrelations correlations_of(QuantityColumn const& column, std::vector<Input> const& inputs,
                                   std::vector<double> output, bool independent) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < output.size(); ++i) {
        if (!std::isnan(output[i])) numbers.push_back(i);
    }
    bool const gaps = numbers.size() < output.size();
    if (gaps) output = taken(output, numbers);
    ColumnCorrelations result{column, output.size(), {}, {}, {}};
    std::vector<double> const output_ranks = midranks(output);
    std::vector<std::vector<double>> values;
    for (Input const& input : inputs) {
        values.push_back(gaps ? taken(input.values, numbers) : input.values);
        double const r = product_moment(gaps ? midranks(values.back()) : input.ranks, output_ranks);
        result.ranks.push_back({r, {}});
        if (independent) result.ranks.back().interval = rank_correlation_interval(r, output.size(), confidence_level);
    }
    result.regression = standardised_regression(values, output);
    result.ranking = ranking(inputs.size(), [&](std::size_t i) { return std::abs(result.ranks[i].value); });
    return result;
}

}  // namespace

IndexReport index_report(ToleranceMembers const& members, Scene const& scene, std::span<QuantityColumn const> columns) {
    std::size_t const inputs = scene.variations.size(), width = inputs + 2;
    IndexReport report;
    std::vector<std::size_t> const rows = usable_rows(members, width, report);
    for (QuantityColumn const& column : columns) {
        std::vector<double> radial;
        radial.reserve(rows.size() * width);
        {
            std::vector<double> const values = members.column(column.quantity, column.index);
            for (std::size_t const first : rows) {
                auto const from = values.begin() + static_cast<std::ptrdiff_t>(first);
                radial.insert(radial.end(), from, from + static_cast<std::ptrdiff_t>(width));
            }
        }
        BootstrapSettings bootstrap;
        bootstrap.level = confidence_level;
        bootstrap.seed = scene.seed;
        ColumnIndices result{column, sobol_indices({inputs, radial}, bootstrap), {}};
        result.ranking = ranking(inputs, [&](std::size_t i) { return result.indices.total[i].value; });
        report.columns.push_back(std::move(result));
    }
    return report;
}

std::vector<ColumnCorrelations> correlation_report(ToleranceMembers const& members, Scene const& scene,
                                                   std::span<QuantityColumn const> columns, bool independent) {
    std::vector<ColumnCorrelations> report;
    if (scene.variations.empty()) return report;
    std::vector<std::size_t> const used = correlated_members(members);
    std::vector<Input> inputs;
    for (Variation const& variation : scene.variations) {
        Input input{taken(members.column(variable_name(*variation.key)), used), {}};
        input.ranks = midranks(input.values);
        inputs.push_back(std::move(input));
    }
    for (QuantityColumn const& column : columns) {
        std::vector<double> output = taken(members.column(column.quantity, column.index), used);
        report.push_back(correlations_of(column, inputs, std::move(output), independent));
    }
    return report;
}

}  // namespace slideway
