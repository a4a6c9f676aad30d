// Keys of the guide as it is made: clearances of single faces, and the slider's centre of mass and pin.
#include <gtest/gtest.h>

#include <string>

#include "host/config/scene.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::guide_test {
namespace {

Scene scene(std::string const& kind, std::string const& more, std::string const& law = "conservative") {
    std::string const contact = kind == "planar_slider_crank" ? "" : "[contact]\nlaw = \"" + law + "\"\nrestitution = 0.5\n";
    return parse_scene("schema = 1\n[mechanism]\nkind = \"" + kind + "\"\n" + contact + more, "scene.toml");
}
std::string error(std::string const& kind, std::string const& more, std::string const& law = "conservative") {
    try {
        scene(kind, more, law);
    } catch (SceneError const& e) {
        std::string const what = e.what();
        return what.substr(what.find(": ") + 2);
    }
    return "";
}

TEST(Guide, OfNoOffsetIsThatOfAnyScene) {
    EXPECT_FALSE(scene("carriage", "").parts.offset_slider);
    EXPECT_FALSE(scene("carriage", "[slider]\npin_x = 0\n").parts.offset_slider) << "the bits of a scene without it";
    EXPECT_TRUE(scene("carriage", "[slider]\npin_x = \"1 mm\"\n").parts.offset_slider);
    EXPECT_TRUE(scene("carriage", "[slider]\nmass_center_z = -1e-6\n").parts.offset_slider);
    EXPECT_TRUE(scene("carriage", "[study]\nmembers = 4\n[study.vary]\n\"slider.pin_y\" = { dist = \"unif\", low = -1e-3, high = 1e-3 }\n").parts.offset_slider);
}

TEST(Guide, ComesBackFromTheResolvedScene) {
    Scene const made = scene("slider_crank", "[joint]\nclearance = \"50 um\"\nclearance_y_plus = \"20 um\"\n[slider]\npin_y = \"4 mm\"\n", "rigid");
    EXPECT_TRUE(made.parts.misaligned_way);
    EXPECT_DOUBLE_EQ(made.inputs.clearance_y_plus, 20e-6);
    EXPECT_DOUBLE_EQ(mean_clearance_y(made.inputs), 35e-6);
    EXPECT_DOUBLE_EQ(mean_clearance_z(made.inputs), 50e-6);
    EXPECT_DOUBLE_EQ(to_middle_y(made.inputs), 15e-6);
    std::string const resolved = resolved_toml(made);
    EXPECT_NE(resolved.find("[slider]\n"), resolved.npos);
    EXPECT_NE(resolved.find("# clearance_y_minus  # derived: clearance_y\n"), resolved.npos) << resolved;
    Scene const again = parse_scene(resolved, "again.toml");
    EXPECT_EQ(again.parts, made.parts);
    EXPECT_EQ(resolved_toml(again), resolved);
    std::string const plain = resolved_toml(scene("slider_crank", ""));
    for (char const* const key : {"clearance_y_plus", "[slider]", "pin_x"}) EXPECT_EQ(plain.find(key), plain.npos) << key;
}

TEST(Guide, IsRefusedWhereItHasNoMeaning) {
    EXPECT_EQ(error("free_slider", "[slider]\npin_x = 1e-3\n"), "slider.pin_x has no meaning for kind = \"free_slider\"; remove it");
    EXPECT_EQ(error("planar_slider_crank", "[slider]\nmass_center_x = 1e-3\n"), "slider.mass_center_x has no meaning for kind = \"planar_slider_crank\"; remove it");
    EXPECT_EQ(error("carriage", "[joint]\nclearance_z_plus = -1\n"), "joint.clearance_z_plus is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm");
    EXPECT_EQ(error("free_slider", "[slider]\nmass_center_x = 1e-3\n", "rigid"), "");
    std::string const both = "[joint]\nclearance_y_plus = 1e-5\nclearance_y_minus = 2e-5\n";
    EXPECT_EQ(error("carriage", both + "[study]\nmembers = 4\n[study.vary]\n\"joint.clearance_y\" = { dist = \"unif\", low = 1e-5, high = 2e-5 }\n"),
              "study.vary.joint.clearance_y is a table (its faces have their own); vary those");
    EXPECT_EQ(error("carriage", both + "[study]\nmembers = 4\n[study.vary]\n\"joint.clearance_y_plus\" = { dist = \"unif\", low = 1e-5, high = 2e-5 }\n"), "");
    EXPECT_EQ(error("slider_crank", "[slider]\npin_y = \"95 mm\"\n").substr(0, 22), "mechanism.rod_length i");
}

TEST(Guide, SaysThatAClearanceOfBothFacesHasNoEffectBesideTheirOwn) {
    auto const warnings = scene("carriage", "[joint]\nclearance_y = 1e-4\nclearance_y_plus = 1e-5\nclearance_y_minus = 2e-5\n").warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "joint.clearance_y has no effect where all of its faces have their own");
    EXPECT_TRUE(parse_scene(resolved_toml(scene("carriage", "[joint]\nclearance_y_plus = 1e-5\nclearance_y_minus = 2e-5\n")), "again.toml").warnings.empty());
}

}  // namespace
}  // namespace slideway::guide_test
