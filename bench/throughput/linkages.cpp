// The planar slider-crank by its own kernel, and as a linkage, by tables and compiled: what a scene of one's own costs.
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/linkage_kernel.hpp"
#include "bench/throughput/throughput.hpp"
#include "host/backend/linkage_modules.hpp"
#include "host/config/scene.hpp"
#include "tests/models/by_isa.hpp"
#include "tests/support/planar_linkage.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(LinkageKernelMaker, linkage_kernels_of_bench)

namespace bench {
namespace {

constexpr char const* friction_and_restitution = R"(
[friction]
static = 0.1
kinetic = 0.05
[contact]
restitution = 0.4
[study]
duration = 0.1
)";

/// Members in like states, in flight or with both lower corners pressed in.
struct States {
    Scene scene;
    std::vector<Inputs> members;
    std::vector<double> states;
};

States states_of(bool is_linkage, bool touches) {
    Overrides const friction{{"friction.static", "0.1"}, {"friction.kinetic", "0.05"}};
    States all{is_linkage ? parse_scene(testing::planar_linkage() + friction_and_restitution, "bench.toml")
                          : read_scene(SLIDEWAY_SCENES "/planar_flores.toml", friction),
               {}, {}};
    for (int i = 0; i < 64; ++i) {
        all.members.push_back(all.scene.inputs);
        double const crank = 0.3 + 0.01 * i, y = touches ? -1e-3 - 1e-7 * (1 + i % 5) : 1e-5 * (i % 7), tilt = touches ? 1e-9 : 1e-5 * (i % 4);
        double const rod = std::asin((y - 0.153 * std::sin(crank)) / 0.306), rod_rate = -60 + i % 3, spin = 0.01;
        std::vector<double> const state = is_linkage ? std::vector{crank, 150., rod, rod_rate, tilt, spin} : std::vector{crank, rod, tilt, 150., rod_rate, spin};
        all.states.insert(all.states.end(), state.begin(), state.end());
    }
    return all;
}

void time_linkage(benchmark::State& state, LinkageKernel const& kernel, LinkagePlan const& plan, States const& of) {
    if (of.scene.parts.linkage != nullptr && linkage_module_name(plan) != linkage_module_name(compiled_plan(of.scene.parts)))
        throw std::logic_error("bench: the scene has another plan than linkage_kernel.cpp");
    auto const count = of.members.size();
    std::size_t const bytes = (count / static_cast<std::size_t>(kernel.lanes) * kernel.pack_bytes + 63) / 64 * 64;
    std::unique_ptr<void, decltype(&std::free)> const packs(std::aligned_alloc(64, bytes), &std::free);
    kernel.load(packs.get(), of.scene.parts, of.members.data(), of.states.data(), count);
    constexpr int in_a_row = 6;
    for (auto _ : state) kernel.evaluate(packs.get(), of.scene.parts, count, in_a_row);
    count_rate(state, "rhs/s", static_cast<double>(count) * in_a_row);
}

}  // namespace

void register_linkages() {
    for (bool const touches : {false, true}) {
        for (Isa const isa : runnable_isas()) {
            LinkageKernels const kernels = linkage_kernels_of_bench_by_isa(isa)();
            struct { char const* name; LinkageKernel kernel; } const ways[] = {
                {"planar kernel", kernels.planar}, {"tables", kernels.tables}, {"compiled", kernels.compiled}};
            for (auto const& [name, kernel] : ways) {
                auto const of = std::make_shared<States const>(states_of(&kernel != &ways[0].kernel, touches));
                auto const full = std::string("linkage/") + name + (touches ? ", contact/" : ", flight/") + std::string(name_of(isa));
                benchmark::RegisterBenchmark(full.c_str(), [=, kernel = kernel](benchmark::State& state) { time_linkage(state, kernel, *kernels.plan, *of); });
            }
        }
    }
}

}  // namespace bench
}  // namespace slideway
