// Studies of a table of members, moved and merged where the table is out of reach.
#include <algorithm>

#include <fmt/ranges.h>

#include "host/store/result_view.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::table_test {
namespace {

namespace fs = std::filesystem;

constexpr char const* scene = R"(
schema = 1
[contact]
law = "conservative"
[study]
duration = "2 ms"
samples = 3
design = "table"
table = "rows.csv"
)";

class TableRun : public Program {
protected:
    TableRun() {
        fs::create_directories(path("a"));
        write("a/s.toml", scene);
        write_rows("a/rows.csv");
    }
    /// y of member m is (m - 8)/100 mm, but for the last one.
    void write_rows(std::string const& name, double last = 0.07) const {
        std::string text = "initial.y [mm]\n";
        for (int m = 0; m < 15; ++m) text += fmt::format("{}\n", (m - 8) / 100.0);
        write(name, text + fmt::format("{}\n", last));
    }
    Outcome run_in(std::string const& folder, std::vector<std::string> options = {}) const {
        options.insert(options.begin(), {"run", folder + "/s.toml", "--no-progress", "--threads", "2", "--block-members", "4",
                                         "-o", folder + "/s.nc"});
        return run(std::move(options));
    }
    /// All members but those of the second shard.
    void leave_shards() const {
        ASSERT_EQ(run_in("a", {"--shard", "1/1"}).code, 0);
        ASSERT_TRUE(fs::remove(path("a/s.nc.shards/members-0000000004.nc")));
    }
    std::string hash_of(std::string const& name) const {
        ResultReader const file(path(name).string());
        EXPECT_EQ(file.stored_hash(), file.computed_hash()) << name;
        return file.computed_hash();
    }
    std::string whole_hash() const {
        EXPECT_EQ(run_in("a").code, 0);
        std::string const hash = hash_of("a/s.nc");
        fs::remove(path("a/s.nc"));
        return hash;
    }
    /// Begins the run, moves its folder, and goes on there to what it comes to in one go.  @return the hash of that
    std::string expect_to_go_on_in(std::string const& folder) {
        std::string const hash = whole_hash();
        leave_shards();
        fs::rename(path("a"), path(folder));
        Outcome const outcome = run_in(folder, {"--resume"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(hash_of(folder + "/s.nc"), hash);
        return hash;
    }
};

TEST_F(TableRun, GoesOnWhereItsFolderWasMoved) {
    expect_to_go_on_in("b");
    EXPECT_EQ(ResultReader(path("b/s.nc").string()).values("initial_y")[15], 0.07e-3);
    EXPECT_FALSE(fs::exists(path("b/s.nc.shards")));
    // So is a result that is complete.
    fs::rename(path("b"), path("c"));
    EXPECT_EQ(run_in("c", {"--resume"}).code, 0);
    Outcome const complete = run({"run", "c/s.toml", "-o", "c/s.nc", "--resume"});
    EXPECT_EQ(complete.err, "resuming: c/s.nc is complete already\n");
}

/// A result has its members' inputs: nothing is asked of the table, which may have other columns since, or be shorter, or gone.
TEST_F(TableRun, IsToldByItsResultAlone) {
    std::string const study = "[study]\nkind = \"tolerance\"\nverify = 0\nquantities = [\"peak_normal_force\", \"peak_tilt\"]\n";
    std::string text = scene;
    write("a/s.toml", text.replace(text.find("samples = 3\n"), 12, "").replace(text.find("[study]\n"), 8, study) +
                          "vary = { \"initial.z\" = { dist = \"unif\", low = 0, high = 1e-5 } }\nlimits = { peak_normal_force = { max = 1e9 } }\n");
    ASSERT_EQ(run_in("a").code, 0);
    std::vector<std::string> const info{"info", "a/s.nc"}, probe{"probe", "a/s.nc", "--member", "3"};
    Outcome const told = run(info), state = run(probe);
    for (char const* const part : {"Yield, of 16 members", "initial.y", "initial.z"}) EXPECT_NE(told.out.find(part), std::string::npos) << told.out;
    EXPECT_EQ(state.code, 0) << state.err;
    auto const expect_same = [&](char const* what) {
        EXPECT_EQ(run(info).out, told.out) << what;
        EXPECT_EQ(run(info).err, "") << what;
        EXPECT_EQ(run(probe).out, state.out) << what;
    };
    write("a/rows.csv", "initial.vx,initial.vy\n" + fmt::format("{}", fmt::join(std::vector<std::string>(16, "0.1,0\n"), "")));
    expect_same("other columns");
    write("a/rows.csv", "initial.y\n0\n");
    expect_same("fewer rows");
    fs::remove(path("a/rows.csv"));
    expect_same("no table");
}

TEST_F(TableRun, IsMergedWithoutTheTable) {
    std::string const hash = whole_hash();
    std::string const table = fs::canonical(path("a")) / "rows.csv";
    ASSERT_EQ(run_in("a", {"--shard", "1/1"}).code, 0);
    fs::rename(path("a/s.nc.shards"), path("shards"));
    fs::remove_all(path("a"));
    Outcome const outcome = run({"merge", "shards", "-o", "m.nc"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(hash_of("m.nc"), hash);
    // The file says where the table was, as that of a run does.
    std::string const said = ResultReader(path("m.nc").string()).attribute("scene");
    EXPECT_NE(said.find("\ntable = \"" + table + "\"  # 16 rows"), said.npos) << said;
}

TEST_F(TableRun, WithAnotherTableIsRefused) {
    leave_shards();
    write_rows("a/rows.csv", 0.071);
    expect_refusal(2, "holds 12 finished members of another run (study.table: rows.csv has changed since the run began, from 16 rows, FNV-1a ",
                   {"run", "a/s.toml", "-o", "a/s.nc", "--resume"});
    write_rows("a/rows.csv");
    ASSERT_EQ(run_in("a", {"--resume"}).code, 0);
    write_rows("a/rows.csv", 0.071);
    expect_refusal(2, "it is the result of another run (study.table: rows.csv has changed since the run began, from 16 rows, FNV-1a ",
                   {"run", "a/s.toml", "-o", "a/s.nc", "--resume"});
}

TEST_F(TableRun, IsNotMergedWithAnotherTableInPlaceOfTheCopy) {
    leave_shards();
    EXPECT_EQ(file_text(path("a/s.nc.shards/study.table.csv")), file_text(path("a/rows.csv")));
    write_rows("a/s.nc.shards/study.table.csv", 0.071);
    expect_refusal(4, "a/s.nc.shards/study.table.csv: is not the table of this run (its checksum differs)",
                   {"merge", "a/s.nc.shards", "-o", "m.nc"});
    fs::remove(path("a/s.nc.shards/study.table.csv"));
    expect_refusal(2, "a/s.nc.shards/study.table.csv cannot be read", {"merge", "a/s.nc.shards", "-o", "m.nc"});
    // Whoever goes on has the table, and puts it there again.
    EXPECT_EQ(run_in("a", {"--resume", "--shard", "1/1"}).code, 0);
    EXPECT_EQ(run({"merge", "a/s.nc.shards", "-o", "m.nc"}).code, 0);
}

TEST_F(TableRun, NamesMembersThatFailedByTheirLabel) {
    write("a/rows.csv", "part;initial.y [mm];lot\nA-001;0,01;north\nA-002;0,02;\n");
    Outcome outcome = run_in("a", {"--set", "integrator.max_steps=3"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.out.find("  member 0 (A-001, north): max_steps at t = "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("  member 1 (A-002): max_steps at t = "), std::string::npos) << outcome.out;
    outcome = run_in("a", {"--set", "integrator.max_steps=3", "--json", "--force"});
    EXPECT_NE(outcome.out.find("\"label\": \"A-001, north\""), std::string::npos) << outcome.out;
    EXPECT_EQ(ResultReader(path("a/s.nc").string()).texts("member_label"), (std::vector<std::string>{"A-001, north", "A-002"}));
    EXPECT_NE(run({"info", "a/s.nc", "--members", "0..0"}).out.find("  A-001, north\n"), std::string::npos);
    EXPECT_NE(run({"info", "a/s.nc", "--json"}).out.find("\"label\": \"A-002\""), std::string::npos);
    // Of members that finish nothing is to be said.
    outcome = run_in("a", {"--json", "--force"});
    EXPECT_NE(outcome.out.find("\"failed\": []"), std::string::npos) << outcome.out;
}

TEST_F(TableRun, LabelsThatAreErrorsOfASpreadsheetAreRefused) {
    write("a/rows.csv", "part;initial.y [mm]\nA-001;0,01\n#N/A;0,02\n");
    expect_refusal(2, "a/rows.csv:3: part (column 1) is \"#N/A\" (an error of the spreadsheet)", {"check", "a/s.toml"});
    write("a/rows.csv", "part;initial.y [mm]\nA-001;0,01\n;0,02\n");
    EXPECT_EQ(run({"check", "a/s.toml"}).code, 0) << "a remark may be missing";
}

/// Whether given, drawn or in a row: a drive whose place the last bit of time moves too far is refused.
TEST_F(TableRun, RowsWhoseDriveIsNotResolvedAreRefusedAsAScenesOwnNumbersAre) {
    std::string const too_long = "the study is too long: after 1.43e+09 revolutions the last bit of a number of double precision moves the drive by";
    write("a/rows.csv", "mechanism.crank_speed\n3\n9000\n");
    for (char const* const command : {"check", "run"}) {
        expect_refusal(2, "a/rows.csv:3: " + too_long, {command, "a/s.toml", "--set", "study.duration=1e6"});
        if (HasFailure()) return;  // else a run of days
    }
    write("a/rows.csv", "mechanism.crank_speed\n3\n5\n");
    EXPECT_EQ(run({"check", "a/s.toml", "--set", "study.duration=1e6"}).code, 0);
    write("a/drawn.toml", "schema = 1\n[contact]\nlaw = \"conservative\"\n[study]\nmembers = 8\nduration = 1e6\n"
                          "[study.vary]\n\"mechanism.crank_speed\" = { dist = \"unif\", low = 8999, high = 9000 }\n");
    expect_refusal(2, "a/drawn.toml: member 0: " + too_long, {"check", "a/drawn.toml"});
}

TEST_F(TableRun, KeepsLabelsThroughShardsAndMerges) {
    std::string rows = "initial.y [mm];part\n";
    std::vector<std::string> labels;
    for (int m = 0; m < 16; ++m) {
        labels.push_back(fmt::format("Wälzlager {}", std::string(static_cast<std::size_t>(m % 5), 'x')));
        rows += fmt::format("0,0{};{}\n", m % 7, labels.back());
    }
    for (std::string& label : labels) label.erase(label.find_last_not_of(' ') + 1);
    write("a/rows.csv", rows);
    std::string const hash = whole_hash();
    leave_shards();
    ASSERT_EQ(run_in("a", {"--resume", "--shard", "1/1"}).code, 0);
    ASSERT_EQ(run({"merge", "a/s.nc.shards", "-o", "m.nc"}).code, 0);
    EXPECT_EQ(hash_of("m.nc"), hash);
    EXPECT_EQ(ResultReader(path("m.nc").string()).texts("member_label"), labels);
}

/// A pump whose load is read from a table beside its scene, and whose members are the rows of another.
class LoadTableRun : public TableRun {
protected:
    LoadTableRun() {
        write("a/s.toml", std::string(scene) + "[load.plunger]\ntable = \"indicator.csv\"\nover = \"crank_angle\"\ncolumn = \"pressure\"\nforce_x = -1\nscale = 1e-6\n");
        write_pressures("a/indicator.csv", 40);
    }
    void write_pressures(std::string const& name, int bar) const {
        write(name, fmt::format("crank_angle [deg], pressure [bar]\n0, 1\n90, 2\n180, {}\n360, 1\n", bar));
    }
};

TEST_F(LoadTableRun, GoesOnWhereItsFolderWasMoved) {
    std::string const hash = expect_to_go_on_in("b");
    EXPECT_FALSE(fs::exists(path("b/s.nc.shards")));
    // The scene that the result has runs again wherever its tables lie beside it.
    write("again.toml", ResultReader(path("b/s.nc").string()).attribute("scene"));
    fs::rename(path("b/indicator.csv"), path("indicator.csv"));
    fs::rename(path("b/rows.csv"), path("rows.csv"));
    Outcome const again = run({"run", "again.toml", "--no-progress", "-o", "again.nc"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.err.find("load.plunger.table is not there any more; indicator.csv is read in its place"), std::string::npos) << again.err;
    EXPECT_EQ(hash_of("again.nc"), hash);
}

TEST_F(LoadTableRun, IsMergedWithoutItsTables) {
    std::string const hash = whole_hash(), table = fs::canonical(path("a")) / "indicator.csv";
    ASSERT_EQ(run_in("a", {"--shard", "1/1"}).code, 0);
    fs::rename(path("a/s.nc.shards"), path("shards"));
    fs::remove_all(path("a"));
    EXPECT_EQ(run({"merge", "shards", "-o", "m.nc"}).code, 0);
    EXPECT_EQ(hash_of("m.nc"), hash);
    std::string const said = ResultReader(path("m.nc").string()).attribute("scene");
    EXPECT_NE(said.find("\ntable = \"" + table + "\"  # 4 rows"), said.npos) << said;
    write_pressures("shards/load.plunger.table.csv", 41);
    expect_refusal(4, "shards/load.plunger.table.csv: is not the table of this run (its checksum differs)", {"merge", "shards", "-o", "n.nc"});
}

TEST_F(LoadTableRun, WithAnotherTableIsRefusedByItsName) {
    leave_shards();
    write_pressures("a/indicator.csv", 41);
    std::string const words = "of another run (load.plunger.table: indicator.csv has changed since the run began, from 4 rows, FNV-1a ";
    std::vector<std::string> const resume{"run", "a/s.toml", "-o", "a/s.nc", "--resume"};
    expect_refusal(2, words, resume);
    write_pressures("a/indicator.csv", 40);
    ASSERT_EQ(run_in("a", {"--resume"}).code, 0);
    write_pressures("a/indicator.csv", 41);
    expect_refusal(2, words, resume);
}

/// The same on a drive whose profile is a table.
class DriveTableRun : public TableRun {
protected:
    DriveTableRun() {
        write("a/s.toml", std::string(scene) + "[drive]\nkind = \"profile\"\ntable = \"speeds.csv\"\ncolumn = \"speed\"\ngives = \"speed\"\n");
        write_speeds("a/speeds.csv", 40);
    }
    void write_speeds(std::string const& name, int last) const { write(name, fmt::format("time [s], speed [rad/s]\n0, 3\n1 , 20\n2, {}\n", last)); }
};

TEST_F(DriveTableRun, GoesOnWhereItsFolderWasMoved) {
    expect_to_go_on_in("b");
    EXPECT_NE(ResultReader(path("b/s.nc").string()).attribute("scene").find("speeds.csv\"  # 3 rows"), std::string::npos);
}

TEST_F(DriveTableRun, WithAnotherTableIsRefusedByItsName) {
    leave_shards();
    write_speeds("a/speeds.csv", 41);
    expect_refusal(2, "of another run (drive.table: speeds.csv has changed since the run began, from 3 rows, FNV-1a ", {"run", "a/s.toml", "-o", "a/s.nc", "--resume"});
}

}  // namespace
}  // namespace slideway::testing::table_test
