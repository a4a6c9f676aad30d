#include "host/study/probe.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/study/result_summary.hpp"
#include "kernels/members/start.hpp"

namespace slideway {

std::vector<ProbeResult> probe(Isa isa, Parts const& parts, std::vector<Inputs> const& inputs, std::vector<double> const& times) {
    std::vector<ProbeResult> results(inputs.size());
    find_instance(isa, parts).probe({inputs.data(), times.data(), inputs.size(), results.data()});
    return results;
}

namespace {

/// Of rigid contacts a state tells depths and energy: what pushes, and so how it moves on, depends on how contacts began.
void forget_forces(ProbeResult& result) {
    auto const forget = [](auto& values) { std::ranges::fill(values, nan); };
    forget(result.derivative), forget(result.normal_force_y), forget(result.normal_force_z), forget(result.forces), forget(result.signals);
    result.surfaces = result.lines = result.points = 0;
    for (double* const value : {&result.power_crank, &result.power_friction, &result.power_damping, &result.contact_potential, &result.crank_torque}) *value = nan;
    for (LoadPower const& power : load_powers) result.*power.value = nan;
}

}  // namespace

std::vector<ProbeResult> probe(StateTable const& table, Isa isa) {
    std::vector<Parts> kinds;
    for (Parts const& parts : table.parts) {
        if (std::find(kinds.begin(), kinds.end(), parts) == kinds.end()) kinds.push_back(parts);
    }
    std::vector<ProbeResult> results(table.rows());
    // Rows of the same parts go to the kernels as one table, so that packs are full.
    for (Parts const& parts : kinds) {
        std::vector<std::size_t> rows;
        std::vector<Inputs> inputs;
        std::vector<double> times;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (!(table.parts[row] == parts)) continue;
            rows.push_back(row);
            inputs.push_back(table.inputs[row]);
            times.push_back(table.times[row]);
        }
        std::vector<ProbeResult> const group = probe(isa, parts, inputs, times);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            results[rows[i]] = group[i];
            if (parts.rigid) forget_forces(results[rows[i]]);
        }
    }
    return results;
}

std::vector<std::pair<std::string, double>> result_columns(StateTable const& table, ProbeResult const& result) {
    MechanismInfo const& has = info(table.mechanism);
    std::vector<std::pair<std::string, double>> columns;
    columns.reserve(static_cast<std::size_t>(has.states));
    for (int i = 0; i < has.states; ++i) {
        columns.emplace_back(fmt::format("d_{}", state_info(has, i).name), result.derivative[i]);
    }
    columns.emplace_back("power_crank", result.power_crank);
    columns.emplace_back("power_friction", result.power_friction);
    columns.emplace_back("power_damping", result.power_damping);
    if (table.has_loads) {
        for (LoadPower const& power : load_powers) columns.emplace_back(power.name, result.*power.value);
    }
    int const places = has.spatial ? 8 : 4;
    auto const add_places = [&](std::string_view prefix, double const(&values)[8]) {
        for (int i = 0; i < places; ++i) columns.emplace_back(fmt::format("{}{}", prefix, i + 1), values[i]);
    };
    if (has.spatial) {
        add_places("pen_y_P", result.penetration_y);
        add_places("pen_z_P", result.penetration_z);
        add_places("fn_y_P", result.normal_force_y);
        add_places("fn_z_P", result.normal_force_z);
    } else {
        add_places("pen_C", result.penetration_y);
        add_places("fn_C", result.normal_force_y);
    }
    bool const is_known = !std::isnan(result.contact_potential);  // else what is held is not, either (forget_forces)
    for (auto const& [name, count] : {std::pair("surfaces", result.surfaces), {"lines", result.lines}, {"points", result.points}})
        columns.emplace_back(name, is_known ? count : nan);
    columns.emplace_back("energy", result.energy);
    columns.emplace_back("contact_potential", result.contact_potential);
    if (selects(has.series, Series::crank_torque)) columns.emplace_back("crank_torque", result.crank_torque);
    for (std::size_t i = 0; i < has.signals.size(); ++i) columns.emplace_back(has.signals[i].name, result.signals[i]);
    return columns;
}

std::vector<std::pair<std::string, double>> force_columns(MechanismInfo const& mechanism, ProbeResult const& result) {
    std::vector<std::pair<std::string, double>> columns;
    for (int i = first_force_series; i < series_count; ++i) {
        if (selects(mechanism.series, static_cast<Series>(i))) columns.emplace_back(series_table[i].name, result.forces[i - first_force_series]);
    }
    return columns;
}

void write_probe_csv(std::ostream& out, StateTable const& table, std::vector<ProbeResult> const& results) {
    std::string line;
    for (std::string const& name : table.parameter_names) line += name + ',';
    line += 't';
    MechanismInfo const& has = info(table.mechanism);
    for (int i = 0; i < has.states; ++i) line += fmt::format(",{}", state_info(has, i).name);
    for (auto const& [name, value] : result_columns(table, {})) line += ',' + name;
    out << line << ",status\n";
    for (std::size_t row = 0; row < table.rows(); ++row) {
        line.clear();
        for (std::string const& text : table.parameter_texts[row]) line += text + ',';
        line += fmt::format("{:.17g}", table.times[row]);
        StateNumbers const state = start_of(info(table.mechanism), table.inputs[row]);
        for (int i = 0; i < has.states; ++i) line += fmt::format(",{:.17g}", state[static_cast<std::size_t>(i)]);
        for (auto const& [name, value] : result_columns(table, results[row]))
            line += fmt::format(",{:.17g}", value);
        out << line << ',' << name_of(results[row].status) << '\n';
    }
}

}  // namespace slideway
