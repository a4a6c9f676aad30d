#include "host/store/netcdf_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/base/open_file.hpp"
#include "host/base/process.hpp"

namespace slideway {

static_assert(NetcdfFile::global == NC_GLOBAL);
namespace {

constexpr int closed = -1;
constexpr char const* of_header = "read the header";

/// netCDF's number of each type and the bytes of a value, in the order of NetcdfFile::Type.
constexpr struct StoredType {
    nc_type number;
    std::size_t bytes;
} type_table[] = {{NC_BYTE, 1}, {NC_INT, 4}, {NC_DOUBLE, 8}, {NC_CHAR, 1}};

[[noreturn]] void fail(std::string const& path, std::string_view action, int code) {
    // HDF5 has one reason for all that goes wrong within it.
    constexpr std::uint64_t scarce = 16 << 20;
    require_memory(scarce);
    bool const reads = action.starts_with("read") || action == "open";
    throw FileError(fmt::format("{}: cannot {}: {}{}", path, action, nc_strerror(code),
                                reads && code <= NC_EHDFERR && code >= NC4_LAST_ERROR ? "; the file is damaged, or its disk fails" : ""));
}

/// netCDF asks HDF5 for attributes that need not be there, and silences its complaints in the first thread alone.
void silence_hdf5() {
    thread_local herr_t const silent = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    static_cast<void>(silent);
}

/// Where an HDF5 file in memory ends: the memory grows by 64 KiB at a time, and what lies behind the end is empty.  The
/// superblock says it (HDF5 File Format Specification 3.0, II.A), in another place since version 2.
std::size_t end_of_file(std::span<std::byte const> image) {
    constexpr std::size_t version_at = 8, size_of_superblock = 48;
    if (image.size() < size_of_superblock) return image.size();
    bool const is_old = std::to_integer<int>(image[version_at]) < 2;
    if (std::to_integer<int>(image[is_old ? 13 : 9]) != 8) return image.size();  // bytes of an address
    std::uint64_t end = 0;
    for (std::size_t i = 8; i-- > 0;) end = end << 8 | std::to_integer<std::uint64_t>(image[(is_old ? 40 : 28) + i]);
    return static_cast<std::size_t>(std::min<std::uint64_t>(end, image.size()));
}

/// What a call that opens or makes a file gives it as its number.
template <class Call> int number_of(std::string const& path, std::string_view action, Call call) {
    silence_hdf5();
    int id = closed;
    if (int const code = call(&id); code != NC_NOERR) fail(path, action, code);
    return id;
}

}  // namespace

void NetcdfFile::require(int code, std::string_view action) const {
    if (code != NC_NOERR) fail(path_, action, code);
}

/// A name that a call writes.
template <class Call> std::string NetcdfFile::name_by(Call call) const {
    char name[NC_MAX_NAME + 1];
    require(call(name), of_header);
    return name;
}

/// A number that a call writes.
template <class Call> int NetcdfFile::number_by(std::string_view action, Call call) const {
    int number = 0;
    require(call(&number), action);
    return number;
}

bool NetcdfFile::stores(int type) { return std::ranges::count(type_table, type, &StoredType::number) > 0; }

NetcdfFile NetcdfFile::create(std::string const& path) {
    return {path, number_of(path, "create", [&](int* id) { return nc_create(path.c_str(), NC_NOCLOBBER | NC_NETCDF4, id); }), Kind::written};
}

NetcdfFile NetcdfFile::open(std::string const& path) {
    require_file(path);
    return {path, number_of(path, "open", [&](int* id) {
                int const code = nc_open(path.c_str(), NC_NOWRITE, id);
                if (code == NC_ENOTNC) throw FileError(path + ": is no netCDF file; give a result of slideway run");
                return code;
            }), Kind::read};
}

NetcdfFile NetcdfFile::create_in_memory(std::string const& name) {
    constexpr std::size_t first_size = 1 << 16;  // netCDF takes no less
    return {name, number_of(name, "create", [&](int* id) { return nc_create_mem(name.c_str(), NC_NETCDF4, first_size, id); })};
}

std::vector<std::byte> NetcdfFile::close_to_bytes() {
    NC_memio memory{};
    require(nc_close_memio(std::exchange(id_, closed), &memory), "close");
    auto const* const begin = static_cast<std::byte const*>(memory.memory);
    std::vector<std::byte> bytes(begin, begin + end_of_file({begin, memory.size}));
    std::free(memory.memory);
    return bytes;
}

NetcdfFile NetcdfFile::open_in_memory(std::string const& name, std::vector<std::byte> bytes) {
    NetcdfFile file(name, number_of(name, "open", [&](int* id) { return nc_open_mem(name.c_str(), NC_NOWRITE, bytes.size(), bytes.data(), id); }));
    file.bytes_ = std::move(bytes);  // they stay where they are
    return file;
}

NetcdfFile::NetcdfFile(NetcdfFile&& other) noexcept
    : path_(std::move(other.path_)), id_(std::exchange(other.id_, closed)), kind_(other.kind_), bytes_(std::move(other.bytes_)) {}

NetcdfFile::~NetcdfFile() {
    if (id_ == closed || kind_ == Kind::group) return;
    bool ignored = false;
    close_with_reason(ignored);
}

/// netCDF 4.9 crashes over a file whose last write fails as HDF5 closes it.  With a handle of our own HDF5 closes it for us, and
/// says so.  Where there is no handle to be had, netCDF's word is all there is.
int NetcdfFile::close_with_reason(bool& hdf5_failed) noexcept {
    hid_t const own = kind_ == Kind::written ? H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT) : H5I_INVALID_HID;
    int const code = nc_close(std::exchange(id_, closed));
    hdf5_failed = own >= 0 && H5Fclose(own) < 0;
    return code;
}

void NetcdfFile::close() {
    bool hdf5_failed = false;
    int const code = close_with_reason(hdf5_failed);
    int const reason = errno;
    require(code, "close");
    if (hdf5_failed) throw FileError(fmt::format("{}: cannot write its end: {}", path_, std::strerror(reason)));
}

int NetcdfFile::add_dimension(std::string const& name, std::size_t length) {
    return number_by("define dimension " + name, [&](int* dimension) { return nc_def_dim(id_, name.c_str(), length, dimension); });
}

int NetcdfFile::add_variable(std::string const& name, Type type, std::span<int const> dimensions, bool fill) {
    nc_type const number = type_table[static_cast<int>(type)].number;
    int const rank = static_cast<int>(dimensions.size());
    int const variable = number_by("define variable " + name, [&](int* id) { return nc_def_var(id_, name.c_str(), number, rank, dimensions.data(), id); });
    require(nc_def_var_fill(id_, variable, fill ? NC_FILL : NC_NOFILL, fill ? &nan : nullptr), "define variable " + name);
    return variable;
}

void NetcdfFile::put(int variable, std::string const& name, Value const& value) {
    int code = NC_NOERR;
    if (auto const* const text = std::get_if<std::string>(&value)) {
        // netCDF marks texts as ASCII; only its strings are UTF-8 to other readers.
        bool const ascii = std::ranges::all_of(*text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
        char const* string = text->c_str();
        code = ascii ? nc_put_att_text(id_, variable, name.c_str(), text->size(), string) : nc_put_att_string(id_, variable, name.c_str(), 1, &string);
    } else if (auto const* const real = std::get_if<double>(&value)) {
        code = nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, 1, real);
    } else if (auto const* const whole = std::get_if<int>(&value)) {
        code = nc_put_att_int(id_, variable, name.c_str(), NC_INT, 1, whole);
    } else {
        auto const& bytes = std::get<std::vector<signed char>>(value);
        code = nc_put_att_schar(id_, variable, name.c_str(), NC_BYTE, bytes.size(), bytes.data());
    }
    require(code, "write attribute " + name);
}

void NetcdfFile::flush() { require(nc_sync(id_), "write (disk full?)"); }

void NetcdfFile::write(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void const* values) {
    require(nc_put_vara(id_, variable, start.data(), count.data(), values), "write (disk full?)");
}

void NetcdfFile::write(int variable, void const* values) { require(nc_put_var(id_, variable, values), "write (disk full?)"); }

void NetcdfFile::read(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void* values) const {
    require(nc_get_vara(id_, variable, start.data(), count.data(), values), "read");
}

std::unique_ptr<DataFile> NetcdfFile::add_group(std::string const& name) {
    int const id = number_by("define group " + name, [&](int* group) { return nc_def_grp(id_, name.c_str(), group); });
    return std::unique_ptr<DataFile>(new NetcdfFile(path_, id, Kind::group));
}

std::unique_ptr<DataFile> NetcdfFile::group(std::string const& name) const { return std::make_unique<NetcdfFile>(inner(name)); }

NetcdfFile NetcdfFile::inner(std::string const& name) const {
    return {path_, number_by("find group " + name, [&](int* group) { return nc_inq_ncid(id_, name.c_str(), group); }), Kind::group};
}

std::vector<std::string> NetcdfFile::groups() const {
    int count = number_by(of_header, [&](int* groups) { return nc_inq_grps(id_, groups, nullptr); });
    std::vector<int> ids(static_cast<std::size_t>(count));
    require(nc_inq_grps(id_, &count, ids.data()), of_header);
    std::vector<std::string> names;
    names.reserve(ids.size());
    for (int const id : ids) names.push_back(name_by([&](char* name) { return nc_inq_grpname(id, name); }));
    return names;
}

int NetcdfFile::dimension(std::string const& name) const {
    return number_by("find dimension " + name, [&](int* dimension) { return nc_inq_dimid(id_, name.c_str(), dimension); });
}

std::vector<NetcdfFile::Dimension> NetcdfFile::dimensions() const {
    int count = number_by(of_header, [&](int* dimensions) { return nc_inq_ndims(id_, dimensions); });
    std::vector<Dimension> dimensions;
    // Numbers of dimensions go through the whole file: those of a group need not start at 0.
    std::vector<int> ids(static_cast<std::size_t>(count));
    require(nc_inq_dimids(id_, &count, ids.data(), 0), of_header);
    for (int const id : ids) {
        std::size_t length = 0;
        std::string name = name_by([&](char* text) { return nc_inq_dim(id_, id, text, &length); });
        dimensions.push_back({std::move(name), length});
    }
    return dimensions;
}

std::vector<NetcdfFile::Variable> NetcdfFile::variables() const {
    int const count = number_by(of_header, [&](int* variables) { return nc_inq_nvars(id_, variables); });
    std::vector<Variable> variables;
    for (int i = 0; i < count; ++i) {
        nc_type number = NC_NAT;
        int rank = 0, dimensions[NC_MAX_VAR_DIMS];
        std::string name = name_by([&](char* text) { return nc_inq_var(id_, i, text, &number, &rank, dimensions, nullptr); });
        auto const type = std::ranges::find(type_table, number, &StoredType::number);
        if (type == std::end(type_table)) continue;  // `uncovered` tells of it
        Variable& variable = variables.emplace_back(Variable{i, std::move(name), static_cast<Type>(type - std::begin(type_table)), {}});
        for (int d = 0; d < rank; ++d) {
            std::size_t& length = variable.shape.emplace_back();
            variable.dimensions.push_back(name_by([&](char* text) { return nc_inq_dim(id_, dimensions[d], text, &length); }));
        }
    }
    return variables;
}

// Attributes of netCDF files as they are read.

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
