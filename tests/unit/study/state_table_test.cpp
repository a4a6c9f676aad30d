#include "host/study/state_table.hpp"

#include <cmath>
#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/study/probe.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/start.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::state_table_test {
namespace {

constexpr char const* states = "t,y,z,vy,vz,roll,yaw,pitch,wx,wy,wz";

StateTable read(std::string const& text, Scene const& scene = {}) {
    std::istringstream in(text);
    return read_state_table(in, "states.csv", scene);
}

std::string error_of(std::string const& text, Scene const& scene = {}) {
    try {
        read(text, scene);
    } catch (SceneError const& error) {
        return error.what();
    }
    return "";
}

std::string with_column(std::string const& name, std::string const& value) {
    return name + "," + states + "\n" + value + ",0,1,2,3,4,5,6,7,8,9,10\n";
}

TEST(StateTable, ReadsColumnsInAnyOrder) {
    StateTable const table = read(
        "wz,t,ignored,vy,z,y,vz,roll,yaw,pitch,wx,wy\n"
        "10,0.5,text,3,2e-4,-1e-4,4,0.5,0.6,0.7,8,9\r\n"
        "\n"
        " 11 , +0.25 ,, 3,2,1,4,5,6,7,8,9");
    ASSERT_EQ(table.rows(), 2u);
    EXPECT_EQ(table.times, (std::vector<double>{0.5, 0.25}));
    Inputs const& first = table.inputs[0];
    EXPECT_EQ(first.y, -1e-4);
    EXPECT_EQ(first.z, 2e-4);
    EXPECT_EQ(first.vy, 3);
    EXPECT_EQ(first.vz, 4);
    EXPECT_EQ(first.roll, 0.5);
    EXPECT_EQ(first.yaw, 0.6);
    EXPECT_EQ(first.pitch, 0.7);
    EXPECT_EQ(first.wx, 8);
    EXPECT_EQ(first.wy, 9);
    EXPECT_EQ(first.wz, 10);
    EXPECT_EQ(table.inputs[1].wz, 11);
}

/// A crank of 50 mm, a rod of 120 mm, a slider on the line: the wrist closes the loop.
TEST(StateTable, RefusesStatesInWhichLoopsAreOpen) {
    Scene const scene = testing::scene_of("schema = 1\n[mechanism]\nkind = \"linkage\"\ncrank_speed = 10\n[drive]\nbody = \"crank\"\n"
        "[body.crank]\nmass = 0.3\ninertia = 1e-4\n[body.rod]\nmass = 0.2\ninertia = 2e-4\n[body.slider]\nmass = 0.1\n"
        "[link.shaft]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"crank\"\n[link.way]\nkind = \"prismatic\"\nfirst = \"ground\"\nsecond = \"slider\"\nposition = 0.17\n"
        "[link.pin]\nkind = \"revolute\"\nfirst = \"crank\"\nfirst_x = 0.05\nsecond = \"rod\"\n[link.wrist]\nkind = \"revolute\"\nfirst = \"rod\"\nfirst_x = 0.12\nsecond = \"slider\"\n"
        "[study]\nduration = 1\n");
    std::string const header = "t,crank_angle,crank_angular_velocity,slider_displacement,slider_velocity,rod_angle,rod_angular_velocity\n";
    auto const row = [&](double angle, double place, double rate) {
        double const rod = std::asin(-0.05 * std::sin(angle) / 0.12), turns = -0.5 * std::cos(angle) / (0.12 * std::cos(rod));
        return header + fmt::format("0,{},10,{},{},{},{}\n", angle, 0.05 * std::cos(angle) + 0.12 * std::cos(rod) + place, -0.5 * std::sin(angle) - 0.12 * std::sin(rod) * turns + rate, rod, turns);
    };
    EXPECT_EQ(error_of(row(0.7, 0, 0), scene), "");
    EXPECT_EQ(error_of(row(0.7, 1e-9, 0), scene), "");  // a few digits less
    EXPECT_NE(error_of(row(0.7, 1e-5, 0), scene).find("in this state link.wrist is open by 1e-05 m and opens at"), std::string::npos) << error_of(row(0.7, 1e-5, 0), scene);
    EXPECT_NE(error_of(row(0.7, 0, 0.01), scene).find("opens at 0.01 m/s"), std::string::npos) << error_of(row(0.7, 0, 0.01), scene);
}

TEST(StateTable, TakesTheSceneWhereTheTableIsSilent) {
    Scene scene;
    scene.inputs.rod_length = 0.3;
    scene.parts.friction = true;
    StateTable const table = read(with_column("joint.clearance", "2e-4"), scene);
    Inputs const& in = table.inputs[0];
    EXPECT_EQ(in.rod_length, 0.3);
    EXPECT_EQ(in.clearance_y, 2e-4);
    EXPECT_EQ(in.clearance_z, 2e-4);
    EXPECT_TRUE(table.parts[0].friction);
    // What follows from other inputs is filled in: model.md 2, a steel rod of 14.2 × 7.1 mm.
    EXPECT_NEAR(in.rod_mass, 7800 * 0.0142 * 0.0071 * 0.3, 1e-15);
    EXPECT_NEAR(in.rod_inertia, in.rod_mass * 0.3 * 0.3 / 12, 1e-18);
}

Scene of_law(Law law) {
    Scene scene;
    scene.parts.law = law;
    scene.inputs = with_presets({}, law);
    return scene;
}

TEST(StateTable, TakesWhatALawHasOfItsOwnWhereverItsColumnStands) {
    std::string const row = ",0,1,2,3,4,5,6,7,8,9,10";
    auto const table = [&](std::string const& header, std::string const& cells, Scene const& scene = {}) {
        return read(header + "," + states + "\n" + cells + row + "\n", scene);
    };
    for (auto const& [header, cells] : {std::pair{"contact.law,contact.apex_damping", "kelvin_voigt,40"},
                                        {"contact.apex_damping,contact.law", "40,kelvin_voigt"}}) {
        StateTable const read_table = table(header, cells);
        EXPECT_EQ(read_table.parts[0].law, Law::kelvin_voigt);
        EXPECT_TRUE(std::isnan(read_table.inputs[0].law_a)) << "its preset";
        EXPECT_EQ(read_table.inputs[0].law_b, 40);
    }
    // The scene's own numbers count for rows of its law, and presets for the others.
    Scene scene = of_law(Law::kelvin_voigt);
    scene.inputs.law_a = 5e6;
    EXPECT_EQ(table("contact.law", "kelvin_voigt", scene).inputs[0].law_a, 5e6);
    EXPECT_EQ(table("contact.law", "paper", scene).parts[0].law, Law::paper);
    // A damping that the row's law lacks stays behind.
    Scene restituting;
    restituting.parts.damping = Damping::restitution;
    EXPECT_EQ(table("contact.law", "kelvin_voigt", restituting).parts[0].damping, Damping::point);
    EXPECT_EQ(table("contact.law", "conservative", restituting).parts[0].damping, Damping::restitution);
}

TEST(StateTable, RefusesKeysThatTheRowsLawDoesNotKnow) {
    EXPECT_EQ(error_of(with_column("contact.chi_line", "3"), of_law(Law::kelvin_voigt)),
              "states.csv:2: column contact.chi_line: contact.law \"kelvin_voigt\" does not know it; remove it");
    EXPECT_EQ(error_of(with_column("contact.chi_line", "0"), of_law(Law::kelvin_voigt)),
              "states.csv:2: column contact.chi_line: contact.law \"kelvin_voigt\" does not know it; remove it");
    EXPECT_EQ(error_of(with_column("contact.apex_damping", "0")),
              "states.csv:2: column contact.apex_damping: contact.law \"paper\" does not know it; remove it");
    EXPECT_EQ(error_of(with_column("contact.apex_stiffness", "-1"), of_law(Law::kelvin_voigt)),
              "states.csv:2: contact.apex_stiffness is -1 N/m (the stiffness of an apex must be positive); use a value > 0");
}

TEST(StateTable, PicksThePartsThatARowNeeds) {
    auto const parts = [](std::string const& name, std::string const& value) {
        return read(with_column(name, value)).parts[0];
    };
    EXPECT_EQ(parts("contact.law", "conservative").law, Law::conservative);
    EXPECT_EQ(parts("contact.law", "paper").law, Law::paper);
    EXPECT_EQ(parts("contact.chi_line", "0").damping, Damping::point);
    EXPECT_EQ(parts("contact.chi_line", "0.1").damping, Damping::rate);
    EXPECT_EQ(parts("contact.chi_surface", "0.1").damping, Damping::rate);
    EXPECT_EQ(parts("contact.restitution", "0.5").damping, Damping::restitution);
    EXPECT_FALSE(parts("way.pitch", "0").misaligned_way);
    EXPECT_TRUE(parts("way.pitch", "-1e-9").misaligned_way);
    EXPECT_FALSE(parts("contact.eta", "0.1").friction);
    EXPECT_TRUE(parts("friction.static", "0").friction);
}

TEST(StateTable, ReadsSpreadsheetsOfOtherCountries) {
    std::string header(states);
    std::ranges::replace(header, ',', ';');
    StateTable const table = read(header + ";part\n0,5;1e-5;-2,5e-5;0;0;0;0;0;0;0;0;A-001\n");
    EXPECT_EQ(table.times[0], 0.5);
    EXPECT_EQ(table.inputs[0].y, 1e-5);
    EXPECT_EQ(table.inputs[0].z, -2.5e-5);
    EXPECT_EQ(error_of(header + "\n#N/A;0;0;0;0;0;0;0;0;0;0\n"),
              "states.csv:2: column t: '#N/A' is an error of the spreadsheet; correct its formula, or remove the row");
}

TEST(StateTable, HeadersMayHaveUnits) {
    StateTable const table = read("t [ms],y [mm],z,vy,vz,roll [deg],yaw,pitch,wx,wy,wz,joint.clearance [mm]\n5,0.01,0,0,0,90,0,0,0,0,0,0.2\n");
    EXPECT_EQ(table.times[0], 5e-3);
    EXPECT_EQ(table.inputs[0].y, 1e-5);
    EXPECT_DOUBLE_EQ(table.inputs[0].roll, std::numbers::pi / 2);
    EXPECT_EQ(table.inputs[0].clearance_y, 2e-4);
    EXPECT_EQ(table.parameter_texts[0], std::vector<std::string>{"0.00020000000000000001"});
    std::string const rest = ",z,vy,vz,roll,yaw,pitch,wx,wy,wz\n";
    EXPECT_NE(error_of("t,y [s]" + rest).find("states.csv:1: column y [s]: "), std::string::npos);
    EXPECT_EQ(error_of("t,y [mm" + rest), "states.csv:1: column y [mm: its unit has no end; write \"y [m]\"");
    EXPECT_EQ(error_of("t,y [mm]" + rest + "0,x,0,0,0,0,0,0,0,0,0\n"), "states.csv:2: column y: 'x' is not a number; give a number of mm");
}

TEST(StateTable, TellsOfUnusualNumbersOnceAColumn) {
    StateTable const table = read(std::string(states) + ",joint.clearance\n" + "0,0,0,0,0,0,0,0,0,0,0,1e-4\n0,0,0,0,0,0,0,0,0,0,0,1\n0,0,0,0,0,0,0,0,0,0,0,2\n");
    ASSERT_EQ(table.warnings.size(), 1u);
    EXPECT_EQ(table.warnings[0].substr(0, 38), "states.csv:3: joint.clearance is 1 m (") << table.warnings[0];
}

TEST(StateTable, SaysWhereItCannotBeUsed) {
    std::string const header = std::string(states) + "\n";
    EXPECT_EQ(error_of(""), "states.csv:1: the table is empty");
    EXPECT_EQ(error_of(header), "states.csv:1: the table has a header but no row");
    EXPECT_EQ(error_of("t,y,z,vy,vz,roll,yaw,pitch,wx,wy\n").substr(0, 35), "states.csv:1: column wz: is missing");
    EXPECT_EQ(error_of(header + "0,0,0,0,0,0,0,0,0,0,0\n0,0,0,0,x1,0,0,0,0,0,0\n"),
              "states.csv:3: column vz: 'x1' is not a number; give a number in SI units");
    EXPECT_EQ(error_of(header + "0,0,0,0,,0,0,0,0,0,0\n"), "states.csv:2: column vz: '' is a missing value; give a number, or remove the row");
    EXPECT_EQ(error_of(header + "0,0,0,0,1.5e,0,0,0,0,0,0\n"), "states.csv:2: column vz: '1.5e' is not a number; give a number in SI units");
    EXPECT_EQ(error_of(header + "0,0,0\n"), "states.csv:2: the row has 3 fields between commas (the header has 11 columns); write one for each column");
    EXPECT_EQ(
        error_of(with_column("joint.clearence", "1")),
        "states.csv:1: column joint.clearence: no numeric key of a scene has this name; did you mean joint.clearance?");
    EXPECT_EQ(error_of(with_column("y", "1")), "states.csv:1: column y: stands there twice");
    EXPECT_NE(error_of(with_column("initial.y", "1")), "");
    EXPECT_NE(error_of(with_column("joint.clearance_y,joint.clearance", "1,1")), "");
    EXPECT_EQ(error_of(with_column("contact.law", "hertz")),
              "states.csv:2: column contact.law: 'hertz' is no law; use one of paper, conservative, kelvin_voigt, foundation");
    EXPECT_EQ(error_of(with_column("joint.clearance_y", "-1")).substr(0, 37), "states.csv:2: joint.clearance_y is -1");
    EXPECT_NE(error_of(header + "0,nan,0,0,0,0,0,0,0,0,0\n"), "");
    EXPECT_NE(error_of(header + "inf,0,0,0,0,0,0,0,0,0,0\n"), "");
}

Scene scene_of(Mechanism mechanism) {
    Scene scene;
    scene.parts.mechanism = mechanism;
    return scene;
}

TEST(StateTable, OfAFreeSliderHasItsWay) {
    Scene const free = scene_of(Mechanism::free_slider);
    StateTable const table = read(std::string(states) + ",x,vx\n0,1,2,3,4,5,6,7,8,9,10,11,12\n", free);
    EXPECT_EQ(table.inputs[0].wz, 10);
    EXPECT_EQ(table.inputs[0].x, 11);
    EXPECT_EQ(table.inputs[0].vx, 12);
    EXPECT_EQ(
        error_of(std::string(states) + "\n0,1,2,3,4,5,6,7,8,9,10\n", free),
        "states.csv:1: column x: is missing; the table needs t, y, z, vy, vz, roll, yaw, pitch, wx, wy, wz, x, vx");
}

constexpr char const* planar_states = "t,crank_angle,rod_angle,pitch,crank_angular_velocity,rod_angular_velocity,wz";

TEST(StateTable, OfThePlanarMechanismHasItsAngles) {
    Scene planar = scene_of(Mechanism::planar_slider_crank);
    planar.inputs.crank_length = 0.3, planar.inputs.rod_length = 0.5;
    // sin 30° = 1/2 and sin θ2 = −3/10 put the slider on its line, whatever turns; cos 30° = √3/2.
    double const rod = std::asin(-0.3), cosine = std::sqrt(0.91);
    std::string const row = fmt::format("0,{:.17g},{:.17g},0.01,2,-3,4\n", std::acos(-1.0) / 6, rod);
    StateTable const table = read(std::string(planar_states) + "\n" + row, planar);
    Inputs const& in = table.inputs[0];
    EXPECT_DOUBLE_EQ(in.start_angle, std::acos(-1.0) / 6);
    EXPECT_NEAR(in.y, 0, 1e-16);
    EXPECT_NEAR(in.vy, 0.3 * std::sqrt(0.75) * 2 - 0.5 * cosine * 3, 1e-15);
    EXPECT_EQ(in.pitch, 0.01);
    EXPECT_EQ(in.crank_speed, 2);
    EXPECT_EQ(in.wz, 4);
    StateNumbers const back = start_of(info(Mechanism::planar_slider_crank), in);
    EXPECT_NEAR(back[1], rod, 1e-15);
    EXPECT_NEAR(back[4], -3, 1e-14);
    EXPECT_EQ(error_of(std::string(planar_states) + "\n0,0,1.6,0,0,0,0\n", planar),
              "states.csv:2: rod_angle is 1.6 rad (the rod is to point along the way); use a value within a right "
              "angle of 0");
}

TEST(StartOfAMember, TakesEachComponentFromItsOwnInput) {
    MechanismInfo turning = spatial_slider_info();
    turning.states = 12;
    turning.state[10] = Series::crank_angle, turning.state[11] = Series::crank_angular_velocity;
    ASSERT_TRUE(has_start_inputs(turning));
    Inputs in;
    in.x = 7, in.vx = 8, in.start_angle = 0.3, in.crank_speed = 20, in.wz = 5;
    StateNumbers const start = start_of(turning, in);
    EXPECT_EQ(start[9], 5);
    EXPECT_EQ(start[10], 0.3);
    EXPECT_EQ(start[11], 20);
    Inputs back;
    set_start(turning, start, back);
    EXPECT_EQ(back.start_angle, 0.3);
    EXPECT_EQ(back.crank_speed, 20);
    EXPECT_EQ(back.x, 0) << "it is no component";
    turning.state[11] = Series::rod_angle;
    EXPECT_FALSE(has_start_inputs(turning));
}

TEST(StateTable, HasNoColumnsThatDoNotCountForTheMechanism) {
    std::string const row = "0.1,0,0,0,0,0,0,0\n";
    Scene const planar = scene_of(Mechanism::planar_slider_crank);
    auto const error = [&](std::string const& name) {
        return error_of(name + "," + planar_states + "\n" + row, planar);
    };
    EXPECT_EQ(error("way.pitch"),
              "states.csv:1: column way.pitch: has no meaning for kind = \"planar_slider_crank\"; remove it");
    EXPECT_EQ(error("contact.law"),
              "states.csv:1: column contact.law: has no meaning for kind = \"planar_slider_crank\"; remove it");
    EXPECT_EQ(error("mechanism.start_angle").substr(0, 78),
              "states.csv:1: column mechanism.start_angle: the state to probe stands in the c");
    EXPECT_EQ(error("joint.slider_height"), "");
    EXPECT_EQ(error_of(with_column("mechanism.rod_length", "1"), scene_of(Mechanism::carriage)),
              "states.csv:1: column mechanism.rod_length: has no meaning for kind = \"carriage\"; remove it");
    EXPECT_EQ(error_of(with_column("mechanism.start_angle", "1")), "") << "an angle of the slider-crank";
}

std::string header_of(Mechanism mechanism, std::string const& columns, std::string const& row) {
    StateTable const table = read(columns + "\n" + row, scene_of(mechanism));
    std::ostringstream out;
    write_probe_csv(out, table, std::vector<ProbeResult>(table.rows()));
    return out.str().substr(0, out.str().find('\n'));
}

TEST(ProbeTable, HasTheColumnsOfItsMechanism) {
    EXPECT_EQ(header_of(Mechanism::planar_slider_crank, planar_states, "0,0,0,0,0,0,0\n"),
              std::string(planar_states) +
                  ",d_crank_angle,d_rod_angle,d_pitch,d_crank_angular_velocity,d_rod_angular_velocity,d_wz,power_crank,"
                  "power_friction,power_damping,pen_C1,pen_C2,pen_C3,pen_C4,fn_C1,fn_C2,fn_C3,fn_C4,surfaces,lines,"
                  "points,energy,contact_potential,crank_torque,status");
    std::string const free =
        header_of(Mechanism::free_slider, std::string(states) + ",x,vx", "0,0,0,0,0,0,0,0,0,0,0,0,0\n");
    EXPECT_NE(free.find(",wz,x,vx,d_y,"), free.npos) << free;
    EXPECT_NE(free.find(",d_wz,d_x,d_vx,power_crank,"), free.npos) << free;
    EXPECT_TRUE(free.ends_with("fn_z_P8,surfaces,lines,points,energy,contact_potential,status")) << free;
}

TEST(ProbeTable, HasTheColumnsOfTheInputThenTheGoldenOnes) {
    StateTable const table = read(with_column("contact.law,joint.clearance", "paper,0.1e-3"));
    std::ostringstream out;
    ProbeResult result{};
    result.derivative[0] = 0.1;
    result.crank_torque = -3;
    write_probe_csv(out, table, {result});
    std::istringstream lines(out.str());
    std::string header, row;
    std::getline(lines, header);
    std::getline(lines, row);
    EXPECT_TRUE(header.starts_with("contact.law,joint.clearance,t,y,z,vy,vz,roll,yaw,pitch,wx,wy,wz,d_y,")) << header;
    EXPECT_TRUE(header.ends_with("fn_z_P8,surfaces,lines,points,energy,contact_potential,crank_torque,status"))
        << header;
    EXPECT_TRUE(row.starts_with("paper,0.0001,0,1,2,3,4,5,6,7,8,9,10,0.10000000000000001,0,")) << row;
    EXPECT_TRUE(row.ends_with(",-3,finished")) << row;
}

TEST(StateTable, OfADrivenPlanarMechanismHasTheCrankWhereItSays) {
    Scene scene;
    scene.parts.mechanism = Mechanism::planar_slider_crank;
    std::string const head = "t,crank_angle,rod_angle,pitch,crank_angular_velocity,rod_angular_velocity,wz\n";
    std::string const state = ",0.7,-0.2,0,10,-3,0\n";
    // What a state says of its forces does not depend on when it is reached.
    StateTable const table = read(head + "0" + state + "0.37" + state, scene);
    auto const results = probe(table, best_isa());
    ASSERT_EQ(results.size(), 2u);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(results[0].derivative[i], results[1].derivative[i]) << i;
    EXPECT_NE(results[0].derivative[4], 0);
}

TEST(StateTable, GivenAsNumbersObeysTheRulesOfATable) {
    auto const error_of_numbers = [](Scene const& scene, std::vector<double> const& numbers, std::vector<double> const& times) -> std::string {
        try {
            state_table(scene, numbers, times);
        } catch (SceneError const& error) {
            return error.what();
        }
        return "";
    };
    Scene const spatial = scene_of(Mechanism::slider_crank), planar = scene_of(Mechanism::planar_slider_crank);
    std::vector<double> const still(10, 0.0), rod_across = {0, 1.6, 0, 0, 0, 0};
    EXPECT_EQ(error_of_numbers(spatial, still, {0.5}), "");
    EXPECT_TRUE(error_of_numbers(spatial, still, {std::nan("")}).ends_with(": state 0: t is nan s; use a finite number"));
    EXPECT_TRUE(error_of_numbers(spatial, still, {HUGE_VAL}).ends_with(": state 0: t is inf s; use a finite number"));
    EXPECT_NE(error_of_numbers(planar, rod_across, {}).find("state 0: rod_angle is 1.6 rad"), std::string::npos);
}

/// What they push with is another matter: it depends on how they began.
TEST(StateTable, MayBeOfRigidContacts) {
    Scene scene;
    scene.parts.mechanism = Mechanism::planar_slider_crank;
    scene.parts.rigid = true;
    EXPECT_EQ(error_of("t,crank_angle,rod_angle,pitch,crank_angular_velocity,rod_angular_velocity,wz\n0,0,0,0,1,0,0\n", scene), "");
}

}  // namespace
}  // namespace slideway::state_table_test
