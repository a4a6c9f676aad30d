#include "host/study/probe.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "host/cli/commands.hpp"
#include "host/cli/text.hpp"

namespace slideway::cli {
namespace {

StateTable load_table(std::string const& path, Scene const& scene) {
    std::ifstream in(path);
    // A folder opens, and only fails to read.
    if (!in || (in.peek() == std::ifstream::traits_type::eof() && in.bad())) {
        throw FileError(fmt::format("{}: cannot read: {}", path, std::strerror(errno)));
    }
    return read_state_table(in, path, scene);
}

void write_table(std::string const& path, StateTable const& table, std::vector<ProbeResult> const& results) {
    std::ofstream out(path);
    if (out) write_probe_csv(out, table, results);
    out.close();
    if (!out) throw FileError(fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
}

void print_apices(std::string_view label, double const (&values)[8]) {
    fmt::print("  {:<18}", label);
    for (double const value : values) fmt::print(" {:>11.4g}", value);
    fmt::print("\n");
}

void print_listing(Scene const& scene, StateTable const& table, ProbeResult const& result, Isa isa) {
    print_field("scene", fmt::format("{} at t = 0, computed with {}", scene.path, name_of(isa)));
    print_field("status", name_of(result.status));
    fmt::print("\n  {:<8} {:<8} {:>24} {:>24}\n", "state", "unit", "value", "derivative");
    for (int i = 0; i < state_size; ++i) {
        fmt::print("  {:<8} {:<8} {:>24.16g} {:>24.16g}\n", series_table[i].name, series_table[i].unit,
                   table.inputs[0].*state_inputs[i], result.derivative[i]);
    }
    fmt::print("\n  {:<18}", "apex");
    for (int i = 1; i <= 8; ++i) fmt::print(" {:>11}", fmt::format("P{}", i));
    fmt::print("\n");
    print_apices("penetration Y [m]", result.penetration_y);
    print_apices("penetration Z [m]", result.penetration_z);
    print_apices("force Y [N]", result.normal_force_y);
    print_apices("force Z [N]", result.normal_force_z);
    fmt::print("\n");
    print_field("mode", fmt::format("{} surfaces, {} lines, {} points", result.surfaces, result.lines, result.points));
    print_field("energy",
                fmt::format("{:.10g} J, of it {:.10g} J in the contacts", result.energy, result.contact_potential));
    print_field("power", fmt::format("{:.10g} W crank, {:.10g} W friction, {:.10g} W damping", result.power_crank,
                                     result.power_friction, result.power_damping));
    print_field("crank torque", fmt::format("{:.10g} N m, without the crank's own weight", result.crank_torque));
}

}  // namespace

int probe(ProbeArguments const& arguments) {
    Isa const isa = parse_isa(arguments.scene.isa);
    Scene const scene = load_scene(arguments.scene);
    StateTable const table = arguments.table.empty() ? start_state(scene) : load_table(arguments.table, scene);
    std::vector<ProbeResult> const results = slideway::probe(table, isa);
    if (!arguments.output.empty())
        write_table(arguments.output, table, results);
    else if (!arguments.table.empty())
        write_probe_csv(std::cout, table, results);
    else
        print_listing(scene, table, results[0], isa);
    return exit_code::done;
}

}  // namespace slideway::cli
