// What a continued sweep runs, and what it leaves alone.
#include "host/study/continued_sweep.hpp"

#include <atomic>

#include <gtest/gtest.h>

#include "host/study/study_run.hpp"
#include "tests/unit/scene_fixture.hpp"

namespace slideway {
namespace {

constexpr std::uint64_t starts = 5, columns = 4, total = starts * columns;

Scene sweep_scene() {
    return testing::scene_of(R"(
        schema = 1
        [mechanism]
        crank_speed = 100
        [study]
        kind = "sweep"
        members = 5
        parameter = "joint.clearance"
        values = ["0.2 mm", "0.1 mm", "0.15 mm", "0.1 mm"]
        transient_revolutions = 0
        revolutions = 1
        phase = "90 deg"
        exponents = 0
        start = "continue"
        [study.vary]
        "initial.y" = { dist = "unif", low = "-0.03 mm", high = "0.03 mm" }
    )");
}

/// How many members were integrated for those asked for.
std::uint64_t integrated_for(Scene const& scene, MemberSet const& asked, MemberEnds ends = {}) {
    EnsemblePlan plan = ensemble_plan(scene, asked, *cpu_backend(Isa::scalar), 2);
    std::atomic<std::uint64_t> drawn{0}, emitted{0};
    plan.source = [&drawn, draw = plan.source](std::uint64_t member, Inputs& inputs) {
        ++drawn;
        return draw(member, inputs);
    };
    BlockKernel const kernel = cpu_backend(Isa::scalar)->kernel(scene.parts, false);
    StopRequest stop;
    continue_columns(scene, plan, asked, kernel, std::move(ends), stop);
    run_ensemble(
        plan, kernel, [&](BlockResult const& block) { emitted += block.members.size(); }, stop);
    EXPECT_EQ(emitted, asked.count());
    return drawn;
}

TEST(ContinuedSweepParts, IntegrateEachMemberOnce) {
    Scene const scene = sweep_scene();
    MemberSet const all({0, total});
    EXPECT_EQ(integrated_for(scene, all), total);
    for (std::uint64_t const parts : {2u, 3u, 7u}) {
        std::uint64_t integrated = 0;
        MemberSet together;
        for (std::uint64_t number = 1; number <= parts; ++number) {
            MemberSet const mine = members_of_part(scene, {number, parts, true}, all);
            EXPECT_FALSE(together.overlaps(mine));
            together.add(mine);
            if (!mine.empty()) integrated += integrated_for(scene, mine);
        }
        EXPECT_EQ(together, all);
        EXPECT_EQ(integrated, total) << parts;
    }
}

TEST(ContinuedSweepParts, TakeOfTheirStartsWhatIsAskedFor) {
    // Members 7 to 16: starts 2 to 4 of column 1, all of column 2, 0 and 1 of column 3.
    MemberSet const asked({7, 10});
    EXPECT_EQ(members_of_part(sweep_scene(), {1, 2, true}, asked).text(), "7,10-12,15-16");
    EXPECT_EQ(members_of_part(sweep_scene(), {2, 2, true}, asked).text(), "8-9,13-14");
}

TEST(ContinuedSweepParts, OfOtherSweepsAreConsecutiveMembers) {
    Scene scene = sweep_scene();
    scene.chaos.continued = false;
    EXPECT_EQ(members_of_part(scene, {2, 4, true}, MemberSet({0, total})), MemberSet({5, 5}));
}

TEST(ContinuedSweepResumed, RecallsOneEndOfEachStart) {
    Scene const scene = sweep_scene();
    // Columns 0 and 1 are done, of column 2 members 10 and 11.
    EXPECT_EQ(members_before(scene, MemberSet({12, 8})).text(), "7-11");
    EXPECT_EQ(members_before(scene, MemberSet({0, total})).text(), "");
    EXPECT_EQ(members_before(scene, MemberSet({0, 3})).text(), "");
    // A start whose second and fourth columns are left goes on twice.
    EXPECT_EQ(members_before(scene, MemberSet::of(std::vector<std::uint64_t>{6, 16})).text(), "1,11");
}

TEST(ContinuedSweepResumed, RunsNothingBeforeAnEndThatItRecalls) {
    Scene const scene = sweep_scene();
    MemberSet const last_column({3 * starts, starts});
    MemberSet const known = members_before(scene, last_column);
    MemberEnds const ends = [&](std::uint64_t member) -> std::optional<MemberEnd> {
        if (!known.contains(member)) return std::nullopt;
        return MemberEnd{true, {}};
    };
    EXPECT_EQ(integrated_for(scene, last_column, ends), starts);
    EXPECT_EQ(integrated_for(scene, last_column), total);
}

}  // namespace
}  // namespace slideway
