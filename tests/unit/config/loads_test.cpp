// [load.<name>]: what a scene may say of loads, and what it is told where it errs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "host/config/loads.hpp"
#include "kernels/loads/table_value.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::scene_loads_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;

class SceneLoadFiles : public ::testing::Test {
protected:
    std::filesystem::path const folder_ = std::filesystem::temp_directory_path() / ("slideway_loads_" + std::to_string(getpid()));

    SceneLoadFiles() { std::filesystem::create_directories(folder_); }
    ~SceneLoadFiles() override { std::filesystem::remove_all(folder_); }

    std::string file(std::string const& text) const {
        auto const path = folder_ / "p.csv";
        std::ofstream(path) << text;
        return path.string();
    }
    std::string scene(std::string const& csv, std::string const& more = "over = \"crank_angle\"\ncolumn = \"pressure\"\nscale = 3e-4\n") const {
        return "schema = 1\n[load.gas]\nforce_x = -1\ntable = \"" + file(csv) + "\"\n" + more;
    }
};

/// By one line that has these words.
void expect_refused(std::string const& scene, std::string_view words) {
    std::string const error = error_of(scene);
    EXPECT_TRUE(contains(error, words)) << scene << "\n" << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

/// Of a load of a scene, by the name of its number.
double number(Scene const& scene, std::size_t row, std::string_view name) {
    Load load = scene.loads->load(row);
    for (LoadNumber const& one : load_numbers()) {
        if (one.kind == load.kind && one.name == name) return scene.inputs.*load_inputs[one.place(load)];
    }
    return std::nan("");
}

TEST(SceneLoads, AreForcesWithUnitsOnSliderAndCrank) {
    Scene const scene = scene_of(R"(schema = 1
[load.cutting]
force_x = "-1.5 kN"
point_y = "3 mm"
frame = "slider"
[load.brake]
on = "crank"
torque = "-20 N mm"
)");
    ASSERT_EQ(scene.parts.loads.count, 2);
    EXPECT_EQ(number(scene, 0, "force_x"), -1500);
    EXPECT_EQ(number(scene, 0, "point_y"), 3e-3);
    EXPECT_NEAR(number(scene, 1, "torque"), -0.02, 1e-17);
    EXPECT_TRUE(scene.parts.loads.loads[0].turns_with_slider);
    EXPECT_EQ(scene.parts.loads.loads[0].force[1], Load::none);
    EXPECT_EQ(scene.parts.loads.loads[1].force[0], Load::none);
}

TEST(SceneLoads, VaryAndAreSetLikeOtherNumbers) {
    Scene const scene = scene_of("schema = 1\n[load.gas]\nforce_x = 3\n[study]\nmembers = 50\n[study.vary]\n\"load.gas.force_x\" = { dist = \"unif\", low = 1, high = 2 }\n",
                                 {{"load.gas.scale", "0.5"}});
    EXPECT_EQ(number(scene, 0, "scale"), 0.5);
    Load load = scene.loads->load(0);
    double least = 9, most = 0;
    for (std::uint64_t m = 0; m < 50; ++m) {
        double const force = member_inputs(scene, m).*load_inputs[load.force[0]];
        least = std::min(least, force), most = std::max(most, force);
    }
    EXPECT_GE(least, 1);
    EXPECT_LE(most, 2);
    EXPECT_GT(most - least, 0.5);
}

TEST_F(SceneLoadFiles, ReadATableInItsUnits) {
    Scene const scene = scene_of(this->scene("crank_angle [deg], other, pressure [bar]\n0, 9, 1\n90, 9, 5\n180, 9, 2\n360, 9, 1\n"));
    auto const table = scene.parts.loads.loads[0].table;
    EXPECT_TRUE(table.repeats);
    EXPECT_NEAR(table.high, 2 * std::numbers::pi, 1e-15);
    EXPECT_NEAR(table_point(table, std::numbers::pi / 2).value, 5e5, 1e-9);
    EXPECT_NEAR(table_point(table, std::numbers::pi * 5).value, 2e5, 1e-8);
    EXPECT_EQ(number(scene, 0, "scale"), 3e-4);
}

TEST_F(SceneLoadFiles, AreReadAgainFromTheResolvedScene) {
    std::string const text = scene("crank_angle [deg], pressure\n0, 1\n120, 5\n360, 1\n") + "[load.pull]\nforce_y = 2\nframe = \"slider\"\n[friction]\n";
    std::string const resolved = resolved_toml(scene_of(text));
    Scene const again = scene_of(resolved);
    EXPECT_EQ(resolved_toml(again), resolved);
    EXPECT_EQ(number(again, 0, "force_x"), -1);
    EXPECT_NEAR(table_point(again.parts.loads.loads[0].table, 2 * std::numbers::pi / 3).value, 5, 1e-12);
    EXPECT_EQ(again.loads->rows()[1].name, "load.pull");
    // Another table is another scene.
    file("crank_angle [deg], pressure\n0, 1\n120, 5.0001\n360, 1\n");
    EXPECT_NE(resolved_toml(scene_of(text)), resolved);
}

TEST(SceneLoads, ErrorsAreOneLine) {
    struct Bad { char const *text, *words; };
    for (Bad const& bad : {
             Bad{"[load.gas]\n", "scene.toml:2: load.gas.force_x is missing"},
             Bad{"[load]\ngas = 3\n", "load.gas is 3 (a load is a table)"},
             Bad{"[load.Gas]\nforce_x = 1\n", "is no name of a load"},
             Bad{"[load.gas]\nforce = 1\n", "load.gas.force is no key of a load"},
             Bad{"[load.gas]\nforce_x = \"3 mm\"\n", "load.gas.force_x is \"3 mm\""},
             Bad{"[load.gas]\ntorque = 1\n", "it is of loads on the crank"},
             Bad{"[load.gas]\non = \"crank\"\nforce_x = 1\n", "it is of loads on the slider"},
             Bad{"[load.gas]\nforce_x = 1\nscale = nan\n", "load.gas.scale is nan"},
             Bad{"[load.gas]\nforce_x = 1\nover = \"x\"\n", "it is of a table, and there is none"},
             Bad{"[load.gas]\nforce_x = 1\ntable = \"nowhere.csv\"\nover = \"x\"\ncolumn = \"f\"\n", "nowhere.csv cannot be read"},
             Bad{"[load.gas]\nforce_x = 1\ntable = \"nowhere.csv\"\nover = \"x\"\n", "load.gas.column is missing"},
             Bad{"[mechanism]\nkind = \"carriage\"\n[load.gas]\non = \"crank\"\ntorque = 1\n", "a carriage has no crank"},
             Bad{"[mechanism]\nkind = \"planar_slider_crank\"\n[load.gas]\nforce_z = 1\n", "load.gas.force_z has no meaning"},
             Bad{"[load.a]\nforce_x=1\nforce_y=1\nforce_z=1\ntorque_x=1\ntorque_y=1\ntorque_z=1\npoint_x=0\npoint_y=0\npoint_z=0\n"
                 "[load.b]\nforce_x=1\nforce_y=1\nforce_z=1\ntorque_x=1\ntorque_y=1\ntorque_z=1\npoint_x=0\npoint_y=0\npoint_z=0\n"
                 "[load.c]\nforce_x=1\nforce_y=1\nforce_z=1\ntorque_x=1\ntorque_y=1\ntorque_z=1\npoint_x=0\npoint_y=0\npoint_z=0\n", "have 26 numbers at most together"},
             Bad{"[load.gas]\nforce_x = 1\nagainst = \"rod\"\n", "load.gas.against has no meaning"},
             Bad{"[load.gas]\nforce_x = 1\nframe = \"body\"\n", "load.gas.frame"},
             Bad{"[spring.s]\non = \"slider\"\nanchor_x = 1\nstiffness = 1\nrest_length = 1\n", "spring.s.on has no meaning"},
             Bad{"[stop.s]\nangle = 1\nposition = 1\nblocks = \"+x\"\nstiffness = 1\n", "stop.s.angle has no meaning"},
             Bad{"[stop.s]\nposition = 1\nblocks = \"+angle\"\nstiffness = 1\n", "stop.s.blocks"},
         }) {
        expect_refused(std::string("schema = 1\n") + bad.text, bad.words);
    }
}

TEST(SceneLoads, SpringsAndStopsAreNumbersToo) {
    std::string const text = R"(schema = 1
[mechanism]
kind = "free_slider"
[spring.return]
along = "x"
anchor_x = "-80 mm"
stiffness = "2 N/mm"
rest_length = "80 mm"
[spring.side]
anchor_y = 0.1
point_x = "10 mm"
preload = 3
[stop.front]
blocks = "-x"
position = "50 mm"
stiffness = 1e5
dissipation = 0.5
[study]
members = 3
[study.vary]
"spring.return.stiffness" = { dist = "unif", low = 1000, high = 3000 }
)";
    Scene const scene = scene_of(text, {{"stop.front.damping", "\"3 N s/mm\""}});
    ASSERT_EQ(scene.parts.loads.count, 3);
    EXPECT_EQ(number(scene, 0, "anchor_x"), -0.08);
    EXPECT_EQ(number(scene, 0, "stiffness"), 2000);
    EXPECT_EQ(number(scene, 1, "preload"), 3);
    EXPECT_EQ(number(scene, 2, "damping"), 3000);
    Load const* const loads = scene.parts.loads.loads;
    EXPECT_TRUE(loads[0].kind == LoadKind::spring && loads[0].along);
    EXPECT_TRUE(loads[1].kind == LoadKind::spring && !loads[1].along);
    EXPECT_TRUE(loads[2].kind == LoadKind::stop && loads[2].side == -1);
    EXPECT_EQ(resolved_toml(scene_of(resolved_toml(scene))), resolved_toml(scene));
    // A third of the time on the stop.
    EXPECT_LE(scene.integrator.max_step, std::sqrt(complete_inputs(scene.inputs).slider_mass / 1e5));
    EXPECT_GT(scene_of(text, {{"stop.front.stiffness", "1"}}).integrator.max_step, 5e-4);
    EXPECT_LT(scene_of(text, {{"stop.front.stiffness", "1e9"}}).integrator.max_step, 2e-5);
}

TEST(SceneLoads, AFilmHasThreeNumbers) {
    std::string const text = R"(schema = 1
[film]
viscosity = "60 mPa s"
least_gap = "1 um"
[study]
members = 3
[study.vary]
"film.viscosity" = { dist = "unif", low = 0.04, high = 0.08 }
)";
    Scene const scene = scene_of(text, {{"film.cavitation_pressure", "\"1 bar\""}});
    ASSERT_EQ(scene.parts.loads.count, 1);
    EXPECT_EQ(scene.parts.loads.find(LoadKind::film), scene.parts.loads.loads);
    EXPECT_NEAR(number(scene, 0, "viscosity"), 0.06, 1e-17);
    EXPECT_NEAR(number(scene, 0, "least_gap"), 1e-6, 1e-21);
    EXPECT_EQ(number(scene, 0, "cavitation_pressure"), 1e5);
    EXPECT_EQ(resolved_toml(scene_of(resolved_toml(scene))), resolved_toml(scene));
    EXPECT_EQ(scene_of(text).parts.loads.find(LoadKind::film)->cavitation_pressure, Load::none);
    EXPECT_EQ(scene_of("schema = 1\n[load.gas]\nforce_x = 1\n").parts.loads.find(LoadKind::film), nullptr);
}

TEST_F(SceneLoadFiles, OfTheGroundsMotionHaveUpToThreeColumns) {
    auto const ground = [&](std::string const& csv, std::string const& more = "") {
        return "schema = 1\n[ground_motion]\ntable = \"" + file(csv) + "\"\n" + more;
    };
    std::string const three = "time [ms], az [cm/s2], ax\n0, 100, 0\n10, 0, 3\n20, 100, 0\n";
    Scene const scene = scene_of(ground(three, "scale_z = 2\nrepeats = true\ninterpolation = \"linear\"\n"));
    ASSERT_EQ(scene.parts.loads.count, 2);
    EXPECT_EQ(number(scene, 0, "scale_x"), 1);
    EXPECT_EQ(number(scene, 1, "scale_z"), 2);
    EXPECT_NEAR(table_point(scene.parts.loads.loads[0].table, 0.035).value, 1.5, 1e-12);
    EXPECT_NEAR(table_point(scene.parts.loads.loads[1].table, 0.005).value, 0.5, 1e-12);
    EXPECT_EQ(resolved_toml(scene_of(resolved_toml(scene))), resolved_toml(scene));
    EXPECT_EQ(number(scene_of(ground(three), {{"ground_motion.scale_x", "7"}}), 0, "scale_x"), 7);
    // In a plane az does not count.
    EXPECT_EQ(scene_of(ground(three) + "[mechanism]\nkind = \"planar_slider_crank\"\n").parts.loads.count, 1);
    struct Bad { std::string csv, more; char const* words; };
    for (Bad const& bad : {
             Bad{three, "scale_y = 1\n", "the table has no column ay"},
             Bad{three, "gain = 1\n", "ground_motion.gain is no key"},
             Bad{"time, a\n0, 1\n1, 1\n", "", "the table has no column of an acceleration"},
             Bad{"t, ax\n0, 1\n1, 1\n", "", "the table has no column time"},
             Bad{"time, ax [m]\n0, 1\n1, 1\n", "", "its unit is none of m/s2"},
             Bad{"time, ax\n0, 1\n0, 1\n", "", "the place stands twice"},
             Bad{"time, ax\n0, 1\n1, 2\n", "repeats = true\n", "the period does not close"},
         }) expect_refused(ground(bad.csv, bad.more), bad.words);
    expect_refused("schema = 1\n[ground_motion]\n", "ground_motion.table is missing");
}

TEST_F(SceneLoadFiles, OfAWaysProfileAreDepthsOfFaces) {
    auto const worn = [&](std::string const& csv, std::string const& more = "") {
        return "schema = 1\n[way_profile.wear]\ntable = \"" + file(csv) + "\"\ncolumn = \"depth\"\n" + more;
    };
    std::string const hollow = "x [mm], depth [um]\n0, 0\n50, 20\n100, 0\n";
    Scene const scene = scene_of(worn(hollow, "faces = \"z\"\nscale = 2\nrepeats = true\ninterpolation = \"monotone\"\n[way_ends]\nto = \"30 cm\"\n"));
    ASSERT_EQ(scene.parts.loads.count, 2);
    Load const& profile = scene.parts.loads.loads[0];
    EXPECT_EQ(profile.kind, LoadKind::way_profile);
    EXPECT_EQ(profile.faces, 12);
    EXPECT_EQ(number(scene, 0, "scale"), 2);
    EXPECT_NEAR(table_point(profile.table, 0.15).value, 2e-5, 1e-18);
    EXPECT_EQ(scene.parts.loads.loads[1].kind, LoadKind::way_ends);
    EXPECT_EQ(number(scene, 1, "to"), 0.3);
    EXPECT_EQ(scene.parts.loads.loads[1].from, Load::none);
    EXPECT_EQ(resolved_toml(scene_of(resolved_toml(scene))), resolved_toml(scene));
    EXPECT_EQ(number(scene_of(worn(hollow, "scale = 1\n"), {{"way_profile.wear.scale", "7"}}), 0, "scale"), 7);
    EXPECT_EQ(scene_of(worn(hollow)).parts.loads.loads[0].faces, 15);
    struct Bad { std::string csv, more; char const* words; };
    for (Bad const& bad : {
             Bad{hollow, "faces = \"x\"\n", "way_profile.wear.faces is \"x\""},
             Bad{hollow, "interpolation = \"linear\"\n", "way_profile.wear.interpolation is \"linear\""},
             Bad{hollow, "over = \"time\"\n", "way_profile.wear.over is no key of a profile of the way"},
             Bad{hollow, "scale = -1\n", "way_profile.wear.scale is -1"},
             Bad{hollow, "scale = 100\n", "its faces then have a slope of"},
             Bad{"x, depth\n0, 0\n0.05, 20\n0.1, 0\n", "", "its faces then have a slope of"},
             Bad{"x, depth [um]\n0, 0\n0.05, -1\n0.1, 0\n", "", "p.csv:3: depth is -1e-06 m (a profile lies back"},
             Bad{"x, depth [um]\n0, 0\n0.06, 0\n0.1, 0\n0.14, 300\n0.2, 300\n", "", "m between its rows (a profile lies back"},
             Bad{"x, depth [kg]\n0, 0\n1, 1\n", "", "its unit is none of m"},
             Bad{"time, depth\n0, 0\n1, 1\n", "", "the table has no column x"},
             Bad{"x, wear\n0, 0\n1, 1\n", "", "the table has no column depth"},
             Bad{"x, depth\n0, 0\n1, 1e-3\n", "repeats = true\n", "the period does not close"},
             Bad{hollow, "[mechanism]\nkind = \"planar_slider_crank\"\n", "way_profile"},
             Bad{hollow, "[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n", "rigid contacts are with straight faces"},
         }) {
        SCOPED_TRACE(bad.csv + bad.more);
        expect_refused(worn(bad.csv, bad.more), bad.words);
    }
    expect_refused("schema = 1\n[way_profile.wear]\nfaces = \"y\"\n", "way_profile.wear.table is missing");
    expect_refused("schema = 1\n[way_profile.wear]\ntable = \"p.csv\"\n", "way_profile.wear.column is missing");
    expect_refused("schema = 1\n[way_ends]\n", "way_ends.to is missing");
    expect_refused("schema = 1\n[way_ends]\nfrom = 0.2\nto = 0.2\n", "way_ends.to is 0.2 m (the way ends where it begins");
    expect_refused("schema = 1\n[way_ends]\nto = 0.3\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n", "a way without ends");
    // Slopes of profiles of the same faces add up.
    auto const two = [&](std::string const& faces) {
        return worn(hollow, "scale = 60\nfaces = \"y\"\n[way_profile.more]\ntable = \"" + file(hollow) + "\"\ncolumn = \"depth\"\nscale = 60\nfaces = \"" + faces + "\"\n");
    };
    EXPECT_EQ(scene_of(two("z")).parts.loads.count, 2);
    expect_refused(two("all"), "way_profile.more.scale is 60 (its faces then have a slope of 0.0");
    // Drawn numbers keep their rules, too.
    Inputs drawn = scene.inputs;
    drawn.*load_inputs[profile.scale] = -1;
    EXPECT_TRUE(contains(defect(drawn, scene.parts).value_or(""), "way_profile.wear.scale is -1"));
    drawn.*load_inputs[profile.scale] = 1e4;
    EXPECT_TRUE(contains(defect(drawn, scene.parts).value_or(""), "way_profile.wear.scale is 10000 (its faces then have a slope of"));
    expect_refused("schema = 1\n[way_ends]\nto = 0.3\n[film]\nviscosity = 0.1\nleast_gap = 1e-6\n", "between straight faces without ends");
    expect_refused("schema = 1\n[way_ends]\nto = 0.3\n[mechanism]\nkind = \"planar_slider_crank\"\n", "way_ends");
}

TEST_F(SceneLoadFiles, AreFoundFromAFolderThatIsALink) {
    auto const deep = folder_ / "a" / "b", link = folder_ / "link";
    std::filesystem::create_directories(deep);
    std::filesystem::create_directory_symlink(deep, link);
    std::ofstream(folder_ / "a" / "p.csv") << "crank_angle [deg], pressure\n0, 1\n180, 3\n360, 1\n";
    std::ofstream(deep / "scene.toml") << "schema = 1\n[load.gas]\nforce_x = -1\ntable = \"../p.csv\"\nover = \"crank_angle\"\ncolumn = \"pressure\"\n";
    Scene const through = read_scene((link / "scene.toml").string()), straight = read_scene((deep / "scene.toml").string());
    EXPECT_EQ(through.tables.at(0).path, straight.tables.at(0).path);
    EXPECT_EQ(through.tables.at(0).checksum, straight.tables.at(0).checksum);
}

TEST(SceneLoads, ElementsThatCannotBeAreOneLine) {
    struct Bad { char const *text, *words; };
    for (Bad const& bad : {
             Bad{"[spring.a]\nstiffness = 3\n", "spring.a.anchor_x is missing"},
             Bad{"[spring.a]\nanchor_x = 3\n", "spring.a.stiffness is missing"},
             Bad{"[spring.a]\nanchor_x = 3\nstiffness = 2\n", "spring.a.rest_length is missing"},
             Bad{"[spring.a]\nanchor_x = 3\nalong = \"x\"\nstiffness = -2\n", "scene.toml:5: spring.a.stiffness is -2"},
             Bad{"[spring.a]\nanchor_y = 3\nalong = \"x\"\nstiffness = 2\n", "spring.a.anchor_y is 3 (a spring along x"},
             Bad{"[spring.a]\nanchor_x = 3\nalong = \"y\"\n", "spring.a.along is \"y\""},
             Bad{"[spring.a]\nforce_x = 3\n", "spring.a.force_x is no key of a spring"},
             Bad{"[spring.A]\nanchor_x = 3\n", "is no name of a spring"},
             Bad{"[spring]\na = 3\n", "spring.a is 3 (a spring is a table)"},
             Bad{"[mechanism]\nkind = \"planar_slider_crank\"\n[spring.a]\nanchor_z = 3\n", "spring.a.anchor_z has no meaning"},
             Bad{"[stop.a]\nposition = 3\n", "stop.a.blocks is missing"},
             Bad{"[stop.a]\nblocks = \"+x\"\n", "stop.a.position is missing"},
             Bad{"[stop.a]\nblocks = \"+x\"\nposition = 1\n", "stop.a.stiffness is missing"},
             Bad{"[stop.a]\nblocks = \"+x\"\nposition = 1\nstiffness = 0\n", "stop.a.stiffness is 0"},
             Bad{"[stop.a]\nblocks = \"up\"\nposition = 1\nstiffness = 1\n", "stop.a.blocks is \"up\""},
             Bad{"[stop.a]\nblocks = \"+x\"\nposition = 1\nstiffness = 1\ndissipation = -1\n", "stop.a.dissipation is -1"},
             Bad{"[mechanism]\nkind = \"planar_slider_crank\"\ncross_inclination = 1\n", "mechanism.cross_inclination has no meaning"},
             Bad{"[film]\n", "film.viscosity is missing (how strongly the film damps); add viscosity = \"0.1 Pa s\""},
             Bad{"[film]\nviscosity = 1\n", "film.least_gap is missing"},
             Bad{"[film]\nviscosity = 0\nleast_gap = 1e-6\n", "film.viscosity is 0"},
             Bad{"[film]\nviscosity = 1\nleast_gap = 0\n", "film.least_gap is 0"},
             Bad{"[film]\nviscosity = \"1 cSt\"\nleast_gap = 1e-6\n", "film.viscosity is \"1 cSt\""},
             Bad{"[film]\nviscosity = 1\nleast_gap = 1e-6\ncavitation_pressure = -1\n", "film.cavitation_pressure is -1"},
             Bad{"[film]\nviscosity = 1\nleast_gap = 1e-6\ngap = 1\n", "film.gap is no key"},
             Bad{"film = 3\n", "it must be a table"},
             Bad{"[film]\nviscosity = 1\nleast_gap = 1e-6\n[mechanism]\nkind = \"planar_slider_crank\"\n", "scene.toml:2: film has no meaning"},
             Bad{"[film]\nviscosity = 1\nleast_gap = 1e-6\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n", "the equations of rigid contacts know no film"},
         }) {
        expect_refused(std::string("schema = 1\n") + bad.text, bad.words);
    }
}

TEST_F(SceneLoadFiles, BadTablesAreOneLine) {
    struct Bad { char const *csv, *words; };
    for (Bad const& bad : {
             Bad{"", "the table is empty"},
             Bad{"crank_angle [deg], pressure\n", "the table is too short"},
             Bad{"crank_angle [deg], pressure\n0, 1\n", "p.csv:2: the table is too short"},
             Bad{"crank_angle [deg], pressure\n0, 1\n200, 3\n100, 2\n360, 1\n", "p.csv:4: crank_angle (the places do not rise)"},
             Bad{"crank_angle [deg], pressure\n0, 1\n100, 3\n100, 2\n360, 1\n", "p.csv:4: crank_angle (the place stands twice)"},
             Bad{"crank_angle [deg], pressure\n0, 1\n100, \n360, 1\n", "p.csv:3"},
             Bad{"crank_angle [deg], pressure\n0, 1\n100, nan\n360, 1\n", "p.csv:3"},
             Bad{"crank_angle [deg], pressure\n0, 1\n100, 3\n360, 1.5\n", "the period does not close"},
             Bad{"crank_angle [deg], pressure\n0, 1\n100, 3\n350, 1\n", "a period is of whole turns"},
             Bad{"crank_angle [deg], pressure\n0, 1\n1e-320, 3\n360, 1\n", "it has no finite slope"},
             Bad{"crank_angle [deg], pressure, pressure\n0, 1, 2\n360, 1, 2\n", "the table has several columns pressure"},
             Bad{"crank_angle [mm], pressure\n0, 1\n360, 1\n", "its unit is none of rad"},
             Bad{"crank_angle [deg], pressure [kg]\n0, 1\n360, 1\n", "its unit is none of"},
             Bad{"angle [deg], pressure\n0, 1\n360, 1\n", "the table has no column crank_angle"},
             Bad{"crank_angle [deg], force\n0, 1\n360, 1\n", "the table has no column pressure"},
         }) {
        SCOPED_TRACE(bad.csv);
        expect_refused(scene(bad.csv), bad.words);
    }
}

TEST_F(SceneLoadFiles, BoundTheStepsThatWouldLeapOverThem) {
    auto const longest = [&](std::string const& csv, std::string const& over, std::string const& more = "") {
        return scene_of(this->scene(csv, "over = \"" + over + "\"\ncolumn = \"pressure\"\n") + "[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n" + more).integrator.max_step;
    };
    EXPECT_NEAR(longest("time [s], pressure\n0, 0\n0.5037, 0\n0.5087, 200\n0.5137, 0\n1, 0\n", "time"), 2.5e-3, 1e-12);
    // A crank that turns in 2 s: a fiftieth of that but for the table.
    EXPECT_NEAR(longest("crank_angle [deg], pressure\n0, 0\n100, 0\n101, 5\n102, 0\n360, 0\n", "crank_angle"), 2.0 / 720, 1e-12);
    EXPECT_NEAR(longest("crank_angle [deg], pressure\n0, 1\n180, 2\n360, 1\n", "crank_angle"), 0.04, 1e-12);
    EXPECT_EQ(longest("time [s], pressure\n0, 0\n1, 1\n", "time", "[integrator]\nmax_step = 0.03\n"), 0.03);
}

TEST_F(SceneLoadFiles, MayHaveAMillionRows) {
    std::string csv = "time [s], pressure\n";
    for (int i = 0; i < 1'000'000; ++i) csv += std::to_string(i) + "," + std::to_string(i % 7) + "\n";
    std::string const more = "over = \"time\"\ncolumn = \"pressure\"\n";
    Scene const scene = scene_of(this->scene(csv, more));
    EXPECT_NEAR(table_point(scene.parts.loads.loads[0].table, 777'777.0).value, 777'777 % 7, 1e-9);
    EXPECT_TRUE(contains(error_of(this->scene(csv + "1000000,3\n", more)), "at most 1000000 rows"));
}

TEST(SceneLoads, HaveKeysOfTheirOwn) {
    Scene const one = scene_of("schema = 1\n[load.gas]\nforce_x = 1\n[load.spring]\nforce_x = 2\n");
    Scene const other = scene_of("schema = 1\n[load.spring]\nforce_x = 4\n[load.gas]\nforce_x = 3\n");
    EXPECT_EQ(number(one, 0, "force_x"), 1);
    EXPECT_EQ(number(other, 0, "force_x"), 4);
    EXPECT_EQ(find_key("load.gas.force_x", one)->get(one.inputs), 1);
    EXPECT_EQ(find_key("load.gas.force_x", other)->get(other.inputs), 3);
    EXPECT_EQ(find_key("load.gas.force_x", scene_of("schema = 1\n")), nullptr);
    EXPECT_EQ(find_key("load.gas.force_x"), nullptr);
}

TEST(SceneLoads, OfAnyNumberOfScenesOfAProcessHaveRoom) {
    for (int scenes = 0; scenes < 40; ++scenes) {
        std::string text = "schema = 1\n";
        for (int i = 0; i < 8; ++i) text += fmt::format("[load.of_{}_{}]\nforce_x = {}\nscale = 2\n", (scenes * 7 + i * i) % 31, (scenes + i) % 10, i);
        Scene const scene = scene_of(text);
        for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(number(scene, i, "force_x"), static_cast<double>(i));
    }
}

TEST(SceneLoads, SayThatANumberMustBeGivenToVary) {
    std::string const loads = "schema = 1\n[load.plunger]\nforce_x = 1\n[study]\n";
    auto const vary = [](std::string const& key) { return "[study.vary]\n\"" + key + "\" = { dist = \"unif\", low = 0, high = 1 }\n"; };
    std::string const words = "load.plunger.force_y is not given in [load.plunger] (a number must be given to vary); add force_y = 0";
    expect_refused(loads + "members = 2\n" + vary("load.plunger.force_y"), "scene.toml:7: " + words);
    expect_refused(loads + "kind = \"sweep\"\nmembers = 1\nparameter = \"load.plunger.force_y\"\nvalues = [1]\n", "scene.toml:7: " + words);
    expect_refused(loads + "members = 2\n" + vary("load.plunger.scale"), "add scale = 1");
    expect_refused(loads + "members = 2\n" + vary("load.piston.force_y"), "load.piston.force_y is of no load of the scene (there is no [load.piston])");
    expect_refused(loads + "members = 2\n" + vary("load.plunger.force"), "did you mean \"load.plunger.force_x\"?");
    testing::TableFolder const folder;
    folder.write("m.csv", "load.plunger.force_y [N]\n1\n");
    EXPECT_EQ(folder.error(loads.substr(11) + "design = \"table\"\ntable = \"m.csv\"\n"), "m.csv:1: " + words);
    Scene scene = scene_of(loads);
    EXPECT_THROW(take_members(scene, {"load.plunger.force_y"}, std::vector<double>{1}), SceneError);
    take_members(scene, {"load.plunger.force_x"}, std::vector<double>{7});
    EXPECT_EQ(member_inputs(scene, 0).*load_inputs[scene.loads->load(0).force[0]], 7);
}

TEST(SceneLoads, WarnOfAPointWithoutAForce) {
    Scene const scene = scene_of("schema = 1\n[load.gas]\ntorque_z = 1\npoint_y = 2e-3\n");
    EXPECT_EQ(std::ranges::count(scene.warnings, "scene.toml:4: load.gas.point_y has no effect, for the load has no force"), 1);
    EXPECT_TRUE(std::ranges::none_of(scene_of("schema = 1\n[load.gas]\nforce_x = 1\npoint_y = 2e-3\n").warnings,
                                     [](std::string const& line) { return contains(line, "load.gas"); }));
    expect_refused("schema = 1\n[load.gas]\npoint_y = 2e-3\n", "load.gas.force_x is missing (a load without a force or a torque does nothing)");
}

TEST_F(SceneLoadFiles, ThatBeginAnewWithAColumnAreOfNoContinuedSweep) {
    std::string const sweep = "[study]\nkind = \"sweep\"\nmembers = 1\nparameter = \"joint.clearance\"\nvalues = [5e-4, 4e-4]\ntransient_revolutions = 0\n"
                              "revolutions = 2\nphase = 0\n";
    auto const scene_with = [&](std::string const& csv, std::string const& over, std::string const& more = "") {
        return scene(csv, "over = \"" + over + "\"\ncolumn = \"pressure\"\n" + more) + sweep;
    };
    std::string const begins_anew = "study.start is \"continue\" (columns begin at time 0 in the first turn, where the table of load.gas would jump)";
    std::string const one_turn = scene_with("crank_angle [deg], pressure\n0, 1\n100, 2\n360, 1\n", "crank_angle");
    EXPECT_EQ(error_of(one_turn + "start = \"continue\"\n"), "");
    std::string const two_turns = scene_with("crank_angle [deg], pressure\n0, 1\n100, 2\n720, 1\n", "crank_angle");
    expect_refused(two_turns + "start = \"continue\"\n", begins_anew);
    EXPECT_EQ(error_of(two_turns), "");
    std::string const ends = scene_with("crank_angle [deg], pressure\n0, 1\n100, 2\n360, 1\n", "crank_angle", "repeats = false\n");
    expect_refused(ends + "start = \"continue\"\n", begins_anew);
    expect_refused(scene_with("time [s], pressure\n0, 1\n1, 1\n", "time", "repeats = true\n") + "start = \"continue\"\n", begins_anew);
    EXPECT_EQ(error_of(scene_with("x [m], pressure\n0, 1\n1, 2\n", "x") + "start = \"continue\"\n"), "");
}

TEST_F(SceneLoadFiles, AreReadOnce) {
    std::string const text = scene("crank_angle [deg], pressure\n0, 1\n90, 5\n360, 1\n");
    Scene const first = scene_of(text);
    std::filesystem::remove(folder_ / "p.csv");
    Scene const other = parse_scene(text, "scene.toml", {{"load.gas.scale", "7"}}, &first);
    EXPECT_EQ(other.loads->rows()[0].table.function, first.loads->rows()[0].table.function);
    EXPECT_EQ(number(other, 0, "scale"), 7);
    EXPECT_EQ(other.tables[0].path, first.tables[0].path);
    // Other pieces through the same rows; not a second text of them.
    Scene const straight = parse_scene(text, "scene.toml", {{"load.gas.interpolation", "linear"}}, &other);
    EXPECT_EQ(straight.tables[0].text, first.tables[0].text);
    EXPECT_NEAR(table_point(straight.parts.loads.loads[0].table, std::numbers::pi / 4).value, 3, 1e-12);
    EXPECT_THROW(scene_of(text), SceneError);
}

}  // namespace
}  // namespace slideway::scene_loads_test
