// The jobs of examples/jobs: each runs, and comes to what can be known without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "host/store/result_view.hpp"
#include "tests/support/shell.hpp"

namespace slideway::jobs_test {
namespace {

std::string const jobs = std::string(SLIDEWAY_SOURCE) + "/examples/jobs/";

/// The result of a job, run once.
class Job {
public:
    /// @param options more of the command line
    Job(std::string const& job, std::string const& options)
        : folder_(std::filesystem::temp_directory_path() / ("slideway_job_" + std::to_string(getpid()) + "_" + std::to_string(++count))) {
        std::filesystem::create_directories(folder_);
        auto const run = testing::run_shell(folder_, std::string(SLIDEWAY_BINARY) + " run '" + jobs + job + "' -o job.nc " + options);
        EXPECT_EQ(run.code, 0) << run.err;
    }
    ~Job() { std::filesystem::remove_all(folder_); }
    Job(Job const&) = delete;
    Job& operator=(Job const&) = delete;

    std::vector<double> values(std::string const& name) const { return ResultReader((folder_ / "job.nc").string()).values(name); }
    double mean(std::string const& name) const {
        auto const values = this->values(name);
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    }

private:
    static inline int count = 0;
    std::filesystem::path folder_;
};

/// Work of the indicator diagram on the pump without clearance, by the rule of trapezia over straight lines between its rows [J per turn].
double work_of_indicator() {
    std::ifstream file(jobs + "indicator.csv");
    std::string line;
    std::getline(file, line);
    std::vector<double> angle, pressure;
    char comma;
    for (double a, p; file >> a >> comma >> p;) angle.push_back(a * std::numbers::pi / 180), pressure.push_back(1e5 * p);
    double const r = 0.03, l = 0.12, area = 4.909e-4;
    auto const x = [&](double t) { return r * std::cos(t) + std::sqrt(l * l - r * r * std::sin(t) * std::sin(t)); };
    double work = 0;
    constexpr int parts = 36'000;
    for (int i = 0; i < parts; ++i) {
        double const a = 2 * std::numbers::pi * i / parts, b = 2 * std::numbers::pi * (i + 1) / parts, middle = 0.5 * (a + b);
        std::size_t row = 0;
        while (row + 2 < angle.size() && angle[row + 1] <= middle) ++row;
        double const share = (middle - angle[row]) / (angle[row + 1] - angle[row]);
        work -= area * std::lerp(pressure[row], pressure[row + 1], share) * (x(b) - x(a));
    }
    return work;
}

TEST(Jobs, PumpDoesTheWorkOfItsIndicatorDiagram) {
    std::string const few = "--set study.members=16 --set study.verify=0";
    Job const pump("pump.toml", few), idle("pump.toml", few + " --set 'study.vary.\"load.plunger.scale\"={dist=\"const\",value=0}'");
    double const work = pump.mean("load_work") / 5, lost = pump.mean("friction_loss"), given = pump.mean("drive_work");
    // Between rows the pressure is no straight line.
    EXPECT_NEAR(work, work_of_indicator(), 0.01 * std::abs(work));
    EXPECT_GT(lost, 20 * idle.mean("friction_loss"));
    EXPECT_NEAR(given, -5 * work + lost, 0.01 * given);
}

TEST(Jobs, PressTakesItsStrokesFromTheFlywheel) {
    std::string const few = "--set study.members=8 --set study.verify=0";
    Job const press("press.toml", few), light("press.toml", few + " --set 'study.vary.\"drive.inertia\"={dist=\"const\",value=0.05}'");
    double const work = press.mean("load_work"), given = press.mean("drive_work");
    // What the drive gives and does not go into the strokes is in friction, impacts and what turns.
    double const lost = press.mean("friction_loss") + press.mean("damping_loss"), kept = press.mean("energy_change");
    EXPECT_LT(work, -50);
    EXPECT_NEAR(given + work, lost + kept, 1e-4 * given);
    // A flywheel loses what a stroke takes: a light one slows the press down more, and it makes fewer strokes.
    EXPECT_GT(light.mean("load_work"), work);
}

TEST(Jobs, CarriageFollowsItsProfile) {
    // There and back it stops where it began: all that the drive gives is lost, but for what the slider keeps across the way.
    Job const job("carriage.toml", "--set study.members=4 --set study.verify=0");
    double const given = job.mean("drive_work");
    EXPECT_GT(given, 0);
    EXPECT_NEAR(given, job.mean("friction_loss") + job.mean("damping_loss") + job.mean("energy_change"), 1e-4 * given);
}

/// Cells of a row of a table without commas in its cells.
std::vector<std::string> cells_of(std::string const& row) {
    std::vector<std::string> cells;
    std::istringstream in(row);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

TEST(Jobs, ExportHasTheNumbersOfTheResult) {
    auto const folder = std::filesystem::temp_directory_path() / ("slideway_export_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::string const programs = std::filesystem::path(SLIDEWAY_BINARY).parent_path().string();
    auto const run = testing::run_shell(folder, "PATH='" + programs + "':\"$PATH\" sh '" + jobs + "export.sh' --quiet --set study.members=8 study.verify=0");
    ASSERT_EQ(run.code, 0) << run.err;
    ResultReader const results((folder / "pump.nc").string());
    std::vector<double> const works = results.values("load_work"), heights = results.values("y");

    std::ifstream members(folder / "pump_members.csv"), series(folder / "pump_series.csv"), mat(folder / "pump.mat", std::ios::binary);
    std::string row;
    std::getline(members, row);
    auto const header = cells_of(row);
    auto const place = static_cast<std::size_t>(std::ranges::find(header, "load_work [J]") - header.begin());
    ASSERT_LT(place, header.size()) << row;
    EXPECT_NE(row.find(",load.plunger.scale,"), row.npos) << row;
    for (double const work : works) {
        ASSERT_TRUE(std::getline(members, row));
        EXPECT_EQ(std::stod(cells_of(row).at(place)), work);
    }
    EXPECT_FALSE(std::getline(members, row));
    std::getline(series, row);
    EXPECT_EQ(row, "member,time [s],y [m],vy [m s-1]");
    for (double const height : heights) {
        ASSERT_TRUE(std::getline(series, row));
        EXPECT_EQ(std::stod(cells_of(row).at(2)), height);
    }
    EXPECT_EQ(heights.size(), 8u * 501u);
    std::string title(6, ' ');
    mat.read(title.data(), 6);
    EXPECT_EQ(title, "MATLAB");
    EXPECT_GT(std::filesystem::file_size(folder / "pump.mat"), 2 * 8 * heights.size());
    std::filesystem::remove_all(folder);
}

constexpr double weight = 9.81;  // of a kilogram [N]

/// e of a = χ v: a (1 + e) = ln[(1 + a)/(1 − e a)].
double restitution_of(double a) {
    double low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
        double const e = 0.5 * (low + high);
        (e * a < 1 && a * (1 + e) - std::log((1 + a) / (1 - e * a)) > 0 ? low : high) = e;
    }
    return low;
}

TEST(Jobs, EndStopsTakeWhatFrictionLeavesThem) {
    std::string const alike = "--set study.members=4 --set study.verify=0 --set 'study.vary={\"initial.z\"={dist=\"const\",value=0}}'";
    Job const job("end_stops.toml", alike);
    double const mass = 0.8, friction = 0.1 * mass * weight;
    // It meets the buffer, comes back and slides to rest before it meets the other one.
    double const before = 0.5 * mass * 0.5 * 0.5 - friction * 0.05, speed = std::sqrt(2 * before / mass), e = restitution_of(7.7 * speed);
    double const lost = job.mean("spring_loss");
    EXPECT_LT(e * e * before / friction, 0.1);
    // Friction takes its share on the buffer too, over twice the depth at most.
    EXPECT_LT(lost, (1 - e * e) * before);
    EXPECT_GT(lost, (1 - e * e) * (before - 2 * friction * speed * std::sqrt(mass / 1e5)));
    EXPECT_NEAR(job.mean("energy_change"), -0.5 * mass * 0.5 * 0.5, 1e-6);
    EXPECT_NEAR(job.mean("friction_loss"), 0.5 * mass * 0.5 * 0.5 - lost, 2e-6);
}

TEST(Jobs, OilFilmCarriesItsTableAsReynoldsSays) {
    double const mass = 20, press = 1800, all = press + mass * weight, viscosity = 0.06, gap = 40e-6, length = 0.2, width = 0.06, depth = 0.08;
    double const squeeze = viscosity * depth * depth * depth * (length - 0.63 * depth), sides = 2 * viscosity * length * width / gap;
    for (char const* const seconds : {"0.5", "3"}) {
        Job const job("oil_film.toml", "--set study.members=2 --set study.verify=0 --set 'study.vary={\"film.viscosity\"={dist=\"const\",value=0.06}}'"
                                       " --set study.duration=" + std::string(seconds));
        // The film below pushes and the one above holds; the sides are sheared.
        double const sunk = job.mean("load_work") / press, below = gap - sunk, above = gap + sunk;
        double const pushed = 0.5 * squeeze * (1 / (below * below) - 1 / (above * above)) + sides * sunk;
        EXPECT_NEAR(pushed, all * std::stod(seconds), 1e-5 * pushed);
        EXPECT_NEAR(job.mean("film_loss"), all * sunk, 1e-5 * all * sunk);
        EXPECT_NEAR(job.mean("peak_position_error"), sunk, 1e-5 * sunk);
        EXPECT_EQ(job.mean("contact_onsets"), 0);
    }
}

TEST(Jobs, ShakenSpringTakesThePowerOfItsResonanceCurve) {
    auto const alike = [](int seconds) {
        return "--set study.members=4 --set study.verify=0 --set study.duration=" + std::to_string(seconds) +
               " --set 'study.vary={\"initial.z\"={dist=\"const\",value=0}}'";
    };
    // Once it swings evenly, with the amplitude a/|k/m − w² + i w c/m|.
    double const m = 0.8, k = 800, c = 2.5, w = 2 * std::numbers::pi * 4, amplitude = 1.5 / std::hypot(k / m - w * w, w * c / m);
    double const power = 0.5 * c * w * w * amplitude * amplitude;
    Job const longer("shaken_spring.toml", alike(10)), shorter("shaken_spring.toml", alike(9));
    for (char const* const quantity : {"ground_work", "spring_loss"}) {
        double const late = longer.mean(quantity) - shorter.mean(quantity);
        EXPECT_NEAR(late, power, 1e-3 * power) << quantity;
    }
}

TEST(Jobs, OverhangPressesItsEdgesAsItsMomentsSay) {
    // At constant speed, between the landing after the start and the reversal.
    auto const until = [](char const* seconds) {
        return std::string("--set study.members=2 --set study.verify=0 --set 'study.vary={\"initial.vz\"={dist=\"const\",value=0}}' --set study.duration=") + seconds;
    };
    Job const late("overhang.toml", until("0.24")), early("overhang.toml", until("0.16"));
    // The tool's weight is held up by the front's top and the rear's bottom: N_f − N_r = M g, and about the hole's centre
    // l (N_f + N_r) + h μ (N_f − N_r) − y_P μ (N_f + N_r) = M g x_G.
    double const mass = 1.2, mu = 0.12, l = 0.03, h = 0.01, pin = -0.025, overhang = 0.045;
    double const press = mass * weight * (overhang - h * mu) / (l - pin * mu);
    EXPECT_NEAR(late.mean("friction_loss") - early.mean("friction_loss"), mu * press * 0.2 * 0.08, 3e-3 * mu * press * 0.2 * 0.08);
    EXPECT_NEAR(late.mean("drive_work") - early.mean("drive_work"), mu * press * 0.2 * 0.08, 3e-3 * mu * press * 0.2 * 0.08);
    // On the way back friction turns round.
    Job const end("overhang.toml", until("0.5")), middle("overhang.toml", until("0.42"));
    double const back = mass * weight * (overhang + h * mu) / (l + pin * mu);
    EXPECT_NEAR(end.mean("friction_loss") - middle.mean("friction_loss"), mu * back * 0.2 * 0.08, 3e-3 * mu * back * 0.2 * 0.08);
}

TEST(Jobs, WornWayLeansTheCarriageAsItsDepthsSay) {
    // Of h = d/2 (1 − cos k x) the slider's ends lie d sin(k L/2) apart at most; at constant speed friction has μ M g.
    Job const job("worn_way.toml", "--set study.members=2 --set study.verify=0 --set study.duration=0.44 --set 'study.vary={\"way_profile.wear.scale\"={dist=\"const\",value=1}}'");
    double const pi = std::numbers::pi, length = 0.06, k = 2 * pi / 0.24, pitch = 30e-6 * std::sin(0.5 * k * length) / length;
    auto const tilt = job.values("peak_tilt");  // roll, yaw, pitch of each member
    ASSERT_EQ(tilt.size(), 6u);
    for (std::size_t const of : {2u, 5u}) EXPECT_NEAR(tilt[of], pitch, 0.02 * pitch);
    double const rub = 0.1 * 1.5 * weight;
    EXPECT_NEAR(job.mean("friction_loss"), rub * 0.4 * 0.44, 0.01 * rub * 0.4 * 0.44);
    EXPECT_NEAR(job.mean("drive_work"), job.mean("friction_loss") + job.mean("damping_loss") + job.mean("energy_change"), 1e-4 * job.mean("drive_work"));
}

TEST(Jobs, LeaningWayPressesOnTwoFaces) {
    std::string const alike = "--set study.members=4 --set study.verify=0 --set 'study.vary={\"initial.vy\"={dist=\"const\",value=0}}'";
    Job const job("leaning_way.toml", alike);
    double const pi = std::numbers::pi, mass = 7800 * 0.04 * 0.02 * 0.03, press = mass * weight * std::cos(pi / 6) * 2 * std::sqrt(0.5);
    double const pull = mass * weight * std::sin(pi / 6) - 0.15 * press, way = 0.5 * pull / mass * 0.5 * 0.5;
    EXPECT_NEAR(job.mean("mean_normal_force"), press, 1e-6 * press);
    EXPECT_NEAR(job.mean("friction_loss"), 0.15 * press * way, 1e-4 * press * way);
}

}  // namespace
}  // namespace slideway::jobs_test
