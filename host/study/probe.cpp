#include "host/study/probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include <fmt/format.h>

#include "host/backend/linkage_numbers.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/linkages.hpp"
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
    if (Linkage const* const linkage = linkage_of(table.mechanism)) {
        for (std::size_t k = 0; k < linkage->closures.size(); ++k) {
            std::string const name = linkage->closures[k].substr(linkage->closures[k].find('.') + 1);
            auto const& closure = linkage->plan.closure[k];
            for (int i = 0; i < closure.pairs(); ++i) {
                std::string const place = closure.pairs() == 1 ? name : fmt::format("{}_C{}", name, i + 1);
                columns.emplace_back("pen_" + place, result.penetration_y[closure.pair + i]);
                columns.emplace_back("fn_" + place, result.normal_force_y[closure.pair + i]);
            }
        }
        columns.emplace_back("energy", result.energy);
        columns.emplace_back("contact_potential", result.contact_potential);
        columns.emplace_back("drive_torque", result.crank_torque);
        return columns;
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
    if (has_series(has, Series::crank_torque)) columns.emplace_back("crank_torque", result.crank_torque);
    for (std::size_t i = 0; i < has.signals.size(); ++i) columns.emplace_back(has.signals[i].name, result.signals[i]);
    return columns;
}

std::vector<std::pair<std::string, double>> force_columns(MechanismInfo const& mechanism, ProbeResult const& result) {
    std::vector<std::pair<std::string, double>> columns;
    for (int i = first_force_series; i < series_count; ++i) {
        if (has_series(mechanism, static_cast<Series>(i))) columns.emplace_back(series_table[i].name, result.forces[i - first_force_series]);
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
        StateNumbers const state = start_of(table.mechanism, table.inputs[row]);
        for (int i = 0; i < has.states; ++i) line += fmt::format(",{:.17g}", state[static_cast<std::size_t>(i)]);
        for (auto const& [name, value] : result_columns(table, results[row]))
            line += fmt::format(",{:.17g}", value);
        out << line << ',' << name_of(results[row].status) << '\n';
    }
}

namespace {

/// μ(V) (M5.2).
double friction_coefficient(double speed, Inputs const& in) {
    double const rise = in.friction_stick_speed, most = in.friction_static, least = in.friction_kinetic;
    if (speed < rise) return most * std::sin(std::numbers::pi * speed / (2 * rise));
    if (speed >= in.friction_slip_speed) return least;
    return (most + least) / 2 + (most - least) / 2 * std::cos(std::numbers::pi * (speed - rise) / (in.friction_slip_speed - rise));
}

/// The contacts of a face (M4.1).
void add_modes(std::vector<FaceMode>& modes, int face, std::array<bool, 4> const& touches) {
    auto const& apices = face_apices[face];
    if (std::ranges::count(touches, true) == 4) {
        modes.push_back({face, "surface", {std::begin(apices), std::end(apices)}});
        return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t const next = (i + 1) % 4, last = (i + 3) % 4;
        if (touches[i] && touches[next]) modes.push_back({face, "line", {apices[i], apices[next]}});
        if (touches[i] && !touches[next] && !touches[last]) modes.push_back({face, "point", {apices[i]}});
    }
}

}  // namespace

std::string ApexPair::name() const { return fmt::format("P{} {}", apex + 1, face_names[face]); }

std::vector<JointForce> joint_forces(StateTable const& table, std::size_t row, ProbeResult const& result) {
    Linkage const* const linkage = linkage_of(table.mechanism);
    std::vector<JointForce> forces;
    for (int k = 0; linkage != nullptr && k < linkage->plan.closures; ++k) {
        LinkageClosure const& of = linkage->plan.closure[k];
        if (!of.has_clearance()) continue;
        auto const body = [&](int side) { return of.body[side] == LinkageBody::ground ? std::string(ground_name) : linkage->bodies[static_cast<std::size_t>(of.body[side])]; };
        std::string const& name = linkage->closures[static_cast<std::size_t>(k)];
        auto const [x, y] = place_in_joint(linkage->plan, table.inputs[row], k);
        JointForce joint{name.substr(name.find('.') + 1), body(0), body(1), x, y, nan, -std::numeric_limits<double>::infinity(), 0, nan, nan};
        for (int pair = of.pair; pair < of.pair + of.pairs(); ++pair) {
            joint.depth = std::max(joint.depth, result.penetration_y[pair]);
            joint.normal_force += result.normal_force_y[pair];
        }
        if (of.kind == ClosureKind::block) {
            joint.x = nan, joint.y = x, joint.tilt = y;
        } else {
            double const along = joint.normal_force > 0 ? -joint.normal_force / std::hypot(x, y) : 0;
            joint.force_x = along * x + 0.0, joint.force_y = along * y + 0.0;
        }
        forces.push_back(std::move(joint));
    }
    return forces;
}

Explanation explain(StateTable const& table, std::size_t row, ProbeResult const& result) {
    MechanismInfo const& mechanism = info(table.mechanism);
    if (!mechanism.spatial)
        throw SceneError(fmt::format("--explain follows the forces of sliders with eight apices, and a {} has corners; leave it out", mechanism.name));
    Inputs const& in = table.inputs[row];
    Parts const& parts = table.parts[row];
    bool const is_told = has_series(mechanism, Series::face_force_y_plus) && !parts.rigid;
    auto const known = [&](double value) { return is_told ? value + 0.0 : nan; };  // no −0
    Explanation found{};
    for (int face = 0; face < 4; ++face) {
        bool const is_y = face < 2;
        std::array<bool, 4> touches{};
        for (std::size_t i = 0; i < 4; ++i) {
            int const apex = face_apices[face][i];
            auto const of = [&](double const(&y)[8], double const(&z)[8]) { return (is_y ? y : z)[apex]; };
            ApexPair pair{apex, face, of(result.penetration_y, result.penetration_z), known(of(result.approach_y, result.approach_z)),
                          known(of(result.normal_force_y, result.normal_force_z)), known(of(result.sliding_y, result.sliding_z)), known(0), 0};
            if (parts.friction) pair.coefficient = friction_coefficient(pair.sliding, in);
            pair.friction = pair.coefficient * pair.normal_force;
            touches[i] = pair.touches();
            found.pairs.push_back(pair);
        }
        if (is_told) add_modes(found.modes, face, touches);
    }
    auto const vector = [&](Series first, std::size_t i) { return known(result.forces[static_cast<std::size_t>(first) - first_force_series + i]); };
    for (std::size_t i = 0; i < 3; ++i) {
        found.friction[i] = vector(Series::friction_force_x, i);
        found.force[i] = vector(Series::contact_force_x, i);
        found.torque[i] = known(result.torque[i]);
    }
    found.length = in.slider_length, found.width = in.way_width, found.depth = in.way_depth;
    return found;
}

}  // namespace slideway
