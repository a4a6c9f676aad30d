// What a tolerance study concludes: distributions, yields and the influence of what varies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/scene.hpp"
#include "host/run/ensemble.hpp"
#include "host/sampling/design.hpp"
#include "host/statistics/correlation.hpp"
#include "host/statistics/sobol_indices.hpp"
#include "host/statistics/summary.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/data_file.hpp"
#include "host/store/result_layout.hpp"
#include "host/store/result_view.hpp"
#include "host/study/result_summary.hpp"
#include "kernels/status.hpp"

namespace slideway {

inline constexpr double confidence_level = 0.95;  // of all intervals
inline constexpr double reported_quantiles[] = {0.001, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 0.999};

/// Of the draws that finished.
struct ColumnStatistics {
    QuantityColumn column;
    Summary summary;
    Interval mean;                            // by Student's t
    std::vector<QuantileEstimate> quantiles;  // [reported_quantiles]
    Histogram histogram;
};

struct LimitYield {
    Limit limit;
    std::string unit;
    Proportion met;  // of the draws that ran
};

struct ColumnIndices {
    QuantityColumn column;
    std::string why_none;              // in words, where the column varies by no more than rounding: then indices are NaN; else ""
    SobolIndices indices;              // [inputs]
    std::vector<std::size_t> ranking;  // inputs, the largest total index first; those without an index last
};

/// Of a saltelli design.
struct IndexReport {
    std::uint64_t rows = 0;        // of which the file holds a member
    std::uint64_t failed = 0;      // left out: a member failed
    std::uint64_t incomplete = 0;  // left out: a member is not in the file or did not run
    std::vector<ColumnIndices> columns;
    std::uint64_t used() const { return rows - failed - incomplete; }
};

struct ColumnCorrelations {
    QuantityColumn column;
    std::string why_none;                    // as of indices
    std::size_t members = 0;                 // used: finished, with a number
    std::vector<Estimate> ranks;  // [inputs], Spearman's
    StandardisedRegression regression;       // [inputs]
    std::vector<std::size_t> ranking;        // inputs, the largest magnitude of the rank correlation first
};

struct ToleranceReport {
    std::string policy;          // whom the numbers are of, in words
    std::string intervals;       // what the intervals mean, in words
    std::string quantile_error;  // of quantiles, medians and their intervals, in words; "" where they are exact
    DesignKind design = DesignKind::mc;
    std::vector<StatusCount> statuses;  // of all members of the file
    std::vector<StatusCount> draws;     // of those that distributions and yields are of
    std::vector<std::string> inputs;    // dotted keys of what varies
    std::vector<ColumnStatistics> columns;
    std::vector<LimitYield> limits;                // in the scene's order
    std::optional<Proportion> all_met;             // if there are limits
    std::optional<IndexReport> indices;            // of a saltelli design
    std::vector<ColumnCorrelations> correlations;  // of any other
};

/// How a report is made.
struct ReportSettings {
    int threads = default_threads();  // numbers do not depend on them
    /// Members that take part in correlations, at most: of more, as many that the scene's seed chooses at random.
    std::size_t most_correlated = std::size_t{1} << 20;
    std::function<void()> pause = [] {};  // called now and then; what it throws ends the report
};

/// Statistics of a result of the study `tolerance`, by this policy:
/// - moments, quantiles and histograms are of members that finished;
/// - members that failed are counted by status, and meet no limit;
/// - members that did not run are counted, and left out everywhere else; there are no intervals then, for the slow ones are missing;
/// - of a saltelli design distributions and yields are of the 2N members of A and B, each a draw of all inputs; rows
///   with a member that failed or is missing are left out of the indices whole, and counted;
/// - a column that varies by no more than the error of its numbers has no indices or correlations.
/// Members are known by their number (variable `member`), so the file may hold a part of the design, in any order.  One
/// column of all members is in memory at a time, and the inputs of at most `most_correlated` members.
/// A result that keeps statistics in place of members has the same report without correlations: moments, ends and yields are those of the
/// members, without rounding but for their last; quantiles and histograms are by the sketch (QuantileSketch::error).
/// Intervals are those of independent draws (so as a rule too wide for lhs, sobol and saltelli, whose draws are spread
/// more evenly); of grid and table designs, whose members are no random draws, there are none.
/// @throws FileError if the result lacks a quantity that a limit names, or its members are not those of the scene's
/// design, or its statistics not of the scene's quantities and limits.
ToleranceReport tolerance_report(ResultView const& results, Scene const& scene, ReportSettings const& settings = {});

/// Adds the groups `statistics`, `yield` (if there are limits) and `sensitivity` (if anything varies) to a file that is
/// open for writing, before it is closed.  Variables are named after their quantity (`drive_work_quantile`), lie along
/// its labels (if it has any, by the file's own dimension) and then along the group's: probability, bound, bin, edge,
/// input, limit.  Labels are texts in `<dimension>_name`.  The attributes `policy` and `intervals` say whom the numbers
/// are of.
/// @throws FileError.
void write_statistics(DataFile& file, ToleranceReport const& report);

// Members of a result in the order of their numbers.

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

// Whether numbers of members differ by more than the error that each of them has.

/// Energy below which a number is taken as none [J]: a millionth (the default tolerance) of what a fall through the clearance gives
/// (fall_energy).  Energies are differences of ones of that size: where the true number is 0 (no friction, nothing that damps) what is
/// left is their rounding, and has no size of its own to be compared with.
double least_energy(Scene const& scene);

/// What a number with this unit is on the scale of the joint: of a fall through its clearance; 0 of units that this says nothing of.
double natural_scale(std::string_view unit, Scene const& scene);

/// Why sensitivities of a column would be those of rounding: its standard deviation is no more than its numbers' error (1e-6, the default
/// tolerance, of the largest magnitude, at least of the natural scale), or it is the integration's error (the energy residual of a law that
/// makes no energy).  "" where it varies by more, or is not finite.
/// @param values of members; NaN are left out
std::string why_no_sensitivity(QuantityColumn const& column, std::span<double const> values, Scene const& scene);

}  // namespace slideway
