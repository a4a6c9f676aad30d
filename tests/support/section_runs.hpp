// Studies of sections, run in this process, and a slider that falls onto a rigid face.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "host/study/ensemble_plan.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::testing::section_runs {

/// Time, then the state.
using Row = std::vector<double>;

struct Found {
    std::vector<std::vector<Row>> rows;  // by member
    std::vector<MemberRecord> records;
};

inline Found run_scene(std::string const& text, Isa isa = best_isa()) {
    Scene const scene = parse_scene(text, "test.toml");
    MemberSet const all(MemberRange{0, scene.members});
    EnsemblePlan const plan = ensemble_plan(scene, all, *cpu_backend(isa), 1);
    std::size_t const room = scene.chaos.max_crossings;
    auto const width = static_cast<std::size_t>(1 + info(scene.parts.mechanism).states);
    Found found;
    found.rows.resize(scene.members);
    found.records.resize(scene.members);
    auto const keep = [&](BlockResult const& block) {
        for (std::size_t i = 0; i < block.members.size(); ++i) {
            std::size_t const member = block.members[i];
            found.records[member] = block.records[i];
            for (std::size_t k = 0; k < std::min<std::size_t>(room, block.records[i].crossings); ++k) {
                auto const row = block.sections.subspan((i * room + k) * width, width);
                found.rows[member].emplace_back(row.begin(), row.end());
            }
        }
    };
    EXPECT_EQ(run_ensemble(plan, cpu_backend(isa)->kernel(scene.parts, false), keep, StopRequest{}).failed(), 0u);
    return found;
}

// A slider that falls by 2⁻¹⁰ m from the middle of its way with 8 m/s²: it lands after 1/64 s, at 1/8 m/s.
inline constexpr double fall_time = 1.0 / 64, gravity = 8, landing_speed = 0.125, clearance = 0x1p-10;
inline constexpr std::size_t place_y = 1, place_z = 2, place_vy = 3, place_vz = 4;

inline std::string falling(std::string_view section, std::string_view restitution = "1.0", std::string_view initial = "", double seconds = 1) {
    return fmt::format(R"(schema = 1
[mechanism]
kind = "free_slider"
gravity = 8.0
[joint]
clearance = "0.9765625 mm"
[contact]
law = "rigid"
restitution = {}
[initial]
{}
[study]
kind = "poincare"
members = 1
Ttr = 0.0
duration = {}
section = {{ {} }}
)",
                       restitution, initial, seconds, section);
}

inline std::vector<Row> rows_of(std::string const& text) { return run_scene(text).rows[0]; }

}  // namespace slideway::testing::section_runs
