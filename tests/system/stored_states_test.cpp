// States that results have stored, and how the forces of a state come about.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/system/results.hpp"

namespace slideway::testing::stored_states_test {
namespace {

using Json = nlohmann::json;
using Vector = std::array<double, 3>;

class StoredStates : public ProgramWithResults {
protected:
    void run_scene(std::string const& text) {
        write("s.toml", text);
        Outcome const outcome = run({"run", "s.toml", "-o", "s.nc", "--quiet", "--force"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
    Json probed(std::vector<std::string> words) {
        words.insert(words.begin(), "probe");
        words.insert(words.end(), {"--json", "--explain"});
        Outcome const outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return Json::parse(outcome.out);
    }
};

constexpr char const* members = R"(schema = 1
[contact]
law = "conservative"
[friction]
[integrator]
rtol = 1e-8
[study]
members = 3
duration = "20 ms"
samples = 21
quantities = ["normal_force", "face_force_y_plus", "face_along_y_plus", "friction_force_x", "contact_force_y"]
[study.vary]
"joint.clearance" = { dist = "unif", low = "0.05 mm", high = "0.2 mm" }
"way.roll" = { dist = "unif", low = -0.001, high = 0.001 }
)";

TEST_F(StoredStates, HaveTheForcesOfTheirSeries) {
    ASSERT_NO_FATAL_FAILURE(run_scene(members));
    auto const file = results("s.nc");
    auto const forces = file.values("normal_force");
    double largest = 0;
    for (std::size_t member = 0; member < 3; ++member) {
        auto const own = forces.begin() + static_cast<std::ptrdiff_t>(21 * member);
        for (std::size_t const k : {std::size_t{5}, static_cast<std::size_t>(std::max_element(own, own + 20) - own)}) {
            Json const json = probed({"s.nc", "--member", std::to_string(member), "--time", fmt::format("{}", 1e-3 * static_cast<double>(k) + 3e-4)});
            EXPECT_EQ(json["member"], member);
            EXPECT_EQ(json["stored"], "sample");
            Json const& state = json["states"][0];
            EXPECT_EQ(state["time"], file.values("time")[k]);
            auto const at = [&](std::string const& name) { return file.values(name)[member * 21 + k]; };
            for (std::string const name : {"y", "vz", "pitch", "wx"}) EXPECT_EQ(state["state"][name], at(name)) << name;
            double const force = at("normal_force");
            for (std::string const name : {"face_force_y_plus", "friction_force_x", "contact_force_y"})
                EXPECT_NEAR(state["forces"][name].get<double>(), at(name), 1e-9 * force) << name;
            EXPECT_NEAR(state["forces"]["face_along_y_plus"].get<double>(), at("face_along_y_plus"), 1e-9);
            double sum = 0;
            for (Json const& pair : state["explanation"]["pairs"]) sum += pair["normal_force"].get<double>();
            EXPECT_NEAR(sum, force, 1e-9 * force);
            largest = std::max(largest, force);
        }
    }
    EXPECT_GT(largest, 1);
}

TEST_F(StoredStates, AreAtTheEndWhereNoTimeIsAskedFor) {
    ASSERT_NO_FATAL_FAILURE(run_scene(members));
    Json const json = probed({"s.nc"});
    EXPECT_EQ(json["member"], 0);
    EXPECT_EQ(json["stored"], "end");
    EXPECT_EQ(json["states"][0]["time"], results("s.nc").values("end_time")[0]);
    EXPECT_EQ(json["states"][0]["state"]["y"], results("s.nc").values("final_y")[0]);
    Outcome const listing = run({"probe", "s.nc", "--member", "2", "--time", "0"});
    EXPECT_NE(listing.out.find("s.nc, member 2 at t = 0 s (sample)"), std::string::npos) << listing.out;
}

TEST_F(StoredStates, MayBeSectionsOfAnOrbit) {
    ASSERT_NO_FATAL_FAILURE(run_scene("schema = 1\n[mechanism]\ncrank_speed = \"600 rpm\"\n[contact]\nlaw = \"conservative\"\n[study]\nkind = \"poincare\"\n"
                                      "members = 2\ntransient_revolutions = 0\nrevolutions = 3\n[study.vary]\n\"initial.y\" = { dist = \"unif\", low = 0, high = 1e-5 }\n"));
    Json const json = probed({"s.nc", "--member", "1", "--time", "0.19"});
    EXPECT_EQ(json["stored"], "section");
    auto const file = results("s.nc");
    double const first = file.values("section_count")[0], time = json["states"][0]["time"];
    auto const times = file.values("section_time");
    auto const at = static_cast<std::size_t>(std::find(times.begin() + static_cast<std::ptrdiff_t>(first), times.end(), time) - times.begin());
    ASSERT_LT(at, times.size());
    EXPECT_EQ(json["states"][0]["state"]["vy"], file.values("section_vy")[at]);
}

Vector cross(Vector const& a, Vector const& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
/// Columns of a continued sweep begin at the phase, where the one before has ended, and not at mechanism.start_angle.
TEST_F(StoredStates, OfContinuedColumnsHaveTheirCrankWhereItWas) {
    ASSERT_NO_FATAL_FAILURE(run_scene("schema = 1\n[mechanism]\ncrank_speed = 10\n[contact]\nlaw = \"foundation\"\nrestitution = 0.3\n[study]\nkind = \"sweep\"\n"
                                      "phase = \"90 deg\"\nparameter = \"joint.clearance\"\nvalues = [1e-4, 1.1e-4]\nstart = \"continue\"\nmembers = 1\n"
                                      "transient_revolutions = 1\nrevolutions = 1\nexponents = 0\n"));
    auto const force = [&](char const* member) { return probed({"s.nc", "--member", member})["states"][0]["forces"]["rod_force_x"].get<double>(); };
    EXPECT_GT(std::abs(force("0")), 0.01);
    EXPECT_NEAR(force("1"), force("0"), 0.01 * std::abs(force("0")));  // it lies on its way in both
}


/// Newton's and Euler's laws with what is said of force and torque, and what friction takes pair by pair.
TEST_F(StoredStates, AreExplainedByForcesThatMoveTheSlider) {
    for (std::string const law : {"paper", "conservative", "foundation"}) {
        write("s.toml", fmt::format(R"(schema = 1
[mechanism]
kind = "free_slider"
slider_mass = 0.2
slider_inertia_x = 3e-5
slider_inertia_y = 4e-5
slider_inertia_z = 5e-5
[contact]
law = "{}"
[friction]
[way]
roll = 0.3
pitch = -0.2
yaw = 0.1
offset_y = 1e-5
[initial]
y = 0.9e-4
z = -0.6e-4
vx = 0.2
vy = 0.004
vz = -0.003
roll = 0.3015
yaw = 0.1005
pitch = -0.1993
wx = 5
wy = -0.8
wz = 0.3
[study]
duration = 1
)", law));
        Json const state = probed({"s.toml"})["states"][0], how = state["explanation"];
        ASSERT_EQ(state["status"], "finished");
        auto const of = [&](std::string const& name) { return state["state"][name].get<double>(); };
        auto const slope = [&](std::string const& name) { return state["values"]["d_" + name].get<double>(); };
        Vector const force = how["force"], torque = how["torque"], spin{of("wx"), of("wy"), of("wz")};
        double const size = std::hypot(force[0], force[1], force[2]);
        EXPECT_GT(size, 1) << law;
        EXPECT_NEAR(0.2 * slope("vx"), force[0], 1e-10 * size);
        EXPECT_NEAR(0.2 * (slope("vy") + 9.81), force[1], 1e-10 * size);
        EXPECT_NEAR(0.2 * slope("vz"), force[2], 1e-10 * size);
        double const cr = std::cos(of("roll")), sr = std::sin(of("roll")), cy = std::cos(of("yaw")), sy = std::sin(of("yaw")), cp = std::cos(of("pitch")),
                     sp = std::sin(of("pitch"));
        Vector const axes[3] = {{cp * cy, sp * cy, -sy}, {cp * sy * sr - sp * cr, sp * sy * sr + cp * cr, cy * sr}, {cp * sy * cr + sp * sr, sp * sy * cr - cp * sr, cy * cr}};
        Vector const inertia{3e-5, 4e-5, 5e-5}, momentum{inertia[0] * spin[0], inertia[1] * spin[1], inertia[2] * spin[2]}, turned = cross(spin, momentum);
        char const* const names[] = {"wx", "wy", "wz"};
        double const most = std::hypot(torque[0], torque[1], torque[2]);
        for (std::size_t i = 0; i < 3; ++i) {
            double const along = axes[i][0] * torque[0] + axes[i][1] * torque[1] + axes[i][2] * torque[2];
            EXPECT_NEAR(inertia[i] * slope(names[i]) + turned[i], along, 1e-9 * most) << law << " " << names[i];
        }
        double taken = 0;
        for (Json const& pair : how["pairs"]) {
            EXPECT_NEAR(pair["friction"].get<double>(), pair["friction_coefficient"].get<double>() * pair["normal_force"].get<double>(), 1e-15 * size);
            taken += pair["friction"].get<double>() * pair["sliding_speed"].get<double>();
            EXPECT_EQ(pair["touches"], pair["depth"] > 0);
        }
        EXPECT_NEAR(taken, state["values"]["power_friction"].get<double>(), 1e-12 * taken);
        std::map<std::string, int> counts;
        for (Json const& mode : how["modes"]) ++counts[mode["kind"].get<std::string>() + "s"];
        for (std::string const kind : {"surfaces", "lines", "points"}) EXPECT_EQ(counts[kind], state["values"][kind].get<int>()) << law << " " << kind;
    }
}

/// Depths a moment later, which no kernel has to do with.
TEST_F(StoredStates, AreExplainedWithTheRatesOfTheirDepths) {
    std::string const header = "t,y,z,vy,vz,roll,yaw,pitch,wx,wy,wz\n";
    // Angles and rates about one axis, so that the angle's rate is its own.
    double const h = 1e-7, v = 0.02, w = 0.7;
    auto const row = [&](double t) { return fmt::format("0,{:.17g},{:.17g},{},{},0,0,{:.17g},0,0,{}\n", 2e-5 + v * t, -1e-5 - 2 * v * t, v, -2 * v, 1e-3 + w * t, w); };
    write("s.toml", "schema = 1\n[contact]\nlaw = \"conservative\"\n");
    write("s.csv", header + row(-h) + row(0) + row(h));
    Json const states = probed({"s.toml", "--csv", "s.csv"})["states"];
    for (std::size_t i = 0; i < 16; ++i) {
        auto const pair = [&](std::size_t at) { return states[at]["explanation"]["pairs"][i]; };
        double const slope = (pair(2)["depth"].get<double>() - pair(0)["depth"].get<double>()) / (2 * h);
        EXPECT_NEAR(pair(1)["rate"].get<double>(), slope, 1e-8) << i;
    }
}

TEST_F(StoredStates, OfRigidContactsTellDepthsAlone) {
    ASSERT_NO_FATAL_FAILURE(run_scene("schema = 1\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n[study]\nduration = \"20 ms\"\nsamples = 11\n"));
    Json const json = probed({"s.nc", "--time", "0.01"});
    Json const& state = json["states"][0];
    EXPECT_TRUE(state["values"]["fn_y_P1"].is_null());
    EXPECT_TRUE(state["values"]["surfaces"].is_null());
    EXPECT_TRUE(state["values"]["d_vy"].is_null());
    EXPECT_TRUE(state["explanation"]["force"][0].is_null());
    // The Y faces of an apex are apart by the clearances; its pose is small.
    double const upper = state["values"]["pen_y_P1"], lower = state["values"]["pen_y_P2"];
    EXPECT_NEAR(upper + lower, -2e-4, 1e-6);
    EXPECT_LT(upper, 1e-9);
    Outcome const listing = run({"probe", "s.nc", "--time", "0.01", "--explain"});
    EXPECT_NE(listing.out.find("those of rigid contacts depend on how a contact began"), std::string::npos) << listing.out;
}

TEST_F(StoredStates, ThatAreNotThereAreRefused) {
    ASSERT_NO_FATAL_FAILURE(run_scene(members));
    expect_refusal(2, "s.nc: has no member 7; it has 0 to 2", {"probe", "s.nc", "--member", "7"});
    expect_refusal(2, "--member is for states of result files, and s.toml is a scene; ", {"probe", "s.toml", "--member", "1"});
    expect_refusal(2, "--time is for states of result files, and s.toml is a scene; ", {"probe", "s.toml", "--time", "1"});
    expect_refusal(2, "--time abc: ", {"probe", "s.nc", "--time", "abc"});
    write("planar.toml", "schema = 1\n[mechanism]\nkind = \"planar_slider_crank\"\n");
    EXPECT_NE(run({"probe", "planar.toml", "--explain"}).err.find("--explain follows the forces of sliders with eight apices"), std::string::npos);
    Outcome const kept = run({"run", "s.toml", "-o", "k.nc", "--quiet", "--set", "study.store=statistics", "study.samples=0", "study.quantities=[\"mean_normal_force\"]"});
    ASSERT_EQ(kept.code, 0) << kept.err;
    expect_refusal(2, "k.nc: keeps statistics, no states of members; ", {"probe", "k.nc"});
}

TEST_F(StoredStates, AreExplainedInWords) {
    ASSERT_NO_FATAL_FAILURE(run_scene(members));
    Outcome const flight = run({"probe", "s.nc", "--time", "0", "--explain"});
    EXPECT_EQ(flight.code, 0) << flight.err;
    for (char const* const word : {"How the forces come about", "\n  P1        y_plus ", "touching     none; nearest is P", "modes        free flight", "law          conservative: ",
                                   "torque       0, 0, 0 N m about the centre of its hole"}) {
        EXPECT_NE(flight.out.find(word), std::string::npos) << word << "\n" << flight.out;
    }
    write("lies.toml", "schema = 1\n[contact]\nlaw = \"conservative\"\n[friction]\n[initial]\ny = \"-0.1001 mm\"\n");
    Outcome const lies = run({"probe", "lies.toml", "--explain"});
    EXPECT_NE(lies.out.find("touching     P1 y_plus, P4 y_plus, P8 y_plus, P5 y_plus\n"), std::string::npos) << lies.out;
    EXPECT_NE(lies.out.find("modes        y_plus surface P1 P4 P8 P5\n"), std::string::npos) << lies.out;
    Outcome const excluded = run({"probe", "s.toml", "--explain", "-o", "o.csv"});
    EXPECT_EQ(excluded.code, 2);
}

}  // namespace
}  // namespace slideway::testing::stored_states_test
