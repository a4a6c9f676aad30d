// Scenes that describe linkages: what is refused, in which words, and what the rest of the host knows of them.
#include "host/config/linkages.hpp"

#include <string>

#include <gtest/gtest.h>

#include "host/config/descriptors.hpp"
#include "host/config/outputs.hpp"
#include "host/config/scene.hpp"
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
        {whole() + "[contact]\nlaw = \"rigid\"\n", "the contacts of a linkage give way"},
        {whole() + "[joint]\nclearance = 1e-4\n", "has no meaning for kind = \"linkage\""},
    };
    for (auto const& [text, part] : cases) EXPECT_TRUE(contains(error_of(text), part)) << part << "\n" << error_of(text);
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
    EXPECT_TRUE(contains(error_of(whole("[study.vary]\n\"link.wrist.offset_x\" = { dist = \"unif\", low = 0, high = 1e-5 }\n")), "offset_x"));
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
