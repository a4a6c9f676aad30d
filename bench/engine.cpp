// The whole engine as a run uses it, through the driver: members per second per instruction set, on one and on two threads, and
// how well the lanes are used.
//
//   bench_engine [rounds] > bench/results/engine_<machine>.md
//
// Instruction sets are compared by processor time, threads by the wall clock: those rows need two free cores.  Rounds of all cases
// take turns; medians are reported.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "bench/machine.hpp"
#include "host/driver/ensemble.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {
namespace {

constexpr double pi = 3.141592653589793;

struct Case {
    std::string name;
    Parts parts;
    double clearance, crank_speed, chi, end_time, rtol;
    std::size_t members;
};

std::vector<Case> const cases = {
    {"standard scene, paper", {Law::paper, Damping::point, true, false}, 1e-4, pi, 0, 0.05, 1e-6, 512},
    {"standard scene, conservative", {Law::conservative, Damping::point, true, false}, 1e-4, pi, 0, 0.05, 1e-6, 512},
    {"rattling, conservative", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.05, 1e-5, 512},
    {"settling, conservative", {Law::conservative, Damping::rate, true, false}, 1e-4, pi, 10, 0.4, 1e-4, 512},
    {"crank turn, conservative", {Law::conservative, Damping::rate, true, false}, 1e-4, pi, 10, 2, 1e-3, 512},
};

/// Scattered starts with ±20 % in clearances, speed, friction and damping.
std::vector<Inputs> members_of(Case const& c) {
    auto members = testing::scattered_starts(c.members, c.clearance, c.crank_speed);
    for (std::size_t i = 0; i < members.size(); ++i) {
        auto& in = members[i];
        auto const spread = [&](double irrational) {
            double const x = static_cast<double>(i + 1) * irrational;
            return 0.8 + 0.4 * (x - std::floor(x));
        };
        in.clearance_y *= spread(0.3166247903553998);
        in.clearance_z *= spread(0.6055512754639891);
        in.crank_speed *= spread(0.1231056256176606);
        in.friction_static *= spread(0.3588989435406740);
        in.friction_kinetic *= spread(0.7958315233127191);
        in.eta *= spread(0.3851648071345037);
        in.chi_line = in.chi_surface = c.chi;
    }
    return members;
}

struct Run {
    EnsembleTotals totals;
    double processor_seconds = 0;
    std::vector<double> states;
};

double processor_seconds() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Run run(Case const& c, std::vector<Inputs> const& members, Isa isa, int threads) {
    EnsemblePlan plan;
    plan.members = MemberSet(MemberRange{0, members.size()});
    plan.threads = threads;
    auto const backend = cpu_backend(isa);
    plan.blocks.lanes = backend->lanes();
    plan.blocks.least = backend->least_block();
    auto& settings = plan.request.integrator;
    settings.end_time = c.end_time;
    settings.rtol = settings.atol = c.rtol;
    plan.source = [&](std::uint64_t i, Inputs& in) {
        in = members[i];
        return true;
    };
    Run result;
    result.states.resize(members.size() * state_size);
    StopRequest const stop;
    double const start = processor_seconds();
    result.totals = run_ensemble(
        plan, backend->kernel(c.parts, false),
        [&](BlockResult const& block) {
            std::ranges::copy(block.final_states,
                              result.states.begin() + static_cast<std::ptrdiff_t>(block.members.front() * state_size));
        },
        stop);
    result.processor_seconds = processor_seconds() - start;
    return result;
}

double median(std::vector<double> values) {
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Row {
    Case const* scene;
    std::vector<Inputs> const* members;
    Isa isa;
    Run last{};
    std::vector<double> one{};                   // [s] of the processor, one thread
    std::vector<double> wall_one{}, wall_two{};  // [s]
    std::vector<double> processor{};             // processor time of one thread over that of two
};

std::string load_average() {
    std::ifstream file("/proc/loadavg");
    std::string one;
    return file >> one ? one : "unknown";
}

std::string row_text(Row const& row, Row const& scalar) {
    auto const& t = row.last.totals;
    double const members = static_cast<double>(row.members->size()), seconds = median(row.one);
    auto const evaluations = static_cast<double>(t.rhs_evaluations + t.jacobian_evaluations);
    auto const steps = static_cast<double>(t.steps_accepted + t.steps_rejected);
    bool const same =
        std::memcmp(row.last.states.data(), scalar.last.states.data(), row.last.states.size() * sizeof(double)) == 0;
    return fmt::format(
        "| {} | {} | {:.0f} | {:.2f} | {:.4g} | {:.1f} | {:.0f} | {:.3f} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n",
        row.scene->name, name_of(row.isa), members / seconds, median(scalar.one) / seconds, steps / seconds,
        1e9 * seconds / evaluations, evaluations / members, t.lane_utilisation(),
        row.members->size() - (t.done() - t.failed()), same ? "yes" : "no", median(row.wall_one) / median(row.wall_two),
        std::ranges::min(row.wall_one) / std::ranges::min(row.wall_two), median(row.processor));
}

int benchmark(int rounds) {
    std::vector<std::vector<Inputs>> members;
    for (auto const& c : cases) members.push_back(members_of(c));
    std::vector<Row> rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        for (Isa const isa : {Isa::scalar, Isa::avx2, Isa::avx512}) {
            if (is_supported(isa)) rows.push_back({.scene = &cases[i], .members = &members[i], .isa = isa});
        }
    }
    auto const load = load_average();
    for (int round = 0; round < rounds; ++round) {
        for (auto& row : rows) {
            row.last = run(*row.scene, *row.members, row.isa, 1);
            row.one.push_back(row.last.processor_seconds);
            auto const both = run(*row.scene, *row.members, row.isa, 2);
            row.wall_one.push_back(row.last.totals.seconds);
            row.wall_two.push_back(both.totals.seconds);
            row.processor.push_back(row.last.processor_seconds / both.processor_seconds);
        }
    }
    fmt::print("# The engine, method auto\n\n{}", machine_and_build());
    for (Isa const isa : {Isa::scalar, Isa::avx2, Isa::avx512}) {
        if (is_supported(isa)) fmt::print("- flags, {}: {}\n", name_of(isa), flags_of(isa));
    }
    fmt::print(
        "- medians of {} rounds; load average at the start {}\n\n"
        "Scattered starts, ±20 % in clearances, crank speed, friction and damping; no quantity asked for.  Members per "
        "second and "
        "steps of one core, by processor time; an analytic Jacobian counts as an evaluation.  Lanes in use: lane steps "
        "that served a "
        "member over those executed, one thread.  Two threads: wall time of one over that of two, by the medians and "
        "by the least; "
        "then processor time likewise, which is below 1 by what the threads cost each other.\n\n",
        rounds, load);
    fmt::print(
        "| scene | | members/s | over scalar | member-steps/s | ns per evaluation | evaluations per member | lanes in "
        "use | failed | "
        "bits as scalar | two threads, medians | least | processor "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    Row const* scalar = nullptr;
    for (auto const& row : rows) {
        if (row.isa == Isa::scalar) scalar = &row;
        fmt::print("{}", row_text(row, *scalar));
    }
    fmt::print("\n");
    for (auto const& c : cases) {
        fmt::print("- {}: {} members, {} s, rtol {:.0e}, clearance {} mm, {:.3g} rad/s, χ = {}\n", c.name, c.members,
                   c.end_time, c.rtol, 1e3 * c.clearance, c.crank_speed, c.chi);
    }
    return 0;
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) { return slideway::benchmark(argc > 1 ? std::max(1, std::atoi(argv[1])) : 5); }
