// Scenes that call quantities as earlier versions did.

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/config/descriptors.hpp"
#include "host/config/document.hpp"
#include "host/config/outputs.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::former_names_test {
namespace {

using testing::error_of;
using testing::scene_of;

constexpr char const* tolerances = "schema = 1\n[study]\nkind = \"tolerance\"\nmembers = 4\nquantities = [\"crank_work\", \"friction_loss\"]\n"
                                   "[study.vary]\n\"initial.y\" = { dist = \"unif\", low = 0, high = 1e-5 }\n[study.limits]\n\"crank_work\" = { max = 1 }\n";

TEST(FormerNames, OfScenesAreReadAsThoseOfNow) {
    Scene const scene = scene_of(tolerances);
    EXPECT_TRUE(selects(scene.quantities, Quantity::drive_work));
    ASSERT_EQ(scene.limits.size(), 1u);
    EXPECT_EQ(std::string(scene.limits[0].quantity), "drive_work");
    std::vector<std::string> told = scene.warnings;
    std::erase_if(told, [](std::string const& line) { return line.find("earlier version") == line.npos; });
    EXPECT_EQ(told, (std::vector<std::string>{"scene.toml:5: crank_work is the name of an earlier version; write drive_work",
                                              "scene.toml:9: crank_work is the name of an earlier version; write drive_work"}));
    std::string const resolved = resolved_toml(scene);
    EXPECT_EQ(resolved.find("crank_work"), resolved.npos);
    Scene const again = scene_of(resolved);
    EXPECT_EQ(again.quantities, scene.quantities);
}

TEST(FormerNames, AreNoSecondLimit) {
    std::string const both = std::string(tolerances) + "\"drive_work\" = { min = 0 }\n";
    EXPECT_EQ(error_of(both), "scene.toml:10: study.limits.drive_work cannot be limited (drive_work is limited already); remove one of the two");
}

TEST(FormerNames, AreReplacedAsWholeWords) {
    EXPECT_EQ(words_of_now("yield of crank_work [1]"), "yield of drive_work [1]");
    EXPECT_EQ(words_of_now("crank_work peak_tilt my_crank_work crank_work_2"), "drive_work peak_tilt my_crank_work crank_work_2");
    EXPECT_EQ(words_of_now(""), "");
    EXPECT_EQ(name_of_now("crank_work"), "drive_work");
}

TEST(FormerNames, AreThoseOfNothingElse) {
    for (FormerName const& name : former_names) {
        EXPECT_EQ(std::ranges::count(quantity_table, name.now, &QuantityInfo::name), 1);
        EXPECT_EQ(std::ranges::count(quantity_table, name.then, &QuantityInfo::name), 0);
        EXPECT_EQ(std::ranges::count(series_table, name.then, &SeriesInfo::name), 0);
    }
}

}  // namespace
}  // namespace slideway::former_names_test
