// What commands say to programs, beside what files and pages say.
#include <algorithm>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/system/small_run.hpp"

namespace slideway::testing::json_test {
namespace {

using Json = nlohmann::json;

class JsonOutput : public SmallRun {
protected:
    Json of(std::vector<std::string> words, int code = 0) const {
        words.emplace_back("--json");
        Outcome const outcome = run(std::move(words));
        EXPECT_EQ(outcome.code, code) << outcome.err;
        Json const json = Json::parse(outcome.out);
        EXPECT_EQ(json["schema_version"], 1);
        return json;
    }
};

TEST_F(JsonOutput, OfARunAndOfItsFileAreOneButForTheRun) {
    Json made = of({"run", "s.toml", "--no-progress", "-o", "o.nc"});
    EXPECT_EQ(made["run"]["members"], 37);
    EXPECT_GT(made["run"]["seconds"], 0);
    EXPECT_EQ(made["command"], "run");
    made.erase("run");
    Json const told = of({"info", "o.nc"});
    made["command"] = "info";
    EXPECT_EQ(made, told);

    ResultReader const file = results("o.nc");
    EXPECT_EQ(told["payload_hash"], file.stored_hash());
    EXPECT_EQ(told["statuses"], (Json{{"finished", 37}}));
    EXPECT_EQ(told["dimensions"]["member"], 37);
    double sum = 0;
    for (double const value : file.values("drive_work")) sum += value;
    auto const& quantities = told["quantities"];
    auto const work = std::find_if(quantities.begin(), quantities.end(), [](Json const& one) { return one["name"] == "drive_work"; });
    ASSERT_NE(work, quantities.end());
    EXPECT_EQ((*work)["unit"], "J");
    EXPECT_NEAR((*work)["mean"].get<double>(), sum / 37, 1e-12 * std::abs(sum));
    EXPECT_EQ(told["verification"]["resolution"], "not_checked");
}

TEST_F(JsonOutput, OfAToleranceStudyHasQuantilesAndYields) {
    write("t.toml", std::string(small_scene) + "[study.limits]\npeak_normal_force = { max = 10 }\n\"mode_time[free]\" = { min = 0 }\n");
    Json made = of({"run", "t.toml", "--no-progress", "--threads", "2", "-o", "t.nc", "--set", "study.kind=tolerance", "study.samples=0", "study.seed=7"});
    EXPECT_EQ(made["threads"], 2);
    EXPECT_EQ(made["seed"], 7);
    // By hand, of the members in the file.
    std::vector<double> forces = results("t.nc").values("peak_normal_force");
    ASSERT_EQ(forces.size(), 37u);
    std::ranges::sort(forces);
    auto const within = std::ranges::count_if(forces, [](double force) { return force <= 10; });
    Json const& report = made["tolerance"];
    EXPECT_EQ(report["design"], "mc");
    EXPECT_EQ(report["confidence"], 0.95);
    Json const& yields = report["yields"];
    ASSERT_EQ(yields.size(), 3u);
    EXPECT_EQ(yields[0]["name"], "peak_normal_force");
    EXPECT_EQ(yields[0]["max"], 10);
    EXPECT_TRUE(yields[0]["min"].is_null());
    EXPECT_EQ(yields[0]["met"], within);
    EXPECT_EQ(yields[0]["of"], 37);
    EXPECT_LE(yields[0]["low"].get<double>(), static_cast<double>(within) / 37);
    EXPECT_GE(yields[0]["high"].get<double>(), static_cast<double>(within) / 37);
    EXPECT_EQ(yields[1]["met"], 37);
    EXPECT_EQ(yields[2]["name"], "all limits");
    EXPECT_EQ(yields[2]["met"], within);
    auto const force = std::ranges::find_if(report["quantities"], [](Json const& one) { return one["name"] == "peak_normal_force"; });
    ASSERT_NE(force, report["quantities"].end());
    ASSERT_EQ((*force)["quantiles"].size(), 9u);
    Json const& median = (*force)["quantiles"][4];
    EXPECT_EQ(median["probability"], 0.5);
    EXPECT_EQ(median["value"].get<double>(), forces[18]);
    EXPECT_LT(median["low"].get<double>(), forces[18]);
    EXPECT_GT(median["high"].get<double>(), forces[18]);
    EXPECT_LT((*force)["mean"]["low"].get<double>(), (*force)["mean"]["high"].get<double>());
    made.erase("run");
    made["command"] = "info";
    EXPECT_EQ(made, of({"info", "t.nc"}));
}

TEST_F(JsonOutput, SaysWhatIsLeft) {
    Json const part = of({"run", "s.toml", "--no-progress", "-o", "p.nc", "--shard", "1/2"});
    EXPECT_EQ(part["shards"], "p.nc.shards");
    Json const merged = of({"merge", "p.nc.shards", "-o", "p.nc"}, 5);
    EXPECT_EQ(merged["members_left"], 18);
    EXPECT_EQ(merged["statuses"]["not_run"], 18);
}

TEST_F(JsonOutput, HasNullWhereThereIsNoNumber) {
    Json const one = of({"run", "s.toml", "--no-progress", "-o", "one.nc", "--member", "3"});
    EXPECT_TRUE(one["quantities"][0]["sd"].is_null());
    EXPECT_FALSE(one["quantities"][0]["mean"].is_null());
}

TEST_F(JsonOutput, OfACheckHasASceneThatRuns) {
    Json const json = of({"check", "s.toml"});
    EXPECT_EQ(json["members"], 37);
    EXPECT_GT(json["memory_bytes"], 0);
    Outcome const resolved = run({"check", "s.toml", "--resolved"});
    EXPECT_EQ(resolved.out, json["resolved"]);
    write("r.toml", resolved.out);
    EXPECT_EQ(run({"run", "r.toml", "--no-progress", "-o", "r.nc"}).code, 0);
    EXPECT_EQ(run({"run", "s.toml", "--no-progress", "-o", "o.nc"}).code, 0);
    EXPECT_EQ(hash_of("r.nc"), hash_of("o.nc"));
}

TEST_F(JsonOutput, OfACheckNamesWhatIsDerivedAndFromWhat) {
    // Ten times the paper's size: a thousand times its 0.1872 kg.
    write("large.toml", "schema = 1\n[mechanism]\ncrank_length = 0.5\nrod_length = 1.422\nrod_mass = 100\n[joint]\nslider_length = 0.4\nway_width = 0.2\n"
                        "way_depth = 0.3\n[contact]\nlaw = \"conservative\"\n[study]\nduration = \"1 ms\"\n");
    Json const json = of({"check", "large.toml"});
    auto const of_name = [&](std::string const& name) {
        auto const found = std::ranges::find_if(json["derived"], [&](Json const& one) { return one["name"] == name; });
        return found == json["derived"].end() ? Json() : *found;
    };
    Json const mass = of_name("mechanism.slider_mass");
    EXPECT_NEAR(mass["value"].get<double>(), 187.2, 1e-12);
    EXPECT_EQ(mass["unit"], "kg");
    EXPECT_EQ(mass["from"], "density x slider_length x way_width x way_depth");
    EXPECT_TRUE(of_name("mechanism.rod_mass").is_null()) << "it is given";
    EXPECT_NEAR(of_name("mechanism.rod_inertia")["value"].get<double>(), 100 * 1.422 * 1.422 / 12, 1e-12);
    std::string const text = run({"check", "large.toml"}).out;
    EXPECT_NE(text.find("\nderived "), std::string::npos) << text;
    EXPECT_NE(text.find("slider_mass 187.2 kg"), std::string::npos) << text;
}

TEST_F(JsonOutput, OfAProbeAreItsTable) {
    Json const json = of({"probe", "s.toml"});
    EXPECT_EQ(run({"probe", "s.toml", "-o", "p.csv"}).code, 0);
    std::istringstream table(file_text(path("p.csv")));
    std::string header, row;
    std::getline(table, header);
    std::getline(table, row);
    std::istringstream names(header), values(row);
    int compared = 0;
    for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');) {
        Json const& of_state = json["states"][0];
        Json const& place = of_state["values"].contains(name) ? of_state["values"] : of_state["state"];
        if (!place.contains(name)) continue;
        EXPECT_EQ(place[name].get<double>(), std::stod(value)) << name;
        ++compared;
    }
    EXPECT_GT(compared, 40);
    EXPECT_EQ(json["states"][0]["status"], "finished");
}

TEST_F(JsonOutput, OfStatisticsIsWhatTheTextSays) {
    std::string series = "x\n";
    for (int i = 0; i < 600; ++i) series += std::to_string(std::sin(0.3 * i)) + "\n";
    write("series.csv", series);
    Json const json = of({"stats", "series.csv", "--dt", "0.01"});
    std::string const text = run({"stats", "series.csv", "--dt", "0.01"}).out;
    EXPECT_EQ(json["points"], 600);
    EXPECT_NE(text.find(json["verdict"].get<std::string>()), std::string::npos);
    EXPECT_NEAR(json["average_period"].get<double>(), 0.01 * 2 * M_PI / 0.3, 1e-3);
    EXPECT_EQ(json["zero_one"]["k"].is_null(), text.find("0-1 test         none") != std::string::npos);
}

TEST_F(JsonOutput, IsAllThereIs) {
    // One object, and what is wrong still goes to stderr in one line.
    expect_refusal(4, "missing.nc", {"info", "missing.nc", "--json"});
    expect_refusal(2, "joint.clearance", {"check", "s.toml", "--json", "--set", "joint.clearance=-1"});
}

TEST_F(JsonOutput, QuietRunsSayNothing) {
    Outcome const outcome = run({"run", "s.toml", "--quiet", "-o", "q.nc"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(results("q.nc").values("status").size(), 37u);
}

}  // namespace
}  // namespace slideway::testing::json_test
