// What a file holds that slideway does not write, so that no hash of a result covers it.
#pragma once

#include <string>
#include <vector>

#include "host/store/netcdf_file.hpp"

namespace slideway {

/// In words, by name: "variable extra of type float", "type mine", "attribute of y: weights", "object notes".  Of the data model of netCDF-4
/// variables of other types than `DataFile::Type`, types of a user's own and attributes of these; of a file on the disk also objects and
/// attributes of HDF5 that netCDF-4 does not see.  All else, of any name, is covered by one of the hashes.
std::vector<std::string> uncovered(NetcdfFile const& file);

}  // namespace slideway
