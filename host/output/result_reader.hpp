// Reads a result file back.
#pragma once

#include <string>
#include <vector>

#include "host/output/netcdf_file.hpp"

namespace slideway {

class ResultReader {
public:
    /// @throws FileError if the file is missing, not netCDF, or not a result of slideway.
    explicit ResultReader(std::string const& path);

    std::vector<NetcdfFile::Dimension> dimensions() const { return file_.dimensions(); }
    std::string attribute(std::string const& name) const;  // as text, also numbers; "" when there is none
    bool has(std::string const& variable) const;
    std::vector<std::string> variable_names() const;
    std::string unit(std::string const& variable) const;
    std::string long_name(std::string const& variable) const;
    /// All values in C order.  @throws FileError if there is no such variable or it is not a number.
    std::vector<double> values(std::string const& variable) const;
    std::vector<std::size_t> shape(std::string const& variable) const;

    std::string stored_hash() const { return attribute("payload_hash"); }
    std::string computed_hash() const;  // reads all data

private:
    NetcdfFile::Variable const& find(std::string const& variable) const;

    NetcdfFile file_;
    std::vector<NetcdfFile::Variable> variables_;
};

}  // namespace slideway
