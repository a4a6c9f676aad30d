// The keys of a scene as pages, JSON and JSON Schema: all from the tables, and the page in docs/ is today's.
#include <set>

#include <nlohmann/json.hpp>

#include "host/config/linkages.hpp"
#include "host/config/key_reference.hpp"
#include "host/config/loads.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::keys_test {
namespace {

using Json = nlohmann::json;

class ListedKeys : public Program {
protected:
    Json listed(char const* form) const {
        Outcome const outcome = run({"list", form});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return Json::parse(outcome.out);
    }
};

std::set<std::string> all_names() {
    std::set<std::string> names;
    for (Setting const& row : settings()) names.emplace(row.name);
    for (Setting const& row : load_settings()) names.emplace(row.name);
    for (auto const table : {keys(), twin_keys()}) {
        for (Key const& key : table) names.emplace(key.name);
    }
    for (Setting const& row : linkage_settings()) names.emplace(row.name);
    return names;
}

TEST_F(ListedKeys, AreAllInTheList) {
    std::string const text = run({"list"}).out;
    for (std::string const& name : all_names()) EXPECT_NE(text.find("  " + name + " "), std::string::npos) << name;
}

TEST_F(ListedKeys, AreThereAlone) {
    std::string const all = run({"list"}).out, alone = run({"list", "--keys"}).out;
    EXPECT_NE(all.find("\nkeys of a scene, with their unit, domain and default\n" + alone + "\n"), std::string::npos) << alone;
    EXPECT_EQ(std::count(alone.begin(), alone.end(), '\n'), static_cast<std::ptrdiff_t>(all_names().size()));
    EXPECT_EQ(run({"list", "--keys", "--json"}).out, run({"list", "--json"}).out);
    EXPECT_EQ(run({"list", "--keys", "--schema"}).code, 2);
}

TEST_F(ListedKeys, AreAllInTheJsonWithWhatTheTablesSay) {
    Json const json = listed("--json");
    EXPECT_EQ(json["schema_version"], 1);
    std::set<std::string> names;
    for (Json const& key : json["keys"]) {
        EXPECT_TRUE(names.insert(key["name"]).second) << key;
        EXPECT_FALSE(key["meaning"].get<std::string>().empty()) << key;
    }
    EXPECT_EQ(names, all_names());
    auto const key = [&](std::string const& name) {
        return *std::find_if(json["keys"].begin(), json["keys"].end(), [&](Json const& one) { return one["name"] == name; });
    };
    EXPECT_EQ(key("joint.clearance")["unit"], "m");
    EXPECT_EQ(key("joint.clearance")["minimum"], -1e-4);
    EXPECT_EQ(key("joint.slider_length")["exclusive_minimum"], 0);
    EXPECT_EQ(key("joint.clearance")["usual_maximum"], 0.01);
    EXPECT_FALSE(key("initial.y").contains("usual_maximum"));
    EXPECT_EQ(key("integrator.rtol")["default"], "1e-06");
    EXPECT_EQ(key("study.dt")["studies"], Json::array({"lyapunov"}));
    EXPECT_EQ(key("contact.apex_stiffness")["laws"], Json::array({"kelvin_voigt"}));
    EXPECT_EQ(key("study.design")["choices"].size(), 6u);
    EXPECT_FALSE(key("study.members").contains("mechanisms"));
}

TEST_F(ListedKeys, AreAllInTheSchema) {
    Json const schema = listed("--schema");
    std::set<std::string> names;
    for (auto const& [table_of_keys, value_of_keys] : schema["properties"].items()) {
        // Loads are tables of any name, all with the same keys.
        bool const of_any_name = value_of_keys.contains("additionalProperties") && value_of_keys["additionalProperties"].is_object();
        std::string const table = of_any_name ? table_of_keys + ".<name>" : table_of_keys;
        Json const& value = of_any_name ? value_of_keys["additionalProperties"] : value_of_keys;
        if (!value.contains("properties")) {
            names.insert(table);
            continue;
        }
        EXPECT_EQ(value["additionalProperties"], false) << table;
        for (auto const& [key, what] : value["properties"].items()) {
            names.insert(table + "." + key);
            EXPECT_TRUE(what.contains("description")) << table << "." << key;
        }
    }
    EXPECT_EQ(names, all_names());
}

TEST_F(ListedKeys, AreDescribedOnTheirPage) {
    std::string const page = file_text(std::filesystem::path(SLIDEWAY_SOURCE) / "docs/reference/keys.md");
    EXPECT_TRUE(page == run({"list", "--markdown"}).out) << "docs/reference/keys.md is not of these tables; write it anew: slideway list --markdown >docs/reference/keys.md";
}

TEST_F(ListedKeys, OfANewRowAreEverywhere) {
    using Type = Setting::Type;
    Setting const trial{.name = "integrator.trial_tolerance", .type = Type::number, .unit = "s", .meaning = "of a trial", .preset = "", .what = "trial",
                        .range = {0, 2, false}, .value = at<&Scene::integrator, &IntegratorSettings::rtol>};
    auto const references = with_physics(Settings(&trial, 1));
    Json const json = Json::parse(keys_json(references)), schema = Json::parse(scene_schema(references));
    bool found = false;
    for (Json const& key : json["keys"]) found = found || (key["name"] == trial.name && key["maximum"] == 2 && key["default"] == "1e-06");
    EXPECT_TRUE(found);
    Json const& value = schema["properties"]["integrator"]["properties"]["trial_tolerance"];
    EXPECT_EQ(value["anyOf"][0]["exclusiveMinimum"], 0);
    EXPECT_NE(keys_markdown(references).find("| `trial_tolerance` | s | > 0, ≤ 2 |  | 1e-06 | of a trial |"), std::string::npos);
}

TEST(KeyRules, HaveTheRangesThatTheyCheck) {
    Inputs const presets;
    for (Key const& key : keys()) {
        Range const range = range_of(key.rule);
        auto const holds = [&](double value) { return !broken_rule(key, value).has_value(); };
        double const step = 1e-9;
        if (std::isfinite(range.low)) {
            EXPECT_EQ(holds(range.low), range.low_included) << key.name;
            EXPECT_FALSE(holds(range.low - step)) << key.name;
            EXPECT_TRUE(holds(range.low + step)) << key.name;
        } else {
            EXPECT_TRUE(holds(-1e300)) << key.name;
        }
        if (std::isfinite(range.high)) {
            EXPECT_TRUE(holds(range.high)) << key.name;
            EXPECT_FALSE(holds(range.high + step)) << key.name;
        } else {
            EXPECT_TRUE(holds(1e300)) << key.name;
        }
    }
}

}  // namespace
}  // namespace slideway::testing::keys_test
