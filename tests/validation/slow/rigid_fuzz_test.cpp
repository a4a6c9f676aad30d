// A million planar slider-cranks with rigid contacts, and 160,000 sliders with eight apices, of all proportions, starts, restitutions and frictions: each ends with
// a status, none makes energy in its contacts, and the dearest costs no more than some hundred of the median.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_fuzz_test {
namespace {

constexpr std::size_t block = 4096;

struct Found {
    std::size_t members = 0, finished = 0, jammed = 0, spent = 0, others = 0, made_energy = 0;
    std::vector<double> costs;
};

using Draw = std::vector<Inputs> (*)(std::size_t count, unsigned seed, double most_friction);

Found search(std::size_t count, double most_friction, Parts const& parts, Draw draw) {
    auto o = testing::rigid_options(parts, 1e-6, 0.1);
    o.settings.max_step = 2e-3;
    o.settings.max_steps = 100'000;
    Found found;
    for (unsigned seed = 0; found.members < count; ++seed) {
        auto const members = draw(block, 100 + seed, most_friction);
        auto const r = testing::run(best_isa(), o, members);
        for (std::size_t i = 0; i < members.size(); ++i) {
            Status const status = r.records[i].status;
            bool const ended = status == Status::finished;
            found.finished += ended;
            found.jammed += status == Status::contact_domain;
            found.spent += status == Status::max_steps;
            found.others += !ended && status != Status::contact_domain && status != Status::max_steps;
            double const lost = r.value(i, Quantity::friction_loss) + r.value(i, Quantity::damping_loss);
            double const scale = std::abs(r.value(i, Quantity::crank_work)) + std::abs(r.value(i, Quantity::energy_change));
            bool const made = ended && lost < -1e-6 * scale;
            found.made_energy += made;
            if (made) std::printf("seed %u, member %zu: %g J lost, of %g J\n", 100 + seed, i, lost, scale);
            found.costs.push_back(static_cast<double>(r.records[i].rhs_evaluations));
        }
        found.members += members.size();
    }
    std::ranges::sort(found.costs);
    auto const& c = found.costs;
    std::printf("%s, friction to %.1f, %s crank: %zu members, %zu finished, %zu jammed, %zu spent their steps, %zu others; right-hand sides: median %.0f, p99 %.0f, most %.0f\n",
                info(parts.mechanism).name, most_friction, parts.free_crank ? "free" : "driven", found.members, found.finished, found.jammed, found.spent, found.others, c[c.size() / 2],
                c[c.size() * 99 / 100], c.back());
    return found;
}

TEST(RigidFuzz, AMillionBlocksEndAndMakeNoEnergy) {
    for (bool const free_crank : {false, true}) {
        auto const parts = testing::rigid_planar_parts(true, free_crank);
        auto const mild = search(400'000, 0.3, parts, &testing::random_rigid_blocks);
        EXPECT_EQ(mild.others, 0);
        EXPECT_EQ(mild.made_energy, 0);
        EXPECT_LT(mild.jammed, mild.members / 2000);
        EXPECT_LT(mild.spent, mild.members / 10'000);
        auto const wild = search(100'000, 3, parts, &testing::random_rigid_blocks);
        EXPECT_LT(wild.others, wild.members / 10'000);
        EXPECT_EQ(wild.made_energy, 0);
    }
}

TEST(RigidFuzz, SlidersWithEightApicesEndAndMakeNoEnergy) {
    for (auto const mechanism : {Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::slider_crank}) {
        for (double const friction : {0.3, 1.0}) {
            auto const found = search(20'000, friction, testing::rigid_joint_parts(true, false, mechanism), &testing::random_rigid_sliders);
            EXPECT_EQ(found.made_energy, 0);
            EXPECT_LT(found.others, found.members / 5000);
            // Large friction in wild proportions wedges some.
            EXPECT_LT(found.jammed + found.spent, found.members / (friction < 0.5 ? 100 : 10));
        }
    }
}

}  // namespace
}  // namespace slideway::rigid_fuzz_test
