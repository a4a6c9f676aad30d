// What a run will take, told before it starts.
#pragma once

#include <cstdint>

#include "host/backend/backend.hpp"
#include "host/scene/scene.hpp"

namespace slideway {

/// Memory and output size follow from the scene.  Steps and hours are a rough range: settled contact holds explicit
/// steps near 5 µs (model.md 9), free flight lets them grow to max_step, and nobody knows before the run how long the
/// slider flies.
struct Prediction {
    std::uint64_t buffer_bytes;   // of all threads' blocks; the program itself needs some tens of MB more
    std::uint64_t summary_bytes;  // of the statistics over all members at the end
    std::uint64_t output_bytes;
    std::size_t block_members;
    double least_steps, most_steps;  // of all members
    double least_seconds, most_seconds;
};

Prediction predict(Scene const& scene, Isa isa, int threads);

}  // namespace slideway
