// What the program says of exponents of motion that is known to be regular, or chaotic, at several lengths of run.
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "tests/system/process.hpp"

namespace slideway::testing::exponent_sign_test {
namespace {

using Json = nlohmann::json;

/// Rigid contacts of a slider with eight apices, four starts scattered over the clearance; a yoke but where a test says otherwise.
std::string scene(std::string const& mechanism, double gravity, double restitution, double vy) {
    return fmt::format(R"(
schema = 1
[mechanism]
{}
gravity = {}
[joint]
clearance = "1 mm"
[contact]
law = "rigid"
restitution = {}
[initial]
vy = {}
[study]
kind = "lyapunov"
members = 4
transient_revolutions = 1
exponents = 2
rescalings_per_revolution = 200
verify = 0
vary = {{ "initial.y" = {{ "dist" = "unif", "low" = -0.0005, "high" = 0.0005 }} }}
)",
                       mechanism, gravity, restitution, vy);
}
constexpr char const* yoke = "kind = \"scotch_yoke\"\ncrank_speed = 10.0";
constexpr char const* slow_yoke = "kind = \"scotch_yoke\"\ncrank_speed = 3.0";
constexpr char const* carriage = "kind = \"carriage\"\ncarriage_speed = \"6 cm/s\"\nstroke = \"150 mm\"\nreversal_time = \"20 ms\"";

class ExponentSigns : public Program {
protected:
    Json told(std::string const& file, std::vector<std::string> const& keys) const {
        std::vector<std::string> words{"run", file, "--no-progress", "--json", "--force", "-o", "r.nc"};
        for (std::string const& key : keys) words.insert(words.end(), {"--set", key});
        Outcome const outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return Json::parse(outcome.out);
    }
    Json largest(std::string const& file, std::vector<std::string> const& keys) const { return told(file, keys)["exponents"][0]; }

    /// Growth like t or t²: no sign of any member, nor of the mean, whose interval holds 0.
    void expect_no_sign(std::string const& text, std::vector<double> const& revolutions) const {
        write("s.toml", text);
        for (double const length : revolutions) {
            Json const one = largest("s.toml", {fmt::format("study.revolutions={}", length)});
            EXPECT_EQ(one["members_undecided"], 4) << length << one;
            EXPECT_EQ(one["sign"], "no growth beyond a power of time") << length << one;
            EXPECT_GE(one["mean"]["half_width"].get<double>(), one["mean"]["mean"].get<double>()) << length;
        }
        std::string const text_of = run({"info", "r.nc"}).out;
        EXPECT_NE(text_of.find("largest: 0 members above zero, 0 below, 4 undecided"), std::string::npos) << text_of;
        EXPECT_NE(text_of.find("their mean: no growth beyond a power of time"), std::string::npos) << text_of;
    }
};

TEST_F(ExponentSigns, WithoutContactAreNone) { expect_no_sign(scene(yoke, 0, 1, 0), {6, 20, 50, 200}); }

TEST_F(ExponentSigns, OfASliderAtRestAreNone) { expect_no_sign(scene(yoke, 9.81, 0.5, 0), {6, 20, 50, 200}); }

// Four apices land at the same time, and nothing is lost: offsets grow like t².
TEST_F(ExponentSigns, OfElasticFlatBouncesAreNone) { expect_no_sign(scene(yoke, 0, 1, 0.1), {6, 20, 50, 200, 1000}); }

TEST_F(ExponentSigns, OfACarriageWithoutContactAreNone) { expect_no_sign(scene(carriage, 0, 1, 0), {5, 20}); }

TEST_F(ExponentSigns, OfASlowYokeAtRestAreNone) { expect_no_sign(scene(slow_yoke, 9.81, 0.2, 0), {10, 60}); }

TEST_F(ExponentSigns, OfColumnsOfASweepAreSaid) {
    std::string text = scene(yoke, 0, 1, 0);
    text.replace(text.find("\"lyapunov\""), 10, "\"sweep\"\nparameter = \"joint.clearance\"\nvalues = [\"1 mm\", \"2 mm\"]");
    write("s.toml", text);
    Json const said = told("s.toml", {"study.revolutions=20"});
    ASSERT_EQ(said["columns"].size(), 2u) << said;
    for (Json const& column : said["columns"]) {
        EXPECT_EQ(column["finished"], 4);
        EXPECT_EQ(column["sign"], "no growth beyond a power of time");
    }
    std::string const out = run({"info", "r.nc"}).out;
    EXPECT_NE(out.find("4 of 4"), std::string::npos) << out;
    EXPECT_NE(out.find("  no growth beyond a power of time\n"), std::string::npos) << out;
}

// What impacts have left in damping by restitution is part of where a member is: exponents that forgot it told chaos of a block at rest.
TEST_F(ExponentSigns, OfABlockThatRestsWithRestitutionAreNotAboveZero) {
    write("s.toml", R"(
schema = 1
[mechanism]
kind = "planar_slider_crank"
crank_speed = 10.0
[contact]
restitution = 0.5
[friction]
static = 0.1
kinetic = 0.1
[initial]
y = -9e-5
wz = 0.1
[study]
kind = "lyapunov"
transient_revolutions = 1
revolutions = 2
verify = 0
)");
    for (int const exponents : {1, 2, 4}) {
        Json const all = told("s.toml", {fmt::format("study.exponents={}", exponents)})["exponents"];
        ASSERT_EQ(all.size(), static_cast<std::size_t>(exponents));
        EXPECT_NE(all[0]["sign"], "above zero") << all;
        for (Json const& one : all) EXPECT_LT(one["mean"]["mean"].get<double>(), 1) << all;
    }
}

// λ₁ = 72 1/s (docs/evidence/chaos.md): 48 in five turns, 3 in three tenths of one.
TEST_F(ExponentSigns, OfChaosAreToldOnceTheRecordIsLongEnough) {
    std::string const scene = std::string(SLIDEWAY_SCENES) + "/lyapunov_rigid.toml";
    std::vector<std::string> keys{"study.verify=0", "study.members=8", "study.revolutions=5"};
    Json const whole = largest(scene, keys);
    EXPECT_EQ(whole["sign"], "above zero");
    EXPECT_EQ(whole["members_positive"], 8) << whole;
    keys.back() = "study.revolutions=0.3";
    Json const part = largest(scene, keys);
    EXPECT_EQ(part["members_undecided"], 8) << part;
    EXPECT_NE(part["sign"], "above zero");
}

TEST_F(ExponentSigns, OfThePublishedLawAreAboveZero) {
    Json const one = largest(std::string(SLIDEWAY_SCENES) + "/lyapunov_0.1mm.toml",
                             {"study.verify=0", "study.members=8", "study.transient_revolutions=0.2", "study.revolutions=0.2"});
    EXPECT_EQ(one["sign"], "above zero");
    EXPECT_EQ(one["members_positive"], 8) << one;
}

}  // namespace
}  // namespace slideway::testing::exponent_sign_test
