// study.table: one member a row, as measured or as drawn elsewhere.
#include <cstring>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "host/base/bytes.hpp"
#include "host/base/csv.hpp"
#include "host/base/open_file.hpp"
#include "host/base/shown.hpp"
#include "host/config/reader.hpp"
#include "host/config/scene_text.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

struct Column {
    Key const* key;
    UnitFactor factor;
    std::string unit;  // of its numbers
};

std::string read_bytes(Node const& node, std::string const& path) {
    constexpr std::size_t largest = std::size_t{1} << 28;  // keeps devices from filling the memory
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse(node, {"it is a directory", "name a file in it"});
    InputText input = read_input(path, largest);
    if (input.text.size() > largest) refuse(node, {"it is larger than 256 MiB", "name a table, which is text"});
    if (input.error != 0) {
        refuse(node, {fmt::format("{} cannot be read: {}", shown_briefly(path), std::strerror(input.error)), "check the path, from the scene's folder on"});
    }
    return std::move(input.text);
}

/// A field of the table for messages: `members.csv:3: name is "text" (…); …`.
Node field_node(CsvReader const& table, std::string name, std::string text) {
    Node node;
    node.name = std::move(name);
    node.where = table.where();
    node.line = table.line();
    node.type = Node::Type::text;
    node.text = std::move(text);
    return node;
}

/// "joint.clearance [mm]": the key, and how its numbers become SI ones.
Column read_column(Node const& node) {
    auto const bracket = node.text.find('[');
    std::string const name(trimmed(std::string_view(node.text).substr(0, bracket)));
    Column column{find_key(name), UnitFactor(1), {}};
    if (column.key == nullptr) refuse(node, {"only numeric keys of the physics can be columns", key_advice(name)});
    column.unit = column.key->unit;
    if (bracket == node.text.npos) return column;
    if (!node.text.ends_with(']')) {
        refuse(node, {"its unit has no end", fmt::format("write \"{} [{}]\"", name, column.key->unit)});
    }
    column.unit = trimmed(std::string_view(node.text).substr(bracket + 1, node.text.size() - bracket - 2));
    auto const factor = unit_factor(column.unit, column.key->unit);
    if (auto const* problem = std::get_if<Problem>(&factor)) refuse(node, *problem);
    column.factor = std::get<UnitFactor>(factor);
    return column;
}

/// Adds a variation for each column of the header.
std::vector<Column> read_header(CsvReader const& table, Node const& root, Scene& scene) {
    std::vector<Column> columns;
    for (std::string const& field : table.fields()) {
        Node const node = field_node(table, fmt::format("column {}", columns.size() + 1), field);
        Column const column = read_column(node);
        check_varied(root, node, *column.key, scene, {"study.table has it for every member, so this has no effect", "change the table"});
        require_part(scene.parts, *column.key);
        scene.variations.push_back({column.key, {}, table.line(), columns.size()});
        columns.push_back(column);
    }
    return columns;
}

void read_row(CsvReader const& table, std::vector<Column> const& columns, std::vector<double>& values) {
    if (table.fields().size() != columns.size()) {
        table.fail(fmt::format("the row has {} fields (the header has {} columns); write one number for each column",
                               table.fields().size(), columns.size()));
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::string_view text = table.fields()[i];
        double value = 0;
        if (!read_plain_number(text, value)) {
            Column const& column = columns[i];
            refuse(
                field_node(table, std::string(column.key->name), std::string(text)),
                {"not a number", column.unit == "1" ? "use a number"
                                                    : fmt::format("use a number of {} without its unit", column.unit)});
        }
        if (text.starts_with('+')) text.remove_prefix(1);
        values.push_back(columns[i].factor(text, value));
    }
}

}  // namespace

void read_member_table(Node const& node, Node const& root, Scene& scene) {
    std::string const& given = read_text_value(node);
    if (given.empty()) refuse(node, {"no file has this name", "write for example \"members.csv\""});
    auto const path = (std::filesystem::path(scene.path).parent_path() / given).lexically_normal();
    std::string bytes = read_bytes(node, path.string());

    auto table = std::make_shared<MemberTable>();
    table->path = std::filesystem::absolute(path).lexically_normal().string();
    table->checksum = fnv1a(bytes);
    std::istringstream in(std::move(bytes));
    CsvReader rows(in, shown_briefly(path.string()));
    if (!rows.next())
        rows.fail("the table is empty (it needs a header and a row); write keys like joint.clearance above");
    std::vector<Column> const columns = read_header(rows, root, scene);
    table->columns = columns.size();
    while (rows.next()) read_row(rows, columns, table->values);
    if (table->rows() == 0) rows.fail("the table has a header but no row (a row is a member); add one");

    std::uint64_t const members = table->rows();
    Node const* const count = root.find_path("study.members");
    if (count == nullptr) scene.members = members;
    if (scene.members > members) {
        refuse(*count, {fmt::format("study.table has {} rows", members),
                        fmt::format("use a value <= {}, or leave it out", members)});
    }
    scene.design.table = std::move(table);
}

void take_members(Scene& scene, std::vector<std::string> const& names, std::span<double const> values) {
    auto const fail = [&](std::string const& what) { throw SceneError(fmt::format("{}: {}", scene.path, what)); };
    if (scene.study == StudyKind::sweep || !scene.design.correlation.variations.empty()) {
        fail("cannot take inputs of members: a sweep and correlated draws have a design of their own; use study.kind = \"ensemble\"");
    }
    if (names.empty() || values.empty() || values.size() % names.size() != 0) fail("inputs of members need keys, and rows of one number for each");
    auto table = std::make_shared<MemberTable>();
    table->columns = names.size();
    table->values.assign(values.begin(), values.end());
    table->checksum = fnv1a(std::as_bytes(values));
    for (std::string const& name : names) {
        Key const* const key = find_key(name);
        if (key == nullptr) fail(fmt::format("{}: only numeric keys of the physics can be inputs of members; {}", name, key_advice(name)));
        if (!counts_for(*key, scene.parts)) fail(fmt::format("{} has no meaning for this mechanism and contact law; leave it out", name));
        std::erase_if(scene.variations, [&](Variation const& other) { return other.column == Variation::no_column && other.key->overlaps(*key); });
        for (Variation const& other : scene.variations) {
            if (other.key->overlaps(*key)) fail(fmt::format("{} and {} set the same input; leave one out", other.key->name, name));
        }
        require_part(scene.parts, *key);
        scene.variations.push_back({key, {}, 0, static_cast<std::size_t>(&name - names.data())});
    }
    scene.design = {};
    scene.design.kind = DesignKind::table;
    scene.members = table->rows();
    scene.design.table = std::move(table);
    prepare_sampler(scene);
}

}  // namespace slideway
