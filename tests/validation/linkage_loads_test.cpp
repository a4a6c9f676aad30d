// Loads, springs and stops of linkages that a scene describes: closed forms, virtual work, the planar slider-crank with the same, and their energy.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/backend/backend.hpp"
#include "host/library/slideway.hpp"
#include "tests/support/planar_linkage.hpp"

namespace slideway::linkage_loads_test {
namespace {

using std::numbers::pi;

std::vector<double> column(Result const& result, std::string const& name) { return result.column(name).values(); }
double largest(std::vector<double> const& of) { return *std::ranges::max_element(of); }
double number(Result const& result, std::string const& name) { return column(result, name)[0]; }

std::string const start = "schema = 1\n[mechanism]\nkind = \"linkage\"\n", tight = "[integrator]\nrtol = 1e-13\natol = 1e-13\nmax_step = 0.02\n";
/// A mass on a line that rises by 0.3 rad, which goes up as the displacement grows; the mass is turned by 0.4 rad.
std::string sledge(double position, double speed, double gravity = 9.81) {
    return fmt::format("schema = 1\n[mechanism]\nkind = \"linkage\"\ngravity = {}\n[body.mass]\nmass = 2\n[link.way]\nkind = \"prismatic\"\nfirst = \"ground\"\nsecond = \"mass\"\n"
                       "direction = 0.3\nturn = 0.4\nposition = {}\nspeed = {}\n", gravity, position, speed);
}

/// x'' + 2 ζ ω x' + ω² x = 0.
struct Swing {
    double omega, zeta, x, v;
    double at(double t) const {
        double const damped = omega * std::sqrt(1 - zeta * zeta);
        return std::exp(-zeta * omega * t) * (x * std::cos(damped * t) + (v + zeta * omega * x) / damped * std::sin(damped * t));
    }
};

struct TableFile {
    explicit TableFile(std::string const& text) : path(std::filesystem::temp_directory_path() / fmt::format("slideway_linkage_loads_{}.csv", getpid())) { std::ofstream(path) << text; }
    TableFile(TableFile const&) = delete;
    TableFile& operator=(TableFile const&) = delete;
    ~TableFile() { std::filesystem::remove(path); }
    std::filesystem::path path;
};

/// A four-bar of ideal pins on a drive, with loads.
std::string four_bar(std::string const& rest, std::string const& drive = "") {
    return "schema = 1\n[mechanism]\nkind = \"linkage\"\ncrank_speed = \"150 rpm\"\n[drive]\nbody = \"crank\"\n" + drive +
           "[body.crank]\nmass = 0.4\ninertia = 3e-4\ncenter_x = 0.03\n[body.coupler]\nmass = 0.6\ninertia = 2e-3\ncenter_x = 0.12\nangle = 0.5\n"
           "[body.rocker]\nmass = 0.5\ninertia = 1e-3\ncenter_x = 0.07\nangle = 1.4\n"
           "[link.shaft]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"crank\"\n[link.post]\nkind = \"revolute\"\nfirst = \"ground\"\nfirst_x = 0.22\nsecond = \"rocker\"\n"
           "[link.crank_pin]\nkind = \"revolute\"\nfirst = \"crank\"\nfirst_x = 0.06\nsecond = \"coupler\"\n"
           "[link.coupler_pin]\nkind = \"revolute\"\nfirst = \"coupler\"\nfirst_x = 0.25\nsecond = \"rocker\"\nsecond_x = 0.15\n" + rest;
}

}  // namespace

TEST(LinkageLoads, OfASpringOnAJointSwingAsADampedOscillator) {
    double const k = 300, c = 4, omega = std::sqrt(k / 2), sag = 2 * 9.81 * std::sin(0.3) / k, preload = 1.5;
    Swing const swing{omega, c / (2 * std::sqrt(k * 2)), 0.1 - 0.04 + sag + preload / k, 0.2};
    std::string const numbers = fmt::format("stiffness = {}\ndamping = {}\npreload = {}\n", k, c, preload);
    // Along the joint; and between two points of its line, the anchor 2 m down from where the joint begins.
    std::string const springs[] = {"[spring.return]\nlink = \"way\"\nrest_length = 0.04\n" + numbers,
                                   fmt::format("[spring.return]\non = \"mass\"\nanchor_x = {}\nanchor_y = {}\nrest_length = 2.04\n", -2 * std::cos(0.3), -2 * std::sin(0.3)) + numbers};
    for (std::string const& spring : springs) {
        Result const result = Ensemble::parse(sledge(0.1, 0.2) + spring + tight + "[study]\nduration = 2\nsamples = 21\n").run();
        auto const s = column(result, "mass_displacement");
        ASSERT_EQ(s.size(), 21u);
        for (std::size_t i = 0; i < s.size(); ++i) EXPECT_NEAR(s[i], 0.04 - sag - preload / k + swing.at(0.1 * double(i)), 1e-11) << spring << i;
    }
}

TEST(LinkageLoads, OfATorsionalSpringSwingAsATorsionPendulum) {
    double const k = 5, c = 0.02, inertia = 0.03;
    // By the joint, and by its bodies.
    for (std::string const where : {"link = \"pin\"\n", "on = \"disk\"\n"}) {
        Result const result = Ensemble::parse(start + fmt::format("[body.disk]\nmass = 1\ninertia = {}\nangle = 0.8\n[link.pin]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"disk\"\n"
                                                                  "[spring.wire]\n{}angle = 0.3\nangular_stiffness = {}\nangular_damping = {}\n", inertia, where, k, c) +
                                              tight + "[study]\nduration = 3\nsamples = 31\nquantities = [\"wire_energy\", \"wire_torque\", \"spring_loss\", \"wire_work\", \"energy_residual\"]\n").run();
        double const omega = std::sqrt(k / inertia);
        Swing const swing{omega, c / (2 * std::sqrt(k * inertia)), 0.5, 0};
        auto const angle = column(result, "disk_angle"), speed = column(result, "disk_angular_velocity"), energy = column(result, "wire_energy"), torque = column(result, "wire_torque");
        for (std::size_t i = 0; i < angle.size(); ++i) {
            EXPECT_NEAR(angle[i], 0.3 + swing.at(0.1 * double(i)), 5e-11) << i;
            EXPECT_NEAR(energy[i], 0.5 * k * std::pow(angle[i] - 0.3, 2), 1e-14);
            EXPECT_NEAR(torque[i], k * (angle[i] - 0.3) + c * speed[i], 1e-13);
        }
        // All that it does is to take up, and to lose.
        EXPECT_NEAR(number(result, "wire_work"), energy.front() - energy.back() - number(result, "spring_loss"), 1e-10);
        EXPECT_NEAR(number(result, "wire_work"), 0.5 * inertia * speed.back() * speed.back(), 1e-10);
        EXPECT_NEAR(number(result, "energy_residual"), 0, 1e-11);
    }
}

/// Of a force along the ground's axes, and of one along the body's, which are 0.1 rad from the line.
TEST(LinkageLoads, OfAConstantForceAccelerateAMassOnAnIncline) {
    struct { std::string words; double along; } const cases[] = {
        {"force_x = 12\nforce_y = -5\n", 12 * std::cos(0.3) - 5 * std::sin(0.3)},
        {"frame = \"body\"\nforce_x = 12\nforce_y = -5\nscale = 1.5\n", 1.5 * (12 * std::cos(0.1) + 5 * std::sin(0.1))},
    };
    for (auto const& one : cases) {
        Result const result = Ensemble::parse(sledge(0.1, -1) + "[load.pull]\non = \"mass\"\npoint_x = 0.2\n" + one.words + tight +
                                              "[study]\nduration = 2\nsamples = 2\nquantities = [\"load_work\", \"pull_work\", \"pull_power\"]\n").run();
        double const a = one.along / 2 - 9.81 * std::sin(0.3), s = column(result, "mass_displacement")[1], way = -2 + 2 * a;
        EXPECT_NEAR(s, 0.1 + way, 1e-11 * std::abs(way)) << one.words;
        EXPECT_NEAR(number(result, "load_work"), one.along * way, 1e-11 * std::abs(one.along * way));
        EXPECT_NEAR(number(result, "pull_work"), one.along * way, 1e-11 * std::abs(one.along * way));
        EXPECT_NEAR(column(result, "pull_power")[1], one.along * (-1 + 2 * a), 1e-10);
    }
}

/// Between two stops that lose nothing a mass goes to and fro: flights of 2 L at v, and half periods of the contact.
TEST(LinkageLoads, OfStopsThatLoseNothingLeaveTheSpeed) {
    double const k = 4e4, v = 1.5, period = 2 * (0.2 / v + pi * std::sqrt(2 / k));
    std::string const stops = fmt::format("[stop.front]\nlink = \"way\"\nblocks = \"+x\"\nposition = 0.1\nstiffness = {0}\n[stop.back]\nlink = \"way\"\nblocks = \"-x\"\nposition = -0.1\nstiffness = {0}\n", k);
    Result const result = Ensemble::parse(sledge(0.02, v, 0) + stops + "[integrator]\nrtol = 1e-12\natol = 1e-12\n[study]\nsamples = 2\nduration = " + fmt::format("{:.17g}", 3 * period) +
                                          "\nquantities = [\"energy_change\", \"spring_loss\", \"energy_residual\", \"front_work\", \"front_force\"]\n").run();
    EXPECT_NEAR(column(result, "mass_displacement")[1], 0.02, 1e-8);
    EXPECT_NEAR(column(result, "mass_velocity")[1], v, 1e-8);
    EXPECT_NEAR(number(result, "energy_change"), 0, 1e-8);
    EXPECT_EQ(number(result, "spring_loss"), 0);
    EXPECT_NEAR(number(result, "front_work"), 0, 1e-7);
    // It has pushed.
    Result const half = Ensemble::parse(sledge(0.02, v, 0) + stops + fmt::format("[integrator]\nrtol = 1e-11\natol = 1e-11\n[study]\nsamples = 2\nduration = {:.17g}\nquantities = [\"front_force\", \"front_energy\"]\n", 0.08 / v + pi / 2 * std::sqrt(2 / k))).run();
    EXPECT_NEAR(column(half, "front_force")[1], v * std::sqrt(2 * k), 1e-4 * v * std::sqrt(2 * k));
    EXPECT_NEAR(column(half, "front_energy")[1], v * v, 1e-4);
}

/// A stop at an angle between two bodies that nothing else joins turns: their common speed stays, that against one another is reversed.
TEST(LinkageLoads, OfAStopBetweenTwoAnglesReverseTheSpeedBetweenThem) {
    auto const disk = [](char const* name, double inertia, double speed) { return fmt::format("[body.{0}]\nmass = 1\ninertia = {1}\nspeed = {2}\n[link.pin_{0}]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"{0}\"\n", name, inertia, speed); };
    Result const result = Ensemble::parse(start + disk("one", 0.02, 9) + disk("other", 0.05, 2) + "[stop.dog]\non = \"one\"\nagainst = \"other\"\nangle = 0.5\nblocks = \"+angle\"\nangular_stiffness = 4e3\n"
                                          "[integrator]\nrtol = 1e-11\natol = 1e-11\n[study]\nduration = 0.2\nsamples = 2\n").run();
    double const common = (0.02 * 9 + 0.05 * 2) / 0.07;
    EXPECT_NEAR(column(result, "one_angular_velocity")[1], 2 * common - 9, 1e-7);
    EXPECT_NEAR(column(result, "other_angular_velocity")[1], 2 * common - 2, 1e-7);
}

/// What a force on the rocker asks of the drive is its virtual work; also of one between coupler and rocker, and of a torque between them.
TEST(LinkageLoads, InALoopAskTheDriveForTheirVirtualWork) {
    std::string const study = "[integrator]\nrtol = 1e-9\n[study]\nrevolutions = 1\nsamples_per_revolution = 40\nquantities = [\"drive_torque\"{}]\n";
    Result const bare = Ensemble::parse(four_bar(fmt::format(fmt::runtime(study), ""))).run();
    auto const crank = column(bare, "crank_angle"), coupler = column(bare, "coupler_angle"), rocker = column(bare, "rocker_angle"), w3 = column(bare, "rocker_angular_velocity"),
               w2 = column(bare, "coupler_angular_velocity"), without = column(bare, "drive_torque");
    double const omega = 150 * 2 * pi / 60;
    std::string const loads = "[load.force]\non = \"rocker\"\nforce_x = 40\nforce_y = -25\npoint_x = 0.1\npoint_y = 0.02\n[load.tool]\non = \"rocker\"\nagainst = \"coupler\"\ntorque = 1.2\nforce_x = 30\npoint_x = 0.05\nframe = \"body\"\n";
    Result const with = Ensemble::parse(four_bar(loads + fmt::format(fmt::runtime(study), ", \"force_power\", \"tool_power\""))).run();
    auto const torque = column(with, "drive_torque"), of_force = column(with, "force_power"), of_tool = column(with, "tool_power");
    for (std::size_t i = 0; i < crank.size(); ++i) {
        // Velocities from the angles and their rates.
        double const c3 = std::cos(rocker[i]), s3 = std::sin(rocker[i]), ax = 0.1 * c3 - 0.02 * s3, ay = 0.1 * s3 + 0.02 * c3;
        double const force = w3[i] * (-ay * 40 + ax * -25);
        // The tool's point as both bodies carry it: the coupler's velocity there is that of the crank pin and of its own turning.
        double const px = 0.22 + 0.05 * c3, py = 0.05 * s3, pin_x = 0.06 * std::cos(crank[i]), pin_y = 0.06 * std::sin(crank[i]);
        double const vx = -0.05 * s3 * w3[i] - (-pin_y * omega - (py - pin_y) * w2[i]), vy = 0.05 * c3 * w3[i] - (pin_x * omega + (px - pin_x) * w2[i]);
        double const tool = 1.2 * (w3[i] - w2[i]) + 30 * (c3 * vx + s3 * vy);
        EXPECT_NEAR(of_force[i], force, 1e-6) << i;
        EXPECT_NEAR(of_tool[i], tool, 1e-6) << i;
        EXPECT_NEAR(torque[i] - without[i], -(force + tool) / omega, 1e-6) << i;
    }
    EXPECT_GT(std::abs(of_tool[3]), 1);
    EXPECT_EQ(coupler.size(), crank.size());
}

/// On a drive, with a spring, a torsional one, a load by a table over time and one over the crank's angle: the books balance, line by line.
TEST(LinkageLoads, KeepTheirBooks) {
    TableFile const file("time [s],crank_angle [deg],push\n0,0,0\n0.1,90,30\n0.25,180,-20\n0.5,360,0\n");
    std::string const table = fmt::format("table = \"{}\"\ncolumn = \"push\"\n", file.path.string());
    std::string const loads = "[load.tool]\non = \"rocker\"\nforce_x = 1\nforce_y = 0.5\npoint_x = 0.1\nover = \"time\"\n" + table + "[load.press]\non = \"coupler\"\ntorque = 0.02\nover = \"crank_angle\"\n" + table +
                              "[spring.pull]\non = \"coupler\"\nagainst = \"rocker\"\npoint_x = 0.1\nanchor_x = 0.05\nanchor_y = 0.1\nstiffness = 700\ndamping = 5\nrest_length = 0.12\n"
                              "[spring.bush]\nlink = \"coupler_pin\"\nangle = 1\nangular_stiffness = 3\nangular_damping = 0.01\n"
                              "[stop.bump]\non = \"rocker\"\nangle = 2.1\nblocks = \"+angle\"\nangular_stiffness = 40\nangular_dissipation = 0.3\n";
    Result const result = Ensemble::parse(four_bar(loads + "[integrator]\nrtol = 1e-13\natol = 1e-13\n[study]\nrevolutions = 2\nsamples_per_revolution = 50\nquantities = [\"energy_residual\", \"energy_change\", \"drive_work\", \"load_work\", "
                                                   "\"spring_loss\", \"tool_work\", \"press_work\", \"pull_work\", \"bush_work\", \"bump_work\", \"pull_energy\", \"bush_energy\", \"bump_energy\", \"bump_torque\"]\n")).run();
    EXPECT_EQ(number(result, "status"), 0);
    EXPECT_NEAR(number(result, "energy_residual"), 0, 1e-9);
    EXPECT_NEAR(number(result, "load_work"), number(result, "tool_work") + number(result, "press_work"), 1e-12);
    EXPECT_GT(std::abs(number(result, "tool_work")), 1e-3);
    double elements = 0, stored = 0;
    for (std::string const name : {"pull", "bush", "bump"}) {
        auto const energy = column(result, name + "_energy");
        elements += number(result, name + "_work"), stored += energy.back() - energy.front();
        EXPECT_GT(largest(energy), 1e-3) << name;
    }
    EXPECT_GT(largest(column(result, "bump_torque")), 1);
    EXPECT_NEAR(elements, -stored - number(result, "spring_loss"), 1e-9);
    EXPECT_GT(number(result, "spring_loss"), 0.01);
    // Without a stop, whose touch is a kink, to rounding.
    Result const smooth = Ensemble::parse(four_bar(loads.substr(0, loads.find("[stop")) + "[integrator]\nrtol = 1e-13\natol = 1e-13\n[study]\nrevolutions = 2\nquantities = [\"energy_residual\"]\n")).run();
    EXPECT_NEAR(number(smooth, "energy_residual"), 0, 2e-12);
}

/// The same loads, spring and stop on the slider and the crank of the planar slider-crank, between walls that it does not reach.
TEST(LinkageLoads, MoveAsThePlanarSliderCrankUnderTheSame) {
    std::string const description =
        testing::planar_linkage(0.2) +
        "[load.pull]\non = \"slider\"\nforce_x = 60\nforce_y = 9\npoint_x = 0.004\npoint_y = 0.002\ntorque = 0.003\nframe = \"body\"\n[load.brake]\non = \"crank\"\ntorque = -0.3\n"
        "[spring.back]\non = \"slider\"\nanchor_x = 0.1\nanchor_y = 0.2\npoint_y = 0.001\nstiffness = 400\ndamping = 1.5\nrest_length = 0.2\npreload = 2\n"
        "[stop.front]\nlink = \"way\"\nblocks = \"-x\"\nposition = 0.25\nstiffness = 3e4\ndissipation = 0.4\n[contact]\nrestitution = 0.4\n[integrator]\nrtol = 1e-10\n";
    std::string const study = "[study]\nduration = 0.03\nsamples = 31\nquantities = [\"contact_onsets\", \"load_work\", \"spring_loss\", \"energy_residual\"]\n";
    Settings settings{{"study.samples", "31"}, {"study.duration", "0.03"}, {"integrator.rtol", "1e-10"}, {"integrator.atol", "1e-11"}, {"study.quantities", "[\"contact_onsets\", \"load_work\", \"spring_loss\", \"energy_residual\"]"}};
    for (auto const& [key, value] : std::initializer_list<std::pair<char const*, char const*>>{
             {"load.pull.force_x", "60"}, {"load.pull.force_y", "9"}, {"load.pull.point_x", "0.004"}, {"load.pull.point_y", "0.002"}, {"load.pull.torque_z", "0.003"}, {"load.pull.frame", "slider"},
             {"joint.clearance", "0.2"}, {"load.brake.on", "crank"}, {"load.brake.torque", "-0.3"}, {"spring.back.anchor_x", "0.1"}, {"spring.back.anchor_y", "0.2"}, {"spring.back.point_y", "0.001"}, {"spring.back.stiffness", "400"},
             {"spring.back.damping", "1.5"}, {"spring.back.rest_length", "0.2"}, {"spring.back.preload", "2"}, {"stop.front.blocks", "-x"}, {"stop.front.position", "0.25"}, {"stop.front.stiffness", "3e4"},
             {"stop.front.dissipation", "0.4"}})
        settings.push_back({key, value});
    Result const known = Ensemble::read(SLIDEWAY_SCENES "/planar_flores.toml", settings).run();
    Result const described = Ensemble::parse(description + study).run();
    EXPECT_EQ(number(known, "contact_onsets"), 0);
    for (char const* const name : {"load_work", "spring_loss"}) {
        EXPECT_NEAR(number(described, name), number(known, name), 5e-8) << name;
        EXPECT_GT(std::abs(number(known, name)), 0.01) << name;
    }
    EXPECT_NEAR(number(described, "energy_residual"), 0, 1e-8);
    for (auto const& [one, other] : {std::pair("rod_angle", "rod_angle"), {"crank_angle", "crank_angle"}, {"slider_angle", "pitch"}}) {
        auto const a = column(described, one), b = column(known, other);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-8) << one << ' ' << i;
    }
}

TEST(LinkageLoads, HaveOneHashOnEveryInstructionSetAndNumberOfThreads) {
    std::string const loads = "[load.tool]\non = \"rocker\"\nforce_x = 40\npoint_x = 0.1\nframe = \"body\"\n[spring.pull]\non = \"coupler\"\nagainst = \"rocker\"\npoint_x = 0.1\nanchor_y = 0.1\nstiffness = 700\ndamping = 5\nrest_length = 0.12\n"
                              "[stop.bump]\non = \"rocker\"\nangle = 2\nblocks = \"+angle\"\nangular_stiffness = 40\nangular_dissipation = 0.3\n";
    Ensemble const ensemble = Ensemble::parse(four_bar(loads + "[study]\nmembers = 13\nrevolutions = 1\nverify = 0\nquantities = [\"tool_work\", \"pull_work\", \"bump_work\", \"energy_residual\"]\n[study.vary]\n"
                                                               "\"load.tool.force_x\" = { dist = \"unif\", low = 20, high = 60 }\n\"spring.pull.stiffness\" = { dist = \"unif\", low = 500, high = 900 }\n"
                                                               "\"stop.bump.angle\" = { dist = \"unif\", low = 1.9, high = 2.1 }\n"));
    Result const result = ensemble.run({.threads = 2});
    auto const work = column(result, "bump_work");
    EXPECT_GT(largest(work) - *std::ranges::min_element(work), 1e-4);
    for (Isa const isa : built_isas()) {
        if (is_supported(isa)) EXPECT_EQ(ensemble.run({.threads = 1, .isa = std::string(name_of(isa))}).payload_hash(), result.payload_hash()) << name_of(isa);
    }
}

/// Exponents of a damped pendulum on a torsional spring are its decay, −c/(2 I), twice; their sum is the trace.
TEST(LinkageLoads, CountInExponents) {
    Result const result = Ensemble::parse(start + "gravity = 0\n[body.disk]\nmass = 1\ninertia = 0.03\nangle = 0.8\n[link.pin]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"disk\"\n"
                                                  "[spring.wire]\non = \"disk\"\nangle = 0.3\nangular_stiffness = 5\nangular_damping = 0.06\n[study]\nkind = \"lyapunov\"\nduration = 20\nexponents = 2\n").run();
    auto const exponents = column(result, "lyapunov_exponent");
    ASSERT_EQ(exponents.size(), 2u);
    EXPECT_NEAR(exponents[0] + exponents[1], -2, 1e-8);
    for (double const exponent : exponents) EXPECT_NEAR(exponent, -1, 0.05);
}

}  // namespace slideway::linkage_loads_test
