// Signals of a mechanism of one's own: series and quantities, as all others are, and read without the module.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <regex>

#include <fmt/format.h>

#include "tests/system/own_module_fixture.hpp"

namespace slideway::testing::own_signals_test {
namespace {

namespace fs = std::filesystem;

constexpr char const* motor_scene = R"(
schema = 1
[modules]
search = ["own"]
[mechanism]
kind = "motor_yoke"
crank_speed = "0 rad/s"
stall_torque = "0.5 N m"
no_load_speed = "60 rad/s"
[contact]
law = "kelvin_voigt"
[integrator]
rtol = 1e-9
[study]
members = 16
duration = "40 ms"
quantities = ["drive_work", "max_motor_torque", "min_motor_torque", "mean_motor_torque", "rms_motor_torque", "final_motor_torque", "max_motor_power", "mean_motor_power"]
verify = 0
[study.vary]
"mechanism.stall_torque" = { dist = "unif", low = 0.4, high = 0.6 }
)";

class OwnSignals : public ProgramWithOwnModules {
protected:
    OwnSignals() { write("s.toml", motor_scene); }
};

/// What they are follows from T = T0 (1 − ω/ω0): from the angle and speed of the crank, and from the work of the drive.
TEST_F(OwnSignals, AreSeriesAndQuantitiesOfTheirMembers) {
    provide_motor();
    ASSERT_EQ(run_scene({"--set", "study.samples=401", R"(study.quantities=["motor_torque", "motor_power", "drive_work", "max_motor_torque", "min_motor_torque", "mean_motor_torque", "rms_motor_torque", "final_motor_torque", "max_motor_power", "mean_motor_power"])"}, "s.nc").code, 0);
    auto const file = results("s.nc");
    EXPECT_EQ(file.unit("motor_torque"), "N m");
    EXPECT_EQ(file.long_name("motor_torque"), "torque of the motor");
    EXPECT_EQ(file.unit("max_motor_power"), "W");
    EXPECT_EQ(file.long_name("max_motor_power"), "power of the motor: largest value at the accepted steps");
    EXPECT_FALSE(file.has("rms_motor_power")) << "it is none of the statistics that the signal has";
    constexpr double seconds = 0.04, no_load = 60;
    auto const of = [&](char const* name) { return file.values(name); };
    auto const stall = of("mechanism_stall_torque"), torque = of("motor_torque"), power = of("motor_power"), speed = of("crank_angular_velocity");
    auto const angle = of("final_crank_angle"), at_end = of("final_crank_angular_velocity"), work = of("drive_work");
    auto const largest = of("max_motor_torque"), least = of("min_motor_torque"), mean = of("mean_motor_torque"), rms = of("rms_motor_torque"), last = of("final_motor_torque");
    std::size_t const samples = file.values("time").size();
    ASSERT_EQ(samples, 401u);
    for (std::size_t m = 0; m < stall.size(); ++m) {
        double squares = 0, most_power = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            double const expected = stall[m] * (1 - speed[m * samples + i] / no_load), seen = torque[m * samples + i];
            ASSERT_NEAR(seen, expected, 1e-14) << m << " " << i;
            ASSERT_NEAR(power[m * samples + i], expected * speed[m * samples + i], 1e-12) << m << " " << i;
            squares += (i == 0 || i + 1 == samples ? 0.5 : 1.0) * seen * seen / static_cast<double>(samples - 1);
            most_power = std::max(most_power, power[m * samples + i]);
        }
        EXPECT_EQ(largest[m], stall[m]) << "at rest";
        EXPECT_NEAR(last[m], stall[m] * (1 - at_end[m] / no_load), 1e-14);
        EXPECT_NEAR(least[m], *std::min_element(&torque[m * samples], &torque[m * samples] + samples), 1e-4);
        EXPECT_NEAR(mean[m], stall[m] * (1 - angle[m] / seconds / no_load), 1e-8);
        EXPECT_NEAR(rms[m], std::sqrt(squares), 1e-6);
        EXPECT_NEAR(of("max_motor_power")[m], most_power, 1e-3 * most_power);
        EXPECT_NEAR(of("mean_motor_power")[m] * seconds, work[m], 1e-12 * work[m]);
    }
}

/// Of a motor that turns at half of its no-load speed: half of 0.5 N m, and 30 rad/s times that.
TEST_F(OwnSignals, OfAStateAreProbed) {
    provide_motor();
    auto const json = run({"probe", "s.toml", "--set", "mechanism.crank_speed=30 rad/s", "--json"});
    ASSERT_EQ(json.code, 0) << json.err;
    EXPECT_NE(json.out.find(R"("motor_torque": 0.25)"), std::string::npos) << json.out;
    EXPECT_NE(json.out.find(R"("motor_power": 7.5)"), std::string::npos) << json.out;
    auto const listing = run({"probe", "s.toml", "--set", "mechanism.crank_speed=30 rad/s"}).out;
    EXPECT_TRUE(std::regex_search(listing, std::regex("\nmotor_torque +0.25 N m\nmotor_power +7.5 W\n"))) << listing;
    write("states.csv", "t,y,z,vy,vz,roll,yaw,pitch,wx,wy,wz,crank_angle,crank_angular_velocity\n0,0,0,0,0,0,0,0,0,0,0,0,0\n0,0,0,0,0,0,0,0,0,0,0,1,30\n");
    auto const table = run({"probe", "s.toml", "--csv", "states.csv"});
    ASSERT_EQ(table.code, 0) << table.err;
    EXPECT_NE(table.out.find(",motor_torque,motor_power,status\n"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find(",0.5,0,finished\n"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find(",0.25,7.5,finished\n"), std::string::npos) << table.out;
}

TEST_F(OwnSignals, OfARunInPartsAreThoseOfTheWholeOnEachInstructionSet) {
    provide_motor(best_and_scalar());
    std::string whole;
    for (std::string const& isa : best_and_scalar()) {
        ASSERT_EQ(run_scene({"--isa", isa}, isa + ".nc").code, 0);
        if (whole.empty()) whole = hash_of(isa + ".nc");
        EXPECT_EQ(hash_of(isa + ".nc"), whole);
    }
    ASSERT_EQ(run_scene({"--shard", "1/2"}, "s.nc").code, 0);
    fs::copy(path("s.nc.shards"), path("other.nc.shards"), fs::copy_options::recursive);
    ASSERT_EQ(run_scene({"--shard", "2/2"}, "s.nc").code, 0);
    ASSERT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 0);
    EXPECT_EQ(hash_of("s.nc"), whole);
    ASSERT_EQ(run_scene({"--resume"}, "other.nc").code, 0);
    EXPECT_EQ(hash_of("other.nc"), whole);
}

TEST_F(OwnSignals, AreInStatisticsLimitsAndSensitivities) {
    provide_motor();
    std::vector<std::string> const tolerance{"--set", "study.kind=tolerance", "study.design=lhs", R"(study.limits={max_motor_torque = { max = "500 N mm" }})"};
    ASSERT_EQ(run_scene(tolerance, "members.nc").code, 0);
    // A Latin hypercube of 16 has 8 members in each half: a stall torque up to 0.5 N m.
    auto const told = run({"info", "members.nc"}).out;
    EXPECT_NE(told.find("max_motor_torque"), std::string::npos) << told;
    EXPECT_NE(told.find("<= 0.5 N m"), std::string::npos) << told;
    EXPECT_NE(told.find("50.000"), std::string::npos) << told;
    auto const file = results("members.nc");
    auto const group = file.group("sensitivity");
    auto const rank = [&](char const* name) {
        for (DataFile::Variable const& variable : group->variables()) {
            if (variable.name == name) return group->read<double>(variable).front();
        }
        return 0.0;
    };
    EXPECT_NEAR(rank("max_motor_torque_rank_correlation"), 1, 1e-12) << "the torque at rest is what varies";
    // Statistics alone, in parts too, come to the same.
    auto statistics = tolerance;
    statistics.emplace_back("study.store=statistics");
    ASSERT_EQ(run_scene(statistics, "whole.nc").code, 0);
    for (std::string const part : {"1/2", "2/2"}) {
        auto options = statistics;
        options.insert(options.begin(), {"--shard", part});
        ASSERT_EQ(run_scene(options, "s.nc").code, 0);
    }
    ASSERT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 0);
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
    // Without the module the files say what they are.
    fs::remove_all(path("own"));
    auto const largest = file.values("max_motor_torque");
    double const mean = std::accumulate(largest.begin(), largest.end(), 0.0) / static_cast<double>(largest.size());
    for (std::string const name : {"members.nc", "s.nc"}) {
        Outcome const alone = run({"info", name});
        EXPECT_EQ(alone.code, 0) << alone.err;
        auto const at = alone.out.find("  max_motor_torque");
        ASSERT_NE(at, std::string::npos) << alone.out;
        std::string const line = alone.out.substr(at, alone.out.find('\n', at) - at);
        EXPECT_NE(line.find(" N m "), std::string::npos) << line;
        EXPECT_NE(line.find(fmt::format("{:.4g}", mean)), std::string::npos) << line;
    }
}

/// A yoke of the tree that tells again what the tables have.
constexpr char const* twin = R"(
    #include "kernels/mechanisms/scotch_yoke.hpp"
    namespace slideway::inline SLIDEWAY_ISA {
    struct SeenDrive : ScotchYokeDrive {
        static constexpr Key keys[] = {
            {"mechanism.gauge", &Inputs::mechanism_p, "1", Rule::positive, KeyGroup::mechanism, "factor of a gauge", 1}};
        static constexpr Signal signals[] = {
            {"push", "N", "sum of the normal forces", statistics_of(Statistic::maximum, Statistic::mean)},
            {"travel", "m", "way of the slider"},
        };
        static constexpr MechanismInfo info = [] {
            auto info = ScotchYokeDrive::info;
            info.name = "seen_yoke";
            info.has_exponents = false;  // not compiled for
            info.own_keys = keys;
            info.signals = signals;
            return info;
        }();
        template <class Real, class Report>
        SLIDEWAY_FN static void put_signals(Real, Real const*, SliderParameters<Real> const&, Report const& report, Real* values) {
            values[0] = report.contact.total_force();
            values[1] = report.x;
        }
    };
    using SeenYoke = SpatialSlider<SeenDrive>;
    }
    #define SLIDEWAY_MECHANISM SeenYoke
)";

constexpr char const* seen_scene = R"(
schema = 1
[modules]
search = ["own"]
[mechanism]
kind = "seen_yoke"
gauge = 2
[contact]
law = "conservative"
[friction]
[initial]
y = "-0.05 mm"
[study]
members = 8
duration = "50 ms"
samples = 11
quantities = ["energy_residual", "peak_normal_force", "mean_normal_force", "max_push", "mean_push", "max_travel", "final_travel", "push", "travel", "normal_force", "x"]
verify = 0
[study.vary]
"initial.vy" = { dist = "unif", low = -0.1, high = 0.1 }
)";

TEST_F(OwnSignals, HaveTheBitsOfTheTablesWhereTheyAreTheSame) {
    write("twin.hpp", twin);
    ASSERT_EQ(run({"compile", "twin.hpp", "-o", "own", "--isa", "scalar"}).code, 0);  // soonest compiled
    std::string without_gauge(seen_scene);
    without_gauge.erase(without_gauge.find("gauge = 2\n"), 10);
    write("s.toml", seen_scene);
    ASSERT_EQ(run_scene({}, "s.nc").code, 0);
    auto const file = results("s.nc");
    EXPECT_EQ(file.values("push"), file.values("normal_force"));
    EXPECT_EQ(file.values("travel"), file.values("x"));
    EXPECT_EQ(file.values("max_push"), file.values("peak_normal_force"));
    EXPECT_EQ(file.values("mean_push"), file.values("mean_normal_force"));
    EXPECT_GT(file.values("max_push").front(), 1);
    // It is the tree's yoke otherwise, whatever is asked for.
    std::vector<std::string> const same{"--force", "--set", R"(study.quantities=["energy_residual", "peak_normal_force"])"};
    auto in_tree = same;
    in_tree.emplace_back("mechanism.kind=scotch_yoke");
    ASSERT_EQ(run_scene(same, "own.nc").code, 0);
    write("s.toml", without_gauge);
    ASSERT_EQ(run_scene(in_tree, "tree.nc").code, 0);
    EXPECT_EQ(hash_of("own.nc"), hash_of("tree.nc"));
    // It alone has them, and what is wrong with a name is one line.
    expect_refusal(2, "\"max_push\" (there is no such quantity)", {"check", "s.toml", "--set", "mechanism.kind=scotch_yoke"});
    write("s.toml", seen_scene);
    expect_refusal(2, "it is a time series", {"check", "s.toml", "--set", "study.limits={push = { max = 1 }}"});
    expect_refusal(2, "max_travel", {"check", "s.toml", "--set", R"(study.quantities=["max_travels"])"});
    std::string const resolved = run({"check", "s.toml", "--resolved"}).out;
    EXPECT_NE(resolved.find("gauge = 2"), std::string::npos) << resolved;
    EXPECT_NE(resolved.find("\"max_travel\", \"final_travel\""), std::string::npos) << resolved;
    setenv("SLIDEWAY_MODULES", path("own").c_str(), 1);
    std::string const list = run({"list"}).out;
    unsetenv("SLIDEWAY_MODULES");
    EXPECT_NE(list.find("sum of the normal forces: time mean (seen_yoke)"), std::string::npos);
    EXPECT_NE(list.find("way of the slider (seen_yoke)"), std::string::npos);
}

TEST_F(OwnSignals, WithoutTheFunctionThatTellsThemDoNotCompile) {
    std::string text(twin);
    text.replace(text.find("put_signals"), 11, "tell_signals");
    write("bad.hpp", text);
    Outcome const outcome = run({"compile", "bad.hpp", "-o", "bad", "--isa", "scalar"});
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("there is no put_signals(t, state, parameters, report, values)"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace slideway::testing::own_signals_test
