// Blocks of members that meet their way, one for each thing that a block can be asked for.
#pragma once

#include <vector>

#include "tests/support/owned_block.hpp"

namespace slideway::testing {

/// Every combination of parts.
inline std::vector<Parts> all_parts() {
    std::vector<Parts> all;
    for (Law const law : every_law()) {
        for (Damping const damping : dampings_of(info(law))) {
            for (bool const friction : {false, true}) {
                for (bool const misaligned : {false, true}) all.push_back({law, damping, friction, misaligned});
            }
        }
    }
    return all;
}

inline std::string name_of(Parts const& parts) {
    constexpr char const* dampings[] = {"point", "rate", "restitution"};
    return std::string(info(parts.law).name) + "_" +
           dampings[static_cast<int>(parts.damping)] + (parts.friction ? "_friction" : "") +
           (parts.misaligned_way ? "_way" : "");
}

/// Members that differ in all that changes the course of a program.
inline std::vector<Inputs> varied_members(std::size_t count, Parts const& parts) {
    auto members = scattered_starts(count);
    for (std::size_t i = 0; i < count; ++i) {
        auto& in = members[i];
        double const x = static_cast<double>(i) / static_cast<double>(count);
        in.crank_speed *= 1 + x;
        in = with_own(in, parts.law, 40 * x);
        in.hertz_exponent = i % 3 == 0 ? 1.4 : 1.5;  // both power paths inside one pack
        if (parts.damping == Damping::rate) in.chi_line = in.chi_surface = 10 * x;
        if (parts.damping == Damping::restitution) in.restitution = 0.3 + 0.6 * x;
        if (parts.misaligned_way) in.way_pitch = 1e-4 * x, in.way_roll = -1e-4 * x, in.way_offset_z = 1e-5 * x;
        // Wide angles in some lanes must not change the bits of the others.
        if (i % 7 == 3) in.start_angle = 3.0;
        // Zeros have a sign.
        if (i % 5 == 2) in.z = in.roll = in.yaw = 0;
    }
    return members;
}

/// All quantities and all series but those of forces.
inline BlockPlan sampled_block(std::size_t count, Parts const& parts) {
    BlockPlan plan;
    plan.parts = parts;
    plan.members = varied_members(count, parts);
    plan.settings.rtol = plan.settings.atol = 1e-6;
    plan.settings.end_time = 0.012;
    plan.settings.max_steps = 20'000;
    plan.series = ((Selection(1) << series_count) - 1) & ~force_series;
    for (int i = 0; i <= 24; ++i) plan.sample_times.push_back(i * 5e-4);
    return plan;
}

/// Crossings of a velocity, from a time on that is each member's own.
inline BlockPlan crossing_block(std::size_t count, Parts const& parts) {
    auto plan = sampled_block(count, parts);
    plan.series = state_selection;
    plan.crossings = {
        .on = CrossingPlan::On::state, .direction = CrossingPlan::Direction::both, .index = 2, .level = 0, .room = 5};
    for (std::size_t i = 0; i < count; ++i) plan.clocks.push_back({0.012, 1e-3 * static_cast<double>(1 + i % 3), 0});
    return plan;
}

/// Two shadows beside each member, and stops of which some are sections.
inline BlockPlan shadowed_block(std::size_t count, Parts const& parts) {
    auto plan = sampled_block(count, parts);
    plan.series = state_selection;
    plan.stops = {.count = 9, .transient = 3, .section_every = 2, .growth_lead = 1, .growth_every = 2};
    for (std::size_t i = 0; i < count; ++i) {
        double const period = 1e-3 - 1e-4 * static_cast<double>(i % 3);
        plan.clocks.push_back({0.012, period, period});
    }
    plan.shadows.count = 2;
    return plan;
}

}  // namespace slideway::testing
