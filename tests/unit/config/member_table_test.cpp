// Tables of members as spreadsheets write them: separators, decimal commas, labels, and what is refused of their rows.
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::member_table_test {
namespace {

using testing::contains;
using testing::TableFolder;

constexpr char const* study = "[mechanism]\nkind = \"free_slider\"\n[friction]\n[study]\ndesign = \"table\"\ntable = \"a.csv\"\nduration = \"10 ms\"\n";

Scene scene_of_table(std::string const& table) {
    TableFolder const folder;
    folder.write("a.csv", table);
    return folder.read(study);
}

std::string error_of_table(std::string const& table, std::string const& scene = study) {
    TableFolder const folder;
    folder.write("a.csv", table);
    return folder.error(scene);
}

using Values = std::vector<double>;

TEST(MemberTable, IsReadWithEverySeparatorAndDecimalMark) {
    Values const one{0.1005, 1.25e-3};
    for (char const* const table :
         {"initial.vx [mm/s],joint.clearance [mm]\n100.5,1.25\n", "initial.vx [mm/s];joint.clearance [mm]\n100.5;1.25\n",
          "initial.vx [mm/s]\tjoint.clearance [mm]\n100.5\t1.25\n", "initial.vx [mm/s];joint.clearance [mm]\n100,5;1,25\n",
          "initial.vx [mm/s]\tjoint.clearance [mm]\r\n100,5\t1,25\r\n", "initial.vx [mm/s],joint.clearance [mm],\n100.5,1.25,\n",
          "initial.vx [mm/s];joint.clearance [mm];;\n100,5;1,25;;\n", "\xEF\xBB\xBF\"initial.vx [mm/s]\";\"joint.clearance [mm]\"\n\"100,5\";\"1,25\"\n"}) {
        EXPECT_EQ(scene_of_table(table).design.table->values, one) << table;
    }
    Scene const several = scene_of_table("initial.vx [mm/s];joint.clearance [mm]\n100,5;1,25\n200,25;1,5\n3;1\n");
    EXPECT_EQ(several.design.table->values, (Values{0.1005, 1.25e-3, 0.20025, 1.5e-3, 3e-3, 1e-3}));
    EXPECT_EQ(several.members, 3u);
}

TEST(MemberTable, KeepsColumnsOfTextAsLabels) {
    Scene const scene = scene_of_table("part,initial.vx [m/s],joint.clearance [mm],lot no.\nA-001,1,1,north 7\n\"B, 2\",2,1,\n-,3,1,east\n");
    EXPECT_EQ(scene.design.table->values, (Values{1, 1e-3, 2, 1e-3, 3, 1e-3}));
    EXPECT_EQ(scene.design.table->labelled, "part, lot no.");
    EXPECT_EQ(label_of(scene, 0), "A-001, north 7");
    EXPECT_EQ(label_of(scene, 1), "B, 2");
    EXPECT_EQ(label_of(scene, 2), "east");
    EXPECT_EQ(label_of(scene_of_table("initial.vx\n1\n"), 0), "");
    EXPECT_EQ(scene_of_table("initial.vx,notes\n1,\n2,\n").design.table->labels, (std::vector<std::string>{"", ""})) << "an empty column";
}

TEST(MemberTable, TakesNoKeyThatIsMistypedForALabel) {
    // Whatever stands below: the values of a key would be lost.
    EXPECT_EQ(error_of_table("joint.clearence,initial.vx\nwide,1\n"),
              "a.csv:1: column 1 is \"joint.clearence\" (only numeric keys of the physics can be columns); did you mean \"joint.clearance\"?");
    EXPECT_TRUE(contains(error_of_table("clearance,initial.vx\nwide,1\n"), "did you mean \"joint.clearance"));
    EXPECT_TRUE(contains(error_of_table("initial.speed_of_x,initial.vx\nfast,1\n"), "column 1 is \"initial.speed_of_x\" (only numeric keys"));
    EXPECT_TRUE(contains(error_of_table("gap [mm],initial.vx\nwide,1\n"), "column 1 is \"gap [mm]\" (only numeric keys"));
    EXPECT_TRUE(contains(error_of_table(",initial.vx\na,1\n"), "column 1 is \"\" (only numeric keys"));
    // Numbers are no labels.
    EXPECT_EQ(error_of_table("serial,initial.vx\n17,1\n18,2\n"),
              "a.csv:1: column 1 is \"serial\" (only numeric keys of the physics can be columns); use a dotted key like \"joint.clearance\"");
    EXPECT_EQ(error_of_table("gap,initial.vx\n0.1,1\n0.2,1\nwide,1\n"),
              "a.csv:1: column 1 is \"gap\" (no key of the physics, and below it stand a number, in line 2, and a text, in line 4); "
              "give it texts alone, or remove it");
    // Nor are numbers in a spreadsheet's dress, or what is empty.
    for (std::string const cells : {"\"0,1\",1\n\"0,2\",2\n", "10%,1\n20 %,2\n", "1 mm,1\n2 mm,2\n", "NA,1\n-,2\n"})
        EXPECT_TRUE(contains(error_of_table("mu,initial.vx\n" + cells), "column 1 is \"mu\" (only numeric keys")) << cells;
    for (std::string const label : {"2024-05-01", "17-B", "3rd", "lot 4"}) EXPECT_EQ(error_of_table("part,initial.vx\n" + label + ",1\n"), "") << label;
    EXPECT_EQ(error_of_table("part\nA-001\n"),
              "a.csv:2: the table has no column of numbers (its header names no key); write keys like joint.clearance above");
}

TEST(MemberTable, HasCommentsThatASpreadsheetPutIntoQuotes) {
    EXPECT_EQ(error_of_table("\"# measured, by hand\",,\njoint.clearance [mm],initial.vx,\n0.1,1,\n"), "");
}

TEST(MemberTable, RefusesCellsWithoutANumber) {
    std::string const header = "initial.vx [m/s],joint.clearance [mm]\n1,1\n";
    EXPECT_EQ(error_of_table(header + "#N/A,1\n#DIV/0!,1\n3,1\n"),
              "a.csv:3: initial.vx (column 1) is \"#N/A\" (an error of the spreadsheet); correct its formula, or remove the row; line 4 has such cells too");
    EXPECT_TRUE(error_of_table(header + "1,\n1,1\nNA,1\nx,1\n").ends_with("; lines 5, 6 have such cells too"));
    EXPECT_TRUE(error_of_table(header + ",\n,\n,\n,\n,\n,\n,\n").ends_with("; lines 4, 5, 6, 7, 8 and others have such cells too"));
    EXPECT_EQ(error_of_table(header + "2,#DIV/0!\n"),
              "a.csv:3: joint.clearance (column 2) is \"#DIV/0!\" (an error of the spreadsheet); correct its formula, or remove the row");
    EXPECT_EQ(error_of_table(header + "2,NaN\n"),
              "a.csv:3: joint.clearance (column 2) is \"NaN\" (a missing value); give a number, or remove the row");
    EXPECT_EQ(error_of_table(header + "inf,1\n"), "a.csv:3: initial.vx (column 1) is \"inf\" (not a finite number); use a finite number");
    EXPECT_EQ(error_of_table(header + "# a comment\n"), "a.csv:3: the row has 1 fields between commas (the header has 2 columns); comments stand above the header");
    EXPECT_EQ(error_of_table("initial.vx;joint.clearance [mm]\n1,5;1\n1.5;1\n"),
              "a.csv:3: initial.vx (column 1) is \"1.5\" (a decimal point, after a decimal comma in line 2); use one of the two in all of the file");
}

TEST(MemberTable, RefusesRowsThatASceneCouldNotHave) {
    EXPECT_EQ(error_of_table("part,joint.clearance [mm]\na,1\nb,-1\n"),
              "a.csv:3: joint.clearance (column 2) is \"-1\" (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm");
    EXPECT_TRUE(contains(error_of_table("friction.static\n0.1\n-0.1\n"), "a.csv:3: friction.static (column 1) is \"-0.1\" (the "));
    std::string const crank = "[study]\ndesign = \"table\"\ntable = \"a.csv\"\n";
    EXPECT_EQ(error_of_table("mechanism.rod_length [mm]\n142\n40\n", crank),
              "a.csv:3: mechanism.rod_length is 0.04 m (the crank of 0.05 m cannot turn fully); use a rod longer than the crank, or crank_speed = 0");
    EXPECT_EQ(error_of_table("friction.slip_speed,friction.stick_speed\n0.01,0.001\n0.001,0.001\n", "[friction]\n" + crank),
              "a.csv:3: friction.slip_speed is 0.001 m/s (not above friction.stick_speed, 0.001 m/s); use a slip_speed > stick_speed");
    // What is drawn beside the table may fit where the scene's own value does not.
    EXPECT_EQ(error_of_table("friction.slip_speed\n0.001\n",
                             "[friction]\n" + crank + "[study.vary]\n\"friction.stick_speed\" = {dist=\"unif\", low=1e-4, high=2e-4}"),
              "");
}

}  // namespace
}  // namespace slideway::member_table_test
