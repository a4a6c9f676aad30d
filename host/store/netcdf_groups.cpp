#include <algorithm>

#include <netcdf.h>

#include "host/store/netcdf_file.hpp"

namespace slideway {

NetcdfFile NetcdfFile::add_group(std::string const& name) {
    int id = 0;
    require(nc_def_grp(id_, name.c_str(), &id), "define group " + name);
    return {path_, id, Kind::group};
}

NetcdfFile NetcdfFile::group(std::string const& name) const {
    int id = 0;
    require(nc_inq_ncid(id_, name.c_str(), &id), "find group " + name);
    return {path_, id, Kind::group};
}

bool NetcdfFile::has_group(std::string const& name) const {
    auto const names = groups();
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> NetcdfFile::groups() const {
    int count = 0;
    require(nc_inq_grps(id_, &count, nullptr), "read the header");
    std::vector<int> ids(static_cast<std::size_t>(count));
    require(nc_inq_grps(id_, &count, ids.data()), "read the header");
    std::vector<std::string> names;
    for (int const id : ids) {
        char name[NC_MAX_NAME + 1];
        require(nc_inq_grpname(id, name), "read the header");
        names.emplace_back(name);
    }
    return names;
}

int NetcdfFile::dimension(std::string const& name) const {
    int dimension = 0;
    require(nc_inq_dimid(id_, name.c_str(), &dimension), "find dimension " + name);
    return dimension;
}

}  // namespace slideway
