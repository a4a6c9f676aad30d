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
        {whole("[load.push]\nforce_x = 1\n"), "[load] does not act on linkages yet"},
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

TEST(LinkageScenes, AreReadAgainFromTheirResolvedText) {
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
