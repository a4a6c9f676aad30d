// Members with rigid contacts have the same bits in every instruction set, block, order and company.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/planar_runs.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_test {
namespace {

using testing::EnsembleResult;

/// Blocks that fly, bounce, lie, stick, slip, jam and fail.
std::vector<Inputs> mixed_members(std::size_t count) {
    std::mt19937_64 draw(7);
    auto const uniform = [&draw](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
    std::vector<Inputs> members;
    for (std::size_t i = 0; i < count; ++i) {
        auto in = oracle::planar_check_inputs();
        in.restitution = uniform(0.1, 1);
        in.friction_kinetic = i % 4 == 0 ? uniform(1, 3) : uniform(0, 0.4);
        in.friction_static = in.friction_kinetic + uniform(0, 0.1);
        in.start_angle = uniform(0, 6.2);
        in.crank_speed = i % 5 == 0 ? 0 : uniform(-100, 100);
        in.y = i % 3 == 0 ? -in.clearance_y : uniform(-0.9, 0.9) * in.clearance_y;
        in.wz = i % 3 == 0 ? 0 : uniform(-2, 2);
        if (i % 16 == 7) in.wz = NAN;
        if (i % 16 == 13) in.y = 1.1 * in.clearance_y;
        members.push_back(complete_inputs(in));
    }
    return members;
}

EnsembleResult run(Isa isa, bool free_crank, std::vector<Inputs> const& members) {
    auto o = testing::rigid_options(testing::rigid_planar_parts(true, free_crank), 1e-7, 0.05);
    o.settings.max_steps = 20'000;
    o.series = selections::of({Series::y, Series::vy, Series::pitch});
    o.sample_times = {0, 0.01, 0.0237, 0.05};
    return testing::run(isa, o, members);
}

template <class Row> bool same_bits(Row const& a, Row const& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

/// Of member i of one run and member j of another.
void expect_same(EnsembleResult const& a, std::size_t i, EnsembleResult const& b, std::size_t j) {
    EXPECT_EQ(a.records[i].status, b.records[j].status) << i;
    EXPECT_EQ(a.records[i].steps_accepted, b.records[j].steps_accepted) << i;
    EXPECT_EQ(a.records[i].rhs_evaluations, b.records[j].rhs_evaluations) << i;
    EXPECT_TRUE(same_bits(a.states[i], b.states[j])) << i;
    EXPECT_TRUE(same_bits(a.quantities[i], b.quantities[j])) << i;
}

TEST(RigidBits, AreThoseOfScalarInEveryInstructionSet) {
    auto const members = mixed_members(48);
    for (bool const free_crank : {false, true}) {
        auto const scalar = run(Isa::scalar, free_crank, members);
        for (Isa const isa : testing::isas_beside_scalar()) {
            auto const other = run(isa, free_crank, members);
            for (std::size_t i = 0; i < members.size(); ++i) expect_same(scalar, i, other, i);
            EXPECT_TRUE(same_bits(scalar.series, other.series)) << name_of(isa);
        }
    }
}

TEST(RigidBits, AreAMembersOwn) {
    auto const members = mixed_members(48);
    auto const together = run(best_isa(), true, members);
    std::vector<Inputs> backwards(members.rbegin(), members.rend());
    auto const turned = run(best_isa(), true, backwards);
    for (std::size_t i = 0; i < members.size(); ++i) {
        expect_same(together, i, turned, members.size() - 1 - i);
        expect_same(together, i, run(best_isa(), true, {members[i]}), 0);
    }
}

/// With two shadows each.
testing::ShadowOptions two_shadows(Parts const& parts, double tolerance, std::size_t stops) {
    testing::ShadowOptions options{parts, tolerance, stops, 1e-3, 2, 1e-6, {}};
    options.max_steps = 4000;
    return options;
}

/// Of every instruction set, in another order, and alone.
void expect_own_bits_with_shadows(testing::ShadowOptions const& options, std::vector<Inputs> const& members) {
    auto const width = static_cast<std::size_t>(info(options.parts.mechanism).states),
               growths = 2 * (options.stops - 1);
    auto const of = [](std::vector<double> const& all, std::size_t member, std::size_t count) {
        auto const from = all.begin() + static_cast<std::ptrdiff_t>(member * count);
        return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(count));
    };
    // NaNs say nothing by their sign.
    auto const same = [](std::vector<double> const& a, std::vector<double> const& b) {
        return std::ranges::equal(a, b, [](double x, double y) {
            return std::memcmp(&x, &y, sizeof x) == 0 || (std::isnan(x) && std::isnan(y));
        });
    };
    auto const scalar = testing::run_shadowed(Isa::scalar, options, members);
    auto const expect = [&](testing::ShadowResult const& other, std::size_t i, std::size_t j) {
        EXPECT_EQ(scalar.records[i].status, other.records[j].status) << i;
        EXPECT_EQ(scalar.records[i].rhs_evaluations, other.records[j].rhs_evaluations) << i;
        EXPECT_EQ(scalar.records[i].grown_offsets, other.records[j].grown_offsets) << i;
        EXPECT_EQ(scalar.records[i].lost_offsets, other.records[j].lost_offsets) << i;
        EXPECT_TRUE(same(of(scalar.states, i, width), of(other.states, j, width))) << i;
        EXPECT_TRUE(same(of(scalar.growth, i, growths), of(other.growth, j, growths))) << i;
    };
    for (Isa const isa : testing::isas_beside_scalar()) {
        auto const other = testing::run_shadowed(isa, options, members);
        for (std::size_t i = 0; i < members.size(); ++i) expect(other, i, i);
    }
    std::vector<Inputs> backwards(members.rbegin(), members.rend());
    auto const turned = testing::run_shadowed(best_isa(), options, backwards);
    for (std::size_t i = 0; i < members.size(); ++i) {
        expect(turned, i, members.size() - 1 - i);
        expect(testing::run_shadowed(best_isa(), options, {members[i]}), i, 0);
    }
}

TEST(RigidBits, AreAMembersOwnWithShadowsToo) {
    for (bool const free_crank : {false, true}) {
        auto options = two_shadows(testing::rigid_planar_parts(true, free_crank), 1e-7, 50);
        options.directions = {0, 0.6, 0, 0, 0.8, 0, 0, 0, 0.8, 0, 0, 0.6};
        expect_own_bits_with_shadows(options, mixed_members(48));
    }
}

TEST(RigidBits, AreAMembersOwnWithShadowsOfEightApices) {
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::carriage, Mechanism::scotch_yoke}) {
        SCOPED_TRACE(info(mechanism).name);
        auto options = two_shadows(testing::rigid_joint_parts(true, false, mechanism), 1e-6, 20);
        options.directions = {0, 0.6, 0, 0, 0, 0.8, 0, 0, 0, 0, 0, 0, 0.8, 0, 0, 0, 0, 0, 0, 0.6};
        expect_own_bits_with_shadows(options, testing::random_rigid_sliders(20, 5, 0.4));
    }
}

TEST(RigidBits, ComeFromMembersOfAllKinds) {
    auto const r = run(best_isa(), true, mixed_members(48));
    int finished = 0, refused = 0, invalid = 0;
    for (auto const& record : r.records) {
        finished += record.status == Status::finished;
        refused += record.status == Status::geometry;
        invalid += record.status == Status::nonfinite || record.status == Status::invalid_inputs;
    }
    EXPECT_GT(finished, 30);
    EXPECT_EQ(refused, 3);
    EXPECT_EQ(invalid, 3);
}

/// Sliders with eight apices that fly, bounce, lie, stick, slip, and some that fail.
std::vector<Inputs> mixed_sliders(std::size_t count) {
    auto members = testing::random_rigid_sliders(count, 9, 0.6);
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (i % 3 == 0) members[i].friction_kinetic = members[i].friction_static = 0.2;
        if (i % 16 == 7) members[i].wz = NAN;
        if (i % 16 == 13) members[i].y = 1.5 * members[i].clearance_y;
    }
    return members;
}

TEST(RigidBits, OfSlidersWithEightApicesAreThoseOfScalarInAnyOrder) {
    auto const members = mixed_sliders(24);
    std::vector<Inputs> const reversed(members.rbegin(), members.rend());
    for (auto const mechanism :
         {Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::slider_crank}) {
        for (bool const misaligned : {false, true}) {
            auto o = testing::rigid_options(testing::rigid_joint_parts(true, misaligned, mechanism), 1e-7, 0.02);
            o.settings.max_steps = 20'000;
            auto const scalar = testing::run(Isa::scalar, o, members);
            auto const others = testing::run(best_isa(), o, reversed);
            for (std::size_t i = 0; i < members.size(); ++i) expect_same(scalar, i, others, members.size() - 1 - i);
        }
    }
}

/// Of a random search: conditions that few methods settle, impacts without end, rests whose equations make energy, and some that jam.
TEST(RigidBits, OfSlidersThatAreHardToSolveAreThoseOfScalarInAnyOrder) {
    auto const all = testing::random_rigid_sliders(16'384, 1000, 1);
    std::vector<Inputs> members;
    for (std::size_t const member : {43, 794, 922, 1298, 1893, 2278, 2805, 2964, 4719, 5003, 5113, 6009, 6135, 7829, 8746, 10434, 11009, 13788, 16144}) {
        members.push_back(all[member]);
    }
    std::vector<Inputs> const reversed(members.rbegin(), members.rend());
    for (auto const mechanism : {Mechanism::free_slider, Mechanism::slider_crank}) {
        auto o = testing::rigid_options(testing::rigid_joint_parts(true, false, mechanism), 1e-6, 0.01);
        o.settings.max_steps = 20'000;
        auto const scalar = testing::run(Isa::scalar, o, members);
        auto const others = testing::run(best_isa(), o, reversed);
        for (std::size_t i = 0; i < members.size(); ++i) expect_same(scalar, i, others, members.size() - 1 - i);
    }
}

/// Sliders of the paper's size that have lain down on a face within 30 ms: the last of its apices comes to rest with those that meet it.
std::vector<Inputs> sliders_that_lie_down(std::size_t count) {
    testing::UniformDraws uniform(3);
    std::vector<Inputs> members;
    for (std::size_t i = 0; i < count; ++i) {
        Inputs in;
        in.restitution = uniform(0.1, 0.6);
        in.friction_kinetic = uniform(0.1, 0.5), in.friction_static = in.friction_kinetic * 1.2;
        in.y = uniform(-4e-5, 4e-5), in.z = uniform(-4e-5, 4e-5);
        in.roll = uniform(-1e-3, 1e-3), in.yaw = uniform(-1e-3, 1e-3), in.pitch = uniform(-1e-3, 1e-3);
        members.push_back(complete_inputs(in));
    }
    return members;
}

TEST(RigidBits, OfSlidersThatLieDownAreThoseOfScalarInAnyOrder) {
    auto const members = sliders_that_lie_down(64);
    std::vector<Inputs> const reversed(members.rbegin(), members.rend());
    for (bool const friction : {false, true}) {
        auto o =
            testing::rigid_options(testing::rigid_joint_parts(friction, false, Mechanism::slider_crank), 1e-6, 0.03);
        auto const scalar = testing::run(Isa::scalar, o, members);
        auto const together = testing::run(best_isa(), o, members), turned = testing::run(best_isa(), o, reversed);
        double resting = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            expect_same(scalar, i, together, i);
            expect_same(scalar, i, turned, members.size() - 1 - i);
            resting += scalar.value(i, Quantity::mode_time, 3) > 0 ? 1 : 0;
        }
        EXPECT_GT(resting, 48) << friction;
    }
}

}  // namespace
}  // namespace slideway::rigid_test
