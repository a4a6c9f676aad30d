#include "host/study/probe.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/config/linkages.hpp"
#include "host/config/descriptors.hpp"
#include "host/store/output_target.hpp"
#include "host/study/series_file.hpp"
#include "host/study/state_table.hpp"
#include "host/study/study_run.hpp"
#include "kernels/members/start.hpp"

namespace slideway::cli {
namespace {

/// What is probed.
struct Probed {
    Scene scene;
    StateTable table;
    std::optional<StoredState> stored;  // of a result
};

bool is_result(std::string const& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error) && is_netcdf(*file_stream(path), path);
}

Probed probed_of_result(ProbeArguments const& arguments) {
    std::string const& path = arguments.scene.path;
    require_intact(path);
    ResultReader const results(path);
    Probed probed{stored_scene(results, arguments.scene.overrides), {}, {}};
    if (!arguments.table.empty()) {
        probed.table = read_state_table(*input_stream(arguments.table), arguments.table, probed.scene);
        return probed;
    }
    probed.stored = stored_state(results, probed.scene.parts.mechanism, arguments.member, arguments.time);
    take_member(probed.scene, results, probed.stored->member);
    probed.table = state_table(probed.scene, probed.stored->numbers, std::span(&probed.stored->time, 1));
    return probed;
}

Probed probed_of(ProbeArguments const& arguments) {
    if (is_result(arguments.scene.path)) return probed_of_result(arguments);
    for (auto const& [is_given, option] : {std::pair(arguments.member.has_value(), "--member"), {arguments.time.has_value(), "--time"}}) {
        if (is_given) throw SceneError(fmt::format("{} is for states of result files, and {} is a scene; give OUT.nc in its place, or leave it out", option, arguments.scene.path));
    }
    Probed probed{load_scene(arguments.scene), {}, {}};
    probed.table = arguments.table.empty() ? start_state(probed.scene) : read_state_table(*input_stream(arguments.table), arguments.table, probed.scene);
    for (std::string const& warning : probed.scene.warnings) tell("warning: {}\n", warning);
    return probed;
}

OutputTarget table_target(ProbeArguments const& arguments, Scene const& scene) {
    std::vector<std::string> inputs = inputs_of(scene);
    if (!arguments.table.empty()) inputs.push_back(arguments.table);
    auto const is_ours = [](std::string const& path) {
        return begins_with(path, [](std::string_view line) { return line.ends_with(",status"); });
    };
    return {arguments.output, {inputs, arguments.force, is_ours}};
}

constexpr char const* untold_of_rigid = "not told: those of rigid contacts depend on how a contact began; a run stores normal_force as a series";

std::string probed_text(StateTable const& table, std::vector<ProbeResult> const& results) {
    std::ostringstream out;
    write_probe_csv(out, table, results);
    return out.str();
}

/// Of the eight apices, or of the four corners of a planar slider.
void print_contacts(MechanismInfo const& mechanism, ProbeResult const& result) {
    std::size_t const places = mechanism.spatial ? 8 : 4;
    constexpr std::size_t label_width = 20, cell_width = 12;
    // A terminal may have room for half of them.
    std::size_t const per_line = line_width() == 0 || line_width() >= label_width + places * cell_width ? places : 4;
    for (std::size_t first = 0; first < places; first += per_line) {
        print_out("\n  {:<18}", mechanism.spatial ? "apex" : "corner");
        for (std::size_t i = first; i < first + per_line; ++i) print_out(" {:>11}", fmt::format("{}{}", mechanism.spatial ? "P" : "C", i + 1));
        print_out("\n");
        auto const print_row = [&](std::string_view label, double const(&values)[8]) {
            print_out("  {:<18}", label);
            for (std::size_t i = first; i < first + per_line; ++i) print_out(" {:>11}", cell(values[i], 4));
            print_out("\n");
        };
        print_row("penetration Y [m]", result.penetration_y);
        if (mechanism.spatial) print_row("penetration Z [m]", result.penetration_z);
        print_row("force Y [N]", result.normal_force_y);
        if (mechanism.spatial) print_row("force Z [N]", result.normal_force_z);
    }
    print_out("\n");
}

/// Of the way's faces, then of the vectors in sum and at the pins.
void print_forces(MechanismInfo const& mechanism, ProbeResult const& result) {
    auto const value = [&](Series first, std::size_t i) { return result.forces[static_cast<std::size_t>(first) - first_force_series + i]; };
    TextRows rows{{"face", "normal force [N]", "acts along [m]", "across [m]", "p v [W m-2]"}};
    for (std::size_t i = 0; i < std::size(face_names); ++i) {
        rows.push_back({face_names[i]});
        for (Series const of : {Series::face_force_y_plus, Series::face_along_y_plus, Series::face_across_y_plus, Series::face_pv_y_plus})
            rows.back().push_back(cell(value(of, i), 6));
    }
    print_table([&](int) { return rows; }, 6, 1, 8);
    print_out("\n");
    constexpr std::pair<Series, char const*> vectors[] = {{Series::friction_force_x, "friction"}, {Series::contact_force_x, "way's force"},
                                                          {Series::rod_force_x, "rod's force"}, {Series::crank_pin_force_x, "pin's force"}};
    for (auto const& [first, label] : vectors) {
        if (!has_series(mechanism, first)) continue;
        print_field(label, fmt::format("{:.10g}, {:.10g}, {:.10g} N", value(first, 0), value(first, 1), value(first, 2)));
    }
}

/// Where a state is from: "out.nc, member 3 at t = 0.05 s (sample)".
std::string state_text(Probed const& probed, std::size_t row) {
    std::string const at = fmt::format(" at t = {:.10g} s", probed.table.times[row]);
    if (!probed.stored) return probed.scene.path + at;
    return fmt::format("{}, member {}{} ({})", probed.scene.path, probed.stored->member, at, probed.stored->of);
}

std::string powers_text(StateTable const& table, ProbeResult const& result) {
    std::string powers = fmt::format("{:.10g} W drive, {:.10g} W friction, {:.10g} W damping", result.power_crank, result.power_friction, result.power_damping);
    for (LoadPower const& power : load_powers) {
        double const value = result.*power.value;
        if (table.has_loads && (value != 0 || power.value == &ProbeResult::power_load)) powers += fmt::format(", {:.10g} W {}", value, power.label);
    }
    return powers;
}

/// Of joints with clearance, and in sum.
void print_linkage(Linkage const& linkage, StateTable const& table, ProbeResult const& result) {
    TextRows rows{{"joint", "penetration [m]", "normal force [N]"}};
    for (std::size_t k = 0; k < linkage.closures.size(); ++k) {
        auto const& closure = linkage.plan.closure[k];
        for (int i = 0; i < closure.pairs(); ++i) {
            std::string const place = closure.pairs() == 1 ? linkage.closures[k] : fmt::format("{} C{}", linkage.closures[k], i + 1);
            rows.push_back({place, cell(result.penetration_y[closure.pair + i], 6), cell(result.normal_force_y[closure.pair + i], 6)});
        }
    }
    print_out("\n");
    if (rows.size() > 1) print_table([&](int) { return rows; }, 6, 1, 8);
    print_out("\n");
    print_field("energy", fmt::format("{:.10g} J, of it {:.10g} J in the contacts", result.energy, result.contact_potential));
    print_field("power", powers_text(table, result));
    if (!linkage.driven.empty()) print_field("drive torque", fmt::format("{:.10g} N m", result.crank_torque));
}

void print_listing(Probed const& probed, std::size_t row, ProbeResult const& result, Isa isa) {
    StateTable const& table = probed.table;
    print_field("state", fmt::format("{}, computed with {}", state_text(probed, row), name_of(isa)));
    print_field("status", fmt::format("{}{}", name_of(result.status), probed.stored ? " (of this state; info --members has those of members)" : ""));
    MechanismInfo const& has = info(table.mechanism);
    StateNumbers const state = start_of(table.mechanism, table.inputs[row]);
    TextRows rows{{"state", "unit", "value", "derivative"}};
    for (int i = 0; i < has.states; ++i) {
        SeriesInfo const& entry = state_info(has, i);
        rows.push_back({entry.name, entry.unit, cell(state[static_cast<std::size_t>(i)], 16), cell(result.derivative[i], 16)});
    }
    print_out("\n");
    print_table([&](int) { return rows; }, 3, 2, 8);
    if (Linkage const* const linkage = linkage_of(table.mechanism)) return print_linkage(*linkage, table, result);
    print_contacts(has, result);
    if (table.parts[row].rigid) {
        print_field("energy", fmt::format("{:.10g} J", result.energy));
        return print_field("forces", untold_of_rigid);
    }
    if (has_series(has, Series::face_force_y_plus)) print_forces(has, result);
    print_field("mode", fmt::format("{} surfaces, {} lines, {} points", result.surfaces, result.lines, result.points));
    print_field("energy", fmt::format("{:.10g} J, of it {:.10g} J in the contacts", result.energy, result.contact_potential));
    print_field("power", powers_text(table, result));
    if (has_series(has, Series::crank_torque)) {
        std::string_view const weight = has.spatial ? "by the rod: the series of that name has the crank's own weight and inertia too" : "the crank's own weight included";
        print_field("crank torque", fmt::format("{:.10g} N m, {}", result.crank_torque, weight));
    }
    for (std::size_t i = 0; i < has.signals.size(); ++i)
        print_field(has.signals[i].name, fmt::format("{:.10g} {}", result.signals[i], has.signals[i].unit));
}

/// Of a linkage: what is where in its joints with clearance, and how it pushes.
void print_joints(Probed const& probed, std::size_t row, ProbeResult const& result) {
    std::vector<JointForce> const joints = joint_forces(probed.table, row, result);
    print_out("\nHow the forces come about (docs/explanation/linkages.md): what is where in its joint, and its normal force on the first body\n");
    print_table([&](int digits) {
        TextRows rows{{"joint", "of", "in", "x [m]", "y [m]", "tilt [rad]", "depth [m]", "normal force [N]", "along X [N]", "along Y [N]"}};
        for (JointForce const& one : joints) {
            rows.push_back({one.joint, one.first, one.second});
            for (double const value : {one.x, one.y, one.tilt, one.depth, one.normal_force, one.force_x, one.force_y}) rows.back().push_back(cell(value, digits));
        }
        return rows;
    }, 5, 3, 8);
    print_out("\n");
    std::vector<std::string_view> touching;
    for (JointForce const& one : joints) {
        if (one.touches()) touching.push_back(one.joint);
    }
    print_field("touching", touching.empty() ? "none" : fmt::format("{}", fmt::join(touching, ", ")));
    print_field("damping", fmt::format("{}{}", damping_text(probed.table.parts[row]),
                                       probed.table.parts[row].damping == Damping::restitution ? ", by the speed of the last touch, which no state tells: as after one of 0.1 mm/s" : ""));
}

/// Steps from the apices to what acts on the slider.
void print_explanation(Probed const& probed, std::size_t row, ProbeResult const& result) {
    Explanation const found = explain(probed.table, row, result);
    Parts const& parts = probed.table.parts[row];
    print_out("\nHow the forces come about (docs/explanation/model.md, 3 to 5): apices against their faces\n");
    print_table([&](int digits) {
        TextRows rows{{"apex", "face", "depth [m]", "rate [m/s]", "normal force [N]", "sliding [m/s]", "coefficient", "friction [N]"}};
        for (ApexPair const& pair : found.pairs) {
            rows.push_back({fmt::format("P{}", pair.apex + 1), face_names[pair.face]});
            for (double const value : {pair.depth, pair.rate, pair.normal_force, pair.sliding, pair.coefficient, pair.friction}) rows.back().push_back(cell(value, digits));
        }
        return rows;
    }, 5, 2, 8);
    print_out("\n");
    std::vector<std::string> touching, modes;
    for (ApexPair const& pair : found.pairs) {
        if (pair.touches()) touching.push_back(pair.name());
    }
    for (FaceMode const& mode : found.modes) {
        modes.push_back(fmt::format("{} {}", face_names[mode.face], mode.kind));
        for (int const apex : mode.apices) modes.back() += fmt::format(" P{}", apex + 1);
    }
    ApexPair const& nearest = found.nearest();
    print_field("touching", touching.empty() ? fmt::format("none; nearest is {}, {:.4g} m away", nearest.name(), -nearest.depth)
                                             : fmt::format("{}", fmt::join(touching, ", ")));
    print_field("law", fmt::format("{}: {}; {}", contact_info(parts).name, contact_info(parts).words, damping_text(parts)));
    if (parts.rigid) return;
    print_field("modes", modes.empty() ? "free flight" : fmt::format("{}", fmt::join(modes, ", ")));
    if (parts.damping == Damping::restitution) print_field("damping", "goes by the speed of the last touch, which no state tells: as after one of 0.1 mm/s");
    auto const vector = [](std::array<double, 3> const& v, char const* unit) { return fmt::format("{:.8g}, {:.8g}, {:.8g} {}", v[0], v[1], v[2], unit); };
    print_field("friction", parts.friction ? vector(found.friction, "N along the way's axes") : "none: the scene has no [friction]");
    print_field("force", vector(found.force, "N on the slider, friction included"));
    print_field("torque", vector(found.torque, "N m about the centre of its hole"));
}

}  // namespace

int execute(ProbeArguments const& arguments) {
    Isa const asked = parse_isa(arguments.scene.isa);
    Probed const probed = probed_of(arguments);
    Scene const& scene = probed.scene;
    StateTable const& table = probed.table;
    Isa const isa = arguments.scene.isa == "auto" ? best_isa(scene.parts) : asked;
    std::optional<OutputTarget> const target = arguments.output.empty() ? std::nullopt : std::optional(table_target(arguments, scene));
    for (std::string const& warning : table.warnings) tell("warning: {}\n", warning);
    std::vector<ProbeResult> const results = slideway::probe(table, isa);
    if (target) target->write(probed_text(table, results));
    if (arguments.json) {
        print_out("{}", probe_json(scene.path, table, results, probed.stored, arguments.explain));
    } else if (target) {
        return exit_code::done;
    } else if (!arguments.table.empty() && !arguments.explain) {
        print_out("{}", probed_text(table, results));
    } else {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (row > 0) print_out("\n");
            print_listing(probed, row, results[row], isa);
            if (arguments.explain) is_linkage(table.mechanism) ? print_joints(probed, row, results[row]) : print_explanation(probed, row, results[row]);
        }
    }
    return exit_code::done;
}

}  // namespace slideway::cli
