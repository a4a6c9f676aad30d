// Growth of offsets of the planar slider-crank with rigid contacts (model.md 13) against differences of neighbouring orbits of a reference in 80-bit numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/oracle/planar_runs.hpp"
#include "tests/oracle/rigid_block.hpp"
#include "tests/support/rigid.hpp"

namespace slideway::rigid_growth_test {
namespace {

using testing::rigid_planar_parts;

constexpr std::size_t size = 6;

/// What to follow.
struct Orbit {
    Inputs in;
    bool friction = false, free_crank = true;
    std::size_t stops = 0;
    double every = 1e-3;  // [s] from stop to stop
};

/// Lengths of a state's numbers, as offsets are measured in.
std::vector<double> scales(Inputs const& in) {
    double const rate = std::max(std::abs(in.crank_speed), 1.0), c = in.clearance_y;
    std::vector<double> all{c / in.crank_length, c / in.rod_length, 2 * c / in.slider_length};
    for (std::size_t i = 0; i < 3; ++i) all.push_back(all[i] * rate);
    return all;
}

/// Offsets at the start and at each stop, by central differences of two orbits.
std::vector<std::vector<double>> differences(Orbit const& orbit, std::function<void(Inputs&, double)> const& shift, double amount) {
    std::vector<oracle::PlanarState> states[2];
    for (int side : {0, 1}) {
        auto in = orbit.in;
        shift(in, side == 0 ? -amount : amount);
        auto const run = oracle::rigid_block_run(in, rigid_planar_parts(orbit.friction, orbit.free_crank), orbit.every, static_cast<int>(orbit.stops), 1e-5L);
        EXPECT_TRUE(run.solved);
        states[side] = run.samples;
    }
    auto const scale = scales(orbit.in);
    std::vector<std::vector<double>> offsets;
    for (std::size_t k = 0; k <= orbit.stops; ++k) {
        auto& offset = offsets.emplace_back();
        for (std::size_t i = 0; i < size; ++i) offset.push_back(static_cast<double>((states[1][k][i] - states[0][k][i]) / (2 * scale[i] * amount)));
    }
    return offsets;
}

double length(std::vector<double> const& offset) {
    double square = 0;
    for (double const x : offset) square += x * x;
    return std::sqrt(square);
}

struct Growth {
    MemberRecord record;
    std::vector<double> values;  // ln, [stop][shadow]
};

/// @param directions [shadow][size], of unit length
Growth growth(Orbit const& orbit, std::vector<double> const& directions, double d0, double tolerance, Isa isa = best_isa()) {
    auto const parts = rigid_planar_parts(orbit.friction, orbit.free_crank);
    auto const o = testing::rigid_options(parts, tolerance, 1);
    int const shadows = static_cast<int>(directions.size() / size);
    Growth found;
    found.values.resize(orbit.stops * static_cast<std::size_t>(shadows));
    MemberClock const clock{static_cast<double>(orbit.stops) * orbit.every, 0.5e-9, orbit.every};
    std::vector<double> state(most_states);
    Block block;
    block.inputs = &orbit.in;
    block.members = 1;
    block.settings = o.settings;
    block.clocks = &clock;
    MemberClock own = clock;
    own.first_stop = orbit.every;
    block.clocks = &own;
    block.stops = {.count = orbit.stops};
    block.shadows = {shadows, d0, 0, 0, directions.data()};
    block.records = &found.record;
    block.final_states = state.data();
    block.growth_values = found.values.data();
    find_instance(isa, parts).run_shadowed(block);
    return found;
}

TEST(RigidGrowth, Explore) {
    auto in = oracle::planar_check_inputs();
    in.friction_static = in.friction_kinetic = 0.01;
    in.wz = -0.01;
    for (bool const friction : {false, true}) {
        Orbit const orbit{in, friction, true, 60, 1e-3};
        auto const offsets = differences(orbit, [](Inputs& i, double by) { i.vy += by * i.clearance_y * 150; }, 1e-9);
        std::vector<double> direction;
        for (double const x : offsets[0]) direction.push_back(x / length(offsets[0]));
        auto const g = growth(orbit, direction, 1e-7, 1e-12);
        printf("status %d grown %d lost %d\n", (int)g.record.status, (int)g.record.grown_offsets, (int)g.record.lost_offsets);
        for (std::size_t k = 1; k < orbit.stops; ++k) {
            printf("%2zu %12.8f %12.8f %g\n", k, std::log(length(offsets[k + 1]) / length(offsets[k])), g.values[k - 1], std::log(length(offsets[k + 1]) / length(offsets[k]))- g.values[k - 1]);
        }
    }
}

}  // namespace
}  // namespace slideway::rigid_growth_test
