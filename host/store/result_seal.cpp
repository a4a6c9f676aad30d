#include "host/store/result_seal.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>
#include <netcdf.h>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/store/run_identity.hpp"

namespace slideway {
namespace {

constexpr char const *version_name = "format_version", *payload_name = "payload_hash", *metadata_name = "metadata_hash";

void unify_nans(std::vector<std::byte>& bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(double)) {
        double value;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        if (!std::isnan(value)) continue;
        value = nan;
        std::memcpy(bytes.data() + at, &value, sizeof value);
    }
}

void add_variable(Fnv1a& hash, DataFile const& file, DataFile::Variable const& variable) {
    hash.add(variable.name);
    hash.add(std::uint64_t{variable.shape.size()});
    for (std::size_t const length : variable.shape) hash.add(std::uint64_t{length});
    if (variable.size() == 0) return;

    std::vector<std::size_t> start(variable.shape.size(), 0), count = variable.shape;
    std::size_t const rows = count.empty() ? 1 : count[0];
    std::size_t const row_bytes = variable.size() / rows * DataFile::size_of(variable.type);
    constexpr std::size_t buffer_bytes = 1 << 22;
    std::size_t const rows_at_once = std::max<std::size_t>(1, buffer_bytes / row_bytes);
    std::vector<std::byte> buffer;
    for (std::size_t row = 0; row < rows; row += rows_at_once) {
        std::size_t const taken = std::min(rows_at_once, rows - row);
        if (!start.empty()) start[0] = row, count[0] = taken;
        buffer.resize(taken * row_bytes);
        file.read(variable.id, start, count, buffer.data());
        if (variable.type == DataFile::Type::float64) unify_nans(buffer);
        hash.add(buffer);
    }
}

template <class T> std::vector<T> by_name(std::vector<T> list) {
    std::sort(list.begin(), list.end(), [](T const& a, T const& b) { return a.name < b.name; });
    return list;
}

void add_group(Fnv1a& hash, DataFile const& group) {
    for (DataFile::Variable const& variable : by_name(group.variables())) add_variable(hash, group, variable);
    for (std::string const& name : group.groups()) {
        if (name == verification_group) continue;
        hash.add(name);
        add_group(hash, *group.group(name));
    }
}

/// A text and where it ends.
void add_name(Fnv1a& hash, std::string const& name) {
    hash.add(std::uint64_t{name.size()});
    hash.add(name);
}

void add_attributes(Fnv1a& hash, NetcdfFile const& file, int variable) {
    for (std::string const& name : file.attribute_names(variable)) {
        if (variable == DataFile::global && (name == payload_name || name == metadata_name)) continue;
        add_name(hash, name);
        hash.add(file.attribute_bytes(variable, name));
    }
}

void add_metadata(Fnv1a& hash, NetcdfFile const& group) {
    for (DataFile::Dimension const& dimension : by_name(group.dimensions())) {
        add_name(hash, dimension.name);
        hash.add(std::uint64_t{dimension.length});
    }
    add_attributes(hash, group, DataFile::global);
    for (DataFile::Variable const& variable : by_name(group.variables())) {
        add_name(hash, variable.name);
        hash.add(static_cast<std::uint64_t>(variable.type));
        for (std::string const& name : variable.dimensions) add_name(hash, name);
        add_attributes(hash, group, variable.id);
    }
    std::vector<std::string> groups = group.groups();
    std::sort(groups.begin(), groups.end());
    for (std::string const& name : groups) {
        NetcdfFile const inner = group.inner(name);
        add_name(hash, name);
        add_metadata(hash, inner);
        if (name == verification_group) add_group(hash, inner);
    }
}

std::string text_of(Fnv1a const& hash) { return fmt::format("{:016x}", hash.value()); }

}  // namespace

std::string payload_hash(DataFile const& file) {
    Fnv1a hash;
    add_group(hash, file);
    return text_of(hash);
}

std::string metadata_hash(NetcdfFile const& file) {
    Fnv1a hash;
    add_metadata(hash, file);
    return text_of(hash);
}

void seal(NetcdfFile& file) {
    file.put(DataFile::global, version_name, format_version);
    file.put(DataFile::global, metadata_name, metadata_hash(file));
    file.put(DataFile::global, payload_name, payload_hash(file));
}

int format_of(DataFile const& file) {
    double const version = file.number(DataFile::global, version_name).value_or(1);
    if (version > format_version) {
        throw FileError(fmt::format("{}: is of format {}, and slideway {} reads formats 1 to {}; read it with a newer version", file.path(),
                                    version, build_info().version, format_version));
    }
    bool const is_known = version >= 1 && version == std::floor(version);
    return is_known ? static_cast<int>(version) : format_version;  // any other number is damage, which the hash tells
}

SealCheck check_seal(NetcdfFile const& file) {
    return {format_of(file), file.text(DataFile::global, payload_name), file.text(DataFile::global, metadata_name), payload_hash(file),
            metadata_hash(file), fmt::format("{}", fmt::join(uncovered(file), ", "))};
}

std::string SealCheck::damage() const {
    if (intact()) return {};
    if (is_only_added_to()) return fmt::format("holds what slideway did not write, and no hash covers ({})", foreign);
    if (metadata_match()) return "the data do not match their hash";
    return data_match() ? "the attributes, names or group verification do not match their hash"
                        : "neither the data nor the attributes match their hashes";
}

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
