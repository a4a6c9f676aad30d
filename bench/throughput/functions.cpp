// Functions of kernels/math, contact laws on one face, and the machine's multiply-add rate.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/fma_peak.hpp"
#include "bench/throughput/functions_kernel.hpp"
#include "bench/throughput/throughput.hpp"
#include "tests/models/by_isa.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(FmaPeakRounds, fma_peak_rounds)
SLIDEWAY_BY_ISA(TimedFunctions, timed_functions)
SLIDEWAY_BY_ISA(TimedLaws, timed_laws)

namespace bench {
namespace {

constexpr std::size_t arguments_count = 1024;  // two arrays of them stay in the first cache
constexpr std::size_t law_calls = 1000;

void time_peak(benchmark::State& state, FmaPeakRounds* rounds) {
    std::uint64_t operations = 0;
    for (auto _ : state) operations = rounds(10'000);
    count_rate(state, "flop/s", static_cast<double>(operations));
}

void time_function(benchmark::State& state, TimedFunction const& function) {
    std::vector<double> arguments(arguments_count), values(arguments_count);
    for (std::size_t i = 0; i < arguments_count; ++i) {
        arguments[i] = function.from + (function.to - function.from) * (static_cast<double>(i) + 0.5) / arguments_count;
    }
    for (auto _ : state) {
        function.evaluate(arguments.data(), values.data(), arguments_count);
        benchmark::DoNotOptimize(values.data());
        benchmark::ClobberMemory();
    }
    count_rate(state, "values/s", arguments_count);
}

struct Touch {
    char const* name;
    std::array<double, 4> depths;  // [m]
};
constexpr Touch touches[] = {{"point", {2e-7, -1e-6, -2e-6, -1e-6}},
                             {"line", {2e-7, 1e-7, -1e-6, -1e-6}},
                             {"surface", {2e-7, 1e-7, 1.5e-7, 2.5e-7}}};

/// A slider-crank with what the law has of its own.
Inputs member_of(Law law) { return testing::with_own(testing::scattered_starts(1).front(), law, 100); }

void time_law(benchmark::State& state, TimedLaw const& law, Inputs const& member, Touch const& touch, int lanes) {
    double force = 0;
    for (auto _ : state) force = law.evaluate(member, touch.depths.data(), law_calls);
    if (!(force > 0)) return state.SkipWithError("no force");
    count_rate(state, "faces/s", static_cast<double>(law_calls) * lanes);
}

}  // namespace

void register_peak() {
    for (Isa const isa : runnable_isas()) {
        auto const name = "peak/multiply_add/" + std::string(name_of(isa));
        benchmark::RegisterBenchmark(name.c_str(), time_peak, fma_peak_rounds_by_isa(isa));
    }
}

void register_functions() {
    for (Isa const isa : runnable_isas()) {
        auto const functions = timed_functions_by_isa(isa)();
        for (std::size_t i = 0; i < functions.count; ++i) {
            auto const& function = functions.first[i];
            auto const name = "function/" + std::string(function.name) + "/" + std::string(name_of(isa));
            benchmark::RegisterBenchmark(name.c_str(), time_function, function);
        }
    }
}

void register_laws() {
    for (Isa const isa : runnable_isas()) {
        auto const laws = timed_laws_by_isa(isa)();
        for (std::size_t i = 0; i < laws.count; ++i) {
            for (Touch const& touch : touches) {
                auto const name = "law/" + std::string(laws.first[i].name) + ", " + touch.name + "/" + std::string(name_of(isa));
                benchmark::RegisterBenchmark(name.c_str(), time_law, laws.first[i], member_of(static_cast<Law>(i)), touch, lanes_of(isa));
            }
        }
    }
}

}  // namespace bench
}  // namespace slideway
