// The groups of throughput benchmarks, each a file of this folder, and what they have in common.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "host/backend/backend.hpp"

namespace slideway::bench {

/// Those of this build that run on this machine, `scalar` first.
std::vector<Isa> runnable_isas();

/// A counter of what an iteration does, as a rate: "members/s".
void count_rate(benchmark::State& state, std::string const& name, double per_iteration);

/// They register their benchmarks, named group/what/instruction set, with Google Benchmark.
void register_peak();
void register_right_hand_sides();
void register_linkages();
void register_laws();
void register_functions();
void register_engine();
void register_lorenz();
void register_relief_valve();
void register_study();

}  // namespace slideway::bench
