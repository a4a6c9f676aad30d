// study.store: what it is, what stands in its way, and that the resolved scene keeps it.
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::store_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;

std::string scene_with(std::string const& study) { return "schema = 1\n[friction]\n[study]\n" + study + "\n"; }

std::string const force = "quantities = [\"peak_normal_force\"]\n";

TEST(SceneStore, MembersAreStoredUnlessTheSceneSaysOtherwise) {
    EXPECT_TRUE(scene_of(scene_with("")).stores_members());
    EXPECT_TRUE(scene_of(scene_with("store = \"members\"")).stores_members());
    EXPECT_FALSE(scene_of(scene_with(force + "store = \"statistics\"")).stores_members());
    EXPECT_FALSE(scene_of(scene_with(force + "kind = \"tolerance\"\nstore = \"statistics\"")).stores_members());
}

TEST(SceneStore, ResolvedSceneKeepsIt) {
    Scene const scene = scene_of(scene_with(force + "store = \"statistics\""));
    EXPECT_FALSE(scene_of(resolved_toml(scene)).stores_members());
    // Where members are stored the text, and so the identity of earlier runs, is as before.
    EXPECT_FALSE(contains(resolved_toml(scene_of(scene_with(force + "store = \"members\""))), "store"));
}

TEST(SceneStore, AnOptionTakesItBack) {
    EXPECT_TRUE(scene_of(scene_with(force + "store = \"statistics\""), {{"study.store", "members"}}).stores_members());
}

TEST(SceneStore, RefusalsSayWhy) {
    EXPECT_EQ(
        error_of(scene_with("store = \"statistics\"")),
        "scene.toml:4: study.store is \"statistics\" (there is no quantity to make statistics of); add quantities = "
        "[\"mean_normal_force\"], or see `slideway list`");
    for (std::string const samples : {"samples = 5", "samples_per_revolution = 10"}) {
        EXPECT_EQ(error_of(scene_with(force + "store = \"statistics\"\n" + samples)),
                  "scene.toml:5: study.store is \"statistics\" (time series are of single members); remove the "
                  "samples, or use "
                  "store = \"members\"");
    }
    EXPECT_EQ(
        error_of("schema = 1\n[friction]\n[study]\n" + force +
                 "store = \"statistics\"\nkind = \"tolerance\"\ndesign = \"saltelli\"\nbase = "
                 "4\n[study.vary]\n\"initial.y\" "
                 "= {dist = \"unif\", low = 0, high = 1e-5}\n"),
        "scene.toml:5: study.store is \"statistics\" (sensitivity indices need every member's values); use store = "
        "\"members\"");
    EXPECT_TRUE(contains(error_of(scene_with("store = \"rows\"")), "use one of members, statistics"));
    EXPECT_TRUE(contains(error_of(scene_with("kind = \"lyapunov\"\nstore = \"statistics\"")),
                         "it has no effect with kind = \"lyapunov\""));
}

TEST(SceneStore, NoSamplesAreNoObstacle) {
    EXPECT_FALSE(scene_of(scene_with(force + "store = \"statistics\"\nsamples = 0")).stores_members());
}

}  // namespace
}  // namespace slideway::store_test
