#include "tests/system/process.hpp"

#include <sstream>

#include "host/backend/backend.hpp"
#include "tests/oracle/golden_table.hpp"

namespace slideway::testing::probe_test {
namespace {

std::filesystem::path golden_file(std::string const& name) {
    return std::filesystem::path(SLIDEWAY_TEST_DATA) / "golden" / name;
}

std::string first_line(std::string const& text) { return text.substr(0, text.find('\n')); }

class Probe : public Program {
protected:
    Probe() { write("s.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[friction]\n[initial]\nz = \"0.01 mm\"\n"); }
};

class GoldenTable : public Program, public ::testing::WithParamInterface<std::tuple<std::string, Isa>> {};

TEST_P(GoldenTable, IsMetInEveryColumn) {
    auto const [name, isa] = GetParam();
    if (!is_supported(isa)) GTEST_SKIP() << "not on this machine";
    std::string const scene = std::string(SLIDEWAY_SCENES) + "/slider_crank_0.1mm.toml";
    Outcome const outcome =
        run({"probe", scene, "--csv", golden_file(name).string(), "-o", "got.csv", "--isa", std::string(name_of(isa))});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(first_line(file_text(path("got.csv"))), first_line(file_text(golden_file(name))) + ",status");
    auto const reference = golden::Table::read(golden_file(name)), got = golden::Table::read(path("got.csv"));
    auto const difference = golden::worst_difference(reference, got);
    EXPECT_LE(difference.value, 2e-8) << difference.where;  // model.md 11
}

INSTANTIATE_TEST_SUITE_P(Probe, GoldenTable,
                         ::testing::Combine(::testing::Values("rhs_paper.csv", "rhs_conservative.csv",
                                                              "rhs_parameters.csv", "rhs_kelvin_voigt.csv",
                                                              "rhs_kelvin_voigt_parameters.csv", "rhs_foundation.csv",
                                                              "rhs_foundation_parameters.csv"),
                                            ::testing::ValuesIn(built_isas())),
                         [](auto const& info) {
                             std::string const& name = std::get<0>(info.param);
                             return name.substr(4, name.size() - 8) + "_" +
                                    std::string(name_of(std::get<1>(info.param)));
                         });

TEST_F(Probe, OfAShuffledTableGivesTheSameRows) {
    // The same rows with the columns reversed and a column of no meaning: every row keeps its numbers.
    std::istringstream in(file_text(golden_file("rhs_paper.csv")));
    std::string line, reversed, plain;
    for (int row = 0; row < 12 && std::getline(in, line); ++row) {
        plain += line + "\n";
        std::string turned = row == 0 ? "remark" : "text";
        for (std::size_t end = line.size(); end != line.npos;) {
            auto const comma = line.rfind(',', end - 1);
            turned += ',';
            turned.append(line, comma + 1, end - comma - 1);  // npos + 1 is 0
            end = comma;
        }
        reversed += turned + "\n";
    }
    write("plain.csv", plain);
    write("reversed.csv", reversed);
    ASSERT_EQ(run({"probe", "s.toml", "--csv", "plain.csv", "-o", "a.csv"}).code, 0);
    ASSERT_EQ(run({"probe", "s.toml", "--csv", "reversed.csv", "-o", "b.csv"}).code, 0);
    auto const a = golden::Table::read(path("a.csv")), b = golden::Table::read(path("b.csv"));
    ASSERT_EQ(a.rows(), 11u);
    ASSERT_EQ(b.rows(), 11u);
    for (std::string const& column : a.columns()) {
        for (std::size_t row = 0; row < a.rows(); ++row) EXPECT_EQ(a.text(row, column), b.text(row, column)) << column;
    }
}

TEST_F(Probe, OfASceneShowsItsStart) {
    Outcome const listing = run({"probe", "s.toml"});
    EXPECT_EQ(listing.code, 0) << listing.err;
    for (char const* const word : {"finished", "penetration Y", "0 surfaces, 0 lines, 0 points", "crank torque"}) {
        EXPECT_NE(listing.out.find(word), std::string::npos) << word;
    }
    ASSERT_EQ(run({"probe", "s.toml", "-o", "start.csv"}).code, 0);
    auto const start = golden::Table::read(path("start.csv"));
    ASSERT_EQ(start.rows(), 1u);
    EXPECT_EQ(start.number(0, "z"), 1e-5);
    EXPECT_EQ(start.text(0, "status"), "finished");
    // Centred in Y: every apex is a clearance away from its face; off by 0.01 mm in Z.
    EXPECT_NEAR(start.number(0, "pen_y_P1"), -1e-4, 1e-16);
    EXPECT_NEAR(start.number(0, "pen_z_P1"), -1.1e-4, 1e-16);
    EXPECT_NEAR(start.number(0, "pen_z_P3"), -0.9e-4, 1e-16);
}

/// What a load over time comes to, at the time of the state: between its rows a torque of 0.1 N m/s · t turns a slider that touches nothing.
TEST_F(Probe, OfLoadsIsAtTheTimeOfTheState) {
    write("torque.csv", "time,torque\n0,0\n10,1\n");
    std::string const load = "[load.twist]\ntable = \"torque.csv\"\nover = \"time\"\ncolumn = \"torque\"\ninterpolation = \"linear\"\ntorque_z = 1\n";
    write("spatial.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[mechanism]\nslider_inertia_z = 2e-5\n" + load);
    write("planar.toml", "schema = 1\n[mechanism]\nkind = \"planar_slider_crank\"\nslider_inertia_z = 2e-5\n" + load);
    write("spatial.csv", "t,y,z,vy,vz,roll,yaw,pitch,wx,wy,wz\n2,0,0,0,0,0,0,0,0,0,3\n7,0,0,0,0,0,0,0,0,0,3\n");
    std::string const planar = "t,crank_angle,rod_angle,pitch,crank_angular_velocity,rod_angular_velocity,wz\n2,0,0,0,3,-1,3\n7,0,0,0,3,-1,3\n";
    write("planar.csv", planar);
    for (std::string const& scene : {std::string("spatial"), std::string("planar")}) {
        for (std::string const& crank : {std::string("driven"), std::string("free")}) {
            std::vector<std::string> words{"probe", scene + ".toml", "--csv", scene + ".csv", "-o", "o.csv", "--force"};
            if (crank == "free" && scene == "spatial") continue;
            if (crank == "free") words.insert(words.end(), {"--set", "drive.kind=free"});
            Outcome const outcome = run(words);
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            auto const table = golden::Table::read(path("o.csv"));
            for (std::size_t row : {0u, 1u}) {
                double const torque = 0.1 * table.number(row, "t");
                EXPECT_NEAR(table.number(row, "d_wz"), torque / 2e-5, 1e-8) << scene << ", " << crank;
                EXPECT_NEAR(table.number(row, "power_load"), 3 * torque, 1e-12) << scene << ", " << crank;
            }
            std::string const name = scene == "planar" ? "crank_angle" : "y";
            EXPECT_EQ(table.number(0, name), 0);
            EXPECT_EQ(table.number(1, "d_" + name), scene == "planar" ? 3 : 0);
        }
    }
    Outcome const listing = run({"probe", "spatial.toml"});
    EXPECT_NE(listing.out.find("W damping, 0 W loads"), std::string::npos) << listing.out;
    EXPECT_EQ(run({"probe", "s.toml"}).out.find("W loads"), std::string::npos);
}

/// A dashpot between the slider and the way takes c vx², and says so beside what else acts.
TEST_F(Probe, TellsWhatDampersTake) {
    write("s.toml", "schema = 1\n[mechanism]\nkind = \"free_slider\"\n[spring.dashpot]\nanchor_x = 1\ndamping = 3\n[initial]\nx = 0.1\nvx = 2\n");
    Outcome const outcome = run({"probe", "s.toml", "-o", "o.csv", "--force"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    auto const table = golden::Table::read(path("o.csv"));
    EXPECT_NEAR(table.number(0, "loss_springs"), 12, 1e-12);
    for (char const* const none : {"power_load", "power_ground", "loss_film"}) EXPECT_EQ(table.number(0, none), 0) << none;
    Outcome const listing = run({"probe", "s.toml"});
    EXPECT_NE(listing.out.find("0 W loads, 12 W taken by springs"), std::string::npos) << listing.out;
}

TEST_F(Probe, NamesTheCellThatIsWrong) {
    std::string const header = "t,y,z,vy,vz,roll,yaw,pitch,wx,wy,wz\n";
    write("cell.csv", header + "0,0,0,0,0,0,0,0,0,0,abc\n");
    expect_refusal(2, "cell.csv:2: column wz: 'abc' is not a number", {"probe", "s.toml", "--csv", "cell.csv"});
    write("ragged.csv", header + "0,0\n");
    expect_refusal(2, "ragged.csv:2: the row has 2 fields between commas (the header has 11 columns)", {"probe", "s.toml", "--csv", "ragged.csv"});
    write("empty.csv", "");
    expect_refusal(2, "empty.csv:1: the table is empty", {"probe", "s.toml", "--csv", "empty.csv"});
    expect_refusal(4, "cannot read", {"probe", "s.toml", "--csv", "."});
}

}  // namespace
}  // namespace slideway::testing::probe_test
