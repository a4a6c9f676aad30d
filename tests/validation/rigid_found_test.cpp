// Sliders with rigid contacts that random searches (slow/rigid_fuzz_test.cpp) found where a solver gave up, impacts came to no end or contacts made energy.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_found_test {
namespace {

/// A member of the random sliders of a seed, with friction up to 0.3.
struct Found { Mechanism mechanism; unsigned seed; std::size_t member; };

class RigidFound : public ::testing::TestWithParam<Found> {
protected:
    Inputs inputs = testing::random_rigid_sliders(GetParam().member + 1, GetParam().seed, 0.3).back();
    testing::EnsembleResult result = run();

    testing::EnsembleResult run() {
        auto o = testing::rigid_options(testing::rigid_joint_parts(true, false, GetParam().mechanism), 1e-6, 0.01);
        o.settings.max_step = 2e-3;
        o.settings.max_steps = 100'000;
        return testing::run(best_isa(), o, {inputs});
    }

    void expect_balance() {
        ASSERT_EQ(result.records[0].status, Status::finished);
        double const lost = result.value(0, Quantity::friction_loss) + result.value(0, Quantity::damping_loss);
        double const change = std::abs(result.value(0, Quantity::energy_change)), scale = std::abs(result.value(0, Quantity::drive_work)) + change;
        EXPECT_GE(result.value(0, Quantity::friction_loss), 0);
        EXPECT_GE(result.value(0, Quantity::damping_loss), -1e-9 * scale);
        EXPECT_GT(lost, 0);
        EXPECT_LT(std::abs(result.value(0, Quantity::energy_residual)), 1e-6 * scale);
    }
};

/// Impacts whose loads no search of an earlier version found but thousands of sweeps from pair to pair.
using RigidFoundImpacts = RigidFound;
TEST_P(RigidFoundImpacts, AreSolved) { expect_balance(); }
INSTANTIATE_TEST_SUITE_P(Sliders, RigidFoundImpacts,
                         ::testing::Values(Found{Mechanism::free_slider, 1000, 3817}, Found{Mechanism::free_slider, 1000, 4490},
                                           Found{Mechanism::free_slider, 1000, 5113}, Found{Mechanism::free_slider, 1000, 5529},
                                           Found{Mechanism::carriage, 1000, 2964}, Found{Mechanism::carriage, 1000, 5113},
                                           Found{Mechanism::carriage, 1001, 4641}, Found{Mechanism::carriage, 1002, 6219},
                                           Found{Mechanism::slider_crank, 1000, 2964}, Found{Mechanism::slider_crank, 1000, 6010},
                                           Found{Mechanism::slider_crank, 1000, 12405}, Found{Mechanism::scotch_yoke, 1000, 4719},
                                           Found{Mechanism::scotch_yoke, 1000, 5113}, Found{Mechanism::scotch_yoke, 1000, 5121}));

/// Apices that wedge between two faces, in impacts that stop their slip and while they last, with loads a thousand times those of their approach.
using RigidFoundWedges = RigidFound;
TEST_P(RigidFoundWedges, HaveLoads) { expect_balance(); }
INSTANTIATE_TEST_SUITE_P(Sliders, RigidFoundWedges,
                         ::testing::Values(Found{Mechanism::slider_crank, 100, 2760}, Found{Mechanism::slider_crank, 104, 10986},
                                           Found{Mechanism::slider_crank, 112, 1138},
                                           Found{Mechanism::scotch_yoke, 103, 12759}, Found{Mechanism::scotch_yoke, 111, 16177},
                                           Found{Mechanism::free_slider, 105, 13722}, Found{Mechanism::free_slider, 113, 8398}));

/// Apices hit in turn every few nanoseconds, at speeds that friction keeps up: more than 100,000 steps if they go on.
using RigidFoundRattles = RigidFound;
TEST_P(RigidFoundRattles, ComeToAnEnd) {
    expect_balance();
    EXPECT_LT(result.records[0].rhs_evaluations, 30'000u);
}
INSTANTIATE_TEST_SUITE_P(Sliders, RigidFoundRattles,
                         ::testing::Values(Found{Mechanism::free_slider, 1000, 435}, Found{Mechanism::free_slider, 1000, 6135},
                                           Found{Mechanism::free_slider, 1004, 5053}, Found{Mechanism::free_slider, 1004, 13473},
                                           Found{Mechanism::carriage, 1002, 8192}, Found{Mechanism::carriage, 1007, 1617},
                                           Found{Mechanism::slider_crank, 1000, 435}, Found{Mechanism::slider_crank, 1001, 8470},
                                           Found{Mechanism::scotch_yoke, 1002, 13246}, Found{Mechanism::scotch_yoke, 1022, 12576}));

/// Slips far below what the tolerance resolves, which chatter beside others: more than 80,000 right-hand sides where pairs stick below a thirtieth of
/// the slip at which these do, or slip again from ten times as much on.
using RigidFoundSlips = RigidFound;
TEST_P(RigidFoundSlips, ComeToRest) {
    expect_balance();
    EXPECT_LT(result.records[0].rhs_evaluations, 5'000u);
}
INSTANTIATE_TEST_SUITE_P(Sliders, RigidFoundSlips,
                         ::testing::Values(Found{Mechanism::carriage, 124, 6945}, Found{Mechanism::carriage, 137, 7814},
                                           Found{Mechanism::carriage, 138, 6222}, Found{Mechanism::scotch_yoke, 100, 14565},
                                           Found{Mechanism::scotch_yoke, 122, 13351}, Found{Mechanism::slider_crank, 122, 13351},
                                           Found{Mechanism::slider_crank, 137, 10944},
                                           // And where the end of a slip, in impacts too, sets others in motion.
                                           Found{Mechanism::free_slider, 111, 6342}, Found{Mechanism::free_slider, 122, 6996}));

/// A wedged member of a pack goes the way that it goes alone: what its neighbours hold by friction is theirs.
TEST(RigidFoundBeside, OthersAreAsAlone) {
    std::vector<Inputs> members;
    for (auto const& [seed, member] : {std::pair{100u, 2760u}, {104u, 10986u}, {112u, 1138u}}) {
        auto const all = testing::random_rigid_sliders(member + 3, seed, 0.3);
        members.insert(members.end(), all.end() - 3, all.end());
    }
    auto o = testing::rigid_options(testing::rigid_joint_parts(true, false, Mechanism::slider_crank), 1e-6, 0.01);
    o.settings.max_step = 2e-3;
    auto const together = testing::run(best_isa(), o, members);
    for (std::size_t i = 0; i < members.size(); ++i) {
        auto const alone = testing::run(best_isa(), o, {members[i]});
        EXPECT_EQ(together.records[i].status, alone.records[0].status) << i;
        EXPECT_EQ(together.records[i].rhs_evaluations, alone.records[0].rhs_evaluations) << i;
        EXPECT_EQ(together.value(i, Quantity::friction_loss), alone.value(0, Quantity::friction_loss)) << i;
    }
}

/// Six pairs on three faces that come to rest at once, whose equations with friction have next to no inverse.
using RigidFoundRests = RigidFound;
TEST_P(RigidFoundRests, MakeNoEnergy) { expect_balance(); }
INSTANTIATE_TEST_SUITE_P(Sliders, RigidFoundRests,
                         ::testing::Values(Found{Mechanism::scotch_yoke, 103, 14339}, Found{Mechanism::slider_crank, 110, 10135},
                                           Found{Mechanism::free_slider, 114, 6745}));

/// Friction above what lets rigid contact have forces: such members end as jammed, not as numbers that are none.
TEST(RigidFound, WhatHasNoForcesIsJammed) {
    std::vector<Inputs> members;
    auto const all = testing::random_rigid_sliders(16'384, 1000, 1);
    std::vector<std::size_t> const jams{2964, 4315, 13527};
    for (std::size_t const member : jams) members.push_back(all[member]);
    auto o = testing::rigid_options(testing::rigid_joint_parts(true), 1e-6, 0.01);
    o.settings.max_step = 2e-3;
    auto const r = testing::run(best_isa(), o, members);
    for (std::size_t i = 0; i < jams.size(); ++i) EXPECT_EQ(r.records[i].status, Status::contact_domain) << jams[i];
}

}  // namespace
}  // namespace slideway::rigid_found_test
