// Masses and inertias that a scene does not give: of the solids that its sizes make, by mechanism, for each member; and what says that they are derived.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernels/members/complete_inputs.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::masses_test {
namespace {

using testing::contains;
using testing::scene_of;

std::string scene_with(std::string_view kind, std::string const& lines = "") {
    return fmt::format("schema = 1\n[study]\nduration = 1\n[mechanism]\nkind = \"{}\"\n{}\n", kind, lines);
}

Inputs member_of(std::string_view kind, std::string const& lines = "") { return member_inputs(scene_of(scene_with(kind, lines)), 0); }

constexpr char const* in_space[] = {"slider_crank", "carriage", "scotch_yoke", "free_slider"};

TEST(Masses, OfASliderInSpaceAreThoseOfTheBlockThatItsSizesMake) {
    for (char const* const kind : in_space) {
        // 7800 · 0.4 · 0.2 · 0.3 = 187.2, a thousand times the paper's; sums of squares 0.13, 0.25, 0.2 over 12.
        Inputs const large = member_of(kind, "[joint]\nslider_length = 0.4\nway_width = 0.2\nway_depth = 0.3");
        EXPECT_NEAR(large.slider_mass, 187.2, 1e-12) << kind;
        EXPECT_NEAR(large.slider_inertia_x, 187.2 * 0.13 / 12, 1e-14) << kind;
        EXPECT_NEAR(large.slider_inertia_y, 187.2 * 0.25 / 12, 1e-14) << kind;
        EXPECT_NEAR(large.slider_inertia_z, 187.2 * 0.20 / 12, 1e-14) << kind;
        // Each size counts by itself.
        EXPECT_NEAR(member_of(kind, "[joint]\nslider_length = 0.05").slider_mass, 0.234, 1e-15) << kind;   // 7800 · 0.05 · 0.02 · 0.03
        EXPECT_NEAR(member_of(kind, "[joint]\nway_width = 0.025").slider_mass, 0.234, 1e-15) << kind;      // 7800 · 0.04 · 0.025 · 0.03
        EXPECT_NEAR(member_of(kind, "[joint]\nway_depth = 0.04").slider_mass, 0.2496, 1e-15) << kind;      // 7800 · 0.04 · 0.02 · 0.04
        EXPECT_NEAR(member_of(kind, "[material]\ndensity = 2700").slider_mass, 0.0648, 1e-16) << kind;     // 2700 · 0.04 · 0.02 · 0.03
    }
}

TEST(Masses, OfAHollowSliderAreThoseOfItsWalls) {
    for (char const* const kind : in_space) {
        // Walls of 10 mm around 20 × 30 mm: 40 · 50 − 20 · 30 = 1,400 mm² of section, over 40 mm in steel.
        Inputs const in = member_of(kind, "[joint]\nwall = \"10 mm\"");
        EXPECT_NEAR(in.slider_mass, 7800 * 0.04 * 14e-4, 1e-15) << kind;
        // Outer block less hole, of masses 0.624 and 0.1872 kg.
        EXPECT_NEAR(in.slider_inertia_x, (0.624 * (16e-4 + 25e-4) - 0.1872 * (4e-4 + 9e-4)) / 12, 1e-18) << kind;
        EXPECT_NEAR(in.slider_inertia_y, (0.624 * (16e-4 + 25e-4) - 0.1872 * (16e-4 + 9e-4)) / 12, 1e-18) << kind;
        EXPECT_NEAR(in.slider_inertia_z, (0.624 * (16e-4 + 16e-4) - 0.1872 * (16e-4 + 4e-4)) / 12, 1e-18) << kind;
        // Its inertia goes with a mass that is given.
        EXPECT_NEAR(member_of(kind, "slider_mass = 0.8736\n[joint]\nwall = 0.01").slider_inertia_x, 2 * in.slider_inertia_x, 1e-18) << kind;
    }
}

TEST(Masses, OfThePlanarSliderAreThoseOfItsBlock) {
    // 7800 · 0.1 · 0.05 · 0.03 = 1.17 by default; 0.1² + 0.05² = 0.0125.
    Inputs const in = member_of("planar_slider_crank", "[joint]\nslider_length = 0.1\nslider_height = 0.05");
    EXPECT_NEAR(in.slider_mass, 1.17, 1e-14);
    EXPECT_NEAR(in.slider_inertia_z, 1.17 * 0.0125 / 12, 1e-16);
    EXPECT_NEAR(member_of("planar_slider_crank", "[joint]\nslider_depth = 0.06").slider_mass, 7800 * 0.04 * 0.02 * 0.06, 1e-15);
    EXPECT_NEAR(member_of("planar_slider_crank").slider_mass, 0.1872, 1e-15);
}

TEST(Masses, OfCrankAndRodAreThoseOfTheirSections) {
    for (char const* const kind : {"slider_crank", "planar_slider_crank"}) {
        Inputs const in = member_of(kind, "crank_length = 0.1\nrod_length = 0.4\ncrank_section = \"50 mm2\"\nrod_section = \"200 mm2\"\n[material]\ndensity = 2700");
        EXPECT_NEAR(in.crank_mass, 2700 * 50e-6 * 0.1, 1e-16) << kind;  // 13.5 g
        EXPECT_NEAR(in.rod_mass, 2700 * 200e-6 * 0.4, 1e-15) << kind;   // 216 g
        EXPECT_NEAR(in.rod_inertia, 0.216 * 0.16 / 12, 1e-16) << kind;
        EXPECT_NEAR(in.crank_inertia, 0.0135 * 0.01 / 12, 1e-18) << kind;
    }
}

TEST(Masses, FollowTheSizesThatEachMemberDraws) {
    Scene const scene = scene_of("schema = 1\n[study]\nmembers = 5\nseed = 3\n[study.vary]\n"
                                 "\"joint.slider_length\" = { dist = \"unif\", low = 0.03, high = 0.05 }\n"
                                 "\"material.density\" = { dist = \"unif\", low = 7000, high = 9000 }\n"
                                 "\"joint.wall\" = { dist = \"values\", values = [0, 0.01] }\n");
    bool solid = false, hollow = false;
    for (std::uint64_t member = 0; member < 5; ++member) {
        Inputs const in = member_inputs(scene, member);
        double const section = in.wall > 0 ? 0.04 * 0.05 - 0.02 * 0.03 : 0.02 * 0.03;
        EXPECT_NEAR(in.slider_mass, in.density * in.slider_length * section, 1e-15) << member;
        EXPECT_NE(in.density, 7800) << member;
        (in.wall > 0 ? hollow : solid) = true;
    }
    EXPECT_TRUE(solid && hollow) << "another seed";
}

TEST(Masses, AreMarkedAsDerivedInTheResolvedScene) {
    std::string const block = resolved_toml(scene_of(scene_with("slider_crank", "[joint]\nslider_length = 0.4\nway_width = 0.2\nway_depth = 0.3")));
    EXPECT_TRUE(contains(block, "# slider_mass = 187.2  # kg, derived: density x slider_length x way_width x way_depth\n")) << block;
    EXPECT_TRUE(contains(block, "kg, derived: density x rod_section x rod_length (14.2 x 7.1 mm, the paper's)\n")) << block;
    EXPECT_TRUE(contains(block, "kg, derived: density x crank_section x crank_length (5 x 2.5 mm, the paper's)\n")) << block;
    std::string const own = resolved_toml(scene_of(scene_with("slider_crank", "rod_section = \"2 cm2\"")));
    EXPECT_TRUE(contains(own, "kg, derived: density x rod_section x rod_length\n")) << own;
    EXPECT_TRUE(contains(block, "[material]\ndensity = 7800.0  # kg/m3\n")) << block;
    EXPECT_TRUE(contains(block, "# thickness_y = 0.2  # m, derived: way_width\n")) << block;
    std::string const hollow = resolved_toml(scene_of(scene_with("carriage", "[joint]\nwall = 0.005")));
    EXPECT_TRUE(contains(hollow, "kg, derived: density x slider_length x 2 wall x (way_width + way_depth + 2 wall)\n")) << hollow;
    std::string const planar = resolved_toml(scene_of(scene_with("planar_slider_crank")));
    EXPECT_TRUE(contains(planar, "kg, derived: density x slider_length x slider_height x slider_depth\n")) << planar;
    EXPECT_FALSE(contains(planar, "way_width")) << planar;
}

TEST(Masses, ThatAreDerivedAreSoAgainFromTheResolvedScene) {
    for (std::string const lines : {"[joint]\nwall = 0.003\n[material]\ndensity = 2700", "slider_mass = 0.5\n[joint]\nslider_length = 0.07", ""}) {
        Scene const scene = scene_of(scene_with("slider_crank", lines)), again = scene_of(resolved_toml(scene));
        EXPECT_EQ(resolved_toml(again), resolved_toml(scene));
        EXPECT_TRUE(again.warnings.empty());
        Inputs const a = member_inputs(scene, 0), b = member_inputs(again, 0);
        for (Key const& key : keys()) EXPECT_TRUE(key.get(a) == key.get(b) || std::isnan(key.get(a))) << key.name;
    }
}

TEST(Masses, AreListedWithWhatTheyAreDerivedFrom) {
    Scene const scene = scene_of(scene_with("scotch_yoke", "slider_mass = 0.5"));
    std::vector<std::string> names;
    for (DerivedNumber const& one : derived_numbers(scene)) {
        names.emplace_back(one.key->name);
        EXPECT_FALSE(one.words.empty()) << one.key->name;
        if (one.key->name == "mechanism.slider_inertia_x") {
            EXPECT_NEAR(one.value, 0.5 * 13e-4 / 12, 1e-18);
            EXPECT_EQ(one.words, "slider_mass x (way_width^2 + way_depth^2) / 12");
        }
    }
    EXPECT_EQ(names, (std::vector<std::string>{"mechanism.slider_inertia_x", "mechanism.slider_inertia_y", "mechanism.slider_inertia_z",
                                               "joint.thickness_y", "joint.thickness_z", "contact.point_stiffness"}));
}

constexpr char const* every_mass =
    "slider_mass = 0.2\nslider_inertia_x = 1e-5\nslider_inertia_y = 1e-5\nslider_inertia_z = 1e-5\ncrank_mass = 0.1\nrod_mass = 0.1\nrod_inertia = 1e-4\n";

TEST(Masses, ThatAreAllGivenMakeTheirSourcesIdle) {
    auto const warnings = [](std::string const& lines) { return scene_of(scene_with("slider_crank", lines)).warnings; };
    for (std::string const idle : {"[material]\ndensity = 2700", "[joint]\nwall = 0.01"}) {
        std::string const name = idle.starts_with("[joint]") ? "joint.wall" : "material.density";
        EXPECT_EQ(warnings(every_mass + idle),
                  (std::vector<std::string>{name + " has no effect, for all masses and inertias that would follow from it are given"}));
    }
    EXPECT_EQ(warnings("rod_mass = 0.1\nrod_section = 1e-4").size(), 1u);
    EXPECT_TRUE(warnings("rod_mass = 0.1\n[material]\ndensity = 2700").empty()) << "the slider's mass follows from it";
    EXPECT_TRUE(warnings("slider_mass = 0.2\n[joint]\nwall = 0.01").empty()) << "the slider's inertias follow from it";
    std::string const resolved = resolved_toml(scene_of(scene_with("slider_crank", every_mass)));
    EXPECT_FALSE(contains(resolved, "density") || contains(resolved, "section")) << resolved;
}

}  // namespace
}  // namespace slideway::masses_test
