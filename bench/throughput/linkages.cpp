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

namespace slideway {

SLIDEWAY_BY_ISA(LinkageKernelMaker, linkage_kernels_of_bench)

namespace bench {
namespace {

constexpr char const* planar = R"(
schema = 1
[mechanism]
kind = "planar_slider_crank"
crank_length = 0.153
rod_length = 0.306
crank_speed = 150
crank_mass = 0.038
rod_mass = 0.038
slider_mass = 0.076
crank_inertia = 7.4e-5
rod_inertia = 5.9e-4
slider_inertia_z = 2.7e-6
[drive]
kind = "free"
[joint]
slider_length = 0.1
slider_height = 0.05
clearance = 1e-3
)";
constexpr char const* linkage = R"(
schema = 1
[mechanism]
kind = "linkage"
crank_speed = 150
[drive]
kind = "free"
body = "crank"
[body]
crank = { mass = 0.038, inertia = 7.4e-5, center_x = 0.0765 }
rod = { mass = 0.038, inertia = 5.9e-4, center_x = 0.153 }
slider = { mass = 0.076, inertia = 2.7e-6 }
[link]
shaft = { kind = "revolute", first = "ground", second = "crank" }
crank_pin = { kind = "revolute", first = "crank", second = "rod", first_x = 0.153 }
wrist_pin = { kind = "revolute", first = "rod", second = "slider", first_x = 0.306 }
way = { kind = "block", first = "slider", second = "ground", clearance = 1e-3, length = 0.1, height = 0.05, stiffness = 1e11 }
)";
constexpr char const* rest = R"(
[friction]
static = 0.1
kinetic = 0.05
[study]
duration = 0.1
[contact]
restitution = 0.4
)";

/// Members in like states, in flight or with both lower corners pressed in.
struct States {
    Scene scene;
    std::vector<Inputs> members;
    std::vector<double> states;
};

States states_of(bool is_linkage, bool touches) {
    std::string const text = std::string(is_linkage ? linkage : planar) + rest + (is_linkage ? "" : "point_stiffness = 1e11\n");
    States all{parse_scene(text, "bench.toml"), {}, {}};
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
            struct { char const* name; LinkageKernel kernel; } const ways[] = {{"planar kernel", kernels.planar}, {"tables", kernels.tables}, {"compiled", kernels.compiled}};
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
