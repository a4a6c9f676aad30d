#include "host/store/uncovered.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>
#include <netcdf.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

/// Closes an object of HDF5 whatever happens; of one that did not open nothing.
template <herr_t (*close)(hid_t)> auto closing(hid_t const& id) {
    return std::unique_ptr<hid_t const, void (*)(hid_t const*)>(id >= 0 ? &id : nullptr, [](hid_t const* one) { close(*one); });
}

/// Attributes with which netCDF-4 keeps its data model in HDF5, and shows to nobody.
constexpr char const* reserved[] = {"CLASS",          "NAME",                "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS",
                                    "_Netcdf4Dimid", "_Netcdf4Coordinates", "_nc3_strict",    "_NCProperties"};

/// How netCDF-4 calls a variable that has the name of a dimension and lies not along it.
constexpr std::string_view apart_from_dimension = "_nc4_non_coord_";

std::string without_prefix(std::string const& path) {
    auto const at = path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1;
    return path.compare(at, apart_from_dimension.size(), apart_from_dimension) == 0 ? path.substr(0, at) + path.substr(at + apart_from_dimension.size()) : path;
}

template <class Names> std::vector<std::string> listed(hid_t object, Names names) {
    std::vector<std::string> found;
    if (names(object, &found) < 0) throw FileError("its objects cannot be listed");
    return found;
}

std::vector<std::string> links_of(hid_t file) {
    return listed(file, [](hid_t object, void* found) {
        return H5Lvisit(object, H5_INDEX_NAME, H5_ITER_NATIVE, [](hid_t, char const* name, H5L_info_t const*, void* to) -> herr_t {
            static_cast<std::vector<std::string>*>(to)->emplace_back(name);
            return 0;
        }, found);
    });
}

std::vector<std::string> attributes_of(hid_t object) {
    return listed(object, [](hid_t of, void* found) {
        return H5Aiterate2(of, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, [](hid_t, char const* name, H5A_info_t const*, void* to) -> herr_t {
            static_cast<std::vector<std::string>*>(to)->emplace_back(name);
            return 0;
        }, found);
    });
}

/// What HDF5 has beyond the attributes of netCDF-4, in words.
void list_below(std::string const& path, std::map<std::string, std::set<std::string>> const& attributes, std::vector<std::string>& found) {
    hid_t const file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    auto const closing_file = closing<H5Fclose>(file);
    if (file < 0) throw FileError(path + ": cannot open: HDF5 does not open it twice");
    for (std::string const& link : links_of(file)) {
        if (!attributes.contains(without_prefix(link))) found.push_back("object " + link);
    }
    for (auto const& [name, known] : attributes) {
        hid_t const object = H5Oopen(file, name.c_str(), H5P_DEFAULT);
        auto const closing_object = closing<H5Oclose>(object);
        if (object < 0) continue;  // "_nc4_non_coord_": of its dimension's name there is none
        for (std::string const& attribute : attributes_of(object)) {
            if (known.contains(attribute) || std::ranges::count(reserved, std::string_view(attribute)) > 0) continue;
            found.push_back(name == "." ? "attribute " + attribute : fmt::format("attribute of {}: {}", name, attribute));
        }
    }
}

}  // namespace

void NetcdfFile::list_content(std::string const& prefix, std::map<std::string, std::set<std::string>>& attributes, std::vector<std::string>& foreign) const {
    constexpr char const* of_header = "read the header";
    auto const name_of_type = [&](int type) {
        char name[NC_MAX_NAME + 1];
        require(nc_inq_type(id_, type, name, nullptr), of_header);
        return std::string(name);
    };
    auto const list_attributes = [&](int variable, std::string const& path, std::string const& what) {
        std::set<std::string>& names = attributes[path];
        for (std::string const& name : attribute_names(variable)) {
            names.insert(name);
            nc_type type = NC_NAT;
            require(nc_inq_atttype(id_, variable, name.c_str(), &type), "read attribute " + name);
            if (type > NC_MAX_ATOMIC_TYPE) foreign.push_back(what + name);
        }
    };
    int count = 0;
    require(nc_inq_typeids(id_, &count, nullptr), of_header);
    std::vector<int> types(static_cast<std::size_t>(count));
    require(nc_inq_typeids(id_, &count, types.data()), of_header);
    for (int const type : types) {
        attributes.try_emplace(prefix + name_of_type(type));
        foreign.push_back("type " + prefix + name_of_type(type));
    }
    list_attributes(global, prefix.empty() ? "." : prefix.substr(0, prefix.size() - 1), "attribute ");
    require(nc_inq_nvars(id_, &count), of_header);
    for (int i = 0; i < count; ++i) {
        nc_type type = NC_NAT;
        char own[NC_MAX_NAME + 1];
        require(nc_inq_var(id_, i, own, &type, nullptr, nullptr, nullptr), of_header);
        std::string const name = prefix + own;
        if (!stores(type)) foreign.push_back(fmt::format("variable {} of type {}", name, name_of_type(type)));
        list_attributes(i, name, fmt::format("attribute of {}: ", name));
    }
    for (Dimension const& dimension : dimensions()) attributes.try_emplace(prefix + dimension.name);
    for (std::string const& name : groups()) inner(name).list_content(prefix + name + "/", attributes, foreign);
}

std::vector<std::string> uncovered(NetcdfFile const& file) {
    std::map<std::string, std::set<std::string>> attributes;
    std::vector<std::string> found;
    file.list_content("", attributes, found);
    if (file.is_on_disk()) list_below(file.path(), attributes, found);
    return found;
}

}  // namespace slideway
