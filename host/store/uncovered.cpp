#include "host/store/uncovered.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>
#include <netcdf.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

/// An object of HDF5 that is closed whatever happens.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    Handle(Handle const&) = delete;
    Handle& operator=(Handle const&) = delete;
    hid_t get() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

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

}  // namespace

/// Walks through the groups of a file.
class UncoveredContent {
public:
    void look_at(NetcdfFile const& group, std::string const& prefix) {
        look_at_types(group, prefix);
        std::set<std::string>& own = attributes_[prefix.empty() ? std::string(".") : prefix.substr(0, prefix.size() - 1)];
        look_at_attributes(group, NC_GLOBAL, "", own);
        look_at_variables(group, prefix);
        for (DataFile::Dimension const& dimension : group.dimensions()) attributes_.try_emplace(prefix + dimension.name);
        for (std::string const& name : group.groups()) look_at(group.inner(name), prefix + name + "/");
    }

    /// What HDF5 has beyond all that.
    void look_below(std::string const& path) {
        Handle const file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
        if (file.get() < 0) throw FileError(path + ": cannot open: HDF5 does not open it twice");
        for (std::string const& link : links_of(file.get())) {
            if (!attributes_.contains(without_prefix(link))) found_.push_back("object " + link);
        }
        for (auto const& [name, known] : attributes_) {
            Handle const object(H5Oopen(file.get(), name.c_str(), H5P_DEFAULT), H5Oclose);
            if (object.get() < 0) continue;  // "_nc4_non_coord_": of its dimension's name there is none
            for (std::string const& attribute : attributes_of(object.get())) {
                if (known.contains(attribute) || std::ranges::count(reserved, std::string_view(attribute)) > 0) continue;
                found_.push_back(name == "." ? "attribute " + attribute : fmt::format("attribute of {}: {}", name, attribute));
            }
        }
    }

    std::vector<std::string> take() { return std::move(found_); }

private:
    void look_at_types(NetcdfFile const& group, std::string const& prefix) {
        int count = 0;
        group.require(nc_inq_typeids(group.id_, &count, nullptr), "read the header");
        std::vector<int> ids(static_cast<std::size_t>(count));
        group.require(nc_inq_typeids(group.id_, &count, ids.data()), "read the header");
        for (int const id : ids) {
            attributes_.try_emplace(prefix + name_of_type(group, id));
            found_.push_back("type " + prefix + name_of_type(group, id));
        }
    }

    void look_at_variables(NetcdfFile const& group, std::string const& prefix) {
        int count = 0;
        group.require(nc_inq_nvars(group.id_, &count), "read the header");
        for (int i = 0; i < count; ++i) {
            nc_type type = NC_NAT;
            char own[NC_MAX_NAME + 1];
            group.require(nc_inq_var(group.id_, i, own, &type, nullptr, nullptr, nullptr), "read the header");
            std::string const name = prefix + own;
            if (!NetcdfFile::stores(type)) found_.push_back(fmt::format("variable {} of type {}", name, name_of_type(group, type)));
            look_at_attributes(group, i, name, attributes_[name]);
        }
    }

    void look_at_attributes(NetcdfFile const& group, int variable, std::string const& of, std::set<std::string>& names) {
        for (std::string const& name : group.attribute_names(variable)) {
            names.insert(name);
            nc_type type = NC_NAT;
            group.require(nc_inq_atttype(group.id_, variable, name.c_str(), &type), "read attribute " + name);
            if (type > NC_MAX_ATOMIC_TYPE) found_.push_back(of.empty() ? "attribute " + name : fmt::format("attribute of {}: {}", of, name));
        }
    }

    static std::string name_of_type(NetcdfFile const& group, int type) {
        char name[NC_MAX_NAME + 1];
        group.require(nc_inq_type(group.id_, type, name, nullptr), "read the header");
        return name;
    }

    std::vector<std::string> found_;
    std::map<std::string, std::set<std::string>> attributes_;  // of netCDF-4, by the path of what has them
};

std::vector<std::string> uncovered(NetcdfFile const& file) {
    UncoveredContent content;
    content.look_at(file, "");
    if (file.is_on_disk()) content.look_below(file.path());
    return content.take();
}

}  // namespace slideway
