// The whole engine on a card, against this machine's processor with its widest instruction set and all its threads.
//
//   bench_cuda [--members N] [--rounds N] [--threads N] [--scene TEXT] > bench/results/cuda_<card>.md
//
// Both run the same members, in turn, round after round; medians of wall time are reported.  Exit code 0 if all bits agree that should,
// 1 if some do not, and 4 without a card that can be used, after one line on stderr.  scripts/cuda_check.sh runs it.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/command_line.hpp"
#include "bench/engine_cases.hpp"
#include "bench/engine_flops.hpp"
#include "bench/machine.hpp"
#include "bench/median.hpp"
#include "host/store/run_identity.hpp"

namespace slideway {
namespace {

constexpr int no_card = 4;  // as slideway itself ends then

struct Options {
    int members = 0;  // of each scene; 0: as many as fill the card eight times
    int rounds = 3;
    int threads = default_threads();
    std::string scene;  // those whose name contains this
};

/// Useful flops of an evaluation, on average over all of some members.
double flops_per_evaluation(EngineCase const& c) {
    auto const members = members_of(c, 32);
    std::vector<MemberRecord> records(members.size());
    std::vector<double> states(members.size() * state_size);
    Block block;
    block.inputs = members.data();
    block.members = members.size();
    block.settings = settings_of(c);
    block.records = records.data();
    block.final_states = states.data();
    auto const flops = static_cast<double>(counted_flops(c.parts.law, c.parts.damping, block));
    std::uint64_t evaluations = 0;
    for (auto const& record : records) evaluations += record.rhs_evaluations + record.jacobian_evaluations;
    return flops / static_cast<double>(evaluations);
}

struct Row {
    EngineCase const* scene;
    double flops;                                // of an evaluation
    EngineRun first{};                           // on the card
    std::vector<double> card{};                  // [s]
    std::vector<double> processor{};             // [s]
    bool as_processor = true, as_before = true;  // the bits of each round

    void run(std::vector<Inputs> const& members, Backend const& device, Backend const& cpu, int threads) {
        auto on_card = run_engine(*scene, members, device, threads);
        auto const on_cpu = run_engine(*scene, members, cpu, threads);
        card.push_back(on_card.totals.seconds);
        processor.push_back(on_cpu.totals.seconds);
        as_processor = as_processor && same_bits(on_card, on_cpu);
        if (card.size() == 1) {
            first = std::move(on_card);
        } else {
            as_before = as_before && same_bits(on_card, first);
        }
    }
};

std::string text_of(Row const& row, double members, double peak) {
    auto const& t = row.first.totals;
    double const seconds = median(row.card);
    auto const evaluations = static_cast<double>(t.rhs_evaluations + t.jacobian_evaluations);
    double const rate = evaluations * row.flops / seconds;
    return fmt::format(
        "| {} | {:.0f} | {:.0f} | {:.2f} | {:.4g} | {:.0f} | {:.0f} | {:.1f} | {:.2f} % | {} | {} | {} |\n",
        row.scene->name, members / seconds, members / median(row.processor), median(row.processor) / seconds,
        static_cast<double>(t.steps_accepted + t.steps_rejected) / seconds, evaluations / members, row.flops,
        1e-9 * rate, 100 * rate / peak, t.failed(), row.as_processor ? "yes" : "no",
        row.card.size() == 1 ? "–"
        : row.as_before      ? "yes"
                             : "no");
}

void print(std::vector<Row> const& rows, Backend const& card, Backend const& cpu, std::size_t members,
           Options const& options) {
    fmt::print("# The engine on a card, method auto\n\n- card: {}, FP64 peak {:.2f} TF/s, driver {}\n", card.machine(),
               1e-12 * card.peak(), card_driver());
    fmt::print("- flags, {}: nvcc {} {}\n{}- flags, {}: {}\n", card.isa(), SLIDEWAY_NVCC_VERSION, card.flags(),
               machine_and_build(), cpu.isa(), cpu.flags());
    fmt::print("- {} members of each scene, {} threads of the processor, medians of {} rounds\n\n", members,
               options.threads, options.rounds);
    fmt::print(
        "Scattered starts, ±20 % in clearances, crank speed, friction and damping; no quantity asked for.  Wall time "
        "of "
        "whole runs through the driver, copies to the card and back included; the processor with all its threads that "
        "are named above.  An evaluation is a right-hand side or an analytic Jacobian.  Its flops (additions, "
        "multiplications, divisions and roots; two for a fused multiply-add) are counted along the runs of 32 of the "
        "members, and GF/s are these times the evaluations per second: a lower bound, for what the methods do beside "
        "is "
        "left out.  The peak is the card's by its clock and its units for double precision.\n\n");
    fmt::print(
        "| scene | members/s | members/s, processor | over the processor | member-steps/s | evaluations per member | "
        "flops per evaluation | GF/s | of FP64 peak | failed | bits as the processor | same bits in every round |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (auto const& row : rows) fmt::print("{}", text_of(row, static_cast<double>(members), card.peak()));
    fmt::print("\n");
    for (auto const& row : rows) fmt::print("- {}: {}\n", row.scene->name, text_of(*row.scene));
}

int benchmark(Options const& options) {
    auto const card = cuda_backend();
    auto const cpu = cpu_backend(best_isa());
    std::size_t const members =
        options.members > 0 ? static_cast<std::size_t>(options.members) : 8 * card->bounds({}).least;
    std::vector<Row> rows;
    for (auto const& c : engine_cases()) {
        if (c.name.find(options.scene) != std::string::npos) rows.push_back({&c, flops_per_evaluation(c)});
    }
    for (int round = 0; round < options.rounds; ++round) {
        for (auto& row : rows) row.run(members_of(*row.scene, members), *card, *cpu, options.threads);
    }
    print(rows, *card, *cpu, members, options);
    // A build whose compiler may contract has bits of its own.
    bool const comparable = arithmetic_of(card->isa()) == arithmetic_of(cpu->isa());
    auto const agrees = [&](Row const& row) { return row.as_before && (row.as_processor || !comparable); };
    return std::ranges::all_of(rows, agrees) ? 0 : 1;
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) {
    slideway::bench::CommandLine line("The engine on a card against this machine's processor");
    slideway::Options options;
    line.count("--members", options.members, "Members of each scene; without it as many as fill the card eight times");
    line.count("--rounds", options.rounds, "Rounds");
    line.count("--threads", options.threads, "Threads of the processor; up to four of them feed the card");
    line.option("--scene", options.scene, "Only scenes whose name contains this");
    if (auto const code = line.parse(argc, argv)) return *code;
    try {
        return slideway::benchmark(options);
    } catch (slideway::DeviceError const& error) {
        fmt::print(stderr, "{}\n", error.what());
        return slideway::no_card;
    }
}
