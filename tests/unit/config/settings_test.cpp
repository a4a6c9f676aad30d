// The table of settings, and that a row is all that a new one takes.
#include "host/config/settings.hpp"

#include <set>

#include "host/config/key_reference.hpp"
#include "host/config/reader.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::testing::settings_test {
namespace {

using Type = Setting::Type;

TEST(SceneSettings, AreListedOnceAndSayWhatTheyAre) {
    std::set<std::string_view> names;
    for (Setting const& row : settings()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(find_key(row.name), nullptr) << row.name << " is a number of the physics";
        EXPECT_FALSE(row.meaning.empty()) << row.name;
        EXPECT_NE(row.studies, 0u) << row.name;
        EXPECT_NE(row.methods, 0u) << row.name;
        EXPECT_EQ(row.type == Type::choice, !row.all_choices().empty()) << row.name;
        EXPECT_LE(row.least, row.most) << row.name;
        EXPECT_TRUE(row.value.read == nullptr || row.value.text != nullptr) << row.name << " is read and never written";
        if (row.table() == "study") continue;
        EXPECT_EQ(row.studies, study_sets::all) << row.name;
    }
}

TEST(SceneSettings, ThatSayTheSameSayItOfEachOther) {
    for (Setting const& row : settings()) {
        for (std::string_view const rival : row.rivals) {
            // Which a base, levels or values replace, but are not replaced by.
            if (rival.empty() || rival == "study.members" || rival == "study.spacing") continue;
            auto const& back = setting(rival).rivals;
            EXPECT_NE(std::ranges::find(back, row.name), back.end()) << row.name << " and " << rival;
        }
    }
}

TEST(SceneSettings, HaveTheDefaultsOfAScene) {
    Scene const bare = scene_of("schema = 1");
    for (Setting const& row : settings()) {
        if (row.value.text == nullptr || !row.preset.empty()) continue;
        EXPECT_EQ(preset_text(row), row.value.text(bare, row)) << row.name;
    }
}

/// A row that no scene has.
Setting const trial{.name = "integrator.trial_tolerance", .type = Type::number, .unit = "s", .meaning = "of a trial", .preset = "",
                    .what = "trial tolerance", .range = {0, 1, false}, .value = at<&Scene::integrator, &IntegratorSettings::fixed_step>};

TEST(SceneSettings, AreReadAndWrittenByTheirRow) {
    Scene scene;
    EXPECT_EQ(preset_text(trial), trial.value.text(scene, trial));
    auto const read = [&](std::string const& text, Overrides const& overrides = {}) {
        Node const root = read_document("[integrator]\n" + text, "s.toml", overrides);
        Reading{root, scene, Settings(&trial, 1)}.read_table("integrator");
        return trial.value.text(scene, trial);
    };
    EXPECT_EQ(read("trial_tolerance = \"250 ms\""), "0.25");
    EXPECT_EQ(read("trial_tolerance = 0.5", {{"integrator.trial_tolerance", "0.125"}}), "0.125");
    try {
        read("trial_tolerance = 2");
        FAIL() << "out of range";
    } catch (SceneError const& error) {
        EXPECT_TRUE(contains(error.what(), "s.toml:2: integrator.trial_tolerance is 2 s (out of range for the trial tolerance)")) << error.what();
    }
}

/// Rules of it that no scene has.
KeyRule const trial_rules[] = {
    {Known::integrator, "integrator.trial_tolerance", [](Reading const& r) { return r.scene.parts.friction; }, KeyRule::What::excludes,
     "a {mechanism} with friction has none", "remove one of the two"},
    {Known::integrator, "integrator.trial_tolerance", [](Reading const& r) { return r.scene.members > 1; }, KeyRule::What::needs, "several members want one",
     "add trial_tolerance = 1", "study.members"},
    {Known::all, "integrator.trial_tolerance", [](Reading const& r) { return r.scene.seed > 1; }, KeyRule::What::idle, "with a seed"},
};

class ANewKeyWithRules : public ::testing::Test {
protected:
    std::vector<Setting> rows{settings().begin(), settings().end()};
    ANewKeyWithRules() { rows.push_back(trial); }

    Scene scene(std::string const& lines) const { return parse_scene("schema = 1\n[contact]\nlaw = \"paper\"\n" + lines, "s.toml", {}, rows, trial_rules); }
    std::string error(std::string const& lines) const {
        try {
            scene(lines);
        } catch (SceneError const& error) {
            return error.what();
        }
        return {};
    }
};

TEST_F(ANewKeyWithRules, IsReadAndResolved) {
    std::string const line = "[integrator]\ntrial_tolerance = \"250 ms\"\n";
    Scene const read = scene(line);
    EXPECT_EQ(read.integrator.fixed_step, 0.25);
    EXPECT_EQ(read.warnings, std::vector<std::string>{});
    std::string const resolved = resolved_toml(read, with_physics(rows));
    EXPECT_TRUE(contains(resolved, "\ntrial_tolerance = 0.25  # s\n")) << resolved;
    EXPECT_FALSE(contains(resolved_toml(read), "trial_tolerance")) << "the program's own table";
    EXPECT_TRUE(contains(error_of("schema = 1\n" + line), "integrator.trial_tolerance is no key of a scene"));
}

TEST_F(ANewKeyWithRules, IsHeldToThem) {
    EXPECT_EQ(error("[integrator]\ntrial_tolerance = 0.5\n[friction]\n"),
              "s.toml:5: integrator.trial_tolerance is 0.5 (a slider_crank with friction has none); remove one of the two");
    EXPECT_EQ(error("[study]\nmembers = 2\n"), "s.toml:5: integrator.trial_tolerance is missing (several members want one); add trial_tolerance = 1");
    EXPECT_EQ(error("[friction]\n"), "");
    EXPECT_EQ(scene("[integrator]\ntrial_tolerance = 0.5\n[study]\nseed = 2\n").warnings,
              std::vector<std::string>{"integrator.trial_tolerance has no effect with a seed"});
}

TEST_F(ANewKeyWithRules, IsListedAndInTheSchema) {
    auto const keys = with_physics(rows);
    EXPECT_TRUE(contains(keys_json(keys), "\"integrator.trial_tolerance\""));
    EXPECT_TRUE(contains(scene_schema(keys), "\"trial_tolerance\""));
    EXPECT_TRUE(contains(keys_markdown(keys), "| `trial_tolerance` | s | > 0, ≤ 1 |"));
    EXPECT_EQ(described(trial), "of a trial: > 0, ≤ 1; default 0.0");
}

TEST(KeyRules, AreOfKeysThatThereAre) {
    for (KeyRule const& rule : key_rules()) {
        auto const is_of = [&](Setting const& key) {
            return key.name.starts_with(rule.key) && (key.name == rule.key || rule.after == Known::variation || key.table() == rule.key);
        };
        EXPECT_TRUE(std::ranges::any_of(known_keys(), is_of)) << rule.key;
        EXPECT_EQ(rule.why.empty(), rule.what == KeyRule::What::foreign) << rule.key;
        EXPECT_EQ(rule.instead.empty(), rule.what == KeyRule::What::foreign || rule.what == KeyRule::What::idle) << rule.key;
    }
}

}  // namespace
}  // namespace slideway::testing::settings_test
