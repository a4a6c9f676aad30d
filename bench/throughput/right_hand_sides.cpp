// The right-hand side of the slider-crank per instruction set, lean and with the report that observers need.
#include <algorithm>
#include <bitset>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/rhs_kernel.hpp"
#include "bench/throughput/throughput.hpp"
#include "kernels/laws/list.hpp"
#include "tests/models/by_isa.hpp"
#include "tests/oracle/golden_table.hpp"
#include "tests/support/ensemble.hpp"
#include "tests/support/starting_in.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(RhsKernelMaker, rhs_kernels)
namespace counted {
RhsKernelMaker rhs_kernels;
OperationCounter operations;
}  // namespace counted

namespace bench {
namespace {

/// Calls with the same parameters and contacts, as the stages of a step make them.
constexpr int evaluations_in_a_row = 6;

struct States {
    std::string name;
    Law law = Law::paper;
    std::vector<Inputs> members;
    std::vector<double> times;
};

States free_flight(Law law) {
    States s{"flight", law, testing::scattered_starts(64), {}};
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
        auto const c = golden::case_of(table, row);
        s.members.push_back(testing::starting_in(c.inputs, c.state));
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

double useful_flops(States const& states, bool full) {
    Loaded const counted(kernel_of(counted::rhs_kernels(), states.law), states);
    auto const before = counted::operations();
    counted.evaluate(full, 1, 1);
    return static_cast<double>(counted::operations() - before) / static_cast<double>(states.members.size());
}

void time_states(benchmark::State& state, RhsKernels* kernels, std::shared_ptr<States const> const& states, bool full) {
    Loaded const packs(kernel_of(*kernels, states->law), *states);
    for (auto _ : state) packs.evaluate(full, evaluations_in_a_row, 1);
    double const evaluations = static_cast<double>(states->members.size()) * evaluations_in_a_row;
    count_rate(state, "rhs/s", evaluations);
    count_rate(state, "flop/s", evaluations * useful_flops(*states, full));
}

std::vector<std::shared_ptr<States const>> all_states() {
    std::vector<States> all{free_flight(Law::paper), settled(Law::paper), settled(Law::conservative)};
    for (Law const law : {Law::paper, Law::conservative}) {
        auto const as_they_come = mixed(law);
        all.push_back(as_they_come);
        all.push_back(sorted_by_contact(as_they_come));
    }
    std::vector<std::shared_ptr<States const>> shared;
    for (auto& states : all) shared.push_back(std::make_shared<States const>(std::move(states)));
    return shared;
}

}  // namespace

void register_right_hand_sides() {
    for (auto const& states : all_states()) {
        for (bool const full : {false, true}) {
            for (Isa const isa : runnable_isas()) {
                auto const name = "rhs/" + states->name + (full ? ", full/" : ", lean/") + std::string(name_of(isa));
                benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
                    auto kernels = rhs_kernels_by_isa(isa)();
                    time_states(state, &kernels, states, full);
                });
            }
        }
    }
}

}  // namespace bench
}  // namespace slideway
