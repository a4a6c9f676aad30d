// A million planar slider-cranks with rigid contacts, and a million of each mechanism with eight apices, of all proportions, starts, restitutions and frictions:
// each ends with a status, none makes energy in its contacts, and next to all cost less than a hundred times the median.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_fuzz_test {
namespace {

struct Found {
    std::size_t members = 0, finished = 0, jammed = 0, spent = 0, others = 0, made_energy = 0;
    std::vector<double> costs;  // right-hand sides, ascending

    /// Members that cost more than a hundred times the median.
    [[nodiscard]] std::size_t dear() const {
        return static_cast<std::size_t>(costs.end() - std::ranges::upper_bound(costs, 100 * costs[costs.size() / 2]));
    }
};

/// How members are drawn, how many at a time, and how long they move [s].
struct Draws {
    std::vector<Inputs> (*draw)(std::size_t count, unsigned seed, double most_friction);
    std::size_t block;
    double seconds;
};
constexpr Draws blocks{&testing::random_rigid_blocks, 4096, 0.1}, sliders{&testing::random_rigid_sliders, 16'384, 0.01};

Found search(std::size_t count, double most_friction, Parts const& parts, Draws const& draws) {
    auto o = testing::rigid_options(parts, 1e-6, draws.seconds);
    o.settings.max_step = 2e-3;
    o.settings.max_steps = 100'000;
    Found found;
    for (unsigned seed = 0; found.members < count; ++seed) {
        auto const members = draws.draw(draws.block, 100 + seed, most_friction);
        auto const r = testing::run(best_isa(), o, members);
        for (std::size_t i = 0; i < members.size(); ++i) {
            Status const status = r.records[i].status;
            bool const ended = status == Status::finished;
            found.finished += ended;
            found.jammed += status == Status::contact_domain;
            found.spent += status == Status::max_steps;
            found.others += !ended && status != Status::contact_domain && status != Status::max_steps;
            double const lost = r.value(i, Quantity::friction_loss) + r.value(i, Quantity::damping_loss);
            double const scale = std::abs(r.value(i, Quantity::drive_work)) + std::abs(r.value(i, Quantity::energy_change));
            // Rounding is all that a slider which scarcely moved has gained or lost.
            double const start = members[i].slider_mass * (members[i].vy * members[i].vy + members[i].vz * members[i].vz) / 2;
            bool const made = ended && lost < -1e-6 * scale && lost < -1e-10 * start;
            found.made_energy += made;
            if (made) std::printf("seed %u, member %zu: %g J lost, of %g J\n", 100 + seed, i, lost, scale);
            found.costs.push_back(static_cast<double>(r.records[i].rhs_evaluations));
        }
        found.members += members.size();
    }
    std::ranges::sort(found.costs);
    auto const& c = found.costs;
    std::printf("%s, friction to %.1f, %s crank: %zu members, %zu finished, %zu jammed, %zu spent their steps, %zu others; right-hand sides: median %.0f, p99 %.0f, most %.0f, %zu above a hundred medians\n",
                info(parts.mechanism).name, most_friction, parts.drive.turns_freely() ? "free" : "driven", found.members, found.finished, found.jammed, found.spent, found.others, c[c.size() / 2],
                c[c.size() * 99 / 100], c.back(), found.dear());
    return found;
}

TEST(RigidFuzz, AMillionBlocksEndAndMakeNoEnergy) {
    for (bool const free_crank : {false, true}) {
        auto const parts = testing::rigid_planar_parts(true, free_crank);
        auto const mild = search(400'000, 0.3, parts, blocks);
        EXPECT_EQ(mild.others, 0);
        EXPECT_EQ(mild.made_energy, 0);
        EXPECT_LT(mild.jammed, mild.members / 2000);
        EXPECT_LT(mild.spent, mild.members / 10'000);
        auto const wild = search(100'000, 3, parts, blocks);
        EXPECT_LT(wild.others, wild.members / 10'000);
        EXPECT_EQ(wild.made_energy, 0);
    }
}

class RigidSliderFuzz : public ::testing::TestWithParam<Mechanism> {
protected:
    Parts parts = testing::rigid_joint_parts(true, false, GetParam());
};

TEST_P(RigidSliderFuzz, MostOfAMillionEndAndMakeNoEnergy) {
    auto const mild = search(851'968, 0.3, parts, sliders);
    EXPECT_EQ(mild.others, 0);
    EXPECT_EQ(mild.made_energy, 0);
    EXPECT_LT(mild.jammed, mild.members / 40'000);
    EXPECT_LT(mild.spent, mild.members / 100'000);
    EXPECT_LT(mild.dear(), mild.members / 20'000);
}

TEST_P(RigidSliderFuzz, RestOfAMillionWithLargeFrictionEndsAndMakesNoEnergy) {
    auto const wild = search(163'840, 1, parts, sliders);
    EXPECT_EQ(wild.made_energy, 0);
    // Some have no forces, and driven cranks push some that wedge without end.
    EXPECT_LT(wild.jammed, wild.members / 200);
    EXPECT_LT(wild.spent, wild.members / 2000);
    EXPECT_LT(wild.others, wild.members / 500);
}
INSTANTIATE_TEST_SUITE_P(Mechanisms, RigidSliderFuzz,
                         ::testing::Values(Mechanism::slider_crank, Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke));

}  // namespace
}  // namespace slideway::rigid_fuzz_test
