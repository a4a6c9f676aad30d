#include "host/store/result_seal.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/store/provenance.hpp"
#include "host/store/uncovered.hpp"

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

}  // namespace slideway
