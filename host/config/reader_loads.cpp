// [load.<name>], [spring.<name>], [stop.<name>], [ground_motion], [film]: forces and torques, constant, by a table, or by where the slider is.  And
// [way_profile.<name>], [way_ends].
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/own_modules.hpp"
#include "host/base/bytes.hpp"
#include "host/base/csv.hpp"
#include "host/base/text.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/reader.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

/// Units of what a table is read over, in the order of load_arguments, and those that its values may come to.
constexpr std::string_view argument_units[] = {"rad", "s", "m", "m/s", "rad/s"}, value_units[] = {"1", "N", "N m", "Pa", "N/m", "N s/m", "m/s2"};
constexpr std::string_view acceleration_units[] = {"m/s2"}, depth_units[] = {"m"};

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
               std::span<std::string_view const> units, std::string_view value)
        : rows_(rows), argument_(column(asking, argument)), value_(column(asking, value)),
          argument_factor_(si_factor(cell(argument_), {&argument_unit, 1})), value_factor_(si_factor(cell(value_), units)) {}

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

LoadTable read_table_of(Reading& reading, Node const& file, Node const& asking, std::string const& column, TableKind const& kind) {
    LoadTable table;
    TableFile const input = read_table_file(reading, file);
    table.column = column;
    table.interpolation = kind.interpolation;
    std::istringstream in(*input.text);
    CsvReader rows(in, input.name);
    if (!rows.next()) rows.fail("the table is empty; it needs a header and rows");
    TwoColumns columns(rows, asking, kind.argument, kind.argument_unit, kind.value_units, table.column);
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
    auto const proud = std::ranges::find_if(columns.values, [&](double value) { return kind.opens && value < 0; });
    if (proud != columns.values.end())
        throw SceneError(fmt::format("{}:{}: {} is {:g} m (a profile lies back from the clearance, and is not proud of it); give the clearance where the gap is narrowest, and "
                                     "depths from there", input.name, columns.lines[static_cast<std::size_t>(proud - columns.values.begin())], table.column, *proud));
    if (kind.repeats && !kind.advances) columns.values.back() = columns.values.front();
    auto const function = std::make_shared<PieceFunction const>(columns.places, columns.values, kind.interpolation, kind.repeats);
    if (auto const steep = function->not_finite())
        throw SceneError(fmt::format("{}:{}: {} (next to another row it has no finite slope); move it, or remove it", input.name, columns.lines[*steep],
                                     kind.argument));
    // Beside a step a spline swings to its other side.
    if (double const least = function->least(); kind.opens && least < -0.02 * function->range())
        throw SceneError(fmt::format("{}: {} is {:g} m between its rows (a profile lies back from the clearance, and is not proud of it); set "
                                     "interpolation = \"monotone\", or give rows nearer to one another", input.name, table.column, least));
    table.function = function;
    table.span = columns.places.back() - columns.places.front(), table.narrowest = table.span;
    for (std::size_t i = 1; i < table.rows; ++i) table.narrowest = std::min(table.narrowest, columns.places[i] - columns.places[i - 1]);
    return table;
}

namespace {

/// A load as a table of the scene gives it, without the places of its numbers.
struct GivenLoad {
    SceneLoads::Row row;
    Load load;
    std::vector<LoadNumber const*> numbers;
};

class LoadReader {
public:
    /// @param node the table of one load
    LoadReader(Node const& node, LoadKind kind, Reading& reading) : node_(node), kind_(kind), reading_(reading), scene_(reading.scene) {
        if (!node.is_table()) refuse(node, {fmt::format("a {} is a table", noun()), fmt::format("write [{}] and its keys below", node.name)});
        if (has_named_loads(table_of(kind)) && !is_module_name(node.key))
            refuse_that(node, fmt::format("is no name of a {}", noun()), {"names have at most 60 small letters, digits and '_', a letter first", "rename it"});
        given_.row.name = node.name;
        given_.load.kind = kind;
        on_crank_ = kind == LoadKind::push && !on_linkage_ && choice("on", load_bodies) == 1;
        for (Node const& child : node.children) check(child);
        if (on_linkage_) given_.row.words = read_place_on_linkage(reading, node, given_.load);
    }

    /// What there is of it; of the ground's motion one for each axis.
    std::vector<GivenLoad> read() {
        switch (kind_) {
            case LoadKind::push: read_push(); break;
            case LoadKind::spring: read_spring(); break;
            case LoadKind::stop: read_stop(); break;
            case LoadKind::ground_motion: return read_ground();
            case LoadKind::way_profile: read_profile(); break;
            case LoadKind::way_ends: read_ends(); break;
            case LoadKind::film: read_film(); break;
        }
        return {std::move(given_)};
    }

private:
    std::string noun() const {
        switch (kind_) {
            case LoadKind::ground_motion: return "motion of the ground";
            case LoadKind::way_profile: return "profile of the way";
            case LoadKind::way_ends: return "way with ends";
            default: return std::string(table_of(kind_));
        }
    }
    /// Of on_spatial_slider and its like.
    unsigned target() const { return on_linkage_ ? on_linkage : on_crank_ ? on_crank : is_planar() ? on_planar_slider : on_spatial_slider; }
    bool is_planar() const { return !info(scene_.parts.mechanism).spatial; }

    std::size_t choice(std::string_view name, std::span<std::string_view const> of, std::size_t preset = 0) const {
        Node const* const given = node_.find(name);
        return given == nullptr ? preset : read_choice(*given, name, of);
    }
    bool gives(std::string_view name) const {
        return std::ranges::any_of(given_.numbers, [&](LoadNumber const* number) { return number->name.starts_with(name); });
    }
    void require(std::string_view name, std::string_view why, std::string_view advice) const {
        if (node_.find(name) == nullptr) refuse_missing(node_, fmt::format("{}.{}", node_.name, name), why, advice);
    }

    void check(Node const& child) {
        LoadNumber const* const number = find_load_number(kind_, child.key);
        if (number == nullptr) {
            std::vector<std::string_view> known;
            for (Setting const& one : load_settings()) {
                if (one.table() == table_of(kind_)) known.push_back(one.name.substr(one.name.rfind('.') + 1));
            }
            static constexpr std::string_view of_linkages[] = {"against", "link"}, of_sliders[] = {"along"};
            bool const joins = std::ranges::find(of_linkages, child.key) != std::end(of_linkages) || (child.key == "on" && kind_ != LoadKind::push);
            if (on_linkage_ ? std::ranges::find(of_sliders, child.key) != std::end(of_sliders) : joins)
                refuse_meaningless(child.where, child.name, scene_.parts.mechanism);
            if (std::ranges::find(known, child.key) != known.end()) return;
            refuse_that(child, fmt::format("is no key of a {}", noun()), {"mistyped, it would have no effect", choice_advice(child.key, known)});
        }
        if ((number->of & target()) == 0) {
            if (on_crank_) refuse(child, {"it is of loads on the slider", "use torque"});
            if (number->of == (on_crank | on_linkage)) refuse(child, {"it is of loads on the crank", "use torque_z, or on = \"crank\""});
            if (on_linkage_ && number->name == "torque_z") refuse(child, {"it is of loads on a slider", "use torque"});
            refuse_meaningless(child.where, child.name, scene_.parts.mechanism);
        }
        given_.numbers.push_back(number);
    }

    void read_push() {
        if (!on_linkage_) given_.load.turns_with_slider = choice("frame", std::span(load_frames).first(2)) == 1;
        bool const turns = info(scene_.parts.mechanism).drive == DriveKind::crank;
        if (on_crank_ && !turns) refuse(*node_.find("on"), {fmt::format("a {} has no crank", info(scene_.parts.mechanism).name), "use on = \"slider\""});
        if (on_crank_ && node_.find("frame") != nullptr) refuse(*node_.find("frame"), {"the torque on a crank is about its axis", "remove it"});
        if (!gives("force") && !gives("torque"))
            refuse_missing(node_, node_.name + (on_crank_ ? ".torque" : ".force_x"), "a load without a force or a torque does nothing", "give one");
        warn_of_idle_points();
        read_table();
    }

    void read_spring() {
        if (on_linkage_) return;
        bool const along = given_.load.along = choice("along", spring_directions) == 1;
        if (!gives("anchor")) require("anchor_x", "where the spring is held on the ground", "add anchor_x = 0.1, or another component of the place");
        if (!gives("stiffness") && !gives("damping") && !gives("preload"))
            require("stiffness", "a spring without a stiffness, a damping or a preload does nothing", "add stiffness = \"2 N/mm\"");
        for (std::string_view const across : {"anchor_y", "anchor_z"}) {
            if (Node const* const idle = node_.find(across); along && idle != nullptr)
                refuse(*idle, {"a spring along x has its force and its length along x alone", "remove it, or along = \"x\""});
        }
        if (gives("stiffness") && !along) require("rest_length", "the length at which the spring is slack but for its preload", "add rest_length = \"50 mm\"");
    }

    void read_stop() {
        if (on_linkage_) return;
        require("position", "where along x the slider touches the stop", "add position = 0.15");
        require("blocks", "which way the slider cannot go on", "add blocks = \"+x\", or \"-x\"");
        require("stiffness", "how far the stop gives way", "add stiffness = \"1e7 N/m\"");
        given_.load.side = choice("blocks", std::span(stop_sides).first(2)) == 0 ? 1 : -1;
    }

    void read_profile() {
        given_.load.faces = profiled_face_bits[choice("faces", profiled_faces)];
        require("table", "how far the faces lie back", "add table = \"wear.csv\", of a column x and one of depths");
        require("column", "which column of the table says how far the faces lie back", "add column = \"depth\", or what it is called");
        Node const& file = *node_.find("table");
        given_.load.over = LoadArgument::x;
        Node const* const repeats = node_.find("repeats");
        given_.row.table.interpolation = static_cast<Interpolation>(choice("interpolation", smooth_interpolation_names));
        given_.row.table.column = read_text_value(*node_.find("column"));
        read_file(file, *node_.find("column"), argument_of_x, repeats != nullptr && read_boolean(*repeats), depth_units);
        given_.load.steepest = given_.row.table.function->steepest();
    }

    void read_ends() {
        Node const *const from = node_.find("from"), *const to = node_.find("to");
        if (from == nullptr && to == nullptr) refuse_missing(node_, node_.name + ".to", "where the way ends", "add to = 0.3, or from, where it begins");
    }

    void read_film() {
        require("viscosity", "how strongly the film damps", "add viscosity = \"0.1 Pa s\"");
        require("least_gap", "how thin roughness lets the film become", "add least_gap = \"1 um\"");
    }

    /// A load for each of the columns ax, ay, az that the table has.
    std::vector<GivenLoad> read_ground() {
        require("table", "the ground's acceleration over time", "add table = \"quake.csv\", of columns time and ax, ay or az");
        Node const& file = *node_.find("table");
        constexpr std::string_view axes[] = {"ax", "ay", "az"}, scales[] = {"scale_x", "scale_y", "scale_z"};
        given_.row.table.interpolation = static_cast<Interpolation>(choice("interpolation", interpolation_names));
        given_.load.over = LoadArgument::time;
        Node const* const repeats = node_.find("repeats");
        std::vector<std::string> const columns = columns_of(file);
        std::vector<GivenLoad> all;
        for (std::size_t axis = 0; axis < (is_planar() ? 2u : 3u); ++axis) {
            Node const* const scale = node_.find(scales[axis]);
            bool const has = std::ranges::find(columns, axes[axis]) != columns.end();
            if (!has && scale != nullptr) refuse(*scale, {fmt::format("the table has no column {}", axes[axis]), "remove it, or add the column"});
            if (!has) continue;
            given_.row.table.column = axes[axis];
            read_file(file, file, argument_of_time, repeats != nullptr && read_boolean(*repeats), acceleration_units);
            given_.numbers = {find_load_number(kind_, scales[axis])};
            all.push_back(given_);
        }
        if (all.empty()) refuse(file, {"the table has no column of an acceleration", is_planar() ? "name one ax or ay" : "name one ax, ay or az"});
        return all;
    }

    std::vector<std::string> columns_of(Node const& file) {
        TableFile const input = read_table_file(reading_, file);
        std::istringstream in(*input.text);
        CsvReader rows(in, input.name);
        std::vector<std::string> names;
        if (!rows.next()) rows.fail("the table is empty; it needs a header and rows");
        for (std::string const& field : rows.fields()) names.push_back(column_header(field).name);
        return names;
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
        given_.load.over = static_cast<LoadArgument>(over + 1);
        bool const of_slider = given_.load.over == LoadArgument::x || given_.load.over == LoadArgument::vx;
        bool const has_crank = info(scene_.parts.mechanism).drive == DriveKind::crank;
        if (on_linkage_ && of_slider) refuse(*node_.find("over"), {"it is of a slider", has_crank ? "use time, crank_angle or crank_speed" : "use time"});
        bool const by_angle = given_.load.over == LoadArgument::crank_angle, by_crank = by_angle || given_.load.over == LoadArgument::crank_speed;
        if (by_crank && !has_crank)
            refuse(*node_.find("over"), {fmt::format("a {} has no crank", info(scene_.parts.mechanism).name), on_linkage_ ? "use time" : "use time, x or vx"});
        Node const* const repeats = node_.find("repeats");
        bool const ever = repeats == nullptr ? by_angle : read_boolean(*repeats);
        given_.row.table.interpolation = static_cast<Interpolation>(choice("interpolation", interpolation_names));
        given_.row.table.column = read_text_value(*node_.find("column"));
        read_file(*file, *node_.find("column"), over, ever, value_units);
    }

    void warn_of_idle_points() {
        if (gives("force")) return;
        for (LoadNumber const* const number : given_.numbers) {
            if (number->name.starts_with("point"))
                reading_.warn(fmt::format("{}: {}.{} has no effect, for the load has no force", node_.find(number->name)->where, node_.name, number->name));
        }
    }

    /// @param asking for the column  @param over a place in load_arguments
    void read_file(Node const& file, Node const& asking, std::size_t over, bool repeats, std::span<std::string_view const> units) {
        TableKind const kind{load_arguments[over], argument_units[over], units, repeats, given_.row.table.interpolation, false, kind_ == LoadKind::way_profile};
        LoadTable const* const same = former_table(file, kind);
        if (same == nullptr) {
            given_.row.table = read_table_of(reading_, file, asking, given_.row.table.column, kind);
            return;
        }
        given_.row.table = *same;
        read_table_file(reading_, file);  // it is among the tables of this scene, too
    }

    /// What a former reading of the scene made of the same rows.
    LoadTable const* former_table(Node const& file, TableKind const& kind) const {
        Scene const* const former = reading_.former;
        for (std::size_t i = 0; former != nullptr && former->loads != nullptr && i < former->loads->rows().size(); ++i) {
            auto const& [name, table, words] = former->loads->rows()[i];
            TableFile const* const of = find_table(*former, name + ".table");
            if (of == nullptr || of->key != file.name || of->given != read_text_value(file) || table.column != given_.row.table.column) continue;
            Load const& load = former->loads->load(i);
            if (load.over == given_.load.over && table.interpolation == kind.interpolation && load.table.repeats == kind.repeats) return &table;
        }
        return nullptr;
    }

    static constexpr std::size_t argument_of_time = 1, argument_of_x = 2;
    static_assert(load_arguments[argument_of_time] == "time" && load_arguments[argument_of_x] == "x");

    Node const& node_;
    LoadKind const kind_;
    Reading& reading_;
    Scene const& scene_;
    GivenLoad given_;
    bool const on_linkage_ = is_linkage(scene_.parts.mechanism);
    bool on_crank_ = false;
};

/// All that the tables of a scene give, in the order of load_tables.
std::vector<GivenLoad> given_loads(Reading& reading) {
    std::vector<GivenLoad> all;
    auto const add = [&](Node const& node, LoadKind kind) {
        for (GivenLoad& load : LoadReader(node, kind, reading).read()) all.push_back(std::move(load));
    };
    MechanismInfo const& mechanism = info(reading.scene.parts.mechanism);
    for (std::size_t i = 0; i < std::size(load_tables); ++i) {
        auto const kind = static_cast<LoadKind>(i);
        Node const* const table = reading.given(table_of(kind));
        if (table == nullptr) continue;
        if (module_of(reading.scene.parts.mechanism) != nullptr) {
            throw SceneError(fmt::format("{}: [{}] acts on the mechanisms of slideway, and {} is of a module; put it into its own equations", table->where,
                                         table->name, mechanism.name));
        }
        if (!has_named_loads(table->key)) {
            add(*table, kind);
            continue;
        }
        if (!table->is_table()) refuse(*table, {fmt::format("{}s are tables", table->key), fmt::format("write [{}.name] and its keys below", table->key)});
        for (Node const& node : table->children) add(node, kind);
    }
    return all;
}

}  // namespace

void refuse_ungiven(std::string_view where, std::string_view name, Scene const& scene) {
    auto const dot = name.rfind('.');
    if (dot == name.npos) return;
    std::string_view const part = name.substr(0, dot), own = name.substr(dot + 1), table = part.substr(0, part.find('.'));
    auto const is_it = [&](auto const& row) { return row.name == part; };
    bool is_there = false;
    std::string advice = fmt::format("add {}", own);
    if (auto const loads = std::ranges::find(load_tables, table); loads != std::end(load_tables)) {
        LoadNumber const* const number = find_load_number(static_cast<LoadKind>(loads - std::begin(load_tables)), own);
        if (number == nullptr) return;
        if (number->rule != Rule::positive && number->kind != LoadKind::way_ends) advice += fmt::format(" = {}", number->preset);
        is_there = scene.loads != nullptr && std::ranges::any_of(scene.loads->rows(), is_it);
    } else {
        auto const number = std::ranges::find_if(part_numbers(), [&](PartNumber const& one) { return one.table == table && one.name == own; });
        Linkage const* const linkage = linkage_of(scene.parts.mechanism);
        if (linkage == nullptr || number == part_numbers().end()) return;
        if (number->rule != Rule::positive) advice += " = 0";
        is_there = std::ranges::any_of(linkage->rows, is_it);
    }
    if (!is_there) throw SceneError(fmt::format("{}: {} is of no {} of the scene (there is no [{}]); add that, or use the name of another", where, name, table, part));
    throw SceneError(fmt::format("{}: {} is not given in [{}] (a number must be given to vary); {}", where, name, part, advice));
}

void read_loads(Reading& reading) {
    Scene& scene = reading.scene;
    std::vector<GivenLoad> given = given_loads(reading);
    if (given.empty()) return;
    auto const most = static_cast<std::size_t>(LinkagePlan::most_loads);
    if (is_linkage(scene.parts.mechanism) && given.size() > most)
        refuse_that(*reading.given(given[most].row.name), "is one of too many",
                    {fmt::format("a linkage has {} loads, springs and stops at most together", most), "use fewer"});
    auto loads = std::make_shared<SceneLoads>();
    for (GivenLoad& load : given) {
        for (LoadNumber const* const number : load.numbers) {
            std::string name = fmt::format("{}.{}", load.row.name, number->name);
            if (loads->keys().size() == most_load_numbers) {
                Node const* const node = reading.given(name);
                refuse(node != nullptr ? *node : *reading.given(load.row.name),
                       {fmt::format("all loads, springs, stops, profiles and ends of a scene, the ground's motion and the film have {} numbers at most together",
                                   most_load_numbers), "use fewer"});
            }
            int const place = number->place(load.load) = loads->add_key(std::move(name), *number);
            scene.inputs.*load_inputs[place] = number->preset;
        }
        loads->add(std::move(load.row), load.load);
    }
    scene.parts.loads = loads->list();
    scene.loads = std::move(loads);
}

}  // namespace slideway
