// Scenes that describe linkages: what is refused, in which words, and what the rest of the host knows of them.
#include "host/config/linkages.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/config/descriptors.hpp"
#include "host/config/outputs.hpp"
#include "host/config/scene.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::linkage_scenes_test {
namespace {

using testing::contains, testing::error_of;

std::string crank() {
    return "schema = 1\n[mechanism]\nkind = \"linkage\"\ncrank_speed = 10\n[drive]\nbody = \"crank\"\n[body.crank]\nmass = 0.3\ninertia = 1e-4\n"
           "[link.shaft]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"crank\"\n";
}
std::string const rod = "[body.rod]\nmass = 0.2\ninertia = 2e-4\n", slider = "[body.slider]\nmass = 0.1\n";
std::string const pin = "[link.pin]\nkind = \"revolute\"\nfirst = \"crank\"\nfirst_x = 0.05\nsecond = \"rod\"\n";
std::string const way = "[link.way]\nkind = \"prismatic\"\nfirst = \"ground\"\nsecond = \"slider\"\nposition = 0.17\n", study = "[study]\nduration = 1\n";
std::string wrist(std::string const& more = "kind = \"journal\"\nclearance = 1e-4\nradius = 0.01\n") {
    return "[link.wrist]\nfirst = \"rod\"\nfirst_x = 0.12\nsecond = \"slider\"\n" + more;
}
std::string block(std::string const& more = {}) {
    return "[link.wrist]\nfirst = \"rod\"\nfirst_x = 0.12\nsecond = \"ground\"\nsecond_x = 0.17\nkind = \"block\"\nlength = 0.04\nheight = 0.02\nclearance = 1e-4\nstiffness = 1e9\n" + more;
}
/// Journals of crank and rod beside each other.
std::string journals(int count) {
    std::string text;
    for (int i = 0; i < count; ++i)
        text += fmt::format("[link.j{0}]\nkind = \"journal\"\nfirst = \"crank\"\nfirst_x = {1}\nsecond = \"rod\"\nsecond_x = {1}\nclearance = 1e-4\nradius = 0.01\n", i, 0.01 * i);
    return text;
}
/// A driven crank of 50 mm and two more carry a coupler by journals of 0.1 mm, at 0, 100 and 200 mm; the last post is elsewhere.
std::string parallelogram(double last_post) {
    std::string text = "schema = 1\n[mechanism]\nkind = \"linkage\"\ncrank_speed = 10\nstart_angle = 0.9\n[drive]\nbody = \"a\"\n[body.coupler]\nmass = 0.2\ninertia = 5e-4\ncenter_x = 0.1\n";
    for (int i = 0; i < 3; ++i) {
        text += fmt::format("[body.{0}]\nmass = 0.1\ninertia = 1e-5\n{1}[link.post_{0}]\nkind = \"revolute\"\nfirst = \"ground\"\nfirst_x = {2}\nsecond = \"{0}\"\n", "abd"[i],
                            i == 0 ? "" : "angle = 0.9\n", i == 2 ? last_post : 0.1 * i);
        text += fmt::format("[link.pin_{0}]\nkind = \"journal\"\nfirst = \"{0}\"\nfirst_x = 0.05\nsecond = \"coupler\"\nsecond_x = {1}\nclearance = 1e-4\nradius = 0.005\n", "abd"[i], 0.1 * i);
    }
    return text + study;
}
std::string whole(std::string const& more = {}) { return crank() + rod + slider + pin + wrist() + way + study + more; }

}  // namespace

TEST(LinkageScenes, NameWhatIsWrongWithThem) {
    EXPECT_EQ(error_of(whole()), "");
    struct { std::string text, part; } const cases[] = {
        {"schema = 1\n[mechanism]\nkind = \"linkage\"\n", "body.<name> is missing"},
        {crank() + rod + study, "body.rod is held by no link"},
        {crank() + rod + pin + "[link.other]\nkind = \"revolute\"\nfirst = \"rod\"\nsecond = \"rotor\"\n" + study, "link.other.second is \"rotor\" (there is no such body)"},
        {crank() + "[body.rod]\ninertia = 1e-4\n" + pin + study, "body.rod.mass is missing"},
        {crank() + "[body.rod]\nmass = 0\ninertia = 1e-4\n" + pin + study, "body.rod.mass"},
        {crank() + "[body.rod]\nmass = 0.1\n" + pin + study, "body.rod.inertia is missing"},
        {crank() + "[body.rod]\nmass = 0.1\nmas = 2\n" + pin + study, "did you mean \"mass\"?"},
        {whole("[ground_motion]\ntable = \"quake.csv\"\n"), "[ground_motion] does not act on linkages yet"},
        {crank() + rod + slider + pin + wrist("kind = \"journal\"\nradius = 0.01\n") + way + study, "link.wrist.clearance is missing"},
        {crank() + rod + slider + pin + wrist("kind = \"journal\"\nclearance = 0.02\nradius = 0.01\n") + way + study, "no journal is left in the bearing"},
        {crank() + rod + slider + pin + wrist("kind = \"hinge\"\n") + way + study, "kind"},
        {crank() + rod + slider + pin + wrist("kind = \"revolute\"\nclearance = 1e-4\n") + way + study, "a joint of this kind does not have it"},
        // The rod does not reach a slider whose line passes at 0.3 m.
        {crank() + rod + slider + pin + wrist("kind = \"revolute\"\n") + way + "first_y = 0.3\n" + study, "stays open by"},
        // Two pins hold what one does.
        {whole("[link.again]\nkind = \"revolute\"\nfirst = \"crank\"\nfirst_x = 0.05\nsecond = \"rod\"\n"), "holds what other joints hold already"},
        {"schema = 1\n[mechanism]\nkind = \"carriage\"\n" + rod + study, "[body] is of kind = \"linkage\""},
        {whole("[study.vary]\n\"link.wrist.offset_x\" = { dist = \"unif\", low = 0, high = 1e-5 }\n"), "link.wrist.offset_x is not given in [link.wrist] (a number must be given to vary); add offset_x = 0"},
        {whole("[study.vary]\n\"body.rot.mass\" = { dist = \"unif\", low = 1, high = 2 }\n"), "body.rot.mass is of no body of the scene (there is no [body.rot])"},
        {crank() + rod + journals(5) + block() + study, "with it journals touch in 5 places and blocks, with four corners each, in 4: 9 together, of 8"},
        {crank() + rod + pin + block("offset_y = 2e-4\n") + study, "offset_y is 0.0002 m (a corner of the block starts 0.0001 m inside its walls)"},
        {crank() + rod + pin + block("tilt = 0.02\n") + study, "tilt is 0.02 rad (a corner of the block starts 0.000298 m inside its walls)"},
        {crank() + rod + slider + pin + wrist("kind = \"journal\"\nclearance = 1e-4\nradius = 0.01\noffset_x = 3e-4\n") + way + study, "the journal starts 0.0002 m inside its bearing"},
        {parallelogram(0.20067), "beyond its clearance: lengths do not reach"},
        {whole() + "[contact]\nlaw = \"rigid\"\n", "the contacts of a linkage give way"},
        {whole() + "[joint]\nclearance = 1e-4\n", "has no meaning for kind = \"linkage\""},
    };
    for (auto const& [text, part] : cases) EXPECT_TRUE(contains(error_of(text), part)) << part << "\n" << error_of(text);
}

TEST(LinkageScenes, SayWhichBodiesHangOnNothing) {
    std::string const pair = "[body.a]\nmass = 1\ninertia = 1e-3\n[body.b]\nmass = 1\ninertia = 1e-3\n[link.ab]\nkind = \"revolute\"\nfirst = \"a\"\nsecond = \"b\"\n";
    auto const& warnings = testing::scene_of(crank() + pair + journals(0) + study).warnings;
    EXPECT_EQ(std::ranges::count_if(warnings, [](auto const& line) { return contains(line, "no joint leads from body.a, body.b to the ground, so that they fall freely"); }), 1);
    for (std::string const& line : testing::scene_of(whole()).warnings) EXPECT_FALSE(contains(line, "fall freely")) << line;
}

/// Three cranks where two would do: the last post may be off by d where the line through the errors (0, 0, d cos θ) that is nearest to all is within c of each,
/// d cos θ/4 < c, for what is across the cranks they follow.  Pins by trigonometry.
TEST(LinkageScenes, StartWithinClearancesWhereLengthsAskForIt) {
    for (double const off : {0.0, 1e-4, -4e-4, 6.2e-4}) {
        Scene const scene = testing::scene_of(parallelogram(0.2 + off));
        auto const state = start_of(scene.parts.mechanism, complete_inputs(scene.inputs, info(scene.parts.mechanism)));
        std::map<std::string, double> of;
        for (int i = 0; i < info(scene.parts.mechanism).states; ++i) of[state_info(info(scene.parts.mechanism), i).name] = state[static_cast<std::size_t>(i)];
        EXPECT_DOUBLE_EQ(of["a_angle"], 0.9);
        double widest = 0;
        for (int i = 0; i < 3; ++i) {
            double const angle = of[std::string(1, "abd"[i]) + "_angle"], along = 0.1 * i - 0.1, tilt = of["coupler_angle"];
            double const x = (i == 2 ? 0.2 + off : 0.1 * i) + 0.05 * std::cos(angle) - of["coupler_x"] - along * std::cos(tilt);
            double const y = 0.05 * std::sin(angle) - of["coupler_y"] - along * std::sin(tilt);
            widest = std::max(widest, std::hypot(x, y));
        }
        EXPECT_LE(widest, off == 0 ? 1e-9 : 1e-4 * (1 + 1e-9)) << off;
        // Rates follow: all cranks turn alike, the coupler not at all.
        EXPECT_NEAR(of["d_angular_velocity"], 10, 0.3) << off;
        EXPECT_NEAR(of["coupler_angular_velocity"], 0, 0.1) << off;
        EXPECT_GE(widest, 0.9 * std::abs(off) * std::cos(0.9) / 4) << off;
    }
}

TEST(LinkageScenes, HaveForcesOfTheirJointsAsQuantities) {
    Scene const scene = testing::scene_of(whole("quantities = [\"peak_force_wrist\", \"mean_force_wrist\"]\n"));
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    std::string names;
    for (OutputQuantity const& one : selected(outputs.quantities, scene.quantities)) names += std::string(one.name) + ' ';
    EXPECT_EQ(names, "peak_force_wrist mean_force_wrist ");
    EXPECT_EQ(kept_for(outputs, scene.quantities), selections::of({Quantity::peak_apex_force, Quantity::mean_apex_force}));
    EXPECT_TRUE(contains(error_of(whole("quantities = [\"peak_force_pin\"]\n")), "peak_force_pin"));
}

TEST(LinkageScenes, NameWhatIsWrongWithTheirLoads) {
    struct { std::string text, part; } const cases[] = {
        {"[load.a]\nforce_x = 1\n", "load.a.on is missing (which body it acts on); add on = \"crank\""},
        {"[load.a]\non = \"slide\"\nforce_x = 1\n", "load.a.on is \"slide\" (there is no such body); did you mean \"slider\"?"},
        {"[load.a]\non = \"ground\"\nforce_x = 1\n", "the ground stays where it is"},
        {"[load.a]\non = \"rod\"\nagainst = \"rod\"\nforce_x = 1\n", "it acts between two bodies"},
        {"[load.a]\non = \"rod\"\ntorque_z = 1\n", "load.a.torque_z is 1 (it is of loads on a slider); use torque"},
        {"[load.a]\non = \"rod\"\nforce_z = 1\n", "load.a.force_z has no meaning"},
        {"[load.a]\non = \"rod\"\nframe = \"slider\"\nforce_x = 1\n", "load.a.frame"},
        {"[load.a]\non = \"rod\"\n", "a load without a force or a torque does nothing"},
        {"[load.a]\non = \"rod\"\nforce_x = 1\ntable = \"t.csv\"\nover = \"x\"\ncolumn = \"f\"\n", "load.a.over is \"x\" (it is of a slider)"},
        {"[spring.a]\nstiffness = 1\nrest_length = 1\n", "spring.a.on is missing (which body or joint it acts on)"},
        {"[spring.a]\non = \"rod\"\n", "spring.a.stiffness is missing"},
        {"[spring.a]\non = \"rod\"\nstiffness = 1\n", "spring.a.rest_length is missing"},
        {"[spring.a]\non = \"rod\"\nangle = 1\n", "spring.a.angular_stiffness is missing"},
        {"[spring.a]\non = \"rod\"\nangular_stiffness = 1\n", "spring.a.angle is missing"},
        {"[spring.a]\non = \"rod\"\nangular_stiffness = 1\nangle = 1\nstiffness = 1\n", "spring.a.stiffness is 1 (spring.a.angular_stiffness makes it one of an angle)"},
        {"[spring.a]\non = \"rod\"\nalong = \"x\"\nstiffness = 1\nrest_length = 1\n", "spring.a.along has no meaning"},
        {"[spring.a]\nlink = \"wai\"\nstiffness = 1\nrest_length = 1\n", "spring.a.link is \"wai\" (there is no such joint); did you mean \"way\"?"},
        {"[spring.a]\nlink = \"way\"\non = \"rod\"\nstiffness = 1\nrest_length = 1\n", "spring.a.link says which bodies it is between"},
        {"[spring.a]\nlink = \"pin\"\nstiffness = 1\nrest_length = 1\n", "a pin has no displacement"},
        {"[spring.a]\nlink = \"way\"\nangular_stiffness = 1\nangle = 1\n", "it leads along a line"},
        {"[stop.a]\non = \"slider\"\nposition = 1\nblocks = \"+x\"\nstiffness = 1\n", "stop.a.link is missing"},
        {"[stop.a]\nlink = \"way\"\nposition = 1\nblocks = \"+angle\"\nstiffness = 1\n", "stop.a.blocks"},
        {"[stop.a]\nlink = \"way\"\nposition = 1\nstiffness = 1\n", "stop.a.blocks is missing"},
        {"[stop.a]\nlink = \"way\"\npoint_x = 1\nposition = 1\nblocks = \"+x\"\nstiffness = 1\n", "stop.a.point_x has no meaning"},
        {"[stop.a]\non = \"rod\"\nangle = 1\nblocks = \"+angle\"\n", "stop.a.angular_stiffness is missing"},
        {"[stop.a]\non = \"rod\"\nangle = 1\nblocks = \"+angle\"\nangular_stiffness = -1\n", "stop.a.angular_stiffness"},
        {"[spring.rod]\nlink = \"way\"\nstiffness = 1\nrest_length = 1\n[stop.rod]\nlink = \"way\"\nposition = 1\nblocks = \"+x\"\nstiffness = 1\n", "results would have two rod_force"},
    };
    for (auto const& [text, part] : cases) EXPECT_TRUE(contains(error_of(whole(text)), part)) << part << "\n" << error_of(whole(text));
    std::string many;
    for (char const name : {'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h', 'i'}) many += std::string("[load.") + name + "]\non = \"rod\"\ntorque = 1\n";
    EXPECT_TRUE(contains(error_of(whole(many)), "load.i is one of too many (a linkage has 8 loads, springs and stops at most together)")) << error_of(whole(many));
}

TEST(LinkageScenes, AreReadAgainFromTheirResolvedText) {
    Scene const loaded = testing::scene_of(whole("[load.push]\non = \"rod\"\nagainst = \"crank\"\nforce_x = 1\nframe = \"body\"\n[spring.back]\nlink = \"way\"\nstiffness = 2\nrest_length = 0.1\n"
                                                 "[stop.end]\nlink = \"pin\"\nangle = 1\nblocks = \"-angle\"\nangular_stiffness = 3\n"));
    EXPECT_EQ(resolved_toml(testing::scene_of(resolved_toml(loaded))), resolved_toml(loaded));
    ASSERT_EQ(loaded.parts.loads.count, 3);
    Load const &push = loaded.parts.loads.loads[0], &stop = loaded.parts.loads.loads[2];
    LinkagePlan const& plan = *loaded.parts.linkage;
    auto const& bodies = linkage_of(loaded.parts.mechanism)->bodies;
    EXPECT_EQ(bodies[static_cast<std::size_t>(push.body[0])], "rod");
    EXPECT_EQ(bodies[static_cast<std::size_t>(push.body[1])], "crank");
    EXPECT_TRUE(push.turns_with_slider);
    EXPECT_EQ(plan.body[plan.owner[loaded.parts.loads.loads[1].coordinate]].joint, TreeJoint::prismatic);
    EXPECT_TRUE(stop.turns);
    EXPECT_EQ(stop.side, -1);
    EXPECT_EQ(bodies[static_cast<std::size_t>(stop.body[0])], "rod");
    // Columns of loads are of the linkage.
    EXPECT_NE(loaded.parts.mechanism, testing::scene_of(whole()).parts.mechanism);

    Scene const scene = testing::scene_of(whole());
    std::string const text = resolved_toml(scene);
    Scene const again = testing::scene_of(text);
    EXPECT_EQ(resolved_toml(again), text);
    // The same linkage, whatever its numbers.
    EXPECT_EQ(again.parts.mechanism, scene.parts.mechanism);
    EXPECT_EQ(testing::scene_of(whole(), {{"body.rod.mass", "0.25"}}).parts.mechanism, scene.parts.mechanism);
    EXPECT_NE(testing::scene_of(crank() + study).parts.mechanism, scene.parts.mechanism);
}

TEST(LinkageScenes, HaveKeysThatVary) {
    Scene const scene = testing::scene_of(whole() + "members = 4\n[study.vary]\n\"link.wrist.clearance\" = { dist = \"unif\", low = 1e-4, high = 2e-4 }\n\"body.rod.mass\" = { dist = \"unif\", low = 0.2, high = 0.3 }\n");
    double last = 0;
    for (std::uint64_t member = 0; member < 4; ++member) {
        double const clearance = find_key("link.wrist.clearance", scene)->get(member_inputs(scene, member));
        EXPECT_GE(clearance, 1e-4);
        EXPECT_LE(clearance, 2e-4);
        EXPECT_NE(clearance, last);
        last = clearance;
    }
}

TEST(LinkageScenes, CallColumnsAfterBodiesAndLinks) {
    Scene const scene = testing::scene_of(whole());
    MechanismInfo const& info = slideway::info(scene.parts.mechanism);
    ASSERT_EQ(info.states, 6);
    EXPECT_STREQ(state_info(info, 0).name, "crank_angle");
    EXPECT_STREQ(state_info(info, 1).name, "crank_angular_velocity");
    std::string names;
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    for (SeriesInfo const& series : selected(outputs.series, outputs.has_series)) names += std::string(series.name) + ' ';
    for (char const* const name : {"slider_displacement", "rod_angle", "wrist_x", "wrist_y", "wrist_force", "drive_torque"}) EXPECT_TRUE(contains(names, name)) << name;
    // A link and a body of one name would share a column.
    EXPECT_TRUE(contains(error_of(crank() + "[body.wrist]\nmass = 0.2\ninertia = 2e-4\n" + slider + "[link.pin]\nkind = \"journal\"\nfirst = \"crank\"\nsecond = \"wrist\"\nclearance = 1e-4\nradius = 0.01\n" +
                                  "[link.wrist]\nkind = \"journal\"\nfirst = \"wrist\"\nfirst_x = 0.12\nsecond = \"slider\"\nclearance = 1e-4\nradius = 0.01\n" + way + study),
                         "results would have two wrist_x"));
}

}  // namespace slideway::linkage_scenes_test
