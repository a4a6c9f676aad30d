#include "host/study/result_summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/store/result_layout.hpp"
#include "host/store/statistics_merge.hpp"

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

}  // namespace slideway
