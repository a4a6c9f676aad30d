// What a result is made of.  Whatever defines, writes, merges, measures or describes results goes through lists of columns: one more of
// them is one more entry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "host/run/block_buffers.hpp"
#include "host/run/member_set.hpp"
#include "host/store/data_file.hpp"

namespace slideway {

/// A member of a block that has ended.
struct EndedMember {
    BlockResult const& block;
    std::size_t place;              // in the block
    std::span<double const> study;  // what the study concludes of it
    std::uint64_t member() const { return block.members[place]; }
    MemberRecord const& record() const { return block.records[place]; }
};

struct ResultColumn {
    using Numbers = std::vector<double>;  // also of columns that store other types
    std::string name;
    std::string unit;                          // "": no attribute
    std::string meaning;                       // attribute long_name
    std::vector<std::string> dimensions = {};  // slowest first; none: one number
    std::string coordinates = {};              // names of label variables; "": no attribute
    /// Of a column along `member` or `section`: appends what a member has come to, for each of its sections there.
    std::function<void(EndedMember const& row, Numbers& out)> source = {};
    DataFile::Type type = DataFile::Type::float64;
    /// The same where it has not run, by its number; NaN without it.
    std::function<void(std::uint64_t member, Numbers& out)> before = {};
    Numbers values = {};  // of a column that no member changes
    std::vector<DataFile::Attribute> attributes = {};
    bool summarised = false;  // by commands, over the members that finished
};

/// Columns, in their order in the file, with the dimensions they lie along and what the file says of itself.
struct ResultColumns {
    std::vector<DataFile::Dimension> dimensions;
    std::vector<ResultColumn> columns;
    std::vector<DataFile::Attribute> attributes = {};

    std::size_t size(ResultColumn const& column) const;   // of all its values
    std::size_t width(ResultColumn const& column) const;  // of those along all dimensions but the first
    bool has_dimension(std::string const& name) const { return std::ranges::count(dimensions, name, &DataFile::Dimension::name) > 0; }
    /// A dimension of the quantity table (apex, mode_class, axis, direction, channel, face) with its labels in the column `<name>_name`.
    void add_labels_of(std::string const& dimension);
};

/// Defines and describes all columns, and writes what is known before any member is.  @param members along `member`
/// @return the variables  @throws FileError, also if the numbers of members are beyond 32 bits
std::vector<int> define(DataFile& file, ResultColumns const& list, MemberSet const& members = {});
/// Numbers into a variable of a column, from `first` along its first dimension on.
void put_numbers(DataFile& file, int variable, ResultColumns const& list, ResultColumn const& column, ResultColumn::Numbers const& numbers,
                 std::size_t first = 0);

void put_attributes(DataFile& file, int variable, std::vector<DataFile::Attribute> const& attributes);

// Small columns, defined and written in one go.  Their dimensions are of the file or group, or of what this lies in.

int define(DataFile& file, ResultColumn const& column);
/// @param values in C order, as many as the dimensions say
template <std::ranges::contiguous_range Values> void put(DataFile& file, ResultColumn column, Values const& values) {
    column.type = DataFile::type_of<std::ranges::range_value_t<Values>>;
    file.write(define(file, column), std::ranges::data(values));
}
inline void put(DataFile& file, ResultColumn const& column, int value) { put(file, column, std::span(&value, 1)); }
inline void put(DataFile& file, ResultColumn const& column, double value) { put(file, column, std::span(&value, 1)); }
/// The texts of a variable of them, one for each entry of its first dimension; none of any other variable.
std::vector<std::string> read_texts(DataFile const& file, DataFile::Variable const& variable);
/// A text for each entry of a dimension, in the variable `<name>_name`.
void put_texts(DataFile& file, std::string const& name, std::string const& dimension, std::string const& meaning, std::vector<std::string> const& texts);
/// A dimension with a text for each entry.
void put_labels(DataFile& file, std::string const& name, std::string const& meaning, std::vector<std::string> const& labels);

}  // namespace slideway
