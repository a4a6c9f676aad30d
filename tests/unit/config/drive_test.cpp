// [drive] of scenes: what is read, what is refused, and what comes back in the resolved scene.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "host/config/descriptors.hpp"
#include "host/config/loads.hpp"
#include "host/config/scene.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::drive_test {
namespace {

constexpr char const* scene_head = "schema = 1\n[contact]\nlaw = \"conservative\"\n";

/// A scene beside a table drive.csv.
class SceneDrives : public ::testing::Test {
protected:
    std::filesystem::path const folder_ = std::filesystem::temp_directory_path() / ("slideway_drive_" + std::to_string(getpid()));

    SceneDrives() { std::filesystem::create_directories(folder_); }
    ~SceneDrives() override { std::filesystem::remove_all(folder_); }

    void table(std::string const& text) const { std::ofstream(folder_ / "drive.csv") << text; }
    Scene scene(std::string const& kind, std::string const& drive, std::string const& more = "[study]\nduration = 1\n") {
        return parse_scene(scene_head + ("[mechanism]\nkind = \"" + kind + "\"\n" + drive + more), (folder_ / "scene.toml").string());
    }
    std::string error(std::string const& kind, std::string const& drive, std::string const& more = "[study]\nduration = 1\n") {
        try {
            scene(kind, drive, more);
        } catch (SceneError const& e) {
            std::string const what = e.what();
            return what.substr(what.find(": ") + 2);
        }
        return "";
    }
};

std::string const profile = "[drive]\nkind = \"profile\"\ntable = \"drive.csv\"\n";

TEST_F(SceneDrives, OfTorqueHaveTheCrankInTheirState) {
    Scene const press = scene("slider_crank", "[drive]\nkind = \"torque\"\ntorque = \"2 N m\"\nno_load_speed = \"300 rpm\"\ninertia = 0.1\n");
    EXPECT_EQ(press.parts.mechanism, Mechanism::slider_crank_motor);
    EXPECT_EQ(kind_of(press.parts.mechanism), "slider_crank");
    EXPECT_EQ(press.inputs.drive_torque, 2);
    EXPECT_DOUBLE_EQ(press.inputs.drive_no_load_speed, 10 * std::numbers::pi);
    std::string const resolved = resolved_toml(press);
    EXPECT_NE(resolved.find("kind = \"slider_crank\"\n"), resolved.npos);
    EXPECT_NE(resolved.find("[drive]\nkind = \"torque\"\n"), resolved.npos);
    Scene const again = parse_scene(resolved, "again.toml");
    EXPECT_EQ(again.parts, press.parts);
    EXPECT_EQ(resolved_toml(again), resolved);
    EXPECT_EQ(parse_scene("schema = 1\n[mechanism]\nkind = \"planar_slider_crank\"\n[drive]\nkind = \"free\"\n", "planar.toml").parts.mechanism,
              Mechanism::planar_slider_crank);
}

TEST_F(SceneDrives, OfEarlierVersionsAreStillRead) {
    auto const of = [](std::string const& crank) { return parse_scene("schema = 1\n[mechanism]\nkind = \"planar_slider_crank\"\ncrank = \"" + crank + "\"\n", "s.toml"); };
    EXPECT_EQ(of("free").parts.drive.by, DriveBy::nothing);
    EXPECT_EQ(of("driven").parts.drive.by, DriveBy::speed);
    EXPECT_EQ(of("free").warnings.front(), "s.toml:4: mechanism.crank is of an earlier version; write [drive] and kind = \"free\" below");
}

TEST_F(SceneDrives, RefuseWhatTheirKindHasNot) {
    EXPECT_EQ(error("slider_crank", "[drive]\nkind = \"torque\"\n"), "drive.torque is missing (what the motor turns with); add torque = \"2 N m\"");
    EXPECT_EQ(error("slider_crank", "[drive]\nkind = \"free\"\ntorque = 1\n"),
              "drive.torque is given (drive.kind \"free\" does not have it); remove it, or use another kind");
    EXPECT_EQ(error("slider_crank", "[drive]\ninertia = 1\n"), "drive.inertia is given (drive.kind \"speed\" does not have it); remove it, or use another kind");
    EXPECT_EQ(error("slider_crank", "", "[study]\nduration = 1\n[study.vary]\n\"drive.torque\" = { dist = \"const\", value = 1 }\n"),
              "drive.torque is given (drive.kind \"speed\" does not have it); remove it, or use another kind");
    EXPECT_EQ(error("slider_crank", "[drive]\nkind = \"free\"\n", "[study]\nduration = 1\n[study.vary]\n\"drive.scale\" = { dist = \"const\", value = 1 }\n"),
              "drive.scale is given (drive.kind \"free\" does not have it); remove it, or use another kind");
    EXPECT_EQ(error("carriage", "[drive]\nkind = \"torque\"\ntorque = 1\n"),
              "drive.kind is \"torque\" (a carriage has no crank that could turn freely); use \"speed\" or \"profile\"");
    EXPECT_EQ(error("free_slider", "[drive]\nkind = \"profile\"\n"), "drive has no meaning for kind = \"free_slider\"; remove it");
    EXPECT_EQ(error("scotch_yoke", "[drive]\nkind = \"torque\"\ntorque = 1\n"),
              "drive.inertia is 0 kg m2 (nothing else turns at a dead centre); use a value > 0");
    EXPECT_EQ(scene("slider_crank", "crank_inertia = 1e-3\n[drive]\nkind = \"free\"\n").inputs.crank_inertia, 1e-3);
    EXPECT_EQ(error("slider_crank", "crank_inertia = 1e-3\n"), "mechanism.crank_inertia has no meaning for kind = \"slider_crank\"; remove it");
    EXPECT_EQ(error("carriage", "", "[load.a]\nforce_x = 1\ntable = \"drive.csv\"\nover = \"crank_speed\"\ncolumn = \"f\"\n[study]\nduration = 1\n"),
              "load.a.over is \"crank_speed\" (a carriage has no crank); use time, x or vx");
}

TEST_F(SceneDrives, ThatTurnFreelyGoByRevolutionsWithinATime) {
    std::string const motor = "[drive]\nkind = \"torque\"\ntorque = 1\n", limit = "time_limit = \"20 s\"\n";
    Scene const by_turns = scene("slider_crank", motor, "[study]\nrevolutions = 2.5\nsamples_per_revolution = 8\n" + limit);
    EXPECT_TRUE(by_turns.goes_by_turns());
    EXPECT_EQ(by_turns.integrator.end_time, 20);
    ASSERT_EQ(by_turns.sample_times.size(), 21u);
    EXPECT_DOUBLE_EQ(by_turns.sample_times[1], std::numbers::pi / 4);
    EXPECT_DOUBLE_EQ(by_turns.sample_times.back(), 5 * std::numbers::pi);
    std::string const resolved = resolved_toml(by_turns);
    EXPECT_NE(resolved.find("\nrevolutions = 2.5\ntime_limit = 20.0  # s\n"), resolved.npos) << resolved;
    Scene const again = parse_scene(resolved, "again.toml");
    EXPECT_EQ(resolved_toml(again), resolved);
    EXPECT_EQ(again.sample_times, by_turns.sample_times);
    EXPECT_EQ(scene("slider_crank", motor, "[study]\n" + limit).chaos.span, (Span{1, true}));
    EXPECT_FALSE(scene("slider_crank", motor).goes_by_turns());
    for (std::string const kind : {"poincare", "sweep\"\nparameter = \"drive.torque\"\nvalues = [1, 2]\nphase = \"90 deg", "lyapunov"}) {
        Scene const orbits = scene("slider_crank", motor, "[study]\nkind = \"" + kind + "\"\nrevolutions = 3\n" + limit);
        EXPECT_TRUE(orbits.goes_by_turns());
        EXPECT_TRUE(orbits.chaos.transient.revolutions);
        EXPECT_EQ(resolved_toml(parse_scene(resolved_toml(orbits), "again.toml")), resolved_toml(orbits));
    }
}

TEST_F(SceneDrives, ThatTurnFreelyNeedATimeForTheirRevolutions) {
    std::string const motor = "[drive]\nkind = \"torque\"\ntorque = 1\n", missing = "study.time_limit is missing (a crank that turns freely may never turn so far); "
                                                                                "add time_limit = \"60 s\"";
    EXPECT_EQ(error("slider_crank", motor, "[study]\nrevolutions = 2\n"), missing);
    EXPECT_EQ(error("slider_crank", motor, "[study]\nkind = \"poincare\"\n"), missing);
    EXPECT_EQ(error("slider_crank", motor, "[study]\nkind = \"sweep\"\nparameter = \"drive.torque\"\nvalues = [1, 2]\n"), missing);
    EXPECT_EQ(error("slider_crank", motor, "[study]\nkind = \"sweep\"\nparameter = \"mechanism.crank_speed\"\nvalues = [1, 2]\ntime_limit = 9\nstart = \"continue\"\n"),
              "study.start is \"continue\" (mechanism.crank_speed is where a member starts, and columns start where the one before ended); use start = \"fresh\", "
              "or another parameter");
    EXPECT_EQ(error("slider_crank", "", "[study]\nrevolutions = 2\ntime_limit = 3\n"),
              "study.time_limit is 3 (revolutions of the drive last as long as they do); remove it");
    EXPECT_EQ(error("slider_crank", motor, "[study]\nduration = 2\ntime_limit = 3\n"),
              "study.time_limit is 3 (study.duration ends members before); remove one of the two");
    EXPECT_EQ(error("slider_crank", motor, "[study]\nkind = \"lyapunov\"\nTtr = 1\ntime_limit = 3\n"),
              "study.Ttr is 1 (with study.time_limit revolutions are counted); use study.transient_revolutions");
    EXPECT_EQ(error("slider_crank", motor, "[study]\nkind = \"lyapunov\"\ndt = 1\ntime_limit = 3\n"),
              "study.dt is 1 (with study.time_limit revolutions are counted); use study.rescalings_per_revolution");
    EXPECT_EQ(error("slider_crank", motor, "[study]\nrevolutions = 2\ntime_limit = 0\n"), "study.time_limit is 0 s (out of range for the time limit); use a value > 0 s and <= 1000000000 s");
}

TEST_F(SceneDrives, OnProfilesTurnByWhatTheirTableSays) {
    table("time [s],turned [deg]\n0,30\n1,120\n2,390\n");
    Scene const once = scene("slider_crank", profile + "column = \"turned\"\ngives = \"angle\"\nscale = 2\n");
    PieceFunction const& f = *once.drive->table.function;
    EXPECT_NEAR(f.value(0), 0, 1e-15);
    EXPECT_NEAR(f.value(1), std::numbers::pi / 2, 1e-15);
    EXPECT_NEAR(f.value(2), 2 * std::numbers::pi, 1e-14);
    EXPECT_EQ(once.inputs.profile_speed, f.slope(0));
    Scene const again = parse_scene(resolved_toml(once), (folder_ / "again.toml").string());
    EXPECT_EQ(resolved_toml(again), resolved_toml(once));
    Scene const ever = scene("slider_crank", profile + "column = \"turned\"\ngives = \"angle\"\nrepeats = true\n", "[study]\nrevolutions = 3\n");
    EXPECT_DOUBLE_EQ(ever.integrator.end_time, 6);
    EXPECT_NEAR(ever.drive->table.function->value(4.5) - ever.drive->table.function->value(0.5), 4 * std::numbers::pi, 1e-14);
    EXPECT_NEAR(ever.drive->table.function->slope(2 - 1e-9), ever.drive->table.function->slope(0), 1e-7);
}

TEST_F(SceneDrives, OnProfilesIntegrateSpeeds) {
    table("time [s],speed [rpm]\n0,0\n0.5,600\n1,600\n");
    Scene const line = scene("scotch_yoke", profile + "column = \"speed\"\ngives = \"speed\"\ninterpolation = \"linear\"\n");
    double const full = 20 * std::numbers::pi;
    EXPECT_NEAR(line.drive->table.function->value(0.25), full / 2 * 0.125, 1e-13);
    EXPECT_NEAR(line.drive->table.function->value(1), full * 0.75, 1e-13);
    EXPECT_NEAR(line.inputs.crank_speed, full, 1e-12) << "tolerances are meant against the fastest";
    table("time [s],v [mm/s]\n0,0\n1,60\n2,0\n3,-60\n4,0\n");
    Scene const carriage = scene("carriage", profile + "column = \"v\"\ngives = \"speed\"\nrepeats = true\n");
    EXPECT_NEAR(carriage.drive->table.function->value(4.3), carriage.drive->table.function->value(0.3), 1e-15);
    table("time [s],v [mm/s]\n0,0\n1,60\n2,0\n3,-59.9\n4,0\n");
    Scene const measured = scene("carriage", profile + "column = \"v\"\ngives = \"speed\"\nrepeats = true\n");
    EXPECT_NEAR(measured.drive->table.function->value(4.3), measured.drive->table.function->value(0.3), 1e-15);
    ASSERT_FALSE(measured.warnings.empty());
    EXPECT_NE(measured.warnings.front().find("does not come back"), std::string::npos);
}

TEST_F(SceneDrives, RefuseBadProfilesInOneLine) {
    std::string const speed = profile + "column = \"speed\"\ngives = \"speed\"\n";
    table("time [s],speed [rad/s]\n0,1\n0.5,2\n");
    EXPECT_EQ(error("slider_crank", speed), "drive.table is \"drive.csv\" (it ends at 0.5 s, and the run at 1 s); add rows, end the run earlier, or set repeats = true");
    EXPECT_EQ(error("carriage", speed).find("drive.csv"), error("carriage", speed).find("drive.csv"));
    EXPECT_NE(error("carriage", speed), "") << "rad/s are no speed of a carriage";
    EXPECT_EQ(error("slider_crank", profile + "column = \"speed\"\ngives = \"position\"\n"),
              "drive.gives is \"position\" (a crank has an angle); use \"angle\" or \"speed\"");
    EXPECT_EQ(error("slider_crank", profile + "column = \"speed\"\n"), "drive.gives is missing (what the profile's column is); add gives = \"angle\" or \"speed\"");
    table("time [s],speed [rad/s]\n0.1,1\n5,2\n");
    EXPECT_EQ(error("slider_crank", speed), "drive.table is \"drive.csv\" (its first time is 0.1 s, and a run begins at 0); begin it at 0 or earlier");
    table("time [s],place [m]\n0,0\n1,0.1\n2,0.05\n");
    EXPECT_NE(error("carriage", profile + "column = \"place\"\ngives = \"position\"\nrepeats = true\n"), "") << "it does not close";
    EXPECT_NE(error("carriage", profile + "column = \"place\"\ngives = \"position\"\ninterpolation = \"linear\"\n"), "") << "speeds jump";
    table("time [s],speed [rad/s]\n0,1\n0,2\n");
    EXPECT_NE(error("slider_crank", speed).find("the place stands twice"), std::string::npos);
    table("time [s],speed [rad/s]\n0,1\n5,2\n");
    EXPECT_EQ(error("slider_crank", "crank_speed = 3\n" + speed), "mechanism.crank_speed is given (drive.kind \"profile\" says how fast); remove it, or use another kind");
}

}  // namespace
}  // namespace slideway::drive_test
