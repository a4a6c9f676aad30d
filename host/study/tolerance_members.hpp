// Members of a result in the order of their numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host/sampling/design.hpp"
#include "host/store/result_view.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/tolerance_report.hpp"
#include "kernels/status.hpp"

namespace slideway {

/// Members per row of a saltelli design, d + 2; of other designs 0.
std::size_t design_width(Scene const& scene);

class ToleranceMembers {
public:
    /// @param width `design_width` of the scene, or 0 where draws make no difference.  @param members of the whole design.
    /// @throws FileError if a number is not of the design or comes twice.
    ToleranceMembers(ResultView const& results, std::size_t width, std::uint64_t members);

    std::size_t size() const { return numbers_.size(); }
    std::uint64_t number(std::size_t i) const { return numbers_[i]; }
    Status status(std::size_t i) const { return statuses_[i]; }
    bool finished(std::size_t i) const { return statuses_[i] == Status::finished; }
    bool ran(std::size_t i) const { return statuses_[i] != Status::not_run; }
    /// One of those that distributions and yields are of: of a saltelli design A and B, of others all.
    bool is_draw(std::size_t i) const { return width_ == 0 || numbers_[i] % width_ < 2; }

    /// A column of a member variable, in the order of the numbers.
    std::vector<double> column(std::string const& variable, std::size_t index = 0) const;

    /// How many ended how, not_run last; of all, or of the draws.
    std::vector<StatusCount> count(bool draws_only) const;

private:
    ResultView const& results_;
    std::size_t width_;
    std::vector<std::uint64_t> numbers_;  // ascending
    std::vector<Status> statuses_;
    std::vector<std::size_t> places_;  // in the file; empty where it is in order
};

/// Sobol indices of each column, of a saltelli design.
/// @param independent whether the rows are random draws: only these have intervals.
IndexReport index_report(ToleranceMembers const& members, Scene const& scene, std::span<QuantityColumn const> columns,
                         bool independent, ReportSettings const& settings);

/// Rank correlations and regression of each column, of other designs.
/// @param independent whether the members are random draws: only these have intervals.
std::vector<ColumnCorrelations> correlation_report(ToleranceMembers const& members, Scene const& scene,
                                                   std::span<QuantityColumn const> columns, bool independent,
                                                   ReportSettings const& settings);

}  // namespace slideway
