// Tables of golden values: a CSV file with a header, numbers throughout but for the column contact.law.  Also the
// measures by which a computed table is held against one.
#pragma once

#include "oracle.hpp"

#include <span>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace golden {

class Table {
public:
    Table() = default;
    explicit Table(std::vector<std::string> columns);

    /// @throws std::runtime_error naming file and line: no such file, a row of another width.
    static Table read(std::filesystem::path const& file);

    [[nodiscard]] std::vector<std::string> const& columns() const { return columns_; }
    [[nodiscard]] std::size_t rows() const { return cells_.size(); }
    [[nodiscard]] bool has(std::string const& column) const { return index_.count(column) != 0; }
    /// @throws std::runtime_error for an unknown column, a row beyond the last, or text that is no number.
    [[nodiscard]] double number(std::size_t row, std::string const& column) const;
    [[nodiscard]] std::string const& text(std::size_t row, std::string const& column) const;
    /// @throws std::runtime_error for a row of another width.
    void add(std::vector<std::string> row);

private:
    std::vector<std::string> columns_;
    std::map<std::string, std::size_t> index_;
    std::vector<std::vector<std::string>> cells_;
};

/// One row of rhs_*.csv or trajectories.csv: the scene's inputs, completed, and the state if it has one.
struct Case {
    slideway::Inputs inputs;
    slideway::Parts parts;
    double t = 0;
    oracle::State state{};
};
/// Columns are dotted scene keys; what is not a column has its default, friction is on.  A law's own keys are read
/// where the row has that law.
Case case_of(Table const& table, std::size_t row);

/// The computed columns of rhs_*.csv, in their order: derivatives, powers, penetrations, forces, mode, energies.
std::vector<std::string> const& computed_columns();
std::vector<std::string> computed_row(oracle::Result const& result);

struct Difference {
    double value = 0;   // NaN where either side is
    std::string where;  // group, column and row
};
/// The measure for rhs_*.csv: |a - b| over the largest reference entry of the column's group in the row;
/// accelerations over Σ|F|/M where larger; modes as they are.  `got` may have more columns, in any order.
/// @throws std::runtime_error if rows or columns are missing.
Difference worst_difference(Table const& reference, Table const& got);

/// The measure for trajectories.csv: the largest |difference| / (30 u + 1e-7 scale), met at <= 1.  Scales are c for
/// y z, 2c/L_k for the angles, the row's largest entry for vy vz and for ω.
Difference worst_difference(Table const& trajectories, std::size_t row, std::span<double const> got);

}  // namespace golden
