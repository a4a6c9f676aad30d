#include "golden_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "kernels/laws/list.hpp"
#include "names.hpp"

namespace golden {
namespace {

using slideway::Inputs;

std::vector<std::string> split(std::string line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    if (!line.empty() && line.back() == ',') cells.emplace_back();
    return cells;
}

std::string digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::map<std::string, double Inputs::*> const& keys() {
    static std::map<std::string, double Inputs::*> const table = {
        {"mechanism.crank_length", &Inputs::crank_length},
        {"mechanism.rod_length", &Inputs::rod_length},
        {"mechanism.crank_speed", &Inputs::crank_speed},
        {"mechanism.start_angle", &Inputs::start_angle},
        {"mechanism.gravity", &Inputs::gravity},
        {"mechanism.inclination", &Inputs::inclination},
        {"mechanism.crank_mass", &Inputs::crank_mass},
        {"mechanism.rod_mass", &Inputs::rod_mass},
        {"mechanism.rod_mass_center", &Inputs::rod_mass_center},
        {"mechanism.rod_inertia", &Inputs::rod_inertia},
        {"mechanism.slider_mass", &Inputs::slider_mass},
        {"mechanism.slider_inertia_x", &Inputs::slider_inertia_x},
        {"mechanism.slider_inertia_y", &Inputs::slider_inertia_y},
        {"mechanism.slider_inertia_z", &Inputs::slider_inertia_z},
        {"joint.slider_length", &Inputs::slider_length},
        {"joint.way_width", &Inputs::way_width},
        {"joint.way_depth", &Inputs::way_depth},
        {"joint.thickness_y", &Inputs::thickness_y},
        {"joint.thickness_z", &Inputs::thickness_z},
        {"joint.clearance_y", &Inputs::clearance_y},
        {"joint.clearance_z", &Inputs::clearance_z},
        {"way.offset_y", &Inputs::way_offset_y},
        {"way.offset_z", &Inputs::way_offset_z},
        {"way.roll", &Inputs::way_roll},
        {"way.yaw", &Inputs::way_yaw},
        {"way.pitch", &Inputs::way_pitch},
        {"contact.slider_young_modulus", &Inputs::slider_young_modulus},
        {"contact.way_young_modulus", &Inputs::way_young_modulus},
        {"contact.slider_poisson_ratio", &Inputs::slider_poisson_ratio},
        {"contact.way_poisson_ratio", &Inputs::way_poisson_ratio},
        {"contact.edge_radius", &Inputs::edge_radius},
        {"contact.apex_radius", &Inputs::apex_radius},
        {"contact.hertz_exponent", &Inputs::hertz_exponent},
        {"contact.eta", &Inputs::eta},
        {"contact.chi_line", &Inputs::chi_line},
        {"contact.chi_surface", &Inputs::chi_surface},
        {"friction.static", &Inputs::friction_static},
        {"friction.kinetic", &Inputs::friction_kinetic},
        {"friction.stick_speed", &Inputs::friction_stick_speed},
        {"friction.slip_speed", &Inputs::friction_slip_speed}};
    return table;
}

double number_or(Table const& table, std::size_t row, std::string const& column, double otherwise) {
    return table.has(column) ? table.number(row, column) : otherwise;
}

void read_law(Table const& table, std::size_t row, Case& result) {
    Inputs& in = result.inputs;
    result.parts.law = oracle::law_named(table.text(row, "contact.law"));
    switch (result.parts.law) {
        case slideway::Law::paper:
        case slideway::Law::conservative: {
            bool const dissipates = in.chi_line != 0 || in.chi_surface != 0;
            result.parts.damping = dissipates ? slideway::Damping::rate : slideway::Damping::point;
            return;
        }
        case slideway::Law::foundation:
            result.parts.damping = in.chi_surface != 0 ? slideway::Damping::rate : slideway::Damping::point;
            in.law_a = number_or(table, row, "contact.bed_stiffness", slideway::follows);
            return;
        case slideway::Law::kelvin_voigt:
            result.parts.damping = slideway::Damping::point;
            in.law_a = number_or(table, row, "contact.apex_stiffness", slideway::follows);
            in.law_b = number_or(table, row, "contact.apex_damping", 0);
            return;
    }
}

std::vector<std::string> const state_names = {"y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz"};

struct Group {
    std::string name;
    std::vector<std::string> columns;
};

std::vector<std::string> per_apex(std::string const& name) {
    std::vector<std::string> columns;
    for (char const* axis : {"_y_P", "_z_P"})
        for (int i = 1; i <= 8; ++i) columns.push_back(name + axis + std::to_string(i));
    return columns;
}

std::vector<Group> const& groups() {
    static std::vector<Group> const list = {{"position rates", {"d_y", "d_z"}},
                                            {"accelerations", {"d_vy", "d_vz"}},
                                            {"attitude rates", {"d_roll", "d_yaw", "d_pitch"}},
                                            {"angular accelerations", {"d_wx", "d_wy", "d_wz"}},
                                            {"powers", {"power_crank", "power_friction", "power_damping"}},
                                            {"penetrations", per_apex("pen")},
                                            {"forces", per_apex("fn")},
                                            {"modes", {"surfaces", "lines", "points"}},
                                            {"energy", {"energy"}},
                                            {"potential", {"contact_potential"}},
                                            {"torque", {"crank_torque"}}};
    return list;
}

/// NaN is worse than any number.
void keep_worse(Difference& worst, double value, std::string const& where) {
    if (std::isnan(worst.value) || value <= worst.value) return;
    worst = {value, where};
}

}  // namespace

Table::Table(std::vector<std::string> columns) : columns_(std::move(columns)) {
    for (std::size_t i = 0; i < columns_.size(); ++i) index_[columns_[i]] = i;
}

Table Table::read(std::filesystem::path const& file) {
    std::ifstream in(file);
    std::string line;
    if (!in || !std::getline(in, line)) throw std::runtime_error(file.string() + ": cannot be read");
    Table table(split(line));
    for (int number = 2; std::getline(in, line); ++number) {
        auto cells = split(line);
        if (cells.size() != table.columns_.size())
            throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " +
                                     std::to_string(cells.size()) + " cells under a header of " +
                                     std::to_string(table.columns_.size()));
        table.add(std::move(cells));
    }
    return table;
}

void Table::add(std::vector<std::string> row) {
    if (row.size() != columns_.size()) throw std::runtime_error("golden table: a row of another width");
    cells_.push_back(std::move(row));
}

std::string const& Table::text(std::size_t row, std::string const& column) const {
    auto const found = index_.find(column);
    if (found == index_.end()) throw std::runtime_error("golden table: no column " + column);
    if (row >= cells_.size()) throw std::runtime_error("golden table: no row " + std::to_string(row));
    return cells_[row][found->second];
}

double Table::number(std::size_t row, std::string const& column) const {
    std::string const& cell = text(row, column);
    char* end = nullptr;
    double const value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0')
        throw std::runtime_error("golden table: " + column + " of row " + std::to_string(row) + " is '" + cell + "'");
    return value;
}

Case case_of(Table const& table, std::size_t row) {
    Case result;
    for (std::string const& column : table.columns()) {
        auto const key = keys().find(column);
        if (key != keys().end()) result.inputs.*key->second = table.number(row, column);
        if (column == "joint.clearance")
            result.inputs.clearance_y = result.inputs.clearance_z = table.number(row, column);
    }
    result.inputs = oracle::completed(result.inputs);
    read_law(table, row, result);
    result.parts.friction = true;
    result.parts.misaligned_way = table.has("way.roll");
    if (table.has("t")) result.t = table.number(row, "t");
    for (std::size_t i = 0; i < state_names.size(); ++i)
        if (table.has(state_names[i])) result.state[i] = table.number(row, state_names[i]);
    return result;
}

std::vector<std::string> const& computed_columns() {
    static std::vector<std::string> const list = [] {
        std::vector<std::string> names;
        for (auto const& state : state_names) names.push_back("d_" + state);
        for (char const* tail : {"power_crank", "power_friction", "power_damping"}) names.emplace_back(tail);
        for (char const* pairs : {"pen", "fn"})
            for (auto const& column : per_apex(pairs)) names.push_back(column);
        for (char const* tail : {"surfaces", "lines", "points", "energy", "contact_potential", "crank_torque"})
            names.emplace_back(tail);
        return names;
    }();
    return list;
}

std::vector<std::string> computed_row(oracle::Result const& result) {
    std::vector<std::string> row;
    auto const put = [&row](auto const& values) {
        for (double value : values) row.push_back(digits(value));
    };
    for (std::size_t i = 0; i < state_names.size(); ++i) row.push_back(digits(result.derivative[i]));
    put(std::array{result.power_crank, result.power_friction, result.power_damping});
    put(result.pen_y), put(result.pen_z), put(result.fn_y), put(result.fn_z);
    for (int count : {result.surfaces, result.lines, result.points}) row.push_back(std::to_string(count));
    put(std::array{result.energy, result.contact_potential, result.crank_torque});
    return row;
}

Difference worst_difference(Table const& reference, Table const& got) {
    if (reference.rows() != got.rows())
        throw std::runtime_error("golden table: " + std::to_string(got.rows()) + " rows for " +
                                 std::to_string(reference.rows()));
    // The nominal M, and L_k/2 and I of the slider: how far the measure lets cancelling forces and moments count.
    double const mass = 0.187, arm = 0.025, inertia = 2e-5;
    Difference worst;
    for (std::size_t row = 0; row < reference.rows(); ++row) {
        double load = 0;
        for (auto const& column : per_apex("fn")) load += reference.number(row, column);
        for (auto const& [name, columns] : groups()) {
            double scale = 0;
            for (auto const& column : columns) scale = std::max(scale, std::abs(reference.number(row, column)));
            if (scale == 0) scale = 1e-300;
            if (name == "accelerations") scale = std::max(scale, load / mass);
            if (name == "angular accelerations") scale = std::max(scale, load * arm / inertia);
            if (name == "modes") scale = 1;
            for (auto const& column : columns) {
                double const error = std::abs(reference.number(row, column) - got.number(row, column)) / scale;
                keep_worse(worst, error, name + " " + column + " row " + std::to_string(row));
            }
        }
    }
    return worst;
}

Difference worst_difference(Table const& trajectories, std::size_t row, std::span<double const> got) {
    Inputs const inputs = case_of(trajectories, row).inputs;
    double const clearance = std::max(inputs.clearance_y, inputs.clearance_z);
    double const tilt = 2 * clearance / inputs.slider_length;
    auto const largest = [&](std::initializer_list<char const*> columns) {
        double result = 0;
        for (char const* column : columns) result = std::max(result, std::abs(trajectories.number(row, column)));
        return result;
    };
    double const speed = largest({"vy", "vz"}), spin = largest({"wx", "wy", "wz"});
    std::array const scales = {clearance, clearance, speed, speed, tilt, tilt, tilt, spin, spin, spin};
    Difference worst;
    for (std::size_t i = 0; i < state_names.size(); ++i) {
        double const error = std::abs(trajectories.number(row, state_names[i]) - got[i]);
        double const allowed = 30 * trajectories.number(row, "u_" + state_names[i]) + 1e-7 * scales[i];
        // Rates that are zero in the reference have no scale: there only zero will do.
        double const ratio = error == 0 ? 0 : error / std::max(allowed, 1e-300);
        keep_worse(worst, ratio, state_names[i] + " row " + std::to_string(row));
    }
    return worst;
}

}  // namespace golden
