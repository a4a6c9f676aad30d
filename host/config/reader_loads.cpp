// [load.<name>]: forces and torques, constant or by a table.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/own_modules.hpp"
#include "host/base/bytes.hpp"
#include "host/base/csv.hpp"
#include "host/base/shown.hpp"
#include "host/config/loads.hpp"
#include "host/config/reader.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

/// Units of what a table is read over, in the order of load_arguments, and those that its values may come to.
constexpr std::string_view argument_units[] = {"rad", "s", "m", "m/s", "rad/s"}, value_units[] = {"1", "N", "N m", "Pa", "N/m", "N s/m", "m/s2"};

/// How numbers of a column become SI ones.
UnitFactor si_factor(Node const& header, std::span<std::string_view const> units) {
    ColumnHeader const column = column_header(header.text);
    for (std::string_view const unit : units) {
        auto const factor = column.factor_to(unit);
        if (auto const* const found = std::get_if<UnitFactor>(&factor)) return *found;
    }
    refuse(header, {fmt::format("its unit is none of {}, or of what these are made of", fmt::join(units, ", ")), "give another unit in brackets"});
}

/// Rows of two columns of a table.
class TwoColumns {
public:
    TwoColumns(CsvReader& rows, Node const& asking, std::string_view argument, std::string_view argument_unit,
               std::span<std::string_view const> value_units, std::string_view value)
        : rows_(rows), argument_(column(asking, argument)), value_(column(asking, value)),
          argument_factor_(si_factor(cell(argument_), {&argument_unit, 1})), value_factor_(si_factor(cell(value_), value_units)) {}

    void add_row() {
        rows_.require_columns();
        places.push_back(number(argument_, argument_factor_));
        values.push_back(number(value_, value_factor_));
        lines.push_back(rows_.line());
    }

    std::vector<double> places, values;
    std::vector<int> lines;

private:
    std::size_t column(Node const& asking, std::string_view name) const {
        std::vector<std::string> names;
        for (std::string const& field : rows_.fields()) names.push_back(column_header(field).name);
        auto const found = std::ranges::find(names, name);
        if (std::ranges::count(names, name) > 1) refuse(asking, {fmt::format("the table has several columns {}", name), "give them names of their own"});
        if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
        refuse(asking, {fmt::format("the table has no column {}", name), fmt::format("name one of {}, or correct the header", fmt::join(names, ", "))});
    }
    Node cell(std::size_t column) const { return field_node(rows_, fmt::format("column {}", column + 1), rows_.fields()[column]); }
    double number(std::size_t column, UnitFactor const& factor) {
        CellNumber number;
        if (auto const fault = rows_.read_number(column, number)) refuse(cell(column), {fault->reason, fault->advice.empty() ? "use a number" : fault->advice});
        return factor(number.text, number.value);
    }

    CsvReader& rows_;
    std::size_t argument_, value_;
    UnitFactor argument_factor_, value_factor_;
};

constexpr std::size_t most_rows = 1'000'000;

/// A period of the crank's angle is of whole turns, of a four-stroke engine two.
void check_turns(TwoColumns& columns, std::string const& name, TableKind const& kind) {
    if (kind.argument != "crank_angle" || !kind.repeats) return;
    double const turns = (columns.places.back() - columns.places.front()) / (2 * std::numbers::pi), whole = std::round(turns);
    if (whole >= 1 && std::abs(turns - whole) < 1e-6) {
        // To the last bit, that nothing drifts.
        columns.places.back() = columns.places.front() + 2 * std::numbers::pi * whole;
        return;
    }
    throw SceneError(fmt::format("{}:{}: crank_angle ends {:.6g} turns behind its first row (a period is of whole turns); end it there, {}", name,
                                 columns.lines.back(), turns, turns > 50 ? "or give its unit in the header, as crank_angle [deg]" : "or set repeats = false"));
}

}  // namespace

LoadTable read_table_of(Reading& reading, Node const& file, Node const& column, TableKind const& kind) {
    LoadTable table;
    TableFile const input = read_table_file(reading, file);
    table.column = read_text_value(column);
    table.interpolation = kind.interpolation;
    std::istringstream in(*input.text);
    CsvReader rows(in, input.name);
    if (!rows.next()) rows.fail("the table is empty; it needs a header and rows");
    TwoColumns columns(rows, column, kind.argument, kind.argument_unit, kind.value_units, table.column);
    while (rows.next()) {
        if (columns.places.size() == most_rows) rows.fail(fmt::format("a table has at most {} rows; thin it out", most_rows));
        columns.add_row();
    }
    table.rows = columns.places.size();
    if (auto const fault = PieceFunction::fault_of(columns.places, columns.values, kind.repeats && !kind.advances)) {
        int const line = columns.lines.empty() ? rows.line() : columns.lines[fault->point];
        throw SceneError(fmt::format("{}:{}: {} ({}); {}", input.name, line, columns.lines.size() < 2 ? "the table is too short" : kind.argument,
                                     fault->reason, fault->advice));
    }
    check_turns(columns, input.name, kind);
    if (kind.repeats && !kind.advances) columns.values.back() = columns.values.front();
    auto const function = std::make_shared<PieceFunction const>(columns.places, columns.values, kind.interpolation, kind.repeats);
    if (auto const steep = function->not_finite())
        throw SceneError(fmt::format("{}:{}: {} (next to another row it has no finite slope); move it, or remove it", input.name, columns.lines[*steep],
                                     kind.argument));
    table.function = function;
    table.span = columns.places.back() - columns.places.front(), table.narrowest = table.span;
    for (std::size_t i = 1; i < table.rows; ++i) table.narrowest = std::min(table.narrowest, columns.places[i] - columns.places[i - 1]);
    return table;
}

namespace {

class LoadReader {
public:
    LoadReader(Node const& node, Reading& reading) : node_(node), reading_(reading), scene_(reading.scene) {
        row_.name = node.key;
        if (!node.is_table()) refuse(node, {"a load is a table", fmt::format("write [{}] and its keys below", node.name)});
        if (!is_module_name(node.key))
            refuse_that(node, "is no name of a load", {"names have at most 60 small letters, digits and '_', a letter first", "rename it"});
        on_crank_ = choice("on", load_bodies) == 1;
        load_.turns_with_slider = choice("frame", load_frames) == 1;
        bool const turns = info(scene_.parts.mechanism).drive == DriveKind::crank;
        if (on_crank_ && !turns) refuse(*node.find("on"), {fmt::format("a {} has no crank", info(scene_.parts.mechanism).name), "use on = \"slider\""});
        if (on_crank_ && node.find("frame") != nullptr) refuse(*node.find("frame"), {"the torque on a crank is about its axis", "remove it"});
        for (Node const& child : node.children) check(child);
        if (std::ranges::all_of(numbers_, [](LoadNumber const* number) { return number->name == "scale" || number->name.starts_with("point"); }))
            refuse_missing(node, node.name + (on_crank_ ? ".torque" : ".force_x"), "a load without a force or a torque does nothing", "give one");
        warn_of_idle_points();
        read_table();
    }

    std::vector<LoadNumber const*> const& numbers() const { return numbers_; }
    SceneLoads::Row take_row() { return std::move(row_); }
    Load& load() { return load_; }

private:
    std::size_t choice(std::string_view name, std::span<std::string_view const> of, std::size_t preset = 0) const {
        Node const* const given = node_.find(name);
        return given == nullptr ? preset : read_choice(*given, name, of);
    }

    void check(Node const& child) {
        auto const number = std::ranges::find(load_numbers(), child.key, &LoadNumber::name);
        if (number == load_numbers().end()) {
            std::vector<std::string_view> known;
            for (Setting const& one : load_settings()) known.push_back(one.name.substr(one.name.rfind('.') + 1));
            if (std::ranges::find(known, child.key) != known.end()) return;
            refuse_that(child, "is no key of a load", {"mistyped, it would have no effect", choice_advice(child.key, known)});
        }
        if (on_crank_ ? !number->of_crank : !number->of_slider)
            refuse(child, {fmt::format("it is of loads on the {}", on_crank_ ? "slider" : "crank"), on_crank_ ? "use torque" : "use torque_z, or on = \"crank\""});
        if (!number->planar && !info(scene_.parts.mechanism).spatial) refuse_meaningless(child.where, child.name, scene_.parts.mechanism);
        numbers_.push_back(&*number);
    }

    void warn_of_idle_points() {
        if (std::ranges::any_of(numbers_, [](LoadNumber const* number) { return number->name.starts_with("force"); })) return;
        for (LoadNumber const* const number : numbers_) {
            if (number->name.starts_with("point"))
                reading_.warn(fmt::format("{}: {}.{} has no effect, for the load has no force", node_.find(number->name)->where, node_.name, number->name));
        }
    }

    void read_table() {
        Node const* const file = node_.find("table");
        if (file == nullptr) {
            for (std::string_view const name : {"over", "column", "interpolation", "repeats"}) {
                if (Node const* const idle = node_.find(name)) refuse(*idle, {"it is of a table, and there is none", "give table, or remove it"});
            }
            return;
        }
        for (std::string_view const name : {"over", "column"}) {
            if (node_.find(name) == nullptr)
                refuse_missing(*file, fmt::format("{}.{}", node_.name, name), "which columns of the table the load has",
                               name == "over" ? "add over = \"time\", or another column" : "add column = \"force\", or what it is called");
        }
        std::size_t const over = choice("over", load_arguments);
        load_.over = static_cast<LoadArgument>(over + 1);
        bool const by_angle = load_.over == LoadArgument::crank_angle, by_crank = by_angle || load_.over == LoadArgument::crank_speed;
        if (by_crank && info(scene_.parts.mechanism).drive != DriveKind::crank)
            refuse(*node_.find("over"), {fmt::format("a {} has no crank", info(scene_.parts.mechanism).name), "use time, x or vx"});
        Node const* const repeats = node_.find("repeats");
        bool const ever = repeats == nullptr ? by_angle : read_boolean(*repeats);
        row_.table.interpolation = static_cast<Interpolation>(choice("interpolation", interpolation_names));
        read_file(*file, over, ever);
    }

    void read_file(Node const& file, std::size_t over, bool repeats) {
        TableKind const kind{load_arguments[over], argument_units[over], value_units, repeats, row_.table.interpolation};
        LoadTable const* const same = former_table(file, kind);
        if (same == nullptr) {
            row_.table = read_table_of(reading_, file, *node_.find("column"), kind);
            return;
        }
        row_.table = *same;
        read_table_file(reading_, file);  // it is among the tables of this scene, too
    }

    /// What a former reading of the scene made of the same rows.
    LoadTable const* former_table(Node const& file, TableKind const& kind) const {
        Scene const* const former = reading_.former;
        for (std::size_t i = 0; former != nullptr && former->loads != nullptr && i < former->loads->rows().size(); ++i) {
            auto const& [name, table] = former->loads->rows()[i];
            TableFile const* const of = find_table(*former, fmt::format("load.{}.table", name));
            if (of == nullptr || of->key != file.name || of->given != read_text_value(file) || former->loads->load(i).over != load_.over || table.column != read_text_value(*node_.find("column"))) continue;
            if (table.interpolation == kind.interpolation && former->loads->load(i).table.repeats == kind.repeats) return &table;
        }
        return nullptr;
    }

    Node const& node_;
    Reading& reading_;
    Scene const& scene_;
    SceneLoads::Row row_;
    Load load_;
    bool on_crank_ = false;
    std::vector<LoadNumber const*> numbers_;
};

}  // namespace

void refuse_ungiven(std::string_view where, std::string_view name, Scene const& scene) {
    constexpr std::string_view table = "load.";
    auto const dot = name.rfind('.');
    if (!name.starts_with(table) || dot < table.size()) return;
    std::string_view const load = name.substr(0, dot), own = name.substr(dot + 1);
    auto const number = std::ranges::find(load_numbers(), own, &LoadNumber::name);
    if (number == load_numbers().end()) return;
    auto const is_load = [&](SceneLoads::Row const& row) { return row.name == load.substr(table.size()); };
    std::string const advice = fmt::format("add {} = {}", own, own == "scale" ? 1 : 0);
    if (scene.loads == nullptr || std::ranges::none_of(scene.loads->rows(), is_load))
        throw SceneError(fmt::format("{}: {} is of no load of the scene (there is no [{}]); add that, or use the name of another", where, name, load));
    throw SceneError(fmt::format("{}: {} is not given in [{}] (a number must be given to vary); {}", where, name, load, advice));
}

void read_loads(Reading& reading) {
    Scene& scene = reading.scene;
    Node const* const table = reading.given("load");
    if (table == nullptr) return;
    if (!table->is_table()) refuse(*table, {"loads are tables", "write [load.name] and its keys below"});
    if (module_of(scene.parts.mechanism) != nullptr) {
        throw SceneError(fmt::format("{}: loads act on the mechanisms of slideway, and {} is of a module; put them into its own equations", table->where,
                                     info(scene.parts.mechanism).name));
    }
    if (table->children.empty()) return;
    auto loads = std::make_shared<SceneLoads>();
    for (Node const& node : table->children) {
        LoadReader reader(node, reading);
        for (LoadNumber const* const number : reader.numbers()) {
            if (loads->keys().size() == most_load_numbers)
                refuse(*node.find(number->name), {"all loads of a scene have sixteen numbers at most", "use fewer"});
            number->place(reader.load()) = loads->add_key(fmt::format("{}.{}", node.name, number->name), *number);
        }
        loads->add(reader.take_row(), reader.load());
    }
    scene.parts.loads = loads->list();
    scene.loads = std::move(loads);
}

}  // namespace slideway
