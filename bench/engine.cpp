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
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "bench/engine_cases.hpp"
#include "bench/machine.hpp"
#include "bench/median.hpp"

namespace slideway {
namespace {

constexpr std::size_t member_count = 512;  // of each case

struct Run : EngineRun {
    double processor_seconds = 0;
};

double processor_seconds() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Run run(EngineCase const& c, std::vector<Inputs> const& members, Isa isa, int threads) {
    auto const backend = cpu_backend(isa);
    double const start = processor_seconds();
    Run result{run_engine(c, members, *backend, threads)};
    result.processor_seconds = processor_seconds() - start;
    return result;
}

struct Row {
    EngineCase const* scene;
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
    return fmt::format(
        "| {} | {} | {:.0f} | {:.2f} | {:.4g} | {:.1f} | {:.0f} | {:.3f} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n",
        row.scene->name, name_of(row.isa), members / seconds, median(scalar.one) / seconds, steps / seconds,
        1e9 * seconds / evaluations, evaluations / members, t.lane_utilisation(),
        row.members->size() - (t.done() - t.failed()), same_bits(row.last, scalar.last) ? "yes" : "no",
        median(row.wall_one) / median(row.wall_two), std::ranges::min(row.wall_one) / std::ranges::min(row.wall_two),
        median(row.processor));
}

int benchmark(int rounds) {
    auto const cases = engine_cases();
    std::vector<std::vector<Inputs>> members;
    for (auto const& c : cases) members.push_back(members_of(c, member_count));
    std::vector<Row> rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        for (Isa const isa : built_isas()) {
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
    for (Isa const isa : built_isas()) {
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
        fmt::print("- {}: {} members, {}\n", c.name, member_count, text_of(c));
    }
    return 0;
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) { return slideway::benchmark(argc > 1 ? std::max(1, std::atoi(argv[1])) : 5); }
