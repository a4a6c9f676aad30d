// Attributes of netCDF files as they are read.
#include <algorithm>
#include <cstdint>

#include <netcdf.h>

#include "host/store/netcdf_file.hpp"

namespace slideway {

std::vector<std::string> NetcdfFile::attribute_names(int variable) const {
    int count = 0;
    require(nc_inq_varnatts(id_, variable, &count), "read the header");
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        char name[NC_MAX_NAME + 1];
        require(nc_inq_attname(id_, variable, i, name), "read the header");
        names.emplace_back(name);
    }
    std::ranges::sort(names);
    return names;
}

/// Its texts, of an attribute of strings.
std::vector<std::string> NetcdfFile::strings(int variable, std::string const& name, std::size_t count) const {
    std::vector<char*> strings(count, nullptr);
    require(nc_get_att_string(id_, variable, name.c_str(), strings.data()), "read attribute " + name);
    std::vector<std::string> texts;
    texts.reserve(count);
    for (char const* const one : strings) texts.emplace_back(one != nullptr ? one : "");
    nc_free_string(count, strings.data());
    return texts;
}

std::vector<std::byte> NetcdfFile::attribute_bytes(int variable, std::string const& name) const {
    std::size_t count = 0, width = 0;
    nc_type type = NC_NAT;
    require(nc_inq_att(id_, variable, name.c_str(), &type, &count), "read attribute " + name);
    std::uint64_t const head[2] = {static_cast<std::uint64_t>(type), count};
    auto const head_bytes = std::as_bytes(std::span(head));
    std::vector<std::byte> bytes(head_bytes.begin(), head_bytes.end());
    if (type == NC_STRING) {
        for (std::string const& one : strings(variable, name, count)) {
            auto const of_one = std::as_bytes(std::span(one.c_str(), one.size() + 1));
            bytes.insert(bytes.end(), of_one.begin(), of_one.end());
        }
        return bytes;
    }
    if (type > NC_MAX_ATOMIC_TYPE) return bytes;  // may hold addresses of this process; `uncovered` tells of it
    require(nc_inq_type(id_, type, nullptr, &width), "read attribute " + name);
    bytes.resize(sizeof head + count * width);
    if (count * width > 0) require(nc_get_att(id_, variable, name.c_str(), bytes.data() + sizeof head), "read attribute " + name);
    return bytes;
}

std::optional<DataFile::Value> NetcdfFile::attribute(int variable, std::string const& name) const {
    std::size_t length = 0;
    nc_type type = NC_NAT;
    int const code = nc_inq_att(id_, variable, name.c_str(), &type, &length);
    if (code == NC_ENOTATT) return {};
    require(code, "read attribute " + name);  // one that cannot be read is not taken for none
    if (type == NC_CHAR) {
        std::string value(length, '\0');
        require(nc_get_att_text(id_, variable, name.c_str(), value.data()), "read attribute " + name);
        return value;
    }
    if (length != 1) return {};
    if (type == NC_STRING) return strings(variable, name, 1).front();
    double number = 0;
    return nc_get_att_double(id_, variable, name.c_str(), &number) == NC_NOERR ? std::optional<Value>(number) : std::nullopt;
}

}  // namespace slideway
