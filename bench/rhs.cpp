// The right-hand side per instruction set: nanoseconds per member, flops, and how much of the machine's multiply-add rate they are.
//
//   taskset -c 2 bin/bench_rhs [rounds] [text] > bench/results/rhs_<machine>.md
//
// With a text only rows that contain it are measured: "avx2", "settled", "lean" …
//
// Everything is measured in turn, round after round, and the medians are reported: ratios hold on a busy machine too.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/fma_peak.hpp"
#include "bench/machine.hpp"
#include "bench/rhs_kernel.hpp"
#include "host/backend/backend.hpp"
#include "tests/oracle/golden_table.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {

namespace scalar {
RhsKernelMaker rhs_kernels;
FmaPeakRounds fma_peak_rounds;
}  // namespace scalar
namespace sse2 {
RhsKernelMaker rhs_kernels;
FmaPeakRounds fma_peak_rounds;
}  // namespace sse2
namespace avx2 {
RhsKernelMaker rhs_kernels;
FmaPeakRounds fma_peak_rounds;
}  // namespace avx2
namespace avx512 {
RhsKernelMaker rhs_kernels;
FmaPeakRounds fma_peak_rounds;
}  // namespace avx512
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
    [[nodiscard]] std::size_t count() const { return count_; }

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

RhsKernels kernels_of(Isa isa) {
    switch (isa) {
        case Isa::scalar:
            return scalar::rhs_kernels();
        case Isa::sse2:
            return sse2::rhs_kernels();
        case Isa::avx2:
            return avx2::rhs_kernels();
        case Isa::avx512:
            return avx512::rhs_kernels();
    }
    return {};
}

FmaPeakRounds* fma_peak_of(Isa isa) {
    switch (isa) {
        case Isa::scalar:
            return &scalar::fma_peak_rounds;
        case Isa::sse2:
            return &sse2::fma_peak_rounds;
        case Isa::avx2:
            return &avx2::fma_peak_rounds;
        case Isa::avx512:
            return &avx512::fma_peak_rounds;
    }
    return nullptr;
}

/// Something to measure: `run(n)` does its unit of work n times.
struct Work {
    std::function<void(std::uint64_t)> run;
    std::uint64_t times = 1;
    std::vector<double> seconds;  // per unit

    double timed() {
        auto const start = std::chrono::steady_clock::now();
        run(times);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    void calibrate() {
        while (timed() < sample_seconds) times *= 2;
    }
    void sample() { seconds.push_back(timed() / static_cast<double>(times)); }
    [[nodiscard]] double least() const { return *std::min_element(seconds.begin(), seconds.end()); }
    [[nodiscard]] double median() const {
        auto sorted = seconds;
        auto const middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }
};

struct Row {
    std::size_t states;  // which
    Isa isa;
    bool full;
    Work work;
};

int run(int rounds, std::string const& text) {
    std::vector<States> all{free_flight(Law::paper), settled(Law::paper), settled(Law::conservative)};
    for (Law const law : {Law::paper, Law::conservative}) {
        auto const as_they_come = mixed(law);
        all.push_back(as_they_come);
        all.push_back(sorted_by_contact(as_they_come));
    }
    std::vector<Isa> isas;
    for (Isa const isa : all_isas()) {
        if (is_supported(isa)) isas.push_back(isa);
    }

    std::vector<Work> peaks;
    for (Isa const isa : isas) peaks.push_back({[f = fma_peak_of(isa)](std::uint64_t n) { f(n); }, 1, {}});
    std::vector<double> peak_flops;  // per round
    for (Isa const isa : isas) peak_flops.push_back(static_cast<double>(fma_peak_of(isa)(1)));

    std::vector<std::array<double, 2>> flops;  // per member, lean and full
    for (auto const& s : all) {
        Loaded const counted(kernel_of(counted::rhs_kernels(), s.law), s);
        std::array<double, 2> f{};
        for (bool const full : {false, true}) {
            auto const before = counted::operations();
            counted.evaluate(full, 1, 1);
            f[full] = static_cast<double>(counted::operations() - before) / static_cast<double>(s.members.size());
        }
        flops.push_back(f);
    }

    std::vector<Row> rows;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (bool const full : {false, true}) {
            for (Isa const isa : isas) {
                auto const name = fmt::format("{} {} {}", all[i].name, full ? "full" : "lean", name_of(isa));
                if (name.find(text) == std::string::npos) continue;
                auto const packs = std::make_shared<Loaded>(kernel_of(kernels_of(isa), all[i].law), all[i]);
                rows.push_back({i,
                                isa,
                                full,
                                {[packs, full](std::uint64_t n) {
                                     packs->evaluate(full, evaluations_in_a_row, static_cast<int>(n));
                                 },
                                 1,
                                 {}}});
            }
        }
    }
    for (auto& p : peaks) p.calibrate();
    for (auto& r : rows) r.work.calibrate();
    for (int round = 0; round < rounds; ++round) {
        for (auto& p : peaks) p.sample();
        for (auto& r : rows) r.work.sample();
    }

    fmt::print("# Right-hand side of the slider-crank, one core\n\n{}- medians of {} interleaved rounds\n",
               machine_and_build(), rounds);
    for (std::size_t i = 0; i < isas.size(); ++i) {
        fmt::print("- {}: `{}`, multiply-add peak {:.1f} GF/s\n", name_of(isas[i]), flags_of(isas[i]),
                   peak_flops[i] / peaks[i].median() * 1e-9);
    }
    fmt::print(
        "\nFriction on, aligned way, point damping.  `full` also fills the report for the observers.\n\n"
        "| states | variant | ISA | ns/member | least | over scalar | flops/member | GF/s | of peak |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    double scalar_time = 0;
    for (auto const& r : rows) {
        auto const& s = all[r.states];
        double const time = r.work.median() / static_cast<double>(s.members.size() * evaluations_in_a_row);
        if (r.isa == Isa::scalar) scalar_time = time;
        auto const isa = static_cast<std::size_t>(std::find(isas.begin(), isas.end(), r.isa) - isas.begin());
        double const rate = flops[r.states][r.full] / time;
        fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.0f} | {:.1f} | {:.0f} % |\n", s.name,
                   r.full ? "full" : "lean", name_of(r.isa), time * 1e9,
                   r.work.least() * 1e9 / static_cast<double>(s.members.size() * evaluations_in_a_row),
                   scalar_time / time, flops[r.states][r.full], rate * 1e-9,
                   100 * rate * peaks[isa].median() / peak_flops[isa]);
    }
    return 0;
}

}  // namespace
}  // namespace slideway

int main(int argc, char** argv) {
    return slideway::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 51, argc > 2 ? argv[2] : "");
}
