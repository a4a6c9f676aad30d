// study.table: one member a row, as measured or as drawn elsewhere.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/bytes.hpp"
#include "host/base/csv.hpp"
#include "host/base/open_file.hpp"
#include "host/base/text.hpp"
#include "host/config/document.hpp"
#include "host/config/reader.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

/// Of numbers for a key, or of texts that name the members.
struct Column {
    Key const* key;  // nullptr: texts
    UnitFactor factor;
    std::string unit;  // of its numbers
    Node header;
    int text_line = 0, number_line = 0;  // where texts first had one
    bool has_missing = false;            // in words, such as NA
};

[[noreturn]] void refuse_column(Node const& header, Scene const& scene) {
    std::string const name = column_header(header.text).name;
    refuse_ungiven(header.where, name, scene);
    refuse(header, {"only numeric keys of the physics can be columns", key_advice(name, scene)});
}

/// Whether a header may be that of texts: it has no unit, is like no key, and does not begin with a table of keys.
bool may_name_texts(std::string_view header, Scene const& scene) {
    auto const names = numeric_key_names(scene);
    if (header.empty() || header.find('[') != header.npos || !nearest_name(header, names).empty()) return false;
    std::string_view const table = header.substr(0, header.find('.'));
    return table == header || std::ranges::none_of(names, [&](std::string_view name) { return name.starts_with(table) && name[table.size()] == '.'; });
}

/// "joint.clearance [mm]": the key, and how its numbers become SI ones; or "part", above texts.
Column read_column(Node const& node, Scene const& scene) {
    ColumnHeader const header = column_header(node.text);
    Column column{find_key(header.name, scene), UnitFactor(1), {}, node};
    if (column.key == nullptr) {
        if (!may_name_texts(node.text, scene)) refuse_column(node, scene);
        return column;
    }
    column.unit = header.unit.value_or(std::string(column.key->unit));
    auto const factor = header.factor_to(column.key->unit);
    if (auto const* problem = std::get_if<Problem>(&factor)) refuse(node, *problem);
    column.factor = std::get<UnitFactor>(factor);
    return column;
}

/// "1 mm", "10 %", "0,1": who writes them means a quantity, not a name.
bool is_number_with_unit(std::string_view text) {
    std::size_t digits = text.find_first_not_of("+-");
    if (digits == text.npos || digits > 1 || text[digits] < '0' || text[digits] > '9') return false;
    std::size_t const end = text.find_first_not_of("0123456789.,eE+-", digits);
    std::string_view const number = trimmed(text.substr(0, end));
    std::string point(number);
    std::ranges::replace(point, ',', '.');
    double value = 0;
    if (!read_plain_number(point, value)) return false;
    return end == text.npos || text[end] == '%' || (text[end] == ' ' && (text.substr(end).find_first_not_of(' ') != text.npos));
}

/// Reads the rows of a table into members, each checked as a scene's own values are.
class MemberRows {
public:
    /// Reads the header, and adds a variation for each of its keys.
    MemberRows(CsvReader& rows, Reading& reading, MemberTable& table) : rows_(rows), scene_(reading.scene), table_(table) {
        for (std::string const& field : rows.fields()) {
            columns_.push_back(read_column(field_node(rows, fmt::format("column {}", columns_.size() + 1), field), scene_));
            Column const& column = columns_.back();
            if (column.key == nullptr) {
                table.labelled += fmt::format("{}{}", table.labelled.empty() ? "" : ", ", column.header.text);
                continue;
            }
            check_varied(reading, column.header, *column.key, {"study.table has it for every member, so this has no effect", "change the table"});
            require_part(scene_.parts, *column.key);
            scene_.variations.push_back({column.key, {}, rows.line(), table.columns++});
        }
    }

    void add_row() {
        rows_.require_columns();
        Inputs inputs = scene_.inputs;
        std::string label;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (columns_[i].key != nullptr) columns_[i].key->set(inputs, add_number(i));
            else add_text(i, label);
        }
        if (auto const found = find_defect(inputs, scene_.parts)) refuse_row(*found);
        table_.lines.push_back(rows_.line());
        if (table_.labelled.empty()) return;
        table_.label_width = std::max(table_.label_width, label.size());
        table_.labels.push_back(std::move(label));
    }

    /// Columns without a key must hold texts: of numbers it is a key that was mistyped.
    void check_texts() const {
        for (Column const& column : columns_) {
            if (column.key != nullptr) continue;
            // Of numbers, or of missing ones, it is a key that was mistyped.
            if (column.text_line == 0 && (column.number_line != 0 || column.has_missing)) refuse_column(column.header, scene_);
            if (column.number_line == 0) continue;
            refuse(column.header, {fmt::format("no key of the physics, and below it stand a number, in line {}, and a text, in line {}",
                                               column.number_line, column.text_line),
                                   "give it texts alone, or remove it"});
        }
    }

private:
    double add_number(std::size_t place) {
        Column const& column = columns_[place];
        Node const node = field_node(rows_, fmt::format("{} (column {})", column.key->name, place + 1), rows_.fields()[place]);
        CellNumber number;
        if (auto const fault = rows_.read_number(place, number)) {
            std::string const advice = column.unit == "1" ? "use a number" : fmt::format("use a number of {} without its unit", column.unit);
            refuse(node, {fault->reason, (fault->advice.empty() ? advice : fault->advice) + further_faults()});
        }
        double const value = column.factor(number.text, number.value);
        if (auto const problem = broken_rule(*column.key, value)) refuse(node, *problem);
        table_.values.push_back(value);
        return value;
    }

    /// A row that cannot be read has a message of its own, the next time.
    bool has_further_row() {
        try {
            return rows_.next();
        } catch (SceneError const&) {
            return false;
        }
    }

    /// "; lines 4, 7 have such cells too": who corrects one wants to know of all.
    std::string further_faults() {
        constexpr std::size_t listed = 5;
        std::vector<int> lines;
        CellNumber number;
        while (lines.size() <= listed && has_further_row()) {
            for (std::size_t i = 0; i < std::min(columns_.size(), rows_.fields().size()); ++i) {
                if (columns_[i].key == nullptr || !rows_.read_number(i, number)) continue;
                lines.push_back(rows_.line());
                break;
            }
        }
        if (lines.empty()) return {};
        bool const more = lines.size() > listed;
        if (more) lines.pop_back();
        return fmt::format("; {} {}{} {} such cells too", lines.size() == 1 && !more ? "line" : "lines", fmt::join(lines, ", "), more ? " and others" : "",
                           lines.size() == 1 && !more ? "has" : "have");
    }

    void add_text(std::size_t place, std::string& label) {
        std::string const& text = rows_.fields()[place];
        Column& column = columns_[place];
        if (auto const fault = rows_.formula_fault(place))
            refuse(field_node(rows_, fmt::format("{} (column {})", column.header.text, place + 1), text), {fault->reason, fault->advice});
        if (rows_.is_missing(place)) {
            column.has_missing = column.has_missing || !text.empty();
            return;
        }
        int& first = rows_.is_number(place) || is_number_with_unit(text) ? column.number_line : column.text_line;
        if (first == 0) first = rows_.line();
        label += fmt::format("{}{}", label.empty() ? "" : ", ", shown_briefly(text));
    }

    /// Values that do not go together.  What is drawn beside the table is drawn for each member, and may yet fit.
    void refuse_row(Defect const& found) const {
        auto const is_drawn = [&](Key const* key) {
            return key != nullptr && std::ranges::any_of(scene_.variations, [&](Variation const& one) {
                       return one.column == Variation::no_column && one.key->overlaps(*key);
                   });
        };
        if (is_drawn(found.key) || is_drawn(found.other)) return;
        rows_.fail(fmt::format("{} is {} ({}); {}", found.key->name, with_unit(found.value, found.key->unit), found.problem.reason,
                               found.problem.advice));
    }

    CsvReader& rows_;
    Scene& scene_;
    MemberTable& table_;
    std::vector<Column> columns_;
};

}  // namespace

Node field_node(CsvReader const& table, std::string name, std::string text) {
    Node node;
    node.name = std::move(name);
    node.where = table.where();
    node.line = table.line();
    node.type = Node::Type::text;
    node.text = std::move(text);
    return node;
}

TableFile read_table_file(Reading& reading, Node const& node) {
    namespace fs = std::filesystem;
    constexpr std::size_t largest = std::size_t{1} << 28;  // keeps devices from filling the memory
    Scene& scene = reading.scene;
    std::string const& given = read_text_value(node);
    if (given.empty()) refuse(node, {"no file has this name; members of Ensemble.run(inputs=...) are of none", "name a file, or run one of them by slideway.scene(result, member=K)"});
    for (Scene const* const from : {static_cast<Scene const*>(&scene), reading.former}) {
        if (from == nullptr) continue;
        auto const known = std::ranges::find(from->tables, given, &TableFile::given);
        if (known == from->tables.end()) continue;
        if (from == &scene && known->key == node.name) return *known;
        TableFile same = *known;
        same.key = node.name;
        return scene.tables.emplace_back(std::move(same));
    }
    fs::path const folder = fs::path(scene.path).parent_path();
    fs::path path = folder / given;  // as the system reads it: a folder may be a link
    std::error_code ignored;
    if (fs::path(given).is_absolute() && !fs::exists(path, ignored) && fs::exists(folder / path.filename(), ignored)) {
        path = folder / path.filename();
        reading.warn(fmt::format("{}: {} is not there any more; {} is read in its place", node.where, node.name, shown_briefly(path.string())));
    }
    if (fs::is_directory(path, ignored)) refuse(node, {"it is a directory", "name a file in it"});
    InputText input = read_input(path.string(), largest);
    if (input.text.size() > largest) refuse(node, {"it is larger than 256 MiB", "name a table, which is text"});
    if (input.error != 0)
        refuse(node, {fmt::format("{} cannot be read: {}", shown_briefly(path.string()), input.why()), "check the path, from the scene's folder on"});
    std::uint64_t const checksum = fnv1a(input.text);
    fs::path const place = fs::canonical(path, ignored);
    return scene.tables.emplace_back(TableFile{node.name, given, ignored ? fs::absolute(path).string() : place.string(), shown_briefly(path.string()),
                                               std::make_shared<std::string const>(std::move(input.text)), checksum});
}

void read_member_table(Reading& reading, Node const& node) {
    Scene& scene = reading.scene;
    TableFile const file = read_table_file(reading, node);
    auto table = std::make_shared<MemberTable>();
    table->path = file.path;
    table->name = file.name;
    table->checksum = file.checksum;
    std::istringstream in(*file.text);
    CsvReader rows(in, table->name);
    if (!rows.next())
        rows.fail("the table is empty (it needs a header and a row); write keys like joint.clearance above");
    MemberRows members(rows, reading, *table);
    while (rows.next()) members.add_row();
    members.check_texts();
    if (table->lines.empty()) rows.fail("the table has a header but no row (a row is a member); add one");
    if (table->columns == 0) rows.fail("the table has no column of numbers (its header names no key); write keys like joint.clearance above");

    std::uint64_t const count = table->rows();
    Node const* const asked = reading.given("study.members");
    if (asked == nullptr) scene.members = count;
    if (scene.members > count) {
        refuse(*asked, {fmt::format("study.table has {} rows", count), fmt::format("use a value <= {}, or leave it out", count)});
    }
    scene.design.table = std::move(table);
}

void take_members(Scene& scene, std::vector<std::string> const& names, std::span<double const> values) {
    auto const fail = [&](std::string const& what) { throw SceneError(fmt::format("{}: {}", scene.path, what)); };
    if (scene.study == StudyKind::sweep || !scene.design.correlation.variations.empty()) {
        fail("cannot take inputs of members: a sweep and correlated draws have a design of their own; use study.kind = \"ensemble\"");
    }
    if (names.empty() || values.empty() || values.size() % names.size() != 0) fail("inputs of members need keys, and rows of one number for each");
    // Rows of the scene's own table are not of these members.
    for (Variation const& own : scene.variations) {
        auto const is_own = [&](std::string const& name) { return find_key(name, scene) != nullptr && own.key->overlaps(*find_key(name, scene)); };
        if (own.column != Variation::no_column && std::ranges::none_of(names, is_own))
            fail(fmt::format("study.table has a column of {}, which inputs of members lack; give it too", own.key->name));
    }
    std::erase_if(scene.variations, [](Variation const& own) { return own.column != Variation::no_column; });
    auto table = std::make_shared<MemberTable>();
    table->columns = names.size();
    table->values.assign(values.begin(), values.end());
    table->checksum = fnv1a(std::as_bytes(values));
    for (std::string const& name : names) {
        Key const* const key = find_key(name, scene);
        if (key == nullptr) refuse_ungiven(scene.path, name, scene);
        if (key == nullptr) fail(fmt::format("{}: only numeric keys of the physics can be inputs of members; {}", name, key_advice(name, scene)));
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
