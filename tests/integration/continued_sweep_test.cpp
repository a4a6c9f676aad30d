// What a continued sweep runs, and what it leaves alone.
#include "host/study/continued_sweep.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "host/study/study_run.hpp"
#include "kernels/members/start.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::continued_sweep_test {
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

/// The starts of the members of the second column, whose kernel ends every member of the first in `end`.
std::vector<Inputs> second_column(Scene const& scene, StateNumbers const& end) {
    EnsemblePlan plan = ensemble_plan(scene, MemberSet({0, 2}), *cpu_backend(Isa::scalar), 1);
    std::vector<Inputs> starts;
    BlockKernel const kernel = [&](Block& block) {
        for (std::size_t i = 0; i < block.members; ++i) {
            starts.push_back(block.inputs[i]);
            block.records[i].status = Status::finished;
            auto const states = static_cast<std::size_t>(info(scene.parts.mechanism).states);
            std::copy_n(end.begin(), states, block.final_states + i * states);
        }
    };
    StopRequest stop;
    continue_columns(scene, plan, MemberSet({0, 2}), kernel, {}, stop);
    run_ensemble(
        plan, kernel, [](BlockResult const&) {}, stop);
    EXPECT_EQ(starts.size(), 2u);
    return starts;
}

std::string continued(std::string const& kind, std::string const& study) {
    return "schema = 1\n[mechanism]\nkind = \"" + kind +
           "\"\n[study]\nkind = \"sweep\"\nparameter = \"joint.clearance\"\nvalues = [1e-4, 2e-4]\n"
           "transient_revolutions = 0\nrevolutions = 1\nexponents = 0\nstart = \"continue\"\n" +
           study;
}

TEST(ContinuedSweepStarts, OfTheSliderShareTheClearance) {
    for (char const* const kind : {"slider_crank", "carriage"}) {
        auto const starts = second_column(testing::scene_of(continued(kind, "")), {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
        Inputs const& in = starts[1];
        EXPECT_EQ((std::vector{in.y, in.z, in.vy, in.vz, in.roll, in.yaw, in.pitch, in.wx, in.wy, in.wz}),
                  (std::vector<double>{2, 4, 6, 8, 10, 12, 14, 16, 18, 20}));
    }
}

TEST(ContinuedSweepStarts, OfTheSliderLieBetweenItsFacesAsTheyDid) {
    auto const second = [](std::string const& text) {
        Inputs const in = second_column(testing::scene_of(text), {1e-5, 3e-5, 2, 4, 5, 6, 7, 8, 9, 10})[1];
        return std::vector{in.y, in.z, in.vy, in.roll, in.pitch, in.wz};
    };
    std::string text = continued("slider_crank", "");
    auto const with = [&](std::string const& parameter) { return std::string(text).replace(text.find("joint.clearance"), 15, parameter); };
    auto const expect_near = [](std::vector<double> const& found, std::vector<double> const& right) {
        for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(found[i], right[i], 4e-15 * right[i]) << i;
    };
    expect_near(second(with("way.offset_y")), {1e-5 + 1e-4, 3e-5, 2, 5, 7, 10});
    expect_near(second(with("way.offset_z")), {1e-5, 3e-5 + 1e-4, 2, 5, 7, 10});
    expect_near(second(with("joint.slider_length")), {1e-5, 3e-5, 2, 2.5, 3.5, 5});  // twice as long: half as tilted
    text.replace(text.find("[1e-4, 2e-4]"), 12, "[4e-2, 2e-2]");
    expect_near(second(with("joint.slider_length")), {1e-5, 3e-5, 2, 5, 7, 10});
}

TEST(ContinuedSweepStarts, OfThePlanarMechanismFollowFromItsAngles) {
    // Half a turn after the phase nothing is left of the crank's height: y = L sin θ2.
    double const rod = 1e-4, rate = 0.5, pi = std::acos(-1.0);
    Scene const scene = testing::scene_of(continued("planar_slider_crank", "phase = \"180 deg\"\n"));
    auto const starts = second_column(scene, {pi, rod, 1e-3, scene.inputs.crank_speed, rate, 0.2});
    Inputs const& in = starts[1];
    EXPECT_NEAR(in.y, 2 * 0.1422 * std::sin(rod), 1e-16);
    EXPECT_NEAR(in.vy, 2 * (0.1422 * std::cos(rod) * rate - 0.05 * scene.inputs.crank_speed), 1e-15);
    EXPECT_DOUBLE_EQ(in.pitch, 2e-3);
    EXPECT_DOUBLE_EQ(in.wz, 0.4);
    EXPECT_DOUBLE_EQ(in.start_angle, pi);
    EXPECT_EQ(in.crank_speed, scene.inputs.crank_speed);
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
}  // namespace slideway::continued_sweep_test
