#include "host/study/probe.hpp"

#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "host/base/open_file.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/json.hpp"
#include "host/commands/text.hpp"
#include "host/config/descriptors.hpp"
#include "host/store/output_target.hpp"
#include "host/study/study_run.hpp"
#include "kernels/members/start.hpp"

namespace slideway::cli {
namespace {

OutputTarget table_target(ProbeArguments const& arguments, Scene const& scene) {
    std::vector<std::string> inputs = inputs_of(scene);
    if (!arguments.table.empty()) inputs.push_back(arguments.table);
    auto const is_ours = [](std::string const& path) {
        return begins_with(path, [](std::string_view line) { return line.ends_with(",status"); });
    };
    return {arguments.output, {inputs, arguments.force, is_ours}};
}

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
            for (std::size_t i = first; i < first + per_line; ++i) print_out(" {:>11.4g}", values[i]);
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
        if (!selects(mechanism.series, first)) continue;
        print_field(label, fmt::format("{:.10g}, {:.10g}, {:.10g} N", value(first, 0), value(first, 1), value(first, 2)));
    }
}

void print_listing(Scene const& scene, StateTable const& table, ProbeResult const& result, Isa isa) {
    print_field("scene", fmt::format("{} at t = 0, computed with {}", scene.path, name_of(isa)));
    print_field("status", name_of(result.status));
    MechanismInfo const& has = info(table.mechanism);
    StateNumbers const state = start_of(info(table.mechanism), table.inputs[0]);
    TextRows rows{{"state", "unit", "value", "derivative"}};
    for (int i = 0; i < has.states; ++i) {
        SeriesInfo const& entry = state_info(has, i);
        rows.push_back({entry.name, entry.unit, cell(state[static_cast<std::size_t>(i)], 16), cell(result.derivative[i], 16)});
    }
    print_out("\n");
    print_table([&](int) { return rows; }, 3, 2, 8);
    print_contacts(has, result);
    if (selects(has.series, Series::face_force_y_plus)) print_forces(has, result);
    print_field("mode", fmt::format("{} surfaces, {} lines, {} points", result.surfaces, result.lines, result.points));
    print_field("energy", fmt::format("{:.10g} J, of it {:.10g} J in the contacts", result.energy, result.contact_potential));
    print_field("power", fmt::format("{:.10g} W drive, {:.10g} W friction, {:.10g} W damping{}", result.power_crank, result.power_friction,
                                     result.power_damping, table.has_loads ? fmt::format(", {:.10g} W loads", result.power_load) : ""));
    if (selects(has.series, Series::crank_torque)) {
        std::string_view const weight = has.spatial ? "without the crank's own weight" : "the crank's own weight included";
        print_field("crank torque", fmt::format("{:.10g} N m, {}", result.crank_torque, weight));
    }
    for (std::size_t i = 0; i < has.signals.size(); ++i)
        print_field(has.signals[i].name, fmt::format("{:.10g} {}", result.signals[i], has.signals[i].unit));
}

}  // namespace

int execute(ProbeArguments const& arguments) {
    Isa const asked = parse_isa(arguments.scene.isa);
    Scene const scene = load_scene(arguments.scene);
    Isa const isa = arguments.scene.isa == "auto" ? best_isa(scene.parts) : asked;
    std::optional<OutputTarget> const target = arguments.output.empty() ? std::nullopt : std::optional(table_target(arguments, scene));
    StateTable const table =
        arguments.table.empty() ? start_state(scene) : read_state_table(*input_stream(arguments.table), arguments.table, scene);
    for (std::string const& warning : scene.warnings) tell("warning: {}\n", warning);
    for (std::string const& warning : table.warnings) tell("warning: {}\n", warning);
    std::vector<ProbeResult> const results = slideway::probe(table, isa);
    if (target) target->write(probed_text(table, results));
    if (arguments.json)
        print_out("{}", probe_json(scene, table, results));
    else if (target)
        return exit_code::done;
    else if (!arguments.table.empty())
        print_out("{}", probed_text(table, results));
    else
        print_listing(scene, table, results[0], isa);
    return exit_code::done;
}

}  // namespace slideway::cli
