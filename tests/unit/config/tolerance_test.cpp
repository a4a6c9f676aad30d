// What scenes of tolerance studies say: distributions, designs, tables of members, correlations, limits.
#include <cmath>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::tolerance_test {
namespace {

using testing::contains;
using testing::scene_of;
using testing::TableFolder;

constexpr double infinity = std::numeric_limits<double>::infinity();

Distribution distribution_of(std::string const& key, std::string const& arguments) {
    Scene const scene =
        scene_of("schema = 1\n[friction]\n[study.vary]\n\"" + key + "\" = { dist = " + arguments + " }\n");
    return scene.variations.at(0).distribution;
}

Scene study(std::string const& lines, std::string const& vary = "", Overrides const& overrides = {}) {
    return scene_of(
        "schema = 1\n[study]\nkind = \"tolerance\"\nquantities = [\"mode_time\"]\n" + lines + "\n[study.vary]\n" + vary,
        overrides);
}

std::string const three_keys =
    "\"initial.y\" = { dist = \"unif\", low = 0, high = 1e-5 }\n"
    "\"initial.z\" = { dist = \"unif\", low = 0, high = 1e-5 }\n"
    "\"joint.clearance\" = { dist = \"values\", values = [\"0.1 mm\", \"0.2 mm\"] }\n";

TEST(SceneDistributions, TakeTheirArgumentsWithUnits) {
    Distribution const triangle =
        distribution_of("joint.clearance", "\"triang\", low = \"0.05 mm\", mode = \"100 um\", high = 0.0002");
    EXPECT_EQ(triangle.kind, Distribution::Kind::triangular);
    EXPECT_EQ(triangle.low, 5e-5);
    EXPECT_EQ(triangle.mode, 1e-4);
    EXPECT_EQ(triangle.high, 2e-4);

    Distribution const lognormal = distribution_of("joint.clearance", "\"lognorm\", mean = \"0.1 mm\", sd = \"10 um\"");
    EXPECT_EQ(lognormal.kind, Distribution::Kind::lognormal);
    EXPECT_EQ(lognormal.mean, 1e-4);
    EXPECT_EQ(lognormal.sd, 1e-5);
    EXPECT_EQ(lognormal.low, 0) << "though a clearance of 0 is refused: none is drawn";
    EXPECT_EQ(distribution_of("initial.y", "\"lognorm\", mean = 1, sd = 1, low = \"-1 mm\"").low, -1e-3);

    Distribution const weibull =
        distribution_of("mechanism.slider_mass", "\"weibull\", scale = \"10 g\", shape = 2.5, low = \"0.1 kg\"");
    EXPECT_EQ(weibull.kind, Distribution::Kind::weibull);
    EXPECT_EQ(weibull.scale, 0.01);
    EXPECT_EQ(weibull.shape, 2.5);
    EXPECT_EQ(weibull.low, 0.1);
    EXPECT_EQ(distribution_of("joint.clearance", "\"weibull\", scale = 1e-4, shape = 1").low, 0);

    Distribution const list = distribution_of("mechanism.crank_speed", "\"values\", values = [\"60 rpm\", 0, -3.5]");
    EXPECT_EQ(list.kind, Distribution::Kind::values);
    ASSERT_EQ(list.list.size(), 3u);
    EXPECT_DOUBLE_EQ(list.list[0], 2 * M_PI);
    EXPECT_EQ(list.list[1], 0);
    EXPECT_EQ(list.list[2], -3.5);
}

TEST(SceneDistributions, ATriangleMayLeanAgainstItsEnd) {
    EXPECT_EQ(distribution_of("initial.y", "\"triang\", low = 0, mode = 0, high = 1").mode, 0);
    EXPECT_EQ(distribution_of("initial.y", "\"triang\", low = 0, mode = 1, high = 1").mode, 1);
}

TEST(SceneDesigns, AreIndependentDrawsUnlessTheySayMore) {
    EXPECT_EQ(scene_of("schema = 1").design.kind, DesignKind::mc);
    Scene const scene = study("members = 7", three_keys);
    EXPECT_EQ(scene.study, StudyKind::tolerance);
    EXPECT_EQ(scene.design.kind, DesignKind::mc);
    EXPECT_EQ(scene.members, 7u);
    EXPECT_TRUE(scene.sample_times.empty());
    EXPECT_EQ(study("members = 7\ndesign = \"lhs\"", three_keys).design.kind, DesignKind::lhs);
    EXPECT_EQ(study("members = 7\ndesign = \"sobol\"", three_keys).design.kind, DesignKind::sobol);
    EXPECT_EQ(study("samples = 5", three_keys).sample_times.size(), 5u);
}

TEST(SceneDesigns, SaltelliHasTwoMembersMoreThanKeysInARow) {
    Scene const scene = study("design = \"saltelli\"\nbase = 128", three_keys);
    EXPECT_EQ(scene.design.kind, DesignKind::saltelli);
    EXPECT_EQ(scene.design.base, 128u);
    EXPECT_EQ(scene.members, 128u * 5);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(study("design = \"saltelli\"\nbase = 128\nmembers = 640", three_keys).members, 640u);
}

TEST(SceneDesigns, ABaseOfNoPowerOfTwoIsWarnedOf) {
    Scene const scene = study("design = \"saltelli\"\nbase = 200", three_keys);
    EXPECT_EQ(scene.members, 1000u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0],
              "study.base is 200 and no power of two, where points are spread less evenly; use 128 or 256");
}

TEST(SceneDesigns, FewRowsAreWarnedOf) {
    Scene const scene = study("design = \"saltelli\"\nbase = 64", three_keys);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0], "study.base is 64: the intervals of so few rows are too narrow; use 128 or more");
}

TEST(SceneCorrelation, OfAnEvenDesignIsWarnedOf) {
    std::string const correlated =
        three_keys +
        "[study.correlation]\nkeys = [\"joint.clearance\", \"initial.y\"]\nmatrix = [[1, 0.5], [0.5, 1]]\n";
    EXPECT_TRUE(study("members = 7", correlated).warnings.empty());
    EXPECT_TRUE(study("members = 7\ndesign = \"lhs\"", correlated).warnings.empty());
    auto const warnings = study("members = 7\ndesign = \"sobol\"", correlated).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("only joint.clearance keeps its even spread"), std::string::npos) << warnings[0];
}

TEST(SceneDesigns, AGridHasTheProductOfItsLevels) {
    std::string const vary = three_keys +
                             "\"initial.vy\" = { dist = \"norm\", mean = 0, sd = 1, levels = 7 }\n"
                             "\"initial.vz\" = { dist = \"const\", value = 0 }\n";
    Scene const scene = study("design = \"grid\"\nlevels = 3", vary);
    EXPECT_EQ(scene.design.levels, (std::vector<std::uint64_t>{3, 3, 2, 7, 1}));
    EXPECT_EQ(scene.members, 3u * 3 * 2 * 7);
    EXPECT_EQ(study("design = \"grid\"\nlevels = 3\nmembers = 126", vary).members, 126u);
    Scene const all_own = study("design = \"grid\"", "\"initial.y\" = {dist=\"unif\", low=0, high=1, levels=4}");
    EXPECT_EQ(all_own.members, 4u);
}

TEST(SceneDesigns, WhatAnotherDesignReadsIsWarnedOf) {
    std::string const vary = "\"initial.y\" = {dist=\"unif\", low=0, high=1, levels=4}";
    Scene const scene = study("design = \"saltelli\"\nbase = 64\nlevels = 3", vary, {{"study.design", "lhs"}, {"study.members", "8"}});
    EXPECT_EQ(scene.warnings,
              (std::vector<std::string>{"study.base has no effect with design \"lhs\"",
                                        "study.levels has no effect with design \"lhs\"",
                                        "study.vary.initial.y.levels has no effect with design \"lhs\""}));
}

TEST(SceneDesigns, AnOptionOfTheBaseReplacesTheMembers) {
    Scene const scene =
        study("design = \"lhs\"\nmembers = 100", three_keys, {{"study.design", "saltelli"}, {"study.base", "8"}});
    EXPECT_EQ(scene.members, 40u);
}

TEST(SceneDesigns, OtherStudiesHaveThemToo) {
    std::string const y = "[study.vary]\n\"initial.y\" = {dist=\"unif\", low=0, high=1e-5}";
    for (char const* kind : {"ensemble", "lyapunov", "poincare", "sweep"}) {
        std::string lines =
            "schema = 1\n[study]\nmembers = 4\ndesign = \"sobol\"\nkind = \"" + std::string(kind) + "\"\n";
        if (kind == std::string("sweep")) lines += "parameter = \"joint.clearance\"\nvalues = [1e-4]\n";
        EXPECT_EQ(scene_of(lines + y).design.kind, DesignKind::sobol) << kind;
    }
    EXPECT_EQ(scene_of("schema = 1\n[study]\ndesign = \"saltelli\"\nbase = 2\n" + y).members, 6u);
}

TEST(SceneTables, AreMembersRowByRow) {
    TableFolder const folder;
    std::string const text =
        "\xEF\xBB\xBF# measured\n"
        "\n"
        "joint.clearance [mm],\"initial.y [um]\" , friction.kinetic,way.yaw [mrad]\r\n"
        "0.1, 5,0.1,0\n"
        " +0.25 ,\"-3\", 2e-1 ,1.5\n"
        "\n"
        "1,-5e1,0.3,-0.25";
    folder.write("members.csv", text);
    Scene const scene = folder.read("[friction]\n[study]\ndesign = \"table\"\ntable = \"members.csv\"\n");
    EXPECT_EQ(scene.members, 3u);
    ASSERT_NE(scene.design.table, nullptr);
    MemberTable const& table = *scene.design.table;
    EXPECT_EQ(table.rows(), 3u);
    ASSERT_EQ(table.columns, 4u);
    // The bits of the same text with its unit in a scene.
    EXPECT_EQ(table.values[0], 1e-4);
    EXPECT_EQ(table.values[1], 5e-6);
    EXPECT_EQ(table.values[2], 0.1);
    EXPECT_EQ(table.values[4], 2.5e-4);
    EXPECT_EQ(table.values[5], -3e-6);
    EXPECT_EQ(table.values[6], 0.2);
    EXPECT_EQ(table.values[7], 1.5e-3);
    EXPECT_EQ(table.values[8], 1e-3);
    EXPECT_EQ(table.values[9], -5e-5);
    EXPECT_EQ(table.lines, (std::vector<int>{4, 5, 7}));
    EXPECT_TRUE(table.labels.empty());
    ASSERT_EQ(scene.variations.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(scene.variations[i].column, i);
    EXPECT_EQ(scene.variations[0].key, find_key("joint.clearance"));
    EXPECT_EQ(scene.variations[1].key, find_key("initial.y"));
    EXPECT_EQ(scene.variations[0].line, 3);
    EXPECT_TRUE(scene.parts.misaligned_way) << "a column brings the parts that it needs";
    EXPECT_EQ(table.path, (folder.path / "members.csv").string());
}

TEST(SceneTables, HaveTheChecksumOfTheirBytes) {
    TableFolder const folder;
    folder.write("a.csv", "initial.y\n1\n");
    // FNV-1a of the twelve bytes, byte by byte
    std::uint64_t hash = 14695981039346656037u;
    for (unsigned char const byte : std::string("initial.y\n1\n")) hash = (hash ^ byte) * 1099511628211u;
    EXPECT_EQ(folder.read("[study]\ndesign = \"table\"\ntable = \"a.csv\"").design.table->checksum, hash);
}

TEST(SceneTables, GiveTheirFirstRowsToFewerMembers) {
    TableFolder const folder;
    folder.write("a.csv", "initial.y\n1\n2\n3\n");
    Scene const scene = folder.read("[study]\ndesign = \"table\"\ntable = \"a.csv\"\nmembers = 2");
    EXPECT_EQ(scene.members, 2u);
    EXPECT_EQ(scene.design.table->rows(), 3u);
}

TEST(SceneTables, LieBesideTheSceneForOptionsToo) {
    TableFolder const folder;
    folder.write("a.csv", "initial.y\n1\n2\n3\n");
    Scene const scene = folder.read("", {{"study.design", "table"}, {"study.table", "a.csv"}});
    EXPECT_EQ(scene.members, 3u);
    std::string const absolute = (folder.path / "a.csv").string();
    EXPECT_EQ(scene_of("schema = 1", {{"study.design", "table"}, {"study.table", absolute}}).members, 3u);
}

TEST(SceneTables, LeaveOtherKeysToVary) {
    TableFolder const folder;
    folder.write("a.csv", "initial.y\n1\n2\n3\n");
    Scene const scene = folder.read(
        "[study]\ndesign = \"table\"\ntable = \"a.csv\"\n[study.vary]\n\"initial.z\" = {dist=\"unif\", low=0, high=1}");
    ASSERT_EQ(scene.variations.size(), 2u);
    EXPECT_EQ(scene.variations[0].column, Variation::no_column);
    EXPECT_EQ(scene.variations[1].column, 0u);
}

TEST(SceneTables, TellOrbitsWhichSpeedsThereAre) {
    TableFolder const folder;
    std::string const lines =
        "[study]\nkind = \"poincare\"\nrevolutions = 10\ntransient_revolutions = 0\ndesign = \"table\"\n"
        "table = \"a.csv\"\n";
    folder.write("a.csv", "mechanism.crank_speed\n1\n2\n0\n");
    EXPECT_TRUE(contains(folder.error(lines), "mechanism.crank_speed may be 0"));
    EXPECT_EQ(folder.error(lines + "members = 2"), "") << "the row of 0 is not among the first two";
}

TEST(SceneCorrelations, NameVariationsByTheirPlace) {
    Scene const scene = study("", three_keys +
                                      "[study.correlation]\nkeys = [\"joint.clearance\", \"initial.y\"]\n"
                                      "matrix = [[1, -0.5], [-0.5, 1.0]]");
    EXPECT_EQ(scene.design.correlation.variations, (std::vector<std::size_t>{2, 0}));
    EXPECT_EQ(scene.design.correlation.matrix, (std::vector<double>{1, -0.5, -0.5, 1}));
    EXPECT_TRUE(study("", three_keys).design.correlation.variations.empty());
}

TEST(SceneCorrelations, AreRefusedWhereNoValuesHaveThem) {
    auto const error = [](std::string const& entries) {
        return testing::error_of(
            "schema = 1\n[study.vary]\n" + three_keys +
            "[study.correlation]\nkeys = [\"joint.clearance\", \"initial.y\", \"initial.z\"]\nmatrix = " + entries);
    };
    // Equal correlations r of three: positive definite from r > -1/2, where the eigenvalue 1 + 2 r vanishes.
    EXPECT_EQ(error("[[1, -0.499, -0.499], [-0.499, 1, -0.499], [-0.499, -0.499, 1]]"), "");
    for (char const* r : {"-0.5", "-0.501", "-0.9"}) {
        std::string const e(r);
        EXPECT_TRUE(contains(error("[[1, " + e + ", " + e + "], [" + e + ", 1, " + e + "], [" + e + ", " + e + ", 1]]"),
                             "not positive definite"))
            << r;
    }
}

TEST(SceneLimits, AreOfQuantitiesAndTheirEntries) {
    Scene const scene = study("",
                              "[study.limits]\n\"peak_normal_force\" = { max = \"2 kN\" }\n\"mode_time[free]\" = { min "
                              "= \"1 ms\", max = 2 }\n"
                              "\"peak_tilt[pitch]\" = { min = \"-0.1 mrad\" }\n\"peak_apex_force[P8]\" = { max = 3 }");
    ASSERT_EQ(scene.limits.size(), 4u);
    EXPECT_EQ(scene.limits[0].name(), "peak_normal_force");
    EXPECT_EQ(scene.limits[0].high, 2000);
    EXPECT_EQ(scene.limits[0].low, -infinity);
    EXPECT_EQ(scene.limits[1].quantity, "mode_time");
    EXPECT_EQ(scene.limits[1].label, "free");
    EXPECT_EQ(scene.limits[1].low, 1e-3);
    EXPECT_EQ(scene.limits[1].high, 2);
    EXPECT_EQ(scene.limits[2].label, "pitch");
    EXPECT_EQ(scene.limits[2].low, -1e-4);
    EXPECT_EQ(scene.limits[2].high, infinity);
    EXPECT_EQ(scene.limits[3].label, "P8");
}

TEST(SceneLimits, AskForTheirQuantities) {
    Scene const scene = scene_of(
        "schema = 1\n[study]\nkind = \"tolerance\"\n[study.limits]\n\"peak_normal_force\" = { max = 1 }\n"
        "\"peak_tilt[roll]\" = { max = 1 }\n[study.vary]\n" +
        three_keys);
    EXPECT_EQ(scene.quantities, selection_of(Quantity::peak_normal_force) | selection_of(Quantity::peak_tilt));
    EXPECT_EQ(scene_of("schema = 1\n[study.limits]\nfriction_loss = {max=1}").quantities,
              selection_of(Quantity::friction_loss));
}

}  // namespace
}  // namespace slideway::tolerance_test
