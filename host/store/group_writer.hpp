// Small arrays into a netCDF file, defined and written in one go, and dimensions with a label for each entry.
#pragma once

#include <array>
#include <map>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "host/store/data_file.hpp"

namespace slideway {

class GroupWriter {
public:
    /// Into the file itself; into a new group of it.
    explicit GroupWriter(DataFile& file) : file_(file) {}
    GroupWriter(DataFile& file, std::string const& name) : group_(file.add_group(name)), file_(*group_) {}
    GroupWriter(GroupWriter const&) = delete;

    void attribute(std::string const& name, std::string const& text) { file_.put(DataFile::global, name, text); }
    void attribute(std::string const& name, double number) { file_.put(DataFile::global, name, number); }
    void dimension(std::string const& name, std::size_t length) { file_.add_dimension(name, length); }
    /// A dimension with a text for each entry, in the variable `<name>_name`.
    void labels(std::string const& name, std::string const& long_name, std::vector<std::string> const& labels);
    /// A text for each entry of a dimension, in the variable `<name>_name`.
    void texts(std::string const& name, std::string const& dimension, std::string const& long_name, std::vector<std::string> const& texts);

    struct Description {
        std::string name;
        std::string unit;  // "": no attribute
        std::string long_name;
        std::vector<std::string> dimensions = {};  // of this group or the file; none: one number
        std::string coordinates = {};              // names of label variables; "": no attribute
    };
    /// @param values in C order, as many as the dimensions say  @return the variable
    template <std::ranges::contiguous_range Values> int put(Description const& description, Values const& values) {
        int const variable = define(description, DataFile::type_of<std::ranges::range_value_t<Values>>);
        file_.write(variable, std::ranges::data(values));
        return variable;
    }
    int put(Description const& description, int value) { return put(description, std::span(&value, 1)); }
    int put(Description const& description, double value) { return put(description, std::span(&value, 1)); }

private:
    int define(Description const& description, DataFile::Type type);

    std::unique_ptr<DataFile> group_;
    DataFile& file_;
};

/// A variable of texts along the first of two dimensions, their letters along the second.
int define_texts(DataFile& file, std::string const& name, std::array<int, 2> const& dimensions, std::string const& long_name);

/// Defines the dimensions of the quantity table (apex, mode_class, axis, direction, channel) as they are asked for, each with its labels in
/// `<name>_name`.
class LabelAxes {
public:
    explicit LabelAxes(DataFile& file) : file_(file) {}
    struct Axis {
        int dimension;
        std::string label_name;
    };
    /// Before the end of definitions.
    Axis const& axis(std::string const& name);
    /// The labels; after it.
    void write() const;

private:
    DataFile& file_;
    std::map<std::string, Axis> axes_;
    std::vector<std::pair<int, std::vector<std::string>>> labels_;  // by variable
    int label_dimension_ = -1;
};

}  // namespace slideway
