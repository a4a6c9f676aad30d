#include "host/store/result_layout.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/outputs.hpp"
#include "host/store/result_view.hpp"

namespace slideway {
namespace {

using Numbers = ResultColumn::Numbers;

/// A column of one number per member.  @param of what gives it of a EndedMember
template <class Of> ResultColumn of_members(std::string name, std::string unit, std::string meaning, Of of) {
    auto const source = [of](EndedMember const& member, Numbers& out) { out.push_back(static_cast<double>(of(member))); };
    return {std::move(name), std::move(unit), std::move(meaning), {"member"}, "", source};
}

/// The source of a column that has its numbers side by side.
template <class Of> auto row_of(Of of) {
    return [of](EndedMember const& member, Numbers& out) {
        auto const numbers = of(member);
        out.insert(out.end(), numbers.begin(), numbers.end());
    };
}

void add_coordinates(ResultColumns& list, ResultLayout const& layout) {
    list.dimensions.push_back({"member", static_cast<std::size_t>(layout.members.count())});
    list.columns.push_back({.name = "member", .unit = "1", .meaning = "number of the member in the scene's ensemble", .dimensions = {"member"},
                            .type = DataFile::Type::int32,
                            .before = [](std::uint64_t member, Numbers& out) { out.push_back(static_cast<double>(member)); }});
    if (layout.labelled != nullptr) {
        list.dimensions.push_back({"member_label_length", layout.labelled->label_width});
        list.columns.push_back({.name = "member_label", .unit = "", .meaning = fmt::format("{} of study.table", layout.labelled->labelled),
                                .dimensions = {"member", "member_label_length"}, .type = DataFile::Type::text,
                                .before = [table = layout.labelled](std::uint64_t member, Numbers& out) {
                                    std::string const& label = table->labels[static_cast<std::size_t>(member)];
                                    out.insert(out.end(), label.begin(), label.end());
                                    out.resize(out.size() + table->label_width - label.size(), 0);
                                }});
    }
    if (layout.sample_times.empty()) return;
    list.dimensions.push_back({"sample", layout.sample_times.size()});
    if (layout.by_turns) list.columns.push_back({"turned", "rad", "what the crank has turned since the start of the run", {"sample"}});
    else list.columns.push_back({"time", "s", "time since the start of the run", {"sample"}});
    list.columns.back().values = layout.sample_times;
}

void add_records(ResultColumns& list, ResultLayout const& layout) {
    ResultColumn status = status_column("status", "how the member ended", "member");
    status.source = [](EndedMember const& row, Numbers& out) { out.push_back(static_cast<double>(row.record().status)); };
    status.before = [](std::uint64_t, Numbers& out) { out.push_back(static_cast<double>(Status::not_run)); };
    list.columns.push_back(std::move(status));
    // Counts can pass 2^31 and CF-1.8 has no wider integers; a double holds them exactly up to 2^53.
    for (WorkCounter const& counter : work_table)
        list.columns.push_back(of_members(counter.name, "1", counter.meaning, [of = counter.of](EndedMember const& row) { return row.record().*of; }));
    list.columns.push_back(of_members("end_time", "s", "time at which the member ended", [](EndedMember const& row) { return row.record().time; }));
    MechanismInfo const& mechanism = info(layout.mechanism);
    for (int k = 0; k < mechanism.states; ++k) {
        SeriesInfo const& state = state_info(mechanism, k);
        auto const last = [k = static_cast<std::size_t>(k)](EndedMember const& row) { return row.block.final_states[row.place * row.block.states() + k]; };
        list.columns.push_back(of_members(fmt::format("final_{}", state.name), state.unit, fmt::format("{} at end_time", state.long_name), last));
    }
    list.columns.insert(list.columns.end(), layout.parameters.begin(), layout.parameters.end());
}

void add_quantities(ResultColumns& list, ResultLayout const& layout) {
    for (OutputQuantity const& quantity : selected(outputs_of(layout.mechanism).quantities, layout.quantities)) {
        auto const source = row_of([place = quantity.place, width = static_cast<std::size_t>(quantity.columns)](EndedMember const& row) {
            return row.block.quantities.subspan(row.place * row.block.columns() + place, width);
        });
        ResultColumn column{quantity.name, quantity.unit, quantity.long_name, {"member"}, "", source};
        if (quantity.dimension != nullptr) {
            list.add_labels_of(quantity.dimension);
            column.dimensions.emplace_back(quantity.dimension);
            column.coordinates = std::string(quantity.dimension) + "_name";
        }
        column.summarised = true;
        list.columns.push_back(std::move(column));
    }
}

void add_series(ResultColumns& list, ResultLayout const& layout) {
    if (layout.sample_times.empty()) return;
    std::string const place = layout.by_turns ? "turned" : "time";
    if (layout.by_turns) {
        auto const clock = row_of([samples = layout.sample_times.size()](EndedMember const& row) { return row.block.clock.subspan(row.place * samples, samples); });
        list.columns.push_back({"time", "s", "time at which the member's crank had turned so far", {"member", "sample"}, place, clock});
    }
    std::size_t number = 0;
    for (SeriesInfo const& series : selected(outputs_of(layout.mechanism).series, layout.series)) {
        auto const source = row_of([k = number++, samples = layout.sample_times.size()](EndedMember const& row) {
            return row.block.series.subspan((k * row.block.members.size() + row.place) * samples, samples);
        });
        list.columns.push_back({series.name, series.unit, series.long_name, {"member", "sample"}, place, source});
    }
}

/// A column of counts, 0 of members that have not run.
template <class Of> ResultColumn of_counts(std::string name, std::string meaning, Of of) {
    ResultColumn column = of_members(std::move(name), "1", std::move(meaning), of);
    column.type = DataFile::Type::int32;
    column.before = [](std::uint64_t, Numbers& out) { out.push_back(0); };
    return column;
}

/// CF-1.8, 9.3.3: contiguous ragged arrays.
void add_sections(ResultColumns& list, ResultLayout const& layout) {
    if (layout.sections == 0) return;
    // A dimension of no length is one without limit to netCDF.
    list.dimensions.push_back({"section", static_cast<std::size_t>(layout.section_rows)});
    list.columns.push_back(of_counts("section_count", "sections of the member",
                                     [](EndedMember const& row) { return sections_of(row.block, row.place).size() / section_columns(row.block.states()); }));
    list.columns.back().attributes = {{"sample_dimension", "section"}};
    if (layout.crossings) {
        auto const crossings = [](EndedMember const& row) { return std::min<std::uint64_t>(row.record().crossings, std::numeric_limits<int>::max()); };
        list.columns.push_back(of_counts("section_crossings", "crossings of the section, also those beyond study.max_crossings", crossings));
    }
    auto const add = [&list](std::string name, std::string unit, std::string meaning, std::size_t k) {
        list.columns.push_back({std::move(name), std::move(unit), std::move(meaning), {"section"}, "", [k](EndedMember const& row, Numbers& out) {
                                    auto const sections = sections_of(row.block, row.place);
                                    for (std::size_t at = k; at < sections.size(); at += section_columns(row.block.states())) out.push_back(sections[at]);
                                }});
    };
    add("section_time", "s", "time of the section since the start of the run", 0);
    MechanismInfo const& mechanism = info(layout.mechanism);
    for (int k = 0; k < mechanism.states; ++k) {
        SeriesInfo const& state = state_info(mechanism, k);
        add(fmt::format("section_{}", state.name), state.unit, fmt::format("{} at the section", state.long_name), static_cast<std::size_t>(k) + 1);
    }
}

std::vector<std::string> parts_of(std::string const& text, std::string_view between) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < text.size();) {
        std::size_t const to = std::min(text.find(between, from), text.size());
        parts.push_back(text.substr(from, to - from));
        from = to + between.size();
    }
    return parts;
}

}  // namespace

void add_columns(std::vector<QuantityColumn>& columns, QuantityColumn first) {
    if (first.dimension.empty()) return columns.push_back(std::move(first));
    for (std::string& label : labels_of(first.dimension)) {
        first.label = std::move(label);
        columns.push_back(first);
        ++first.index;
        ++first.place;
    }
}

std::vector<QuantityColumn> columns_of(Mechanism mechanism, Selection quantities) {
    std::vector<QuantityColumn> columns;
    for (OutputQuantity const& one : selected(outputs_of(mechanism).quantities, quantities))
        add_columns(columns, {one.name, one.dimension != nullptr ? one.dimension : "", "", 0, one.place, one.unit, one.long_name});
    return columns;
}

QuantityColumn const* column_of(std::vector<QuantityColumn> const& columns, Limit const& limit) {
    auto const found =
        std::ranges::find_if(columns, [&](QuantityColumn const& column) { return column.quantity == limit.quantity && column.label == limit.label; });
    return found == columns.end() ? nullptr : &*found;
}

std::string variable_name(std::string_view key) {
    std::string name(key);
    std::ranges::replace(name, '.', '_');
    return name;
}

ResultColumn parameter_column(std::string_view key, std::string_view unit, std::string_view meaning, double Inputs::*input) {
    auto const of = [input](EndedMember const& member) { return member.block.inputs[member.place].*input; };
    ResultColumn column = of_members(variable_name(key), std::string(unit), std::string(meaning), of);
    column.attributes = {{"key", std::string(key)}};
    return column;
}

std::vector<QuantityColumn> stored_columns(ResultView const& results) {
    std::vector<std::string> names = parts_of(words_of_now(results.attribute("quantities")), " "), units = parts_of(results.attribute("quantity_units"), ", ");
    // Earlier versions did not say, and knew those of the table alone.
    if (names.empty() && results.stores_members()) std::ranges::transform(quantity_table, std::back_inserter(names), &QuantityInfo::name);
    std::vector<QuantityColumn> columns;
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::string const& name = names[i];
        if (results.stores_members() && !results.has(name)) continue;
        QuantityColumn column{name, "", "", 0, 0, "1", name};
        auto const* const known = std::ranges::find_if(quantity_table, [&](QuantityInfo const& one) { return name == one.name; });
        if (known != std::end(quantity_table)) column = {name, known->dimension != nullptr ? known->dimension : "", "", 0, 0, known->unit, known->long_name};
        if (i < units.size()) column.unit = units[i];
        if (results.has(name)) column.unit = results.unit(name), column.long_name = results.long_name(name);
        add_columns(columns, std::move(column));
    }
    return columns;
}

ResultColumn status_column(std::string name, std::string meaning, std::string dimension) {
    std::vector<signed char> values{static_cast<signed char>(Status::not_run)};
    for (int status = 0; status < status_count; ++status) values.push_back(static_cast<signed char>(status));
    ResultColumn column{std::move(name), "", std::move(meaning), {std::move(dimension)}, "", {}, DataFile::Type::int8};
    column.attributes = {{"flag_values", values}, {"flag_meanings", fmt::format("not_run {}", fmt::join(status_names, " "))}};
    return column;
}

ResultColumns result_columns(ResultLayout const& layout) {
    ResultColumns list;
    if (!layout.sweep.empty()) list.attributes.push_back({"sweep_parameter", layout.sweep});
    add_coordinates(list, layout);
    add_records(list, layout);
    add_quantities(list, layout);
    add_series(list, layout);
    for (ResultColumn const& column : layout.study) {
        if (!column.values.empty()) list.dimensions.push_back({column.name, column.values.size()});
        list.columns.push_back(column);
    }
    add_sections(list, layout);
    std::vector<std::string> summarised;
    for (ResultColumn const& column : list.columns) {
        if (column.summarised) summarised.push_back(column.name);
    }
    if (!summarised.empty()) list.attributes.push_back({"quantities", fmt::format("{}", fmt::join(summarised, " "))});
    return list;
}

std::uint64_t payload_bytes(ResultLayout const& layout) {
    ResultLayout full = layout;
    full.section_rows = layout.sections * layout.members.count();
    ResultColumns const list = result_columns(full);
    std::uint64_t bytes = 0;
    for (ResultColumn const& column : list.columns) {
        bool const names_a_dimension = column.type == DataFile::Type::text && !column.values.empty();  // a part of the header
        if (!names_a_dimension) bytes += list.size(column) * DataFile::size_of(column.type);
    }
    return bytes;
}

std::uint64_t header_bytes(ResultLayout const& layout, Provenance const& provenance) {
    // An object of HDF5 for each variable with its attributes, another for each of its dimensions, and what netCDF adds to every file.
    constexpr std::uint64_t of_variable = 1000, of_file = 16'000;
    std::uint64_t const variables = result_columns(layout).columns.size() + layout.study.size();
    return of_file + variables * of_variable + provenance.scene.size() + provenance.maker.flags.size();
}

std::span<double const> sections_of(BlockResult const& block, std::size_t place) {
    std::size_t const width = block.sections.size() / block.members.size();
    auto const room = block.sections.subspan(place * width, width);
    std::size_t reached = 0;
    while (reached < width && !std::isnan(room[reached])) reached += section_columns(block.states());
    return room.first(reached);
}

}  // namespace slideway
