// Tables for other programs: text between commas, and MAT files of MATLAB 5.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/store/output_target.hpp"

namespace slideway {

/// Columns of a table that are read together.
struct TableColumns {
    std::vector<std::string> names;  // one for each number that an entry has: "joint.clearance"; "mode_time[free]", "mode_time[point]" …
    std::string unit = {};           // "" without one
    /// What it has a number for: each member, each sample of all members, or each sample of each member.
    enum class Along { members, samples, both } along = Along::members;
    /// Of entries along its first dimension, in C order.
    std::function<std::vector<double>(std::size_t first, std::size_t count)> numbers = {};
    std::vector<std::string> words = {};  // of each member, in place of numbers
};

/// A row for each member, or for each of its samples where there are some.
struct ExportTable {
    std::string name;
    std::size_t members = 0;
    std::size_t samples = 1;  // of each
    std::vector<TableColumns> columns = {};
};

/// A header, "joint.clearance [m]", and rows with the shortest numbers that read back to the same bits, empty where there is none (NaN).
void write_csv(OutputTarget const& target, ExportTable const& table);

/// How a MAT file of slideway begins.
inline constexpr char const* mat_title = "MATLAB 5.0 MAT-file, written by slideway";

/// A struct for each table, with a field for each column: a vector, a matrix [members × samples], or a cell array of words; and a struct `units`,
/// which has the units of each table.  Names are those of the columns in letters, digits and underscores.
/// @throws FileError if a table has 2 GiB or more, beyond which the format does not go
void write_mat(OutputTarget const& target, std::vector<ExportTable> const& tables);

}  // namespace slideway
