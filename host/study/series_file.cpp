#include "host/study/series_file.hpp"

#include <algorithm>
#include <cmath>
#include <istream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/csv.hpp"
#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

struct Table {
    std::vector<std::string> names;  // empty: no header
    std::vector<std::vector<double>> columns;
    std::vector<std::string> faults;  // of each column what its first cell without a number is, and where; "" of numbers throughout

    std::string label(std::size_t column) const { return names.empty() ? fmt::format("column {}", column + 1) : names[column]; }
    /// The numbers of a column that is asked for.  @throws SceneError where a cell has none
    std::vector<double> const& numbers(std::size_t column) const {
        if (!faults[column].empty()) throw SceneError(faults[column]);
        return columns[column];
    }
};

/// A header is a first row without a number.
Table read_table(std::istream& in, std::string const& name) {
    CsvReader rows(in, name, CsvReader::Kind::series);
    Table table;
    if (!rows.next()) rows.fail("the table is empty");
    std::size_t const count = rows.fields().size();
    table.columns.resize(count);
    table.faults.resize(count);
    bool has_number = false;
    for (std::size_t i = 0; i < count; ++i) has_number = has_number || rows.is_number(i);
    for (std::size_t i = 0; i < count && !has_number; ++i) {
        if (auto const fault = rows.formula_fault(i)) rows.fail(fmt::format("column {} is \"{}\" ({}); {}", i + 1, rows.fields()[i], fault->reason, fault->advice));
    }
    if (!has_number) {
        table.names = rows.fields();
        if (!rows.next()) rows.fail("the table has a header but no row");
    }
    do {
        rows.require_columns();
        // Columns of text may stand beside those that are asked for.
        for (std::size_t i = 0; i < count; ++i) {
            CellNumber number;
            auto const fault = rows.read_number(i, number);
            table.columns[i].push_back(number.value);
            if (!fault || !table.faults[i].empty()) continue;
            table.faults[i] = fmt::format("{}: {} is \"{}\" ({}); {}", rows.where(), table.label(i), rows.fields()[i], fault->reason,
                                          fault->advice.empty() ? "give another column, or numbers" : fault->advice);
        }
    } while (rows.next());
    return table;
}

/// The first column of one of these names, units left aside.
std::optional<std::size_t> column_named(Table const& table, std::initializer_list<std::string_view> wanted) {
    auto const found = std::ranges::find_if(table.names, [&](std::string const& name) { return std::ranges::count(wanted, column_header(name).name) > 0; });
    return found == table.names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - table.names.begin()));
}

std::optional<std::size_t> time_column(Table const& table) { return column_named(table, {"time", "t"}); }

std::size_t column_place(Table const& table, std::string const& table_name, std::string const& wanted) {
    std::size_t const count = table.columns.size();
    if (wanted.empty()) return time_column(table) == count - 1 && count > 1 ? count - 2 : count - 1;
    auto const named = std::ranges::find(table.names, wanted);
    if (named != table.names.end()) return static_cast<std::size_t>(named - table.names.begin());
    if (auto const bare = column_named(table, {wanted})) return *bare;
    auto const place = parse_number<std::size_t>(wanted);
    if (place && *place >= 1 && *place <= count) return *place - 1;
    std::string const known = table.names.empty() ? "" : fmt::format("one of {}, or ", fmt::join(table.names, ", "));
    throw SceneError(fmt::format("{}: there is no column '{}'; give {}a number from 1 to {}", table_name, wanted, known, count));
}

/// "y, z": the variables of which something holds.
template <class Condition> std::string known_variables(ResultView const& file, Condition const& holds) {
    std::vector<std::string> names = file.variable_names();
    std::erase_if(names, [&](std::string const& name) { return !holds(name); });
    return fmt::format("{}", fmt::join(names, ", "));
}

/// The values of a variable at one member's sections.  Crossings that are not equally spaced are iterates all the same, their mean
/// spacing apart.
StoredSeries read_sections(ResultView const& file, std::string variable, std::uint64_t place) {
    if (file.has("section_" + variable)) variable = "section_" + variable;
    auto const times = file.values("section_time");
    auto const is_column = [&](std::string const& name) {
        auto const shape = file.shape(name);
        return name.starts_with("section_") && shape.size() == 1 && shape[0] == times.size() &&
               name != "section_time" && name != "section_count" && name != "section_crossings";
    };
    if (!file.has(variable) || !is_column(variable))
        throw SceneError(fmt::format("{}: has no sections of '{}'; use one of {}", file.path(), variable, known_variables(file, is_column)));
    auto const counts = file.values("section_count");
    double first = 0, all = 0;
    for (std::size_t i = 0; i < counts.size(); all += counts[i++]) {
        if (!(counts[i] >= 0)) all = std::nan("");
        if (i == place) first = all;
    }
    if (place >= counts.size() || all != static_cast<double>(times.size())) {
        throw FileError(fmt::format("{}: is damaged (the sections of its members do not add up); run the study again", file.path()));
    }
    double const count = counts[place];
    if (count < 2)
        throw SceneError(fmt::format("{}: the member has {} sections; a series needs at least 2", file.path(), count));
    auto const of_member = [&](std::vector<double> const& all) {
        auto const begin = all.begin() + static_cast<std::ptrdiff_t>(first);
        return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count));
    };
    auto const own = of_member(times);
    return {variable, file.unit(variable), of_member(file.values(variable)), (own.back() - own.front()) / (count - 1)};
}

}  // namespace

std::uint64_t member_place(ResultView const& file, std::optional<std::uint64_t> member) {
    if (!member) return 0;
    auto const numbers = file.values("member");
    auto const found = std::find(numbers.begin(), numbers.end(), static_cast<double>(*member));
    if (found != numbers.end()) return static_cast<std::uint64_t>(found - numbers.begin());
    throw SceneError(numbers.empty() ? fmt::format("{}: has no members", file.path())
                                     : fmt::format("{}: has no member {}; it has {:.0f} to {:.0f}", file.path(), *member,
                                                   numbers.front(), numbers.back()));
}

std::optional<double> equal_spacing(std::vector<double> const& times) {
    if (times.size() < 2) return std::nullopt;
    double const spacing = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    if (!(spacing > 0) || !std::isfinite(spacing)) return std::nullopt;
    for (std::size_t i = 0; i < times.size(); ++i) {
        double const off = times[i] - (times.front() + static_cast<double>(i) * spacing);
        if (!(std::abs(off) <= 0.01 * spacing)) return std::nullopt;
    }
    return spacing;
}

bool is_netcdf(std::istream& in, std::string const& path) {
    char first[4] = {};
    in.read(first, sizeof first);
    if (in.bad()) throw FileError(path + ": cannot be read");
    std::string_view const bytes(first, static_cast<std::size_t>(in.gcount()));
    in.clear();
    // A pipe cannot be opened again, nor rewound; what is in its buffer can be put back.
    for (std::size_t i = 0; i < bytes.size(); ++i) in.unget();
    return bytes == "\x89HDF" || bytes.starts_with("CDF");
}

StoredSeries read_result_series(std::string const& path, std::string const& variable, std::optional<std::uint64_t> member) {
    return read_result_series(ResultReader(path), variable, member);
}

StoredSeries read_result_series(ResultView const& file, std::string const& variable, std::optional<std::uint64_t> member) {
    std::string const& path = file.path();
    if (!file.stores_members()) {
        throw SceneError(path +
                         ": keeps statistics, no series of members; run one with --member K --set "
                         "study.store=members --set study.samples=1000");
    }
    if (!file.has("time") && file.has("section_count")) return read_sections(file, variable, member_place(file, member));
    if (!file.has("time"))
        throw SceneError(path + ": has no time series; run the scene as kind = \"ensemble\" with study.samples");
    if (file.has("turned"))
        throw SceneError(path + ": its samples are at equal angles, not at equal times; run the scene with study.duration and study.samples");
    std::vector<double> const times = file.values("time");
    std::size_t const members = file.values("member").size();
    if (members == 0) throw SceneError(path + ": has no members");
    auto const is_series = [&](std::string const& name) {
        auto const shape = file.shape(name);
        return shape.size() == 2 && shape[0] == members && shape[1] == times.size();
    };
    if (!file.has(variable) || !is_series(variable))
        throw SceneError(fmt::format("{}: has no series '{}'; use one of {}", path, variable, known_variables(file, is_series)));
    auto const spacing = equal_spacing(times);
    if (!spacing) throw SceneError(path + ": the sample times are not equally spaced");
    std::uint64_t const place = member_place(file, member);
    auto const all = file.values(variable);
    auto const first = all.begin() + static_cast<std::ptrdiff_t>(place * times.size());
    return {variable, file.unit(variable), {first, first + static_cast<std::ptrdiff_t>(times.size())}, *spacing};
}

StoredSeries read_csv_series(std::istream& in, std::string const& name, std::string const& column,
                             std::optional<double> spacing) {
    Table const table = read_table(in, name);
    if (in.bad()) throw FileError(fmt::format("{}: cannot read", name));
    std::size_t const place = column_place(table, name, column);
    std::vector<double> const& values = table.numbers(place);
    if (!spacing) {
        auto const time = time_column(table);
        if (!time) throw SceneError(fmt::format("{}: has no column time or t; give --dt SECONDS", name));
        spacing = equal_spacing(table.numbers(*time));
        auto const factor = column_header(table.names[*time]).factor_to("s");
        if (auto const* problem = std::get_if<Problem>(&factor))
            throw SceneError(fmt::format("{}: column {}: {}; {}", name, table.label(*time), problem->reason, problem->advice));
        if (spacing) spacing = std::get<UnitFactor>(factor)(fmt::format("{}", *spacing), *spacing);
        if (!spacing) throw SceneError(fmt::format("{}: the times are not equally spaced; resample the series", name));
    }
    return {table.label(place), "", values, *spacing};
}

}  // namespace slideway
