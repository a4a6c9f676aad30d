#include "host/study/probe.hpp"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include "host/study/result_summary.hpp"

namespace slideway {
namespace {

/// Rows of the same parts go to the kernels as one table, so that packs are full.
void probe_group(StateTable const& table, std::vector<std::size_t> const& rows, Isa isa,
                 std::vector<ProbeResult>& results) {
    std::vector<Inputs> inputs;
    std::vector<double> times;
    for (std::size_t const row : rows) {
        inputs.push_back(table.inputs[row]);
        times.push_back(table.times[row]);
    }
    std::vector<ProbeResult> group(rows.size());
    find_instance(isa, table.parts[rows.front()]).probe({inputs.data(), times.data(), rows.size(), group.data()});
    for (std::size_t i = 0; i < rows.size(); ++i) results[rows[i]] = group[i];
}

}  // namespace

std::vector<ProbeResult> probe(StateTable const& table, Isa isa) {
    std::vector<Parts> kinds;
    for (Parts const& parts : table.parts) {
        if (std::find(kinds.begin(), kinds.end(), parts) == kinds.end()) kinds.push_back(parts);
    }
    std::vector<ProbeResult> results(table.rows());
    for (Parts const& parts : kinds) {
        std::vector<std::size_t> rows;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (table.parts[row] == parts) rows.push_back(row);
        }
        probe_group(table, rows, isa, results);
    }
    return results;
}

std::vector<std::pair<std::string, double>> result_columns(ProbeResult const& result) {
    std::vector<std::pair<std::string, double>> columns;
    for (int i = 0; i < state_size; ++i) {
        columns.emplace_back(fmt::format("d_{}", series_table[i].name), result.derivative[i]);
    }
    columns.emplace_back("power_crank", result.power_crank);
    columns.emplace_back("power_friction", result.power_friction);
    columns.emplace_back("power_damping", result.power_damping);
    auto const add_apices = [&](std::string_view prefix, double const(&values)[8]) {
        for (int i = 0; i < 8; ++i) columns.emplace_back(fmt::format("{}_P{}", prefix, i + 1), values[i]);
    };
    add_apices("pen_y", result.penetration_y);
    add_apices("pen_z", result.penetration_z);
    add_apices("fn_y", result.normal_force_y);
    add_apices("fn_z", result.normal_force_z);
    columns.emplace_back("surfaces", result.surfaces);
    columns.emplace_back("lines", result.lines);
    columns.emplace_back("points", result.points);
    columns.emplace_back("energy", result.energy);
    columns.emplace_back("contact_potential", result.contact_potential);
    columns.emplace_back("crank_torque", result.crank_torque);
    return columns;
}

void write_probe_csv(std::ostream& out, StateTable const& table, std::vector<ProbeResult> const& results) {
    std::string line;
    for (std::string const& name : table.parameter_names) line += name + ',';
    line += 't';
    for (int i = 0; i < state_size; ++i) line += fmt::format(",{}", series_table[i].name);
    for (auto const& [name, value] : result_columns({})) line += ',' + name;
    out << line << ",status\n";
    for (std::size_t row = 0; row < table.rows(); ++row) {
        line.clear();
        for (std::string const& text : table.parameter_texts[row]) line += text + ',';
        line += fmt::format("{:.17g}", table.times[row]);
        for (auto const input : state_inputs) line += fmt::format(",{:.17g}", table.inputs[row].*input);
        for (auto const& [name, value] : result_columns(results[row])) line += fmt::format(",{:.17g}", value);
        out << line << ',' << name_of(results[row].status) << '\n';
    }
}

}  // namespace slideway
