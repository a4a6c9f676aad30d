#include "host/study/state_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <istream>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/csv.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/base/text.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/units.hpp"
#include "host/store/result_layout.hpp"
#include "host/store/run_identity.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/series_file.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/members/start.hpp"

namespace slideway {
namespace {

/// What a column means.
struct Column {
    enum class Kind { ignored, time, state, law, key };
    Kind kind = Kind::ignored;
    std::string name;
    std::size_t state = 0;  // its place
    Key const* key = nullptr;
    std::string wanted = "in SI units";  // numbers, for words
    bool is_told = false;                // that one of its numbers is unusual
    UnitFactor factor = UnitFactor(1);
};

std::vector<std::string_view> state_names(Mechanism mechanism) {
    std::vector<std::string_view> names;
    for (int i = 0; i < info(mechanism).states; ++i) names.emplace_back(state_info(info(mechanism), i).name);
    return names;
}

/// What starts a member in a state, which has columns of its own.
bool starts_a_state(std::string_view name, Mechanism mechanism) {
    bool const crank = name == "mechanism.start_angle" || name == "mechanism.crank_speed";
    return name.starts_with("initial.") || (crank && info(mechanism).may_turn_freely);
}

[[noreturn]] void fail_meaningless(std::string_view name, Mechanism mechanism, CsvReader const& lines) {
    lines.fail(fmt::format("column {}: has no meaning for kind = \"{}\"; remove it", name, kind_of(mechanism)));
}

Column input_column(std::string_view name, Scene const& scene, CsvReader const& lines) {
    Mechanism const mechanism = scene.parts.mechanism;
    Column column;
    column.name = name;
    if (name == "t") {
        column.kind = Column::Kind::time;
    } else if (name == "contact.law") {
        column.kind = Column::Kind::law;
        if (!info(mechanism).spatial) fail_meaningless(name, mechanism, lines);
    } else if (name.find('.') == name.npos) {
        auto const names = state_names(mechanism);
        auto const found = std::find(names.begin(), names.end(), name);
        if (found != names.end()) column.kind = Column::Kind::state;
        column.state = static_cast<std::size_t>(found - names.begin());
    } else if (column.key = find_key(name, scene); column.key != nullptr) {
        column.kind = Column::Kind::key;
        if (!counts_for(*column.key, mechanism)) fail_meaningless(name, mechanism, lines);
        if (starts_a_state(name, mechanism)) {
            bool const own = info(mechanism).spatial;
            std::string const place = own ? std::string(name.substr(8)) : fmt::format("{}", fmt::join(state_names(mechanism), ", "));
            lines.fail(fmt::format("column {}: the state to probe stands in the column{} {}", name, own ? "" : "s", place));
        }
    } else {
        std::vector<std::string_view> names = numeric_key_names(scene);
        names.emplace_back("contact.law");
        std::string_view const meant = nearest_name(name, names);
        lines.fail(
            fmt::format("column {}: no numeric key of a scene has this name{}", name,
                        meant.empty() ? std::string("; see slideway list") : fmt::format("; did you mean {}?", meant)));
    }
    return column;
}

/// The SI unit of a column's numbers.
std::string unit_of(Column const& column, Mechanism mechanism) {
    if (column.kind == Column::Kind::key) return std::string(column.key->unit);
    return column.kind == Column::Kind::state ? state_info(info(mechanism), static_cast<int>(column.state)).unit : "s";
}

std::vector<Column> read_header(Scene const& scene, CsvReader const& lines) {
    Mechanism const mechanism = scene.parts.mechanism;
    std::vector<Column> columns;
    for (std::string const& text : lines.fields()) {
        ColumnHeader const header = column_header(text);
        std::string const& name = header.name;
        Column column = input_column(name, scene, lines);
        if (column.kind != Column::Kind::ignored && column.kind != Column::Kind::law) {
            std::string const unit = unit_of(column, mechanism);
            auto const factor = header.factor_to(unit);
            if (auto const* problem = std::get_if<Problem>(&factor)) lines.fail(fmt::format("column {}: {}; {}", text, problem->reason, problem->advice));
            column.factor = std::get<UnitFactor>(factor);
            if (header.unit) column.wanted = "of " + *header.unit;
        }
        if (column.kind != Column::Kind::ignored) {
            for (Column const& other : columns) {
                if (other.name == column.name) lines.fail(fmt::format("column {}: stands there twice", name));
                if (column.key && other.key && column.key->overlaps(*other.key)) {
                    lines.fail(fmt::format("column {}: sets the same input as {}", name, other.name));
                }
            }
        }
        columns.push_back(std::move(column));
    }
    auto const need = [&](std::string_view name) {
        auto const has_name = [&](Column const& column) { return column.name == name; };
        if (std::ranges::none_of(columns, has_name))
            lines.fail(fmt::format("column {}: is missing; the table needs t, {}", name, fmt::join(state_names(mechanism), ", ")));
    };
    need("t");
    for (std::string_view const name : state_names(mechanism)) need(name);
    return columns;
}

double number(std::size_t place, Column const& column, CsvReader& lines) {
    CellNumber number;
    auto const fault = lines.read_number(place, number);
    if (!fault) return column.factor(number.text, number.value);
    lines.fail(fmt::format("column {}: '{}' is {}; {}", column.name, lines.fields()[place], fault->reason,
                           fault->advice.empty() ? "give a number " + column.wanted : fault->advice));
}

Law law(std::string_view text, Scene const& scene, CsvReader const& lines) {
    try {
        if (auto const found = find_law(text, scene.modules)) return *found;
    } catch (DeviceError const& error) {
        lines.fail(fmt::format("column contact.law: {}", error.what()));
    }
    lines.fail(fmt::format("column contact.law: '{}' is no law; use one of {}", text, fmt::join(law_names(), ", ")));
}

/// The scene is of another law: what that one has of its own is none of this one's, and its damping may be none.
void choose_law(Parts& parts, Inputs& inputs) {
    inputs = with_presets(inputs, parts.law);
    if (!info(parts.law).has(parts.damping)) parts.damping = info(parts.law).needs_restitution ? Damping::restitution : Damping::point;
}

/// A part with its parameter at zero does what the code without it does.
bool needs_part(Key const& key, double value) {
    return value != 0 || !(key.name.starts_with("way.") || key.name.starts_with("contact.chi_"));
}

/// Puts a state in the place of the start.  @return why it is none, if it is so
std::optional<std::string> take_state(MechanismInfo const& mechanism, StateNumbers const& state, Inputs& inputs) {
    // Beyond it the start would be another, with the same height of the slider.
    if (double const rod_angle = state[1]; !mechanism.spatial && mechanism.own_series.empty() && !(std::abs(rod_angle) < std::numbers::pi / 2))
        return fmt::format("rod_angle is {} rad (the rod is to point along the way); use a value within a right angle of 0", rod_angle);
    set_start(mechanism, state, inputs);
    return {};
}

/// @return why the inputs cannot be used, if it is so; then there is no such row
std::optional<std::string> add(StateTable& table, Inputs const& given, Parts const& parts, double time, std::vector<std::string> texts = {}) {
    Inputs const inputs = complete_inputs(given, info(parts.mechanism));
    if (auto why = defect(inputs, parts)) return why;
    if (!std::isfinite(time)) return fmt::format("t is {} s; use a finite number", time);
    table.inputs.push_back(inputs);
    table.parts.push_back(parts);
    table.times.push_back(time);
    table.parameter_texts.push_back(std::move(texts));
    return {};
}

void add_row(StateTable& table, std::vector<Column>& columns, Scene const& scene, CsvReader& lines) {
    std::vector<std::string> const& cells = lines.fields();
    lines.require_columns();
    Inputs inputs = scene.inputs;
    Parts parts = scene.parts;
    StateNumbers state{};
    double time = 0;
    std::vector<std::string> texts;
    // The keys that count are those of the row's law, wherever its column stands.
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (columns[i].kind != Column::Kind::law) continue;
        parts.law = law(cells[i], scene, lines);
        if (parts.law != scene.parts.law) choose_law(parts, inputs);
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        Column& column = columns[i];
        switch (column.kind) {
            case Column::Kind::ignored:
                break;
            case Column::Kind::time:
                time = number(i, column, lines);
                break;
            case Column::Kind::state:
                state[column.state] = number(i, column, lines);
                break;
            case Column::Kind::law:
                texts.emplace_back(cells[i]);
                break;
            case Column::Kind::key: {
                double const value = number(i, column, lines);
                if (!counts_for(*column.key, parts))
                    lines.fail(fmt::format("column {}: contact.law \"{}\" does not know it; remove it", column.name, info(parts.law).name));
                column.key->set(inputs, value);
                if (auto const words = unusual(*column.key, value); words && !std::exchange(column.is_told, true))
                    table.warnings.push_back(fmt::format("{}: {} {}", lines.where(), column.name, *words));
                if (needs_part(*column.key, value)) require_part(parts, *column.key);
                texts.push_back(fmt::format("{:.17g}", value));
            }
        }
    }
    if (auto const why = take_state(info(parts.mechanism), state, inputs)) lines.fail(*why);
    if (auto const why = add(table, inputs, parts, time, std::move(texts))) lines.fail(*why);
}

/// A table of the scene's mechanism without rows.
StateTable empty_table(Scene const& scene) {
    StateTable table;
    table.mechanism = scene.parts.mechanism;
    table.has_loads = scene.parts.loads.count > 0;
    return table;
}

}  // namespace

StateTable start_state(Scene const& scene) {
    StateTable table = empty_table(scene);
    if (auto const why = add(table, scene.inputs, scene.parts, 0)) throw SceneError(fmt::format("{}: {}", scene.path, *why));
    return table;
}

StateTable state_table(Scene const& scene, std::span<double const> states, std::span<double const> times) {
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    auto const width = static_cast<std::size_t>(mechanism.states);
    StateTable table = empty_table(scene);
    std::size_t const rows = states.size() / width;
    if (states.size() % width != 0 || (!times.empty() && times.size() != rows)) {
        throw SceneError(fmt::format("{}: states are rows of {} numbers ({}), with one time for each", scene.path, width,
                                     fmt::join(state_names(scene.parts.mechanism), ", ")));
    }
    for (std::size_t row = 0; row < rows; ++row) {
        StateNumbers state{};
        std::copy_n(states.begin() + static_cast<std::ptrdiff_t>(row * width), width, state.begin());
        Inputs inputs = scene.inputs;
        auto why = take_state(mechanism, state, inputs);
        if (!why) why = add(table, inputs, scene.parts, times.empty() ? 0 : times[row]);
        if (why) throw SceneError(fmt::format("{}: state {}: {}", scene.path, row, *why));
    }
    return table;
}

StateTable read_state_table(std::istream& in, std::string const& name, Scene const& scene) {
    CsvReader lines(in, name);
    if (!lines.next()) lines.fail("the table is empty");
    std::vector<Column> columns = read_header(scene, lines);
    StateTable table = empty_table(scene);
    for (Column const& column : columns) {
        if (column.kind == Column::Kind::law || column.kind == Column::Kind::key) table.parameter_names.push_back(column.name);
    }
    while (lines.next()) add_row(table, columns, scene, lines);
    if (in.bad()) throw FileError(fmt::format("{}: cannot read", name));
    if (table.rows() == 0) lines.fail("the table has a header but no row");
    return table;
}

namespace {

/// The stored states of one member, of which one is taken.
class MemberStates {
public:
    MemberStates(ResultView const& results, Mechanism mechanism, std::uint64_t place) : results_(results), mechanism_(info(mechanism)), place_(place) {}

    /// Takes what is nearer in time than what there is; a state with a NaN, behind a failure, is none.
    void look(std::string_view of, double wanted) {
        if (of == "end") offer(of, wanted, results_.rows("end_time", place_, 1)[0], [&](std::string const& name) { return results_.rows("final_" + name, place_, 1)[0]; });
        if (of == "sample") look_at_samples(wanted);
        if (of == "section") look_at_sections(wanted);
    }
    StoredState const& nearest() const { return nearest_; }
    bool found() const { return std::isfinite(distance_); }

private:
    std::string name(int i) const { return state_info(mechanism_, i).name; }
    bool has_all(std::string const& prefix) const {
        for (int i = 0; i < mechanism_.states; ++i) {
            if (!results_.has(prefix + name(i))) return false;
        }
        return true;
    }

    template <class Of> void offer(std::string_view of, double wanted, double time, Of const& value) {
        double const distance = std::abs(time - wanted);
        if (!(distance < distance_)) return;
        std::vector<double> numbers;
        for (int i = 0; i < mechanism_.states; ++i) numbers.push_back(value(name(i)));
        if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); })) return;
        distance_ = distance;
        nearest_.time = time, nearest_.of = of, nearest_.numbers = std::move(numbers);
    }

    void look_at_samples(double wanted) {
        if (!results_.has("time") || !has_all("")) return;
        std::vector<std::vector<double>> columns;
        for (int i = 0; i < mechanism_.states; ++i) columns.push_back(results_.rows(name(i), place_, 1));
        std::vector<double> const times = results_.has("turned") ? results_.rows("time", place_, 1) : results_.values("time");
        for (std::size_t k = 0; k < times.size(); ++k) {
            std::size_t i = 0;
            offer("sample", wanted, times[k], [&](std::string const&) { return columns[i++].at(k); });
        }
    }

    void look_at_sections(double wanted) {
        if (!results_.has("section_count") || !has_all("section_")) return;
        std::vector<double> const counts = results_.values("section_count");
        std::size_t first = 0;
        for (std::size_t i = 0; i < place_; ++i) first += count_of(counts.at(i));
        std::size_t const count = count_of(counts.at(place_));
        if (count == 0) return;
        std::vector<double> const times = results_.rows("section_time", first, count);
        for (std::size_t k = 0; k < count; ++k)
            offer("section", wanted, times[k], [&](std::string const& state) { return results_.rows("section_" + state, first + k, 1)[0]; });
    }

    ResultView const& results_;
    MechanismInfo const& mechanism_;
    std::uint64_t place_;
    double distance_ = std::numeric_limits<double>::infinity();
    StoredState nearest_{};
};

/// A table of `rows` with the inputs that the members have of it; of no columns where they are not stored.
std::string table_of_members(ResultView const& results, std::string const& scene, std::size_t rows) {
    std::vector<std::string> lines(rows + 1);
    std::vector<double> const numbers = results.values("member"), statuses = results.values("status", numbers.size());
    for (std::string const& name : results.variable_names()) {
        std::string const key = results.attribute_of(name, "key");
        if (key.empty() || scene.find(fmt::format("\n\"{}\" = ", key)) != scene.npos) continue;  // [study.vary] has it
        std::vector<double> const values = results.values(name, numbers.size());
        std::vector<double> column(rows, nan);
        double any = nan;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            Status const status = status_of(statuses[i]);
            if (status == Status::not_run || status == Status::invalid_inputs || count_of(numbers[i]) >= rows) continue;
            any = column[count_of(numbers[i])] = values[i];
        }
        if (std::isnan(any)) continue;
        std::ranges::replace_if(column, [](double x) { return std::isnan(x); }, any);  // of members that did not run nothing is asked
        char const* const separator = lines[0].empty() ? "" : ",";
        lines[0] += separator + key;
        for (std::size_t row = 0; row < rows; ++row) lines[row + 1] += fmt::format("{}{}", separator, column[row]);
    }
    return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace

Scene stored_scene(ResultView const& results, Overrides overrides) {
    std::string const text = results.attribute("scene"), key = "study.table", given = "members of this result";
    OfTables const tables = contents_of_tables(text);
    Scene own;
    if (auto const content = tables.find(key); content != tables.end() && results.stores_members() && results.attribute("sweep_parameter").empty()) {
        std::string table = table_of_members(results, text, std::strtoull(content->second.c_str(), nullptr, 10));
        if (!table.starts_with('\n')) {  // files without the attribute have none of its columns
            own.tables.push_back({key, given, results.path(), results.path(), std::make_shared<std::string const>(std::move(table)), 0});
            overrides.emplace(overrides.begin(), key, given);
        }
    }
    return parse_scene(text, results.path(), overrides, &own);
}

StoredState stored_state(ResultView const& results, Mechanism mechanism, std::optional<std::uint64_t> member, std::optional<double> time) {
    if (!results.stores_members()) {
        throw SceneError(fmt::format("{}: keeps statistics, no states of members; run one with --member K --set study.store=members", results.path()));
    }
    std::uint64_t const place = member_place(results, member);
    MemberStates states(results, mechanism, place);
    // Where a sample is at the end, or a section, both are the same state.
    for (std::string_view const of : {"end", "sample", "section"}) {
        if (time || of == "end") states.look(of, time.value_or(results.rows("end_time", place, 1)[0]));
    }
    StoredState state = states.nearest();
    state.member = count_of(results.rows("member", place, 1)[0]);
    if (states.found()) return state;
    throw SceneError(fmt::format("{}: has no state of member {}, which ended as {}{}", results.path(), state.member,
                                 name_of(status_of(results.rows("status", place, 1)[0])), time ? "" : "; ask for an earlier one with --time"));
}

void take_member(Scene& scene, ResultView const& results, std::uint64_t member) {
    std::uint64_t const place = member_place(results, member);
    std::vector<Key const*> keys;
    if (scene.study == StudyKind::sweep) keys.push_back(scene.chaos.parameter);
    for (Variation const& variation : scene.variations) keys.push_back(variation.key);
    for (Key const* const key : keys) key->set(scene.inputs, results.rows(variable_name(key->name), place, 1)[0]);
    if (!is_continued(scene) || member < scene.members) return;
    // Where the file does not have the member before, it is taken to have finished: few do not.
    std::vector<double> const numbers = results.values("member"), statuses = results.values("status", numbers.size());
    auto const before = std::ranges::find(numbers, static_cast<double>(member - scene.members)) - numbers.begin();
    bool const goes_on = static_cast<std::size_t>(before) == numbers.size() || status_of(statuses[static_cast<std::size_t>(before)]) == Status::finished;
    if (goes_on) scene.inputs.start_angle = scene.chaos.section.level;
}

}  // namespace slideway
