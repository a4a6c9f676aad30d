// The table of settings, and that a row is all that a new one takes.
#include "host/config/settings.hpp"

#include <set>

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
    Settings const rows(&trial, 1);
    Scene scene;
    EXPECT_EQ(preset_text(trial), trial.value.text(scene, trial));
    read_bound(read_document("[integrator]\ntrial_tolerance = \"250 ms\"", "s.toml", {}), "integrator", scene, rows);
    EXPECT_EQ(trial.value.text(scene, trial), "0.25");
    read_bound(read_document("[integrator]\ntrial_tolerance = 0.5", "s.toml", {{"integrator.trial_tolerance", "0.125"}}), "integrator", scene, rows);
    EXPECT_EQ(trial.value.text(scene, trial), "0.125");
    try {
        read_bound(read_document("[integrator]\ntrial_tolerance = 2", "s.toml", {}), "integrator", scene, rows);
        FAIL() << "out of range";
    } catch (SceneError const& error) {
        EXPECT_TRUE(contains(error.what(), "s.toml:2: integrator.trial_tolerance is 2 s (out of range for the trial tolerance)")) << error.what();
    }
}

}  // namespace
}  // namespace slideway::testing::settings_test
