// Numbers made of rounding: sensitivities of losses that do not depend on what varies (all that a fall leaves is its energy, whatever its
// speed along the way), and the energy that a law made which never switched.
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/store/netcdf_file.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing::sensitivity_floor_test {
namespace {

using Json = nlohmann::json;

class SensitivityFloor : public ProgramWithResults {
protected:
    Json falling(std::string const& design) const {
        write("s.toml", R"(
schema = 1
[mechanism]
kind = "free_slider"
slider_mass = 0.1
[joint]
clearance = "1 mm"
[contact]
law = "rigid"
restitution = 0.5
[initial]
[study]
kind = "tolerance"
verify = 0
duration = 0.2
quantities = ["damping_loss", "contact_onsets", "friction_loss", "energy_change"]
vary = { "initial.vx" = { "dist" = "unif", "low" = 0.1, "high" = 1.0 }, "initial.z" = { "dist" = "unif", "low" = "-0.1 mm", "high" = "0.1 mm" } }
)" + design);
        Outcome const outcome = run({"run", "s.toml", "--no-progress", "--json", "--force", "-o", "s.nc"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return Json::parse(outcome.out)["tolerance"]["sensitivity"];
    }
    /// The losses, which are what the fall gave, and the friction that is not there.
    static void expect_none(Json const& said) {
        int losses = 0;
        for (Json const& column : said) {
            std::string const name = column["name"];
            if (name != "damping_loss" && name != "contact_onsets" && name != "friction_loss" && name != "energy_change") continue;
            ++losses;
            EXPECT_TRUE(column["without"].is_string()) << column;
            for (Json const& input : column["inputs"]) {
                for (char const* const kind : {"first", "total", "rank_correlation"}) {
                    EXPECT_TRUE(!input.contains(kind) || (input[kind]["value"].is_null() && input[kind]["low"].is_null())) << input;
                }
            }
        }
        EXPECT_EQ(losses, 4);
    }
};

TEST_F(SensitivityFloor, OfASaltelliDesignLeavesNoIndex) {
    expect_none(falling("design = \"saltelli\"\nbase = 64\n"));
    std::string const text = run({"info", "s.nc"}).out;
    EXPECT_NE(text.find("contact_onsets: no index, it does not vary"), std::string::npos) << text;
    EXPECT_NE(text.find("energy_change: no index, it varies by"), std::string::npos) << text;
    NetcdfFile const file = NetcdfFile::open(path("s.nc").string());
    std::string const why = file.group("sensitivity")->text(DataFile::global, "without_index");
    for (char const* const name : {"damping_loss", "friction_loss", "energy_change"}) EXPECT_NE(why.find(name), std::string::npos) << why;
}

TEST_F(SensitivityFloor, OfDrawsLeavesNoCorrelation) {
    expect_none(falling("design = \"mc\"\nmembers = 64\n"));
    std::string const text = run({"info", "s.nc"}).out;
    EXPECT_NE(text.find("friction_loss   - varies by"), std::string::npos) << text;
}

/// A slider that falls flat onto one face turns by rounding alone, which follows from what varies.
TEST_F(SensitivityFloor, OfTiltsMadeOfRoundingLeavesNone) {
    write("t.toml", R"(
schema = 1
[contact]
law = "conservative"
restitution = 0.5
[study]
kind = "tolerance"
members = 64
verify = 0
duration = "5 ms"
quantities = ["peak_tilt", "rms_acceleration"]
vary = { "initial.y" = { dist = "unif", low = -5e-5, high = 5e-5 } }
)");
    Outcome const outcome = run({"run", "t.toml", "--no-progress", "--json", "--force", "-o", "t.nc"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    for (Json const& column : Json::parse(outcome.out)["tolerance"]["sensitivity"]) {
        std::string const name = column["name"];
        bool const rounding = name.starts_with("peak_tilt") || name == "rms_acceleration[z]";
        EXPECT_EQ(column["without"].is_string(), rounding) << column;
        for (Json const& input : column["inputs"]) EXPECT_EQ(input["rank_correlation"]["value"].is_null(), rounding) << input;
    }
}

TEST_F(SensitivityFloor, OfEnergyMadeLeavesNone) {
    write("w.toml", R"(
schema = 1
[mechanism]
kind = "slider_crank"
crank_speed = 1.0
[joint]
clearance = "1 mm"
[contact]
law = "paper"
[initial]
[study]
kind = "ensemble"
members = 3
verify = 0
duration = "10 ms"
quantities = ["energy_residual", "drive_work"]
vary = { "initial.y" = { "dist" = "unif", "low" = -1e-4, "high" = 1e-4 } }
)");
    for (std::string const gravity : {"0", "9.81"}) {  // in 10 ms the fall is 0.5 mm of 1 mm
        Outcome const outcome = run({"run", "w.toml", "--no-progress", "--force", "-o", "w.nc", "--set", "mechanism.gravity=" + gravity});
        EXPECT_NE(outcome.out.find("the paper law made no energy: "), std::string::npos) << outcome.out;
        EXPECT_EQ(outcome.out.find("% of the crank's work"), std::string::npos) << outcome.out;
    }
    Outcome const hit = run({"run", "w.toml", "--no-progress", "--force", "-o", "w.nc", "--set", "study.duration=1"});
    EXPECT_NE(hit.out.find("% of the crank's work"), std::string::npos) << hit.out;
}

}  // namespace
}  // namespace slideway::testing::sensitivity_floor_test
