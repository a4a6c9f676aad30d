#include "host/study/result_summary.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/result_layout.hpp"

namespace slideway {
namespace {

/// Of a file without members: the median is sketched.
std::vector<QuantitySummary> sketched_quantities(ResultView const& results) {
    std::vector<QuantityColumn> const columns = stored_columns(results);
    BlockStatistics const statistics = stored_statistics(results);
    std::vector<QuantitySummary> summaries;
    for (std::size_t i = 0; i < std::min(columns.size(), statistics.columns().size()); ++i) {
        summaries.push_back({columns[i].name(), columns[i].unit, statistics.columns()[i].summary()});
    }
    return summaries;
}

}  // namespace

std::string name_of(Status status) {
    auto const index = static_cast<int>(status);
    if (status == Status::not_run) return "not_run";
    if (index < 0 || index >= status_count) return fmt::format("status_{}", index);
    return status_names[index];
}

std::vector<QuantitySummary> summarise_quantities(ResultView const& results) {
    if (!results.stores_members()) return sketched_quantities(results);
    std::vector<double> const statuses = results.values("status");
    std::vector<QuantitySummary> summaries;
    std::vector<double> values;  // of the quantity that a column is of
    for (QuantityColumn const& column : stored_columns(results)) {
        if (column.index == 0) values = results.values(column.quantity);
        std::size_t const width = std::max<std::size_t>(1, labels_of(column.dimension).size());
        if (values.size() != statuses.size() * width) continue;  // written by another version
        std::vector<double> finished;
        for (std::size_t i = 0; i < statuses.size(); ++i) {
            if (status_of(statuses[i]) == Status::finished) finished.push_back(values[i * width + column.index]);
        }
        summaries.push_back({column.name(), column.unit, summarise(finished)});
    }
    return summaries;
}

std::vector<StatusCount> listed(StatusCounts const& counts) {
    std::vector<StatusCount> occurring;
    for (auto const& [status, members] : counts) {
        if (members > 0) occurring.push_back({static_cast<Status>(static_cast<signed char>(status)), members});
    }
    return occurring;
}

std::vector<StatusCount> count_statuses(ResultView const& results) {
    StatusCounts counts;
    auto const entry = [&](double status) -> std::uint64_t& { return counts[static_cast<unsigned char>(status_of(status))]; };
    if (results.stores_members()) {
        for (double const status : results.values("status")) ++entry(status);
    } else {
        std::vector<double> const statuses = results.values("status_value"), members = results.values("status_count");
        for (std::size_t i = 0; i < std::min(statuses.size(), members.size()); ++i) entry(statuses[i]) += count_of(members[i]);
    }
    return listed(counts);
}

std::vector<MemberRow> member_rows(ResultView const& results, MemberRange const& range) {
    if (!results.stores_members())
        throw SceneError(fmt::format("{}: has no members (its scene says study.store = \"statistics\"); leave out --members", results.path()));
    auto const numbers = results.values("member");
    auto const of_members = [&](char const* name) { return results.values(name, numbers.size()); };
    auto const statuses = of_members("status"), times = of_members("end_time"), accepted = of_members("steps_accepted"),
               rejected = of_members("steps_rejected");
    std::vector<std::string> labels;
    if (results.has("member_label")) labels = results.texts("member_label");
    labels.resize(numbers.size());
    std::vector<MemberRow> ends;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::uint64_t const member = count_of(numbers[i]);
        if (member < range.first || member >= range.end()) continue;
        Status const status = status_of(statuses[i]);
        bool const ran = status != Status::not_run;
        auto const steps = [&](std::vector<double> const& of) { return ran ? count_of(of[i]) : 0; };
        ends.push_back({member, status, ran ? times[i] : NAN, steps(accepted), steps(rejected), labels[i]});
    }
    if (ends.empty() && !numbers.empty()) {
        throw SceneError(fmt::format("{}: has none of the members {} to {}; it has {:.0f} to {:.0f}", results.path(), range.first, range.end() - 1,
                                     numbers.front(), numbers.back()));
    }
    return ends;
}

std::vector<FailedMember> failed_members(ResultView const& results, std::size_t limit) {
    bool const stored = results.stores_members();
    if (!stored && !results.has("failed_member")) return {};
    std::vector<double> const statuses = results.values(stored ? "status" : "failed_status");
    std::vector<double> const numbers = results.values(stored ? "member" : "failed_member", statuses.size());
    std::vector<double> const times = results.values(stored ? "end_time" : "failed_time", statuses.size());
    std::vector<FailedMember> failed;
    for (std::size_t i = 0; i < statuses.size() && failed.size() < limit; ++i) {
        Status const status = status_of(statuses[i]);
        if (status == Status::finished || status == Status::not_run) continue;
        failed.push_back({count_of(numbers[i]), status, times[i]});
    }
    return failed;
}

namespace {

std::vector<char> finished_members(ResultView const& results) {
    std::vector<char> finished;
    for (double const status : results.values("status")) finished.push_back(status_of(status) == Status::finished);
    return finished;
}

/// Column j of the rows of `width` numbers whose member finished.
std::vector<double> finished_column(std::vector<double> const& values, std::vector<char> const& finished, std::size_t width, std::size_t j) {
    std::vector<double> column;
    for (std::size_t i = 0; i < finished.size(); ++i) {
        if (finished[i]) column.push_back(values[i * width + j]);
    }
    return column;
}

/// Of a member: the last of a variable's dimensions.  @throws FileError of a variable that has others, or none of them
std::size_t exponents_of(ResultView const& results, char const* variable = "lyapunov_exponent", char const* dimensions = "member, exponent") {
    auto const shape = results.shape(variable);
    auto const rank = static_cast<std::size_t>(std::ranges::count(std::string_view(dimensions), ',')) + 1;
    if (shape.size() == rank && shape.back() > 0) return shape.back();
    throw FileError(fmt::format("{}: {} is not ({})", results.path(), variable, dimensions));
}

/// What a file has of the exponents of the members that finished.
struct StoredExponents {
    explicit StoredExponents(ResultView const& results)
        : finished(finished_members(results)),
          width(exponents_of(results)),
          value(results.values("lyapunov_exponent", finished.size() * width)),
          half_width(results.values("lyapunov_exponent_half_width", finished.size() * width)),
          late(results.values("lyapunov_exponent_late", finished.size() * width)),
          time(results.values("lyapunov_time", finished.size())),
          resolution(results.values("lyapunov_resolution", finished.size())) {}

    /// Of exponent j, of the members from `first` to before `last`.
    std::vector<ExponentRecord> records(std::size_t j, std::size_t first, std::size_t last) const {
        std::vector<ExponentRecord> records;
        for (std::size_t i = first; i < last; ++i) {
            std::size_t const at = i * width + j;
            if (finished[i]) records.push_back({value[at], half_width[at], late[at], time[i]});
        }
        return records;
    }
    ExponentOfMembers over_members(std::size_t j, std::size_t first, std::size_t last) const {
        double largest = 0;
        for (std::size_t i = first; i < last; ++i) largest = finished[i] ? std::max(largest, resolution[i]) : largest;
        return exponent_of_members(records(j, first, last), largest);
    }

    std::vector<char> finished;  // [members]
    std::size_t width;           // exponents of a member
    std::vector<double> value, half_width, late, time, resolution;
};

}  // namespace

std::vector<ExponentSummary> summarise_exponents(ResultView const& results) {
    std::vector<ExponentSummary> summaries;
    if (!results.has("lyapunov_exponent")) return summaries;
    StoredExponents const stored(results);
    std::size_t const members = results.values("status").size();
    for (std::size_t j = 0; j < stored.width; ++j) {
        std::vector<double> values;
        for (ExponentRecord const& record : stored.records(j, 0, members)) values.push_back(record.rate);
        Summary const summary = summarise(values);
        std::erase_if(values, [](double x) { return std::isnan(x); });
        std::ranges::sort(values);
        summaries.push_back({stored.over_members(j, 0, members), summary, quantile(values, 0.05), quantile(values, 0.95)});
    }
    return summaries;
}

std::optional<MeanOfMembers> growth_per_turn(ResultView const& results) {
    char const* const name = "lyapunov_exponent_per_turn";
    if (!results.has(name)) return {};
    auto const finished = finished_members(results);
    std::size_t const width = exponents_of(results, name);
    return mean_of_members(finished_column(results.values(name, finished.size() * width), finished, width, 0));
}

OffsetHealth offset_health(ResultView const& results) {
    auto const finished = finished_members(results);
    double const exponents = static_cast<double>(exponents_of(results));
    auto const share = [&](char const* name) {
        auto const counts = finished_column(results.values(name, finished.size()), finished, 1, 0);
        auto const rescalings = finished_column(results.values("rescalings", finished.size()), finished, 1, 0);
        double counted = 0, all = 0;
        for (std::size_t i = 0; i < counts.size(); ++i) counted += counts[i], all += exponents * rescalings[i];
        return all > 0 ? counted / all : 0.0;
    };
    return {share("lost_offsets"), share("grown_offsets")};
}

std::vector<SweepColumn> summarise_columns(ResultView const& results) {
    std::vector<SweepColumn> columns;
    std::string const parameter = results.attribute("sweep_parameter");
    if (parameter.empty()) return columns;
    auto const finished = finished_members(results);
    auto const values = results.values(parameter, finished.size());
    std::optional<StoredExponents> exponents;
    if (results.has("lyapunov_exponent")) exponents.emplace(results);
    for (std::size_t first = 0, last = 0; first < values.size(); first = last) {
        while (last < values.size() && values[last] == values[first]) ++last;
        last = std::max(last, first + 1);  // of NaN, in a file that was edited
        auto const from = finished.begin() + static_cast<std::ptrdiff_t>(first), to = finished.begin() + static_cast<std::ptrdiff_t>(last);
        SweepColumn& column = columns.emplace_back();
        column.value = values[first];
        column.members = last - first;
        column.finished = static_cast<std::uint64_t>(std::count(from, to, 1));
        column.exponent = exponents ? exponents->over_members(0, first, last) : exponent_of_members({}, 0);
    }
    return columns;
}

std::vector<HistoryPoint> exponent_history(ResultView const& results) {
    std::vector<HistoryPoint> history;
    if (!results.has("lyapunov_history")) return history;
    auto const finished = finished_members(results);
    auto const rescalings = results.values("history");
    std::size_t const exponents = exponents_of(results, "lyapunov_history", "member, history, exponent");
    auto const values = results.values("lyapunov_history", finished.size() * rescalings.size() * exponents);
    for (std::size_t n = 0; n < rescalings.size(); ++n) {
        history.push_back({rescalings[n], mean_of_members(finished_column(values, finished, rescalings.size() * exponents, n * exponents))});
    }
    return history;
}

std::optional<SectionSummary> summarise_sections(ResultView const& results) {
    if (!results.has("section_count")) return std::nullopt;
    auto const finished = finished_members(results);
    auto const counts = results.values("section_count", finished.size());
    auto const crossings = results.has("section_crossings") ? results.values("section_crossings", counts.size()) : counts;
    SectionSummary summary;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        summary.beyond += count_of(crossings[i] - counts[i]);
        summary.sections += count_of(counts[i]);
        if (finished[i] && counts[i] == 0) ++summary.without;
    }
    return summary;
}

}  // namespace slideway
