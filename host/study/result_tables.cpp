#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/error.hpp"
#include "host/base/text.hpp"
#include "host/store/result_layout.hpp"
#include "host/study/result_summary.hpp"

namespace slideway {
namespace {

void require_members(ResultView const& results) {
    if (results.stores_members()) return;
    throw SceneError(fmt::format("{}: keeps statistics, no members (its scene says study.store = \"statistics\"); run the scene with study.store = \"members\"",
                                 results.path()));
}

/// What the entries of a dimension are called: by its texts, by its numbers, or by their places.
std::vector<std::string> entry_names(ResultView const& results, std::string const& dimension, std::size_t length) {
    if (results.has(dimension + "_name")) return results.texts(dimension + "_name");
    std::vector<double> numbers(length);
    for (std::size_t i = 0; i < length; ++i) numbers[i] = static_cast<double>(i);
    if (results.has(dimension)) numbers = results.values(dimension, length);
    std::vector<std::string> names;
    for (double const number : numbers) names.push_back(fmt::format("{}", number));
    return names;
}

TableColumns stored_numbers(ResultView const& results, std::string const& variable, std::string const& name) {
    std::string const unit = results.unit(variable);
    return {.names = {name}, .unit = unit == "1" ? "" : unit,
            .numbers = [&results, variable](std::size_t first, std::size_t count) { return results.rows(variable, first, count); }};
}

/// Columns of a variable of members: one for each of its numbers, "mode_time[free]", "lyapunov_history[1][2]".
TableColumns columns_of_members(ResultView const& results, std::string const& variable) {
    std::string const key = results.attribute_of(variable, "key");
    TableColumns columns = stored_numbers(results, variable, key.empty() ? variable : key);
    std::vector<std::string> const dimensions = results.dimensions_of(variable);
    std::vector<std::size_t> const shape = results.shape(variable);
    for (std::size_t d = 1; d < dimensions.size(); ++d) {
        std::vector<std::string> spread;
        std::vector<std::string> const entries = entry_names(results, dimensions[d], shape[d]);
        for (std::string const& name : columns.names) {
            for (std::string const& entry : entries) spread.push_back(fmt::format("{}[{}]", name, entry));
        }
        columns.names = std::move(spread);
    }
    return columns;
}

/// Variables along `member`, but for series, in the order of the table: what identifies a member, what varies, quantities, all others.
std::vector<std::string> variables_of_members(ResultView const& results) {
    std::vector<std::string> names = results.variable_names();
    std::erase_if(names, [&](std::string const& name) {
        std::vector<std::string> const dimensions = results.dimensions_of(name);
        bool const of_members = !dimensions.empty() && dimensions[0] == "member" && std::ranges::count(dimensions, "sample") == 0;
        return !of_members || name == "member" || name == "status" || name == "member_label";
    });
    std::map<std::string, int> rank;
    for (QuantityColumn const& column : stored_columns(results)) rank[column.quantity] = 1;
    auto const rank_of = [&](std::string const& name) { return !results.attribute_of(name, "key").empty() ? 0 : rank.contains(name) ? 1 : 2; };
    std::ranges::stable_sort(names, {}, rank_of);
    return names;
}

}  // namespace

ExportTable table_of_members(ResultView const& results) {
    require_members(results);
    ExportTable table{.name = "members", .members = results.shape("member").at(0)};
    table.columns.push_back(stored_numbers(results, "member", "member"));
    TableColumns status{.names = {"status"}};
    for (double const number : results.values("status", table.members)) status.words.push_back(name_of(status_of(number)));
    table.columns.push_back(std::move(status));
    if (results.has("member_label")) table.columns.push_back({.names = {"member_label"}, .words = results.texts("member_label")});
    for (std::string const& name : variables_of_members(results)) table.columns.push_back(columns_of_members(results, name));
    return table;
}

ExportTable table_of_series(ResultView const& results, std::vector<std::string> const& names) {
    require_members(results);
    std::vector<std::string> there = results.variable_names();
    std::vector<std::string> const along{"member", "sample"};
    std::erase_if(there, [&](std::string const& name) { return results.dimensions_of(name) != along; });
    if (there.empty()) throw SceneError(results.path() + ": has no time series; run the scene with study.samples, or samples_per_revolution");
    for (std::string const& name : names) {
        if (std::ranges::count(names, name) > 1) throw SceneError(fmt::format("--series has {} twice; name each series once", name));
        if (std::ranges::count(there, name) > 0) continue;
        std::vector<std::string_view> const known(there.begin(), there.end());
        std::string_view const meant = nearest_name(name, known);
        throw SceneError(fmt::format("{}: has no series '{}'; {}", results.path(), name,
                                     meant.empty() ? fmt::format("use some of {}", fmt::join(there, ", ")) : fmt::format("did you mean {}?", meant)));
    }
    ExportTable table{.name = "series", .members = results.shape("member").at(0), .samples = results.shape("time").back()};
    table.columns.push_back(stored_numbers(results, "member", "member"));
    // At equal angles each member has times of its own.
    bool const by_turns = results.has("turned");
    std::string const place = by_turns ? "turned" : "time";
    table.columns.push_back(stored_numbers(results, place, place));
    table.columns.back().along = TableColumns::Along::samples;
    std::vector<std::string> shown = names.empty() ? there : names;
    if (by_turns && std::ranges::count(shown, "time") == 0) shown.insert(shown.begin(), "time");
    for (std::string const& name : shown) {
        table.columns.push_back(stored_numbers(results, name, name));
        table.columns.back().along = TableColumns::Along::both;
    }
    return table;
}

ExportTable table_of_sections(ResultView const& results) {
    require_members(results);
    if (!results.has("section_time")) throw SceneError(results.path() + ": has no sections; run the scene with study.kind = \"poincare\" or \"sweep\"");
    ExportTable table{.name = "sections", .members = results.shape("section_time").at(0)};
    std::vector<double> const members = results.values("member"), counts = results.values("section_count", members.size());
    std::vector<double> owners;
    for (std::size_t i = 0; i < members.size(); ++i)
        owners.insert(owners.end(), std::min<std::size_t>(count_of(counts[i]), table.members - owners.size()), members[i]);
    if (owners.size() != table.members) throw FileError(results.path() + ": is damaged (the sections of its members do not add up); run the study again");
    table.columns.push_back({.names = {"member"}, .numbers = [owners](std::size_t first, std::size_t count) {
                                 auto const begin = owners.begin() + static_cast<std::ptrdiff_t>(first);
                                 return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count));
                             }});
    constexpr std::string_view prefix = "section_";
    std::vector<std::string> const along{"section"};
    for (std::string const& name : results.variable_names()) {
        if (results.dimensions_of(name) == along) table.columns.push_back(stored_numbers(results, name, name.substr(prefix.size())));
    }
    return table;
}

}  // namespace slideway
