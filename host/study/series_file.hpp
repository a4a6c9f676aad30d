// One series out of a result file or a CSV table.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "host/store/result_view.hpp"

namespace slideway {

struct StoredSeries {
    std::string name;  // of the variable or column
    std::string unit;  // empty: not known
    std::vector<double> values;
    double spacing;  // [s]
};

/// Where a result has a member.  @param member its number in the ensemble; nothing: the first of the file.  @throws SceneError if it is not there
std::uint64_t member_place(ResultView const& file, std::optional<std::uint64_t> member);

/// By the first bytes, not by the name; they are still there to read.  @param in freshly opened from `path`
/// @throws FileError if the file cannot be read.
bool is_netcdf(std::istream& in, std::string const& path);

/// One member's samples of a variable (member, sample), spaced as `time` says.
/// @param member its number in the ensemble; nothing: the first of the file.
/// @throws FileError for a file that is no result; SceneError for a variable or member that is not there or no series, and
/// for sample times that are not equally spaced.
StoredSeries read_result_series(std::string const& path, std::string const& variable, std::optional<std::uint64_t> member);
/// The same of a result that somebody else keeps open.
StoredSeries read_result_series(ResultView const& file, std::string const& variable, std::optional<std::uint64_t> member);

/// Columns separated by commas, semicolons or blanks; lines that start with # are skipped; the first line may be a header.
/// @param name of the table, for messages.  @param column a name of the header or a number from 1; empty: the last column that is
/// not the time.  @param spacing [s]; nothing: from the column named time or t.
/// @throws SceneError `name:line: …`.
StoredSeries read_csv_series(std::istream& in, std::string const& name, std::string const& column,
                             std::optional<double> spacing);

/// Mean distance of times that lie on a line to a hundredth of it (tables are rounded); nothing for others.
std::optional<double> equal_spacing(std::vector<double> const& times);

}  // namespace slideway
