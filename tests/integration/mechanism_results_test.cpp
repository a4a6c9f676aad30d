// Results of every mechanism hold its own states, under their names.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/run/ensemble.hpp"
#include "host/store/result_view.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::mechanism_results_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t room = 2;

struct Case {
    Mechanism mechanism;
    std::vector<std::string> states;
};

Case const cases[] = {
    {Mechanism::slider_crank, {"y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz"}},
    {Mechanism::carriage, {"y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz"}},
    {Mechanism::scotch_yoke, {"y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz"}},
    {Mechanism::free_slider, {"y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz", "x", "vx"}},
    {Mechanism::planar_slider_crank,
     {"crank_angle", "rod_angle", "pitch", "crank_angular_velocity", "rod_angular_velocity", "wz"}},
};

/// A kernel that knows how many numbers a state has: state k of a member is 100 member + k, its only section 1000 more.
void numbered(Block& block, std::size_t states) {
    for (std::size_t i = 0; i < block.members; ++i) {
        double const member = block.inputs[i].y;
        block.records[i].status = Status::finished;
        for (std::size_t k = 0; k < states; ++k) {
            block.final_states[i * states + k] = 100 * member + static_cast<double>(k);
            block.section_values[i * room * (1 + states) + 1 + k] = 1000 + 100 * member + static_cast<double>(k);
        }
        block.section_values[i * room * (1 + states)] = member;
        for (int d = 0; d < block.shadows.count; ++d) {
            for (std::size_t k = 0; k < states; ++k) {
                EXPECT_EQ(block.shadows.directions[(i * 2 + static_cast<std::size_t>(d)) * states + k],
                          10 * member + d);
            }
        }
    }
}

std::string name_of_case(::testing::TestParamInfo<Case> const& one) { return info(one.param.mechanism).name; }

class MechanismsFile : public testing::OutputFolder, public ::testing::WithParamInterface<Case> {};

TEST_P(MechanismsFile, HoldsEachMembersStates) {
    auto const& [mechanism, names] = GetParam();
    std::size_t const states = names.size();
    EnsemblePlan plan;
    plan.members = MemberSet({0, 7});
    plan.blocks.fixed = 3;
    plan.source = [](std::uint64_t member, Inputs& inputs) {
        inputs.y = static_cast<double>(member);
        return member != 4;  // its neighbours keep their places
    };
    plan.request.states = states;
    plan.request.sections = true;
    plan.request.crossings.room = room;
    plan.request.shadows.count = 2;
    plan.request.directions = [states](std::uint64_t member, double* out) {
        for (std::size_t k = 0; k < 2 * states; ++k) out[k] = 10.0 * static_cast<double>(member) + (k < states ? 0 : 1);
    };
    ResultLayout layout;
    layout.members = plan.members;
    layout.mechanism = mechanism;
    layout.sections = room;
    std::string const shards = shards_of({"a program", "fused", layout.members, ""});
    ShardStore store(shards);
    StopRequest const stop;
    run_ensemble(
        plan, [states](Block& block) { numbered(block, states); },
        [&](BlockResult const& block) {
            EXPECT_EQ(block.states(), states);
            ShardImage const image = shard_image("a shard", layout, {}, block);
            store.put(image.members, image.bytes);
        },
        stop);
    ShardFolder const from(shards);
    merge_shards(from, from.listed(), {layout, {}, "complete", {}, {}}, path());

    ResultReader const results(path());
    EXPECT_EQ(results.stored_hash(), results.computed_hash());
    EXPECT_EQ(results.values("section_count"), (std::vector<double>{1, 1, 1, 1, 0, 1, 1}));
    for (std::size_t k = 0; k < states; ++k) {
        auto const finals = results.values("final_" + names[k]), sections = results.values("section_" + names[k]);
        ASSERT_EQ(finals.size(), 7u) << names[k];
        ASSERT_EQ(sections.size(), 6u) << names[k];
        for (std::size_t member = 0; member < 7; ++member) {
            double const value = 100.0 * static_cast<double>(member) + static_cast<double>(k);
            if (member == 4) {
                EXPECT_TRUE(std::isnan(finals[member]));
                continue;
            }
            EXPECT_EQ(finals[member], value) << names[k];
            EXPECT_EQ(sections[member - (member > 4 ? 1 : 0)], 1000 + value) << names[k];
        }
    }
    EXPECT_EQ(results.values("section_time"), (std::vector<double>{0, 1, 2, 3, 5, 6}));
    for (char const* const other : {"final_crank_angle", "final_x", "final_y", "section_roll"}) {
        bool const own =
            std::find(names.begin(), names.end(), std::string(other).substr(other[0] == 'f' ? 6 : 8)) != names.end();
        EXPECT_EQ(results.has(other), own) << other;
    }
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, MechanismsFile, ::testing::ValuesIn(cases), name_of_case);

TEST(MechanismsFiles, AreOfEveryMechanism) { EXPECT_EQ(std::size(cases) + 1, mechanism_kinds().size()) << "a linkage has the states that its scene names"; }

TEST(MechanismsBlocks, TakeTheRoomOfTheirStates) {
    BlockRequest small, large;
    small.states = 6, large.states = 12;
    EXPECT_EQ(block_bytes(large, 5) - block_bytes(small, 5), 5 * 6 * sizeof(double));
    small.shadows.count = large.shadows.count = 3;
    EXPECT_EQ(block_bytes(large, 5) - block_bytes(small, 5), 5 * 4 * 6 * sizeof(double));
    small.sections = large.sections = true;
    small.crossings.room = large.crossings.room = 10;
    EXPECT_EQ(block_bytes(large, 5) - block_bytes(small, 5), 5 * 14 * 6 * sizeof(double));
}

class DirectionsFile : public testing::OutputFolder {};

TEST_F(DirectionsFile, HasAValueForEach) {
    ResultLayout layout;
    layout.members = MemberSet({0, 1});
    layout.quantities = selection_of(Quantity::peak_acceleration) | selection_of(Quantity::acceleration_area);
    std::vector<std::uint64_t> const members{0};
    std::vector<Inputs> const inputs(1);
    std::vector<MemberRecord> const records{{Status::finished}};
    std::vector<double> const states(state_size, 0.0);
    std::vector<double> quantities(quantity_columns, nan);
    for (int i = 0; i < 3; ++i)
        quantities[static_cast<std::size_t>(quantity_column(Quantity::peak_acceleration) + i)] = i;
    for (int i = 0; i < 2; ++i)
        quantities[static_cast<std::size_t>(quantity_column(Quantity::acceleration_area) + i)] = 5 + i;
    write_result(path(), layout, {}, {{members, inputs, records, states, quantities, {}, {}, {}}});
    ResultReader const results(path());
    EXPECT_EQ(results.values("peak_acceleration"), (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(results.values("acceleration_area"), (std::vector<double>{5, 6}));
    EXPECT_EQ(labels_of("direction"), (std::vector<std::string>{"x", "y", "z"}));
    EXPECT_EQ(labels_of("channel"), (std::vector<std::string>{"top", "front"}));
    auto const speeds = labels_of("face_speed");
    ASSERT_EQ(speeds.size(), static_cast<std::size_t>(face_speed_count));
    EXPECT_EQ((std::vector{speeds[0], speeds[1], speeds[7], speeds[8], speeds[31]}),
              (std::vector<std::string>{"y_plus_0", "y_plus_0.001", "y_plus_1", "y_minus_0", "z_minus_1"}));
    EXPECT_EQ(labels_of("face"), (std::vector<std::string>{"y_plus", "y_minus", "z_plus", "z_minus"}));
}

}  // namespace
}  // namespace slideway::mechanism_results_test
