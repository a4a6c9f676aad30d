#include "host/study/result_summary.hpp"

#include <array>

#include <fmt/format.h>

#include "host/output/result_layout.hpp"

namespace slideway {
namespace {

Status status_of(double stored) { return static_cast<Status>(static_cast<signed char>(stored)); }

}  // namespace

std::string name_of(Status status) {
    auto const index = static_cast<int>(status);
    if (status == Status::not_run) return "not_run";
    if (index < 0 || index >= status_count) return fmt::format("status_{}", index);
    return status_names[index];
}

std::vector<QuantitySummary> summarise_quantities(ResultView const& results) {
    std::vector<double> const statuses = results.values("status");
    std::vector<QuantitySummary> summaries;
    for (QuantityInfo const& info : quantity_table) {
        if (!results.has(info.name)) continue;
        std::vector<double> const values = results.values(info.name);
        auto const columns = static_cast<std::size_t>(info.columns);
        if (values.size() != statuses.size() * columns) continue;  // written by another version
        std::vector<std::string> const labels = info.dimension ? labels_of(info.dimension) : std::vector<std::string>{};
        for (std::size_t column = 0; column < columns; ++column) {
            std::vector<double> finished;
            for (std::size_t i = 0; i < statuses.size(); ++i) {
                if (status_of(statuses[i]) == Status::finished) finished.push_back(values[i * columns + column]);
            }
            std::string const label = labels.empty() ? info.name : fmt::format("{}[{}]", info.name, labels[column]);
            summaries.push_back({label, results.unit(info.name), summarise(finished)});
        }
    }
    return summaries;
}

std::vector<StatusCount> count_statuses(ResultView const& results) {
    std::array<std::uint64_t, 256> counts{};
    for (double const status : results.values("status")) {
        ++counts[static_cast<unsigned char>(static_cast<signed char>(status))];
    }
    std::vector<StatusCount> occurring;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) occurring.push_back({static_cast<Status>(static_cast<signed char>(i)), counts[i]});
    }
    return occurring;
}

std::vector<FailedMember> failed_members(ResultView const& results, std::size_t limit) {
    std::vector<double> const statuses = results.values("status");
    std::vector<double> const numbers = results.values("member");
    std::vector<double> const times = results.values("end_time");
    std::vector<FailedMember> failed;
    for (std::size_t i = 0; i < statuses.size() && failed.size() < limit; ++i) {
        Status const status = status_of(statuses[i]);
        if (status == Status::finished || status == Status::not_run) continue;
        failed.push_back({static_cast<std::uint64_t>(numbers[i]), status, times[i]});
    }
    return failed;
}

}  // namespace slideway
