#include "host/store/memory_file.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/numbers.hpp"

namespace slideway {

/// A file or one of its groups.  The file owns them all: handles share it.
struct MemoryFile::Node {
    struct Stored {
        Variable variable;
        bool fill;
        std::vector<std::byte> data = {};
        std::vector<Attribute> attributes = {};
    };

    std::string path, name;
    Node* outer = nullptr;                                // of a group
    std::shared_ptr<std::vector<Dimension>> all;          // of the whole file, by number
    std::vector<int> dimensions;                          // numbers of its own
    std::vector<Stored> variables;
    std::vector<Attribute> attributes;
    std::vector<std::unique_ptr<Node>> groups;

    Stored& stored(int id) { return variables.at(static_cast<std::size_t>(id)); }
    std::vector<Attribute>& attributes_of(int id) { return id == global ? attributes : stored(id).attributes; }
};

namespace {

/// Calls copy(offset in the variable, offset in the values, bytes) for each stretch of a hyperslab that is contiguous in the variable.
template <class Copy>
void for_each_stretch(std::span<std::size_t const> shape, std::span<std::size_t const> start, std::span<std::size_t const> count,
                      std::size_t width, Copy const& copy, std::size_t place = 0, std::size_t taken = 0) {
    auto const product = [](std::span<std::size_t const> lengths) {
        return std::accumulate(lengths.begin(), lengths.end(), std::size_t{1}, std::multiplies<>());
    };
    std::size_t const wanted = product(count);
    if (wanted == 0) return;
    if (shape.empty()) return copy(place, taken, width);
    std::size_t const inner = product(shape.subspan(1));
    std::size_t const wanted_inner = wanted / count[0];
    place += start[0] * inner * width;
    if (wanted_inner == inner) return copy(place, taken, wanted * width);
    for (std::size_t i = 0; i < count[0]; ++i) {
        for_each_stretch(shape.subspan(1), start.subspan(1), count.subspan(1), width, copy, place + i * inner * width,
                         taken + i * wanted_inner * width);
    }
}

void require_within(std::string const& path, std::span<std::size_t const> shape, std::span<std::size_t const> start,
                    std::span<std::size_t const> count) {
    bool within = start.size() == shape.size() && count.size() == shape.size();
    for (std::size_t d = 0; within && d < shape.size(); ++d) within = start[d] <= shape[d] && count[d] <= shape[d] - start[d];
    if (!within) throw FileError(path + ": a part of a variable that it does not have");
}

}  // namespace

MemoryFile::MemoryFile(std::string name) : node_(std::make_shared<Node>()) {
    node_->path = std::move(name);
    node_->all = std::make_shared<std::vector<Dimension>>();
}

std::string const& MemoryFile::path() const { return node_->path; }

int MemoryFile::add_dimension(std::string const& name, std::size_t length) {
    node_->all->push_back({name, length});
    node_->dimensions.push_back(static_cast<int>(node_->all->size()) - 1);
    return node_->dimensions.back();
}

int MemoryFile::add_variable(std::string const& name, Type type, std::span<int const> dimensions, bool fill) {
    Node::Stored stored{{static_cast<int>(node_->variables.size()), name, type, {}}, fill};
    for (int const number : dimensions) {
        Dimension const& dimension = node_->all->at(static_cast<std::size_t>(number));
        stored.variable.shape.push_back(dimension.length);
        stored.variable.dimensions.push_back(dimension.name);
    }
    stored.data.resize(stored.variable.size() * size_of(type));
    for (std::size_t at = 0; fill && type == Type::float64 && at < stored.data.size(); at += sizeof nan) std::memcpy(stored.data.data() + at, &nan, sizeof nan);
    node_->variables.push_back(std::move(stored));
    return node_->variables.back().variable.id;
}

std::vector<MemoryFile::Attribute> const& MemoryFile::attributes(int variable) const { return node_->attributes_of(variable); }

void MemoryFile::put(int variable, std::string const& name, Value const& value) {
    auto& list = node_->attributes_of(variable);
    auto const found = std::ranges::find(list, name, &Attribute::name);
    if (found != list.end())
        found->value = value;
    else
        list.push_back({name, value});
}

void MemoryFile::write(int variable, void const* values) {
    auto& data = node_->stored(variable).data;
    if (!data.empty()) std::memcpy(data.data(), values, data.size());
}

void MemoryFile::write(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void const* values) {
    Node::Stored& stored = node_->stored(variable);
    require_within(path(), stored.variable.shape, start, count);
    for_each_stretch(stored.variable.shape, start, count, size_of(stored.variable.type), [&](std::size_t place, std::size_t from, std::size_t bytes) {
        std::memcpy(stored.data.data() + place, static_cast<std::byte const*>(values) + from, bytes);
    });
}

void MemoryFile::read(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void* values) const {
    Node::Stored const& stored = node_->stored(variable);
    require_within(path(), stored.variable.shape, start, count);
    for_each_stretch(stored.variable.shape, start, count, size_of(stored.variable.type), [&](std::size_t place, std::size_t to, std::size_t bytes) {
        std::memcpy(static_cast<std::byte*>(values) + to, stored.data.data() + place, bytes);
    });
}

std::unique_ptr<DataFile> MemoryFile::add_group(std::string const& name) {
    auto& group = *node_->groups.emplace_back(std::make_unique<Node>());
    group.path = node_->path;
    group.name = name;
    group.outer = node_.get();
    group.all = node_->all;
    return std::unique_ptr<DataFile>(new MemoryFile({node_, &group}));
}

MemoryFile MemoryFile::inner(std::string const& name) const {
    auto const found = std::ranges::find(node_->groups, name, [](auto const& group) { return group->name; });
    if (found == node_->groups.end()) throw FileError(fmt::format("{}: cannot find group {}", path(), name));
    return MemoryFile({node_, found->get()});
}

std::unique_ptr<DataFile> MemoryFile::group(std::string const& name) const { return std::make_unique<MemoryFile>(inner(name)); }

std::vector<std::string> MemoryFile::groups() const {
    std::vector<std::string> names;
    for (auto const& group : node_->groups) names.push_back(group->name);
    return names;
}

int MemoryFile::dimension(std::string const& name) const {
    for (Node const* node = node_.get(); node != nullptr; node = node->outer) {
        for (int const number : node->dimensions) {
            if ((*node->all)[static_cast<std::size_t>(number)].name == name) return number;
        }
    }
    throw FileError(fmt::format("{}: cannot find dimension {}", path(), name));
}

std::vector<MemoryFile::Dimension> MemoryFile::dimensions() const {
    std::vector<Dimension> own;
    for (int const number : node_->dimensions) own.push_back((*node_->all)[static_cast<std::size_t>(number)]);
    return own;
}

std::vector<MemoryFile::Variable> MemoryFile::variables() const {
    std::vector<Variable> list;
    for (Node::Stored const& stored : node_->variables) list.push_back(stored.variable);
    return list;
}

std::optional<MemoryFile::Value> MemoryFile::attribute(int variable, std::string const& name) const {
    auto const& list = attributes(variable);
    auto const found = std::ranges::find(list, name, &Attribute::name);
    return found == list.end() ? std::nullopt : std::optional(found->value);
}

std::byte const* MemoryFile::data(int variable) const { return node_->stored(variable).data.data(); }

void MemoryFile::copy_to(DataFile& to) const {
    for (Attribute const& attribute : node_->attributes) to.put(global, attribute.name, attribute.value);
    for (Dimension const& dimension : dimensions()) to.add_dimension(dimension.name, dimension.length);
    std::vector<int> ids;
    for (Node::Stored const& stored : node_->variables) {
        std::vector<int> shape;
        for (std::string const& name : stored.variable.dimensions) shape.push_back(to.dimension(name));
        ids.push_back(to.add_variable(stored.variable.name, stored.variable.type, shape, stored.fill));
        for (Attribute const& attribute : stored.attributes) to.put(ids.back(), attribute.name, attribute.value);
    }
    for (auto const& [variable, fill, data, attributes] : node_->variables) {
        if (data.empty()) continue;
        std::vector<std::size_t> const start(variable.shape.size(), 0);
        to.write(ids[static_cast<std::size_t>(variable.id)], start, variable.shape, data.data());
    }
    for (auto const& inner : node_->groups) MemoryFile({node_, inner.get()}).copy_to(*to.add_group(inner->name));
}

}  // namespace slideway
