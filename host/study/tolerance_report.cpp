#include "host/study/tolerance_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/result_layout.hpp"

namespace slideway {
namespace {

/// Whether members are random draws, so that intervals mean something.
bool is_random(DesignKind design) { return design != DesignKind::grid && design != DesignKind::table; }

std::string policy_of(DesignKind design) {
    std::string text(
        "Moments, quantiles and histograms are of the members that finished. Members that failed are counted by status "
        "and meet no limit. Members that did not run are left out.");
    if (design == DesignKind::saltelli) {
        text +=
            " Of this saltelli design, distributions and yields are of the members of A and B; rows with a member that "
            "failed or is missing are left out of the indices whole.";
    }
    return text;
}

/// @param complete whether every member ran: the slow ones are missing otherwise, and what is left is no fair sample.
std::string interval_words(DesignKind design, bool complete) {
    if (!complete) {
        return "none: members have not run, and not at random: the slow ones are missing, and quick ones are too many "
               "among the others";
    }
    std::string const level = fmt::format("{:.0f} % intervals of independent draws", 100 * confidence_level);
    std::string const skewed = "; those of means hold less often where draws are few and skewed";
    if (!is_random(design)) return "none: the members are no random draws";
    if (design == DesignKind::mc) return level + skewed;
    return level + "; as a rule too wide, for the draws of this design are spread more evenly";
}

/// Without an interval where members are no random draws.
Proportion yield_of(std::uint64_t met, std::uint64_t trials, bool random) {
    Proportion yield = proportion(met, trials, confidence_level);
    if (!random) yield.interval = Interval();
    return yield;
}

QuantityColumn const& limited_column(std::vector<QuantityColumn> const& columns, Limit const& limit, std::string const& path) {
    if (QuantityColumn const* const column = column_of(columns, limit)) return *column;
    throw FileError(fmt::format("{}: has no {}, which study.limits names; add it to study.quantities", path, limit.name()));
}

ColumnStatistics statistics_of(ToleranceMembers const& members, QuantityColumn const& column, bool random) {
    ColumnStatistics result{column, {}, {}, {}, {}};
    std::vector<double> values = members.column(column.quantity, column.index);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (members.finished(i) && members.is_draw(i)) values[kept++] = values[i];
    }
    values.resize(kept);
    result.summary = summarise(values);
    std::erase_if(values, [](double x) { return std::isnan(x); });
    std::sort(values.begin(), values.end());
    if (random) result.mean = mean_interval(result.summary, confidence_level);
    result.quantiles = estimate_quantiles(values, reported_quantiles, confidence_level);
    for (QuantileEstimate& estimate : result.quantiles) {
        if (!random) estimate.interval = Interval();
    }
    result.histogram = histogram(values);
    return result;
}

void add_yields(ToleranceReport& report, ToleranceMembers const& members, Scene const& scene,
                std::vector<QuantityColumn> const& columns, bool random, std::string const& path) {
    if (scene.limits.empty()) return;
    std::vector<char> all_met(members.size());
    std::uint64_t trials = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        trials += members.is_draw(i) && members.ran(i);
        all_met[i] = members.is_draw(i) && members.finished(i);
    }
    for (Limit const& limit : scene.limits) {
        QuantityColumn const& column = limited_column(columns, limit, path);
        std::vector<double> const values = members.column(column.quantity, column.index);
        std::uint64_t met = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            bool const within = limit.low <= values[i] && values[i] <= limit.high;  // not of NaN
            met += members.is_draw(i) && members.finished(i) && within;
            all_met[i] = all_met[i] && within;
        }
        report.limits.push_back({limit, column.unit, yield_of(met, trials, random)});
    }
    auto const all = static_cast<std::uint64_t>(std::count(all_met.begin(), all_met.end(), 1));
    report.all_met = yield_of(all, trials, random);
}

ColumnStatistics statistics_of(ColumnAccumulator const& values, QuantityColumn const& column, bool random) {
    ColumnStatistics result{column, values.summary(), {}, {}, values.histogram()};
    if (random) result.mean = mean_interval(result.summary, confidence_level);
    for (double const p : reported_quantiles)
        result.quantiles.push_back({{values.quantile(p), random ? values.quantile_interval(p, confidence_level) : Interval()}, p});
    return result;
}

/// Of a result without members.
ToleranceReport statistics_report(ResultView const& results, Scene const& scene) {
    BlockStatistics const statistics = stored_statistics(results);
    std::vector<QuantityColumn> const columns = columns_of(scene.parts.mechanism, scene.quantities);
    if (columns.size() != statistics.columns().size() || scene.limits.size() != statistics.met().size()) {
        throw FileError(fmt::format("{}: its statistics are of {} columns and {} limits, and the scene has {} and {}; give the scene of this result",
                                    results.path(), statistics.columns().size(), statistics.met().size(), columns.size(), scene.limits.size()));
    }
    bool const complete = members_left(results) == 0, random = is_random(scene.design.kind) && complete;
    ToleranceReport report;
    report.design = scene.design.kind;
    report.policy = policy_of(report.design) + " Members are not stored, so there are no correlations with what varies.";
    report.intervals = interval_words(report.design, complete);
    report.quantile_error = "relative error of at most 2^-10 of a member of that rank";
    static_assert(QuantileSketch::error == 0x1p-10);
    report.statuses = report.draws = count_statuses(results);
    std::erase_if(report.draws, [](StatusCount const& count) { return count.status == Status::not_run; });
    for (std::size_t i = 0; i < columns.size(); ++i) report.columns.push_back(statistics_of(statistics.columns()[i], columns[i], random));
    std::uint64_t const ran = statistics.members().count();
    for (std::size_t i = 0; i < scene.limits.size(); ++i) {
        QuantityColumn const& column = limited_column(columns, scene.limits[i], results.path());
        report.limits.push_back({scene.limits[i], column.unit, yield_of(statistics.met()[i], ran, random)});
    }
    if (!scene.limits.empty()) report.all_met = yield_of(statistics.all_met(), ran, random);
    return report;
}

}  // namespace

ToleranceReport tolerance_report(ResultView const& results, Scene const& scene, ReportSettings const& settings) {
    if (!results.stores_members()) return statistics_report(results, scene);
    bool const radial = scene.design.kind == DesignKind::saltelli;
    std::size_t const width = design_width(scene);
    std::uint64_t const size = radial ? scene.design.base * width : scene.members;
    ToleranceMembers const members(results, width, size);
    std::vector<QuantityColumn> const columns = stored_columns(results);

    ToleranceReport report;
    report.design = scene.design.kind;
    report.policy = policy_of(report.design);
    report.statuses = members.count(false);
    bool const complete = std::ranges::count(report.statuses, Status::not_run, &StatusCount::status) == 0;
    report.intervals = interval_words(report.design, complete);
    report.draws = members.count(true);
    for (Variation const& variation : scene.variations) report.inputs.emplace_back(variation.key->name);
    bool const random = is_random(report.design) && complete;
    for (QuantityColumn const& column : columns) {
        settings.pause();
        report.columns.push_back(statistics_of(members, column, random));
    }
    settings.pause();
    add_yields(report, members, scene, columns, random, results.path());
    if (radial) {
        report.indices = index_report(members, scene, columns, random, settings);
    } else {
        report.correlations = correlation_report(members, scene, columns, random, settings);
    }
    return report;
}

std::size_t design_width(Scene const& scene) { return scene.design.kind == DesignKind::saltelli ? scene.variations.size() + 2 : 0; }

ToleranceMembers::ToleranceMembers(ResultView const& results, std::size_t width, std::uint64_t members)
    : results_(results), width_(width) {
    std::vector<double> const numbers = results.values("member");
    if (!std::is_sorted(numbers.begin(), numbers.end())) {
        places_.resize(numbers.size());
        std::iota(places_.begin(), places_.end(), std::size_t{0});
        std::sort(places_.begin(), places_.end(),
                  [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    }
    std::vector<double> const statuses = results.values("status");
    if (statuses.size() != numbers.size()) {
        throw FileError(fmt::format("{}: has {} numbers of members and {} statuses; the file is damaged",
                                    results.path(), numbers.size(), statuses.size()));
    }
    numbers_.reserve(numbers.size());
    statuses_.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::size_t const place = places_.empty() ? i : places_[i];
        double const number = numbers[place];
        if (!(number >= 0) || number >= static_cast<double>(members)) {
            throw FileError(fmt::format("{}: holds member {}, but the design has {} members; give the scene of this result", results.path(), number, members));
        }
        numbers_.push_back(static_cast<std::uint64_t>(number));
        if (i > 0 && numbers_[i] == numbers_[i - 1]) {
            throw FileError(fmt::format("{}: holds member {} twice; the file is damaged", results.path(), numbers_[i]));
        }
        statuses_.push_back(status_of(statuses[place]));
    }
}

std::vector<double> ToleranceMembers::column(std::string const& variable, std::size_t index) const {
    std::vector<double> stored = results_.column(variable, index);
    if (stored.size() != size()) throw FileError(fmt::format("{}: {} is not of the members", results_.path(), variable));
    if (places_.empty()) return stored;
    std::vector<double> ordered;
    ordered.reserve(stored.size());
    for (std::size_t const place : places_) ordered.push_back(stored[place]);
    return ordered;
}

std::vector<StatusCount> ToleranceMembers::count(bool draws_only) const {
    StatusCounts counts;
    for (std::size_t i = 0; i < size(); ++i) {
        if (!draws_only || is_draw(i)) ++counts[static_cast<unsigned char>(status(i))];
    }
    return listed(counts);
}

}  // namespace slideway
