// What a user reads about distributions, designs, tables, correlations and limits that cannot be used.
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::tolerance_errors_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::TableFolder;

/// The error of an entry of [study.vary], which is line 4 of the scene.
std::string error_of_entry(std::string const& entry) {
    return error_of("schema = 1\n[friction]\n[study.vary]\n" + entry + "\n");
}

TEST(SceneToleranceErrors, DistributionsBreakTheirOwnRules) {
    EXPECT_TRUE(contains(error_of_entry("\"initial.y\" = {dist=\"triang\", low=0, mode=-1, high=1}"), "mode is -1 m"));
    EXPECT_TRUE(contains(error_of_entry("\"initial.y\" = {dist=\"lognorm\", mean=1, sd=1, low=2}"),
                         "initial.y.mean is 1 m (not above low, 2 m)"));
    EXPECT_TRUE(contains(error_of_entry("\"initial.y\" = {dist=\"weibull\", scale=1, shape=\"1 m\"}"),
                         "the unit \"m\" does not convert to a plain number"));
    for (char const* values : {"[]", "1", "\"1 mm\""}) {
        EXPECT_TRUE(contains(error_of_entry("\"initial.y\" = {dist=\"values\", values=" + std::string(values) + "}"),
                             "(not a list of 1 to 10000 values); write for example [1, 2]"))
            << values;
    }
    EXPECT_TRUE(
        contains(error_of_entry("\"initial.y\" = {dist=\"values\", values=[1, true]}"), "is true (not a number)"));
}

TEST(SceneToleranceErrors, DistributionsBreakTheirKeysRule) {
    EXPECT_TRUE(contains(error_of_entry("\"joint.clearance\" = {dist=\"weibull\", scale=1, shape=1, low=-1}"),
                         "joint.clearance.low is -1 m"));
}

/// The error of lines below [study], the first of which is line 3, with one key that varies.
std::string error_of_study(std::string const& lines) {
    return error_of("schema = 1\n[study]\n" + lines +
                    "\n[study.vary]\n\"initial.y\" = { dist = \"unif\", low = 0, high = 1e-5 }\n");
}

TEST(SceneToleranceErrors, Designs) {
    EXPECT_EQ(error_of_study("design = \"sobel\""),
              "scene.toml:3: study.design is \"sobel\" (there is no such design); did you mean \"sobol\"?");
    for (char const* design : {"lhs", "sobol", "saltelli", "grid"}) {
        std::string const line = "schema = 1\n[study]\ndesign = \"" + std::string(design) + "\"\n";
        std::string const expected = "scene.toml:3: study.design is \"" + std::string(design) +
                                     "\" (nothing varies); add keys to [study.vary], or remove it";
        EXPECT_EQ(error_of(line), expected);
        EXPECT_EQ(error_of(line + "[study.vary]\n\"initial.y\" = {dist=\"const\", value=0}"), expected);
    }
    for (char const* design : {"saltelli", "grid", "table"}) {
        EXPECT_EQ(error_of_study("kind = \"sweep\"\nparameter = \"joint.clearance\"\nvalues = [1e-4]\ndesign = \"" +
                                 std::string(design) + "\""),
                  "scene.toml:6: study.design is \"" + std::string(design) +
                      "\" (a sweep draws the starts of its columns); use \"mc\", \"lhs\" or \"sobol\"");
    }
    EXPECT_EQ(error_of_study("kind = \"poincare\"\ndesign = \"saltelli\""),
              "scene.toml:4: study.design is \"saltelli\" (kind = \"poincare\" asks for no sensitivities); "
              "use \"mc\", \"lhs\" or \"sobol\", or kind = \"tolerance\"");
    EXPECT_EQ(error_of_study("kind = \"lyapunov\"\nbase = 4"),
              "scene.toml:4: study.base is 4 (it has no effect with kind = \"lyapunov\"); "
              "remove it, or use kind = \"ensemble\" or \"tolerance\"");
    EXPECT_EQ(error_of_study("kind = \"tolerance\""),
              "scene.toml:3: a quantity is missing (a tolerance study tells how quantities scatter); "
              "add quantities = [\"mean_normal_force\", \"friction_loss\"], or see `slideway list`");
    EXPECT_TRUE(
        contains(error_of_study("kind = \"tolerance\"\nquantities = []"), "scene.toml:4: a quantity is missing"));
}

TEST(SceneToleranceErrors, NumbersOfMembers) {
    EXPECT_EQ(error_of_study("design = \"saltelli\""),
              "scene.toml:3: study.base is missing (\"saltelli\" has base rows of one member and one more of each key "
              "and another); add base = 256");
    EXPECT_EQ(error_of_study("design = \"saltelli\"\nbase = 8\nmembers = 25"),
              "scene.toml:5: study.members is 25 (the design has 24, study.base times 3); remove it");
    EXPECT_EQ(error_of_study("design = \"saltelli\"\nbase = 1000000000"),
              "scene.toml:4: study.base is 1000000000 (with 3 members a row there would be 3000000000); "
              "use a value <= 333333333");
    EXPECT_EQ(error_of_study("design = \"saltelli\"\nbase = 1"),
              "scene.toml:4: study.base is 1 (the number of rows must be an integer from 2 to 1000000000); "
              "use an integer >= 2 and <= 1000000000");
    EXPECT_EQ(error_of_study("design = \"grid\""),
              "scene.toml:5: study.vary.initial.y.levels is missing (a grid takes each key at as many values); "
              "add levels = 5 to it, or to [study]");
    EXPECT_EQ(error_of_study("design = \"grid\"\nlevels = 8\nmembers = 9"),
              "scene.toml:5: study.members is 9 (the design has 8, the product of the levels); remove it");
    EXPECT_TRUE(
        contains(error_of_study("design = \"grid\"\nlevels = 0"), "study.levels is 0 (the number of levels must"));
    std::string const vary = "\"initial.z\" = {dist=\"unif\", low=0, high=1, levels=1000}\n";
    EXPECT_EQ(error_of("schema = 1\n[study]\ndesign = \"grid\"\nlevels = 1000001\n[study.vary]\n" + vary +
                       "\"initial.y\" = {dist=\"unif\", low=0, high=1}"),
              "scene.toml:4: study.levels is 1000001 (the grid would have more than 1000000000 members); "
              "use fewer levels");
}

TEST(SceneToleranceErrors, TablesThatAreNotThere) {
    TableFolder const folder;
    EXPECT_EQ(folder.error("[study]\ndesign = \"table\""),
              "scene.toml:3: study.table is missing (the design is the rows of a table); add table = \"members.csv\"");
    EXPECT_EQ(folder.error("[study]\ndesign = \"table\"\ntable = \"members.csv\""),
              "scene.toml:4: study.table is \"members.csv\" (members.csv cannot be read: No such file or directory); "
              "check the path, from the scene's folder on");
    EXPECT_EQ(folder.error("[study]\ndesign = \"table\"\ntable = \".\""),
              "scene.toml:4: study.table is \".\" (it is a directory); name a file in it");
    EXPECT_EQ(folder.error("[study]\ndesign = \"table\"\ntable = \"\""),
              "scene.toml:4: study.table is \"\" (no file has this name; members of Ensemble.run(inputs=...) are of none); name a file, or run one of them by slideway.scene(result, member=K)");
    EXPECT_EQ(folder.error("[study]\ntable = \"members.csv\""),
              "scene.toml:3: study.table is \"members.csv\" (design \"mc\" reads no table); "
              "use design = \"table\", or remove it");
    EXPECT_TRUE(contains(folder.error("[study]\ndesign = \"table\"\ntable = \"/dev/zero\""), "larger than 256 MiB"));
}

/// The error of a scene with this table.
std::string error_of_table(std::string const& table, std::string const& lines = "", Overrides const& overrides = {}) {
    TableFolder const folder;
    folder.write("a.csv", table);
    return folder.error("[study]\ndesign = \"table\"\ntable = \"a.csv\"\n" + lines, overrides);
}

TEST(SceneToleranceErrors, HeadersOfTables) {
    EXPECT_EQ(error_of_table(""),
              "a.csv:1: the table is empty (it needs a header and a row); write keys like "
              "joint.clearance above");
    EXPECT_EQ(error_of_table("# a\ninitial.y\n\n"),
              "a.csv:3: the table has a header but no row (a row is a member); add one");
    EXPECT_EQ(error_of_table("\ninitial.y,joint.clearence\n1,1\n"),
              "a.csv:2: column 2 is \"joint.clearence\" (only numeric keys of the physics can be columns); "
              "did you mean \"joint.clearance\"?");
    EXPECT_TRUE(contains(error_of_table("initial.y,,initial.z\n1,1,1\n"), "a.csv:1: column 2 is \"\" (only numeric"));
    EXPECT_EQ(
        error_of_table("initial.y [kg]\n1\n"),
        "a.csv:1: column 1 is \"initial.y [kg]\" (the unit \"kg\" does not convert to m); use a unit like m or mm");
    EXPECT_EQ(error_of_table("initial.y [mm\n1\n"),
              "a.csv:1: column 1 is \"initial.y [mm\" (its unit has no end); write \"initial.y [m]\"");
    EXPECT_EQ(error_of_table("joint.clearance,joint.clearance_z\n1,1\n"),
              "a.csv:1: column 2 is \"joint.clearance_z\" (the column joint.clearance has the same); remove one of the two");
    EXPECT_EQ(error_of_table("initial.y\n1\n", "[study.vary]\n\"initial.y\" = {dist=\"unif\", low=0, high=1}"),
              "a.csv:1: column 1 is \"initial.y\" (study.vary.initial.y varies the same); remove one of the two");
    EXPECT_EQ(error_of_table("friction.static\n0.2\n"),
              "a.csv:1: column 1 is \"friction.static\" (friction is off); add a [friction] table");
    EXPECT_EQ(error_of_table("initial.y\n1\n", "", {{"initial.y", "2"}}),
              "--set initial.y=2: initial.y is 2 (study.table has it for every member, so this has no effect); "
              "change the table");
}

TEST(SceneToleranceErrors, RowsOfTables) {
    EXPECT_EQ(error_of_table("initial.y,initial.z\n1,2\n3\n"),
              "a.csv:3: the row has 1 fields between commas (the header has 2 columns); write one for each column");
    EXPECT_EQ(error_of_table("initial.y [mm],initial.z\n1,2\n\n3 mm,4\n"),
              "a.csv:4: initial.y (column 1) is \"3 mm\" (not a number); use a number of mm without its unit");
    EXPECT_EQ(error_of_table("initial.y,initial.z\n1,\n"),
              "a.csv:2: initial.z (column 2) is \"\" (a missing value); give a number, or remove the row");
    EXPECT_EQ(error_of_table("friction.static\nlots\n", "[friction]\n"),
              "a.csv:2: friction.static (column 1) is \"lots\" (not a number); use a number");
    EXPECT_EQ(error_of_table("initial.y\n\"1\n"),
              "a.csv:2: a quoted field does not end (a quote is open); write \" behind it");
    EXPECT_EQ(error_of_table("initial.y\n\"1\"2\n"),
              "a.csv:2: a quoted field goes on behind its quotes; write a comma there");
    EXPECT_EQ(error_of_table("initial.y\n1\n2\n", "members = 3"),
              "scene.toml:5: study.members is 3 (study.table has 2 rows); use a value <= 2, or leave it out");
}

TEST(SceneToleranceErrors, Correlations) {
    std::string const vary =
        "[study.vary]\n\"initial.y\" = {dist=\"unif\", low=0, high=1}\n\"initial.z\" = {dist=\"unif\", low=0, high=1}\n"
        "\"initial.vy\" = {dist=\"const\", value=0}\n";
    auto const error = [&](std::string const& lines, std::string const& study = "") {
        return error_of("schema = 1\n[study]\n" + study + "\n[study.correlation]\n" + lines + "\n" + vary);
    };
    std::string const keys = "keys = [\"initial.y\", \"initial.z\"]\n", matrix = "matrix = [[1, 0.5], [0.5, 1]]";
    EXPECT_EQ(error(keys + matrix), "");
    EXPECT_EQ(error(matrix),
              "scene.toml:4: study.correlation.keys is missing (which keys vary together); "
              "add keys = [\"joint.clearance_y\", \"joint.clearance_z\"]");
    EXPECT_EQ(error(keys),
              "scene.toml:4: study.correlation.matrix is missing (how keys vary together); "
              "add matrix = [[1, 0.5], [0.5, 1]]");
    EXPECT_EQ(error("key = 1"),
              "scene.toml:5: study.correlation.key is 1 (no argument of a correlation); "
              "use keys, matrix");
    EXPECT_EQ(error("keys = [\"initial.y\"]"),
              "scene.toml:5: study.correlation.keys is a list (not a list of two or more keys); "
              "write for example [\"joint.clearance_y\", \"initial.y\"]");
    EXPECT_EQ(error("keys = [\"initial.y\", \"initial.zz\"]"),
              "scene.toml:5: study.correlation.keys is \"initial.zz\" ([study.vary] has no such key); "
              "did you mean \"initial.z\"?");
    EXPECT_EQ(error("keys = [\"initial.y\", \"joint.clearance\"]"),
              "scene.toml:5: study.correlation.keys is \"joint.clearance\" ([study.vary] has no such key); "
              "name keys as in [study.vary]");
    EXPECT_EQ(
        error("keys = [\"initial.y\", \"initial.y\"]"),
        "scene.toml:5: study.correlation.keys is \"initial.y\" (it is in the list already); remove one of the two");
    EXPECT_EQ(error("keys = [\"initial.y\", \"initial.vy\"]"),
              "scene.toml:5: study.correlation.keys is \"initial.vy\" (its distribution is \"const\"); "
              "remove it, or let it vary");
    for (char const* bad : {"1", "[]", "[[1, 0], [0]]", "[[1]]", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "[1, 0]"}) {
        EXPECT_TRUE(contains(error(keys + "matrix = " + bad),
                             "(not 2 rows of 2 numbers, one for each key); write for example [[1, 0.5], [0.5, 1]]"))
            << bad;
    }
    EXPECT_EQ(
        error(keys + "matrix = [[1, 0.5], [0.5, 2]]"),
        "scene.toml:6: study.correlation.matrix is 2 (row 2, column 2: a key is itself); write 1 on the diagonal");
    EXPECT_EQ(error(keys + "matrix = [[1, 0.5], [0.4, 1]]"),
              "scene.toml:6: study.correlation.matrix is 0.4 (row 2, column 1: the entry across the diagonal is 0.5); "
              "write the same number in both places");
    EXPECT_EQ(error(keys + "matrix = [[1, -1], [-1, 1]]"),
              "scene.toml:6: study.correlation.matrix is -1 (row 1, column 2: such keys would be one); "
              "use a value > -1 and < 1");
    EXPECT_TRUE(contains(error(keys + "matrix = [[1, nan], [nan, 1]]"), "not a finite number"));
    EXPECT_EQ(error(keys + matrix, "design = \"saltelli\"\nbase = 4\n"),
              "scene.toml:6: study.correlation is a table (sensitivities of design \"saltelli\" are of keys that vary "
              "alone); remove it, or use \"mc\", \"lhs\" or \"sobol\"");
    EXPECT_EQ(error(keys + matrix, "design = \"grid\"\nlevels = 4\n"),
              "scene.toml:6: study.correlation is a table (a grid takes its levels of each key alone); "
              "remove it, or use \"mc\", \"lhs\" or \"sobol\"");
    EXPECT_EQ(error_of_table("initial.vz\n1\n",
                             "[study.correlation]\nkeys = [\"initial.y\", \"initial.vz\"]\n" + matrix + "\n" + vary),
              "scene.toml:6: study.correlation.keys is \"initial.vz\" (study.table has its values); "
              "correlate keys of [study.vary] alone");
}

TEST(SceneToleranceErrors, NotPositiveDefinite) {
    std::string vary, keys;
    for (char const* key : {"initial.y", "initial.z", "initial.vy"}) {
        vary += "\"" + std::string(key) + "\" = {dist=\"unif\", low=0, high=1}\n";
        keys += "\"" + std::string(key) + "\", ";
    }
    EXPECT_EQ(error_of("schema = 1\n[study.correlation]\nkeys = [" + keys +
                       "]\nmatrix = [[1, 0.9, 0.9], [0.9, 1, -0.9], [0.9, -0.9, 1]]\n[study.vary]\n" + vary),
              "scene.toml:4: study.correlation.matrix is a list (not positive definite: no values are correlated so); "
              "use entries nearer to 0");
}

TEST(SceneToleranceErrors, Limits) {
    auto const error = [](std::string const& line) { return error_of("schema = 1\n[study.limits]\n" + line); };
    EXPECT_EQ(error("peak_normal_forse = {max=1}"),
              "scene.toml:3: study.limits.peak_normal_forse cannot be limited (there is no such quantity); "
              "did you mean \"peak_normal_force\"?");
    EXPECT_EQ(error("normal_force = {max=1}"),
              "scene.toml:3: study.limits.normal_force cannot be limited (it is a time series); "
              "limit a quantity, see `slideway list`");
    EXPECT_EQ(error("mode_time = {max=1}"),
              "scene.toml:3: study.limits.mode_time cannot be limited (it has a value for each mode_class); "
              "write \"mode_time[free]\", one of free, point, line, surface");
    EXPECT_EQ(error("\"peak_tilt[nod]\" = {max=1}"),
              "scene.toml:3: study.limits.peak_tilt[nod] cannot be limited (there is no such axis); "
              "write \"peak_tilt[roll]\", one of roll, yaw, pitch");
    EXPECT_TRUE(contains(error("\"peak_tilt[roll\" = {max=1}"), "there is no such axis"));
    EXPECT_EQ(error("\"friction_loss[a]\" = {max=1}"),
              "scene.toml:3: study.limits.friction_loss[a] cannot be limited (it is one number); "
              "write \"friction_loss\"");
    EXPECT_EQ(error("friction_loss = 1"),
              "scene.toml:3: study.limits.friction_loss is 1 (not a limit); "
              "write for example { min = 0, max = 1 }, or one of the two");
    EXPECT_EQ(error("friction_loss = {}"),
              "scene.toml:3: study.limits.friction_loss has neither min nor max (it would be met always); "
              "write for example { min = 0, max = 1 }, or one of the two");
    EXPECT_EQ(error("friction_loss = {mx=1}"),
              "scene.toml:3: study.limits.friction_loss.mx is 1 (no argument of a limit); use min, max");
    EXPECT_EQ(error("friction_loss = {min=2, max=1}"),
              "scene.toml:3: study.limits.friction_loss.max is 1 J (below min, 2 J); use min <= max");
    EXPECT_EQ(error("friction_loss = {max=\"1 N\"}"),
              "scene.toml:3: study.limits.friction_loss.max is \"1 N\" (the unit \"N\" does not convert to J); "
              "use a unit like J");
    EXPECT_EQ(error("friction_loss = {min=1, max=1}"), "");
}

}  // namespace
}  // namespace slideway::tolerance_errors_test
