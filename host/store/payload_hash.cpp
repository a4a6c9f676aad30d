#include "host/store/payload_hash.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "host/base/fnv1a.hpp"

namespace slideway {

namespace {

void unify_nans(std::vector<std::byte>& bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(double)) {
        double value;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        if (!std::isnan(value)) continue;
        value = std::numeric_limits<double>::quiet_NaN();
        std::memcpy(bytes.data() + at, &value, sizeof value);
    }
}

void add_variable(Fnv1a& hash, NetcdfFile const& file, NetcdfFile::Variable const& variable) {
    hash.add(variable.name);
    hash.add(std::uint64_t{variable.shape.size()});
    for (std::size_t const length : variable.shape) hash.add(std::uint64_t{length});
    if (variable.size() == 0) return;

    std::vector<std::size_t> start(variable.shape.size(), 0), count = variable.shape;
    std::size_t const rows = count.empty() ? 1 : count[0];
    std::size_t const row_bytes = variable.size() / rows * NetcdfFile::size_of(variable.type);
    constexpr std::size_t buffer_bytes = 1 << 22;
    std::size_t const rows_at_once = std::max<std::size_t>(1, buffer_bytes / row_bytes);
    std::vector<std::byte> buffer;
    for (std::size_t row = 0; row < rows; row += rows_at_once) {
        std::size_t const taken = std::min(rows_at_once, rows - row);
        if (!start.empty()) start[0] = row, count[0] = taken;
        buffer.resize(taken * row_bytes);
        file.read(variable.id, start, count, buffer.data());
        if (variable.type == NetcdfFile::Type::float64) unify_nans(buffer);
        hash.add(buffer);
    }
}

void add_group(Fnv1a& hash, NetcdfFile const& group) {
    std::vector<NetcdfFile::Variable> variables = group.variables();
    std::sort(variables.begin(), variables.end(), [](auto const& a, auto const& b) { return a.name < b.name; });
    for (NetcdfFile::Variable const& variable : variables) add_variable(hash, group, variable);
    for (std::string const& name : group.groups()) {
        if (name == verification_group) continue;
        hash.add(name);
        add_group(hash, group.group(name));
    }
}

}  // namespace

std::string payload_hash(NetcdfFile const& file) {
    Fnv1a hash;
    add_group(hash, file);
    return fmt::format("{:016x}", hash.value());
}

}  // namespace slideway
