// The right-hand side per instruction set: nanoseconds per member, flops, and how much of the machine's multiply-add rate they are.
//
//   taskset -c 2 bin/bench_rhs [rounds] [text] > bench/results/rhs_<machine>.md
//
// With a text only rows that contain it are measured: "avx2", "settled", "lean" …
//
// Everything is measured in turn, round after round, and the medians are reported: ratios hold on a busy machine too.
#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/fma_peak.hpp"
#include "bench/machine.hpp"
#include "bench/rhs_kernel.hpp"
#include "host/backend/by_isa.hpp"
#include "tests/oracle/golden_table.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(RhsKernelMaker, rhs_kernels)
SLIDEWAY_BY_ISA(FmaPeakRounds, fma_peak_rounds)
namespace counted {
RhsKernelMaker rhs_kernels;
OperationCounter operations;
}  // namespace counted

namespace {

/// Calls with the same parameters and contacts, as the stages of a step make them.
constexpr int evaluations_in_a_row = 6;
constexpr double sample_seconds = 5e-4;

struct States {
    std::string name;
    Law law = Law::paper;
    std::vector<Inputs> members;
    std::vector<double> times;
};

States free_flight(Law law) {
    States s{"free flight", law, testing::scattered_starts(64), {}};
    s.times.assign(s.members.size(), 0.3);
    return s;
}

/// All four apices of the bottom face on the way, pressed in by 2e-10 m and a little more.
States settled(Law law) {
    States s{law == Law::paper ? "settled, paper" : "settled, conservative", law, testing::scattered_starts(64), {}};
    for (std::size_t i = 0; i < s.members.size(); ++i) {
        auto& in = s.members[i];
        in.y = -(in.clearance_y + 2e-10 * static_cast<double>(1 + i % 5));
        in.z = in.roll = in.yaw = 0;
        in.pitch = 1e-10;
    }
    s.times.assign(s.members.size(), 0.3);
    return s;
}

/// The states of a golden table, as many as fill packs of every width.
States mixed(Law law) {
    bool const paper = law == Law::paper;
    auto const table = golden::Table::read(std::string(SLIDEWAY_TEST_DATA) +
                                           (paper ? "/golden/rhs_paper.csv" : "/golden/rhs_conservative.csv"));
    States s{paper ? "mixed, paper" : "mixed, conservative", law, {}, {}};
    for (std::size_t row = 0; row < table.rows() / 8 * 8; ++row) {
        auto c = golden::case_of(table, row);
        auto& in = c.inputs;
        std::size_t i = 0;
        for (double* value : {&in.y, &in.z, &in.vy, &in.vz, &in.roll, &in.yaw, &in.pitch, &in.wx, &in.wy, &in.wz}) {
            *value = static_cast<double>(c.state[i++]);
        }
        s.members.push_back(in);
        s.times.push_back(c.t);
    }
    return s;
}

/// One bit per apex and face that are in contact.
unsigned long contact_pattern(Inputs const& member, double time, Law law) {
    ProbeResult result;
    ProbeTable const table{&member, &time, 1, &result};
    find_instance(Isa::scalar, {law, Damping::point, true, false}).probe(table);
    std::bitset<16> touching;
    for (std::size_t i = 0; i < 8; ++i) {
        touching[i] = result.penetration_y[i] > 0;
        touching[8 + i] = result.penetration_z[i] > 0;
    }
    return touching.to_ulong();
}

/// As an engine that regroups its lanes would meet them.
States sorted_by_contact(States const& s) {
    std::vector<std::pair<unsigned long, std::size_t>> order;
    for (std::size_t i = 0; i < s.members.size(); ++i) {
        order.emplace_back(contact_pattern(s.members[i], s.times[i], s.law), i);
    }
    std::sort(order.begin(), order.end());
    States sorted{s.name + ", sorted", s.law, {}, {}};
    for (auto const& [pattern, i] : order) {
        sorted.members.push_back(s.members[i]);
        sorted.times.push_back(s.times[i]);
    }
    return sorted;
}

/// Packs of one kernel, loaded with one set of states.
class Loaded {
public:
    Loaded(RhsKernel const& kernel, States const& states)
        : kernel_(kernel), count_(states.members.size()), bytes_(count_ / lanes() * kernel.pack_bytes) {
        packs_.reset(static_cast<std::byte*>(std::aligned_alloc(64, (bytes_ + 63) / 64 * 64)));
        kernel.load(packs_.get(), states.members.data(), states.times.data(), count_);
    }
    void evaluate(bool full, int in_a_row, int passes) const {
        kernel_.evaluate[full](packs_.get(), count_, in_a_row, passes);
    }

private:
    struct Free {
        void operator()(std::byte* p) const { std::free(p); }
    };
    [[nodiscard]] std::size_t lanes() const { return static_cast<std::size_t>(kernel_.lanes); }
    RhsKernel kernel_;
    std::size_t count_, bytes_;
    std::unique_ptr<std::byte, Free> packs_;
};

RhsKernel kernel_of(RhsKernels const& kernels, Law law) {
    return law == Law::paper ? kernels.paper : kernels.conservative;
}

/// Something to measure: `run(n)` does its unit of work n times.
class Work {
public:
    explicit Work(std::function<void(std::uint64_t)> run) : run_(std::move(run)) {}

    /// Finds how often a sample must repeat the work to be long enough.
    void calibrate() {
        while (timed() < sample_seconds) times_ *= 2;
    }
    void sample() { seconds_.push_back(timed() / static_cast<double>(times_)); }

    // Seconds per unit of work.
    [[nodiscard]] double least() const { return *std::min_element(seconds_.begin(), seconds_.end()); }
    [[nodiscard]] double median() const {
        auto sorted = seconds_;
        auto const middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }

private:
    double timed() {
        auto const start = std::chrono::steady_clock::now();
        run_(times_);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::function<void(std::uint64_t)> run_;
    std::uint64_t times_ = 1;
    std::vector<double> seconds_;
};

struct Peak {
    Isa isa;
    double flops;  // per round
    Work work;
    [[nodiscard]] double rate() const { return flops / work.median(); }
};

struct Row {
    States const* states;
    Isa isa;
    bool full;
    double flops;  // per member
    Work work;     // one pass over all members
    [[nodiscard]] std::string name() const {
        return fmt::format("{} {} {}", states->name, full ? "full" : "lean", name_of(isa));
    }
    /// Seconds per member of a time per pass.
    [[nodiscard]] double per_member(double pass) const {
        return pass / static_cast<double>(states->members.size() * evaluations_in_a_row);
    }
};

double useful_flops(States const& states, bool full) {
    Loaded const counted(kernel_of(counted::rhs_kernels(), states.law), states);
    auto const before = counted::operations();
    counted.evaluate(full, 1, 1);
    return static_cast<double>(counted::operations() - before) / static_cast<double>(states.members.size());
}

std::vector<States> all_states() {
    std::vector<States> all{free_flight(Law::paper), settled(Law::paper), settled(Law::conservative)};
    for (Law const law : {Law::paper, Law::conservative}) {
        auto const as_they_come = mixed(law);
        all.push_back(as_they_come);
        all.push_back(sorted_by_contact(as_they_come));
    }
    return all;
}

std::vector<Row> rows_of(std::vector<States> const& all, std::vector<Isa> const& isas, std::string const& text) {
    std::vector<Row> rows;
    for (auto const& states : all) {
        for (bool const full : {false, true}) {
            double const flops = useful_flops(states, full);
            for (Isa const isa : isas) {
                auto const packs = std::make_shared<Loaded>(kernel_of(rhs_kernels_by_isa(isa)(), states.law), states);
                Row row{&states, isa, full, flops, Work([packs, full](std::uint64_t n) {
                            packs->evaluate(full, evaluations_in_a_row, static_cast<int>(n));
                        })};
                if (row.name().find(text) != std::string::npos) rows.push_back(std::move(row));
            }
        }
    }
    return rows;
}

void print(std::vector<Peak> const& peaks, std::vector<Row> const& rows, int rounds) {
    fmt::print("# Right-hand side of the slider-crank, one core\n\n{}- medians of {} interleaved rounds\n",
               machine_and_build(), rounds);
    for (auto const& p : peaks) {
        fmt::print("- {}: `{}`, multiply-add peak {:.1f} GF/s\n", name_of(p.isa), flags_of(p.isa), p.rate() * 1e-9);
    }
    fmt::print(
        "\nFriction on, aligned way, point damping.  `full` also fills the report for the observers.  Mixed states are "
        "the golden "
        "ones;\n`sorted` groups them by their touching apices, as an engine that regroups its lanes would meet "
        "them.\n\n"
        "| states | variant | ISA | ns/member | least | over scalar | flops/member | GF/s | of peak |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    for (auto const& r : rows) {
        auto const scalar = std::find_if(rows.begin(), rows.end(), [&](Row const& other) {
            return other.states == r.states && other.full == r.full && other.isa == Isa::scalar;
        });
        auto const peak = std::find_if(peaks.begin(), peaks.end(), [&](Peak const& p) { return p.isa == r.isa; });
        double const time = r.per_member(r.work.median());
        std::string const ratio =
            scalar == rows.end() ? "–" : fmt::format("{:.2f}", scalar->work.median() / r.work.median());
        fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {} | {:.0f} | {:.1f} | {:.0f} % |\n", r.states->name,
                   r.full ? "full" : "lean", name_of(r.isa), time * 1e9, r.per_member(r.work.least()) * 1e9, ratio,
                   r.flops, r.flops / time * 1e-9, 100 * r.flops / time / peak->rate());
    }
}

void run(int rounds, std::string const& text) {
    std::vector<Isa> isas;
    for (Isa const isa : all_isas()) {
        if (is_supported(isa)) isas.push_back(isa);
    }
    std::vector<Peak> peaks;
    for (Isa const isa : isas) {
        auto* const peak_rounds = fma_peak_rounds_by_isa(isa);
        peaks.push_back({isa, static_cast<double>(peak_rounds(1)), Work([=](std::uint64_t n) { peak_rounds(n); })});
    }
    auto const states = all_states();
    auto rows = rows_of(states, isas, text);

    for (auto& p : peaks) p.work.calibrate();
    for (auto& r : rows) r.work.calibrate();
    for (int round = 0; round < rounds; ++round) {
        for (auto& p : peaks) p.work.sample();
        for (auto& r : rows) r.work.sample();
    }
    print(peaks, rows, rounds);
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) {
    slideway::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 101, argc > 2 ? argv[2] : "");
}
