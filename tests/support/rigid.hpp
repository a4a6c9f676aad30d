// Runs with rigid contacts.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::testing {

inline Parts rigid_planar_parts(bool friction, bool free_crank) {
    Parts parts;
    parts.mechanism = Mechanism::planar_slider_crank;
    parts.damping = Damping::restitution;
    parts.friction = friction;
    parts.drive.by = free_crank ? slideway::DriveBy::nothing : slideway::DriveBy::speed;
    parts.rigid = true;
    return parts;
}

inline RunOptions rigid_options(Parts const& parts, double tolerance, double seconds) {
    RunOptions o;
    o.parts = parts;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.max_step = 1e-3;
    o.settings.end_time = seconds;
    o.settings.max_steps = 1'000'000;
    o.quantities = all_quantities & ~without_rigid_contact;
    return o;
}

/// Members that stop at equal times, with shadows that are put back to d0 at each.
struct ShadowOptions {
    Parts parts;
    double tolerance = 1e-10;
    std::size_t stops = 0;
    double every = 0;  // [s]
    int shadows = 1;
    double d0 = 1e-6;
    std::vector<double> directions;  // [shadow][state], of unit length, the same for all members
    std::uint64_t max_steps = 1'000'000;
};

struct ShadowResult {
    std::vector<MemberRecord> records;
    std::vector<double> states;  // [member][state], at the end
    std::vector<double> growth;  // ln, [member][interval][shadow]; the first interval begins at the first stop
};

inline ShadowResult run_shadowed(Isa isa, ShadowOptions const& options, std::vector<Inputs> const& members) {
    std::size_t const n = members.size(), width = static_cast<std::size_t>(info(options.parts.mechanism).states);
    ShadowResult r;
    r.records.resize(n);
    r.states.resize(n * width);
    r.growth.resize(n * (options.stops - 1) * static_cast<std::size_t>(options.shadows));
    double const end = std::fma(static_cast<double>(options.stops - 1), options.every, options.every);
    std::vector<MemberClock> const clocks(n, MemberClock{end, options.every, options.every});
    std::vector<double> directions;
    for (std::size_t i = 0; i < n; ++i) directions.insert(directions.end(), options.directions.begin(), options.directions.end());
    Block block;
    block.inputs = members.data();
    block.members = n;
    block.settings = rigid_options(options.parts, options.tolerance, end).settings;
    block.settings.max_steps = options.max_steps;
    block.clocks = clocks.data();
    block.stops = {.count = options.stops};
    block.shadows = {options.shadows, options.d0, 0, 0, directions.data()};
    block.records = r.records.data();
    block.final_states = r.states.data();
    block.growth_values = r.growth.data();
    find_instance(isa, options.parts, true).run_shadowed(block);
    return r;
}

/// Numbers between two bounds, the same with every standard library.
class UniformDraws {
public:
    explicit UniformDraws(unsigned seed) : draw_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * static_cast<double>(draw_() >> 11) * 0x1p-53; }

private:
    std::mt19937_64 draw_;
};

/// Planar slider-cranks of all proportions, starts and restitutions, with friction up to `most_friction`.
inline std::vector<Inputs> random_rigid_blocks(std::size_t count, unsigned seed, double most_friction) {
    UniformDraws uniform(seed);
    std::vector<Inputs> members;
    members.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        Inputs in;
        in.crank_length = uniform(0.01, 0.05);
        in.rod_length = in.crank_length * uniform(2.5, 5);
        in.crank_speed = uniform(-120, 120);
        in.start_angle = uniform(0, 6.283);
        in.clearance_y = std::pow(10, uniform(-5.5, -3));
        in.slider_length = uniform(0.02, 0.1);
        in.slider_height = uniform(0.01, 0.06);
        in.slider_mass = std::pow(10, uniform(-1.5, 0.5));
        in.slider_inertia_z = in.slider_mass * (in.slider_length * in.slider_length + in.slider_height * in.slider_height) / 12 * std::pow(10, uniform(-0.5, 0.5));
        in.restitution = uniform(0.01, 1);
        in.friction_kinetic = uniform(0, most_friction);
        in.friction_static = in.friction_kinetic * uniform(1, 1.5);
        in.y = uniform(-1, 1) * in.clearance_y * 0.9;
        in.wz = uniform(-2, 2);
        members.push_back(complete_inputs(in));
    }
    return members;
}

}  // namespace slideway::testing
