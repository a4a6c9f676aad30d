// What hot paths cost, in numbers that no other work on the machine changes: right-hand sides of the members, and, under valgrind's
// callgrind, instructions.  Prints a line for each scene; callgrind's counts of it are in a file of their own.  Usage: costs ISA
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <valgrind/callgrind.h>

#include "bench/spread.hpp"
#include "host/config/descriptors.hpp"
#include "kernels/laws/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {
namespace {

constexpr double pi = 3.141592653589793;

struct CostCase {
    char const* name;
    Parts parts;
    double clearance, crank_speed, chi, end_time, rtol;
    std::size_t members = 8;
    Selection quantities = 0;
    Method method = Method::automatic;
    Load const* load = nullptr;
};

constexpr Selection audit = Selection(1) << static_cast<int>(Quantity::energy_residual);

// What comes to nothing has no other steps than the same scene without it: the difference is what it costs.
constexpr PieceTable::Piece level[12] = {{0, 0, 0, 0, 0}, {0.5, 0, 0, 0, 0}, {1, 0, 0, 0, 0}, {1.5, 0, 0, 0, 0}, {2, 0, 0, 0, 0}, {2.5, 0, 0, 0, 0},
                                         {3, 0, 0, 0, 0}, {3.5, 0, 0, 0, 0}, {4, 0, 0, 0, 0}, {4.5, 0, 0, 0, 0}, {5, 0, 0, 0, 0}, {5.5, 0, 0, 0, 0}};
constexpr int first_of_cells[13] = {0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
constexpr PieceTable table(double low, double high, bool repeats) { return {level, 12, low, high, repeats, 0, first_of_cells, 12, 12 / (high - low), true}; }
constexpr Load force{.name = "load.force", .force = {0, 1, 2}, .point = {3, 4, 5}};
constexpr Load indicator{.name = "load.indicator", .force = {0, 1, 2}, .point = {3, 4, 5}, .over = LoadArgument::crank_angle, .table = table(0, 6, true)};
constexpr Load profile{.name = "way_profile.level", .kind = LoadKind::way_profile, .over = LoadArgument::x, .table = table(0, 6, false), .faces = 15};

constexpr CostCase cases[] = {
    {"paper", {Law::paper, Damping::point, true, false}, 1e-4, pi, 0, 0.01, 1e-6},
    {"conservative", {Law::conservative, Damping::point, true, false}, 1e-4, pi, 0, 0.01, 1e-6},
    {"rattling", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.05, 1e-6},
    {"rattling_force", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.02, 1e-6, 8, 0, Method::automatic, &force},
    {"rattling_table", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.02, 1e-6, 8, 0, Method::automatic, &indicator},
    {"rattling_profile", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.02, 1e-6, 8, 0, Method::automatic, &profile},
    {"rattling_order_3", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.05, 1e-4},
    {"rattling_clocks", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.05, 1e-5, 8, audit, Method::verner65},
    {"settling", {Law::conservative, Damping::rate, true, false}, 1e-4, pi, 10, 0.2, 1e-4, 2},
    {"audited_restitution", {Law::conservative, Damping::restitution, true, true}, 5e-4, 47, 0, 0.05, 1e-6, 8,
     testing::all_quantities & ~selections::force_quantities},
};

std::vector<Inputs> members_of(CostCase const& c) {
    auto starts = testing::scattered_starts(c.members, c.clearance, c.crank_speed);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        bench::spread_inputs(starts[i], c.chi, [&](double irrational) {
            double const x = static_cast<double>(i + 1) * irrational;
            return 0.8 + 0.4 * (x - static_cast<double>(static_cast<std::uint64_t>(x)));
        });
        starts[i].restitution = 0.7;
    }
    return starts;
}

void measure(Isa isa, CostCase const& c) {
    testing::RunOptions options;
    options.parts = c.parts;
    if (c.load != nullptr) options.parts.loads = {c.load, 1};
    options.settings.end_time = c.end_time;
    options.settings.rtol = options.settings.atol = c.rtol;
    options.settings.method = c.method;
    options.settings.locate_modes = has_switches(c.parts);
    options.quantities = c.quantities;
    auto const starts = members_of(c);
    std::string const name = std::string(name_of(isa)) + " " + c.name;
    CALLGRIND_ZERO_STATS;
    auto const result = testing::run(isa, options, starts);
    CALLGRIND_DUMP_STATS_AT(name.c_str());
    std::uint64_t evaluations = 0;
    for (auto const& record : result.records) evaluations += record.rhs_evaluations;
    std::printf("%s evaluations %llu\n", name.c_str(), static_cast<unsigned long long>(evaluations));
}

}  // namespace
}  // namespace slideway

/// @param argv the name of one instruction set; one that this machine or build does not have prints nothing
int main(int argc, char** argv) {
    using namespace slideway;
    for (Isa const isa : testing::supported_isas()) {
        if (argc < 2 || name_of(isa) != std::string_view(argv[1])) continue;
        for (CostCase const& c : cases) measure(isa, c);
    }
}
