// Small arrays into a group of a netCDF file, defined and written in one go.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/store/netcdf_file.hpp"

namespace slideway {

class GroupWriter {
public:
    GroupWriter(NetcdfFile& file, std::string const& name) : group_(file.add_group(name)) {}

    void attribute(std::string const& name, std::string const& text);
    void attribute(std::string const& name, double number);
    void dimension(std::string const& name, std::size_t length);
    /// A dimension with a text for each entry, in the variable `<name>_name`.
    void labels(std::string const& name, std::string const& long_name, std::vector<std::string> const& labels);
    /// A text for each entry of a dimension, in the variable `<name>_name`.
    void texts(std::string const& name, std::string const& dimension, std::string const& long_name,
               std::vector<std::string> const& texts);

    struct Description {
        std::string name;
        std::string unit;
        std::string long_name;
        std::vector<std::string> dimensions;  // of this group or the file; none: one number
        std::string coordinates;              // names of label variables; "": no attribute
    };
    /// Values in C order.
    void numbers(Description const& description, std::span<double const> values);
    void counts(Description const& description, std::span<int const> values);

private:
    int define(Description const& description, NetcdfFile::Type type);
    void write(int variable, void const* values);

    NetcdfFile group_;
};

}  // namespace slideway
