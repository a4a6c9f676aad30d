// Results and shards of which something has changed on the disk, and results of other formats, as the commands take them.
#include <nlohmann/json.hpp>

#include <netcdf.h>

#include "host/base/error.hpp"
#include "host/store/result_view.hpp"
#include "tests/system/resumed.hpp"

namespace slideway::testing::damage_test {
namespace {

using Json = nlohmann::json;

class Damage : public Resumed {
protected:
    Damage() {
        write("python", "#!/bin/sh\n[ \"$1\" = -c ] || echo page\n");
        fs::permissions(path("python"), fs::perms::owner_all);
        setenv("SLIDEWAY_PYTHON", path("python").c_str(), 1);
    }
    ~Damage() override { unsetenv("SLIDEWAY_PYTHON"); }

    void make_result() const { ASSERT_EQ(run_scene({"--quiet"}).code, 0); }
    void flip(std::string const& name, std::size_t at, char by = 1) const {
        std::string bytes = file_text(path(name));
        bytes.at(at) = static_cast<char>(bytes.at(at) ^ by);
        std::ofstream(path(name), std::ios::binary) << bytes;
    }
    void edit(std::string const& name, std::function<int(int file)> const& change) const {
        int file = 0;
        ASSERT_EQ(nc_open(path(name).c_str(), NC_WRITE, &file), NC_NOERR);
        EXPECT_EQ(change(file), NC_NOERR);
        ASSERT_EQ(nc_close(file), NC_NOERR);
    }
    std::vector<std::vector<std::string>> readers(std::string const& file) const {
        return {{"info", file}, {"info", file, "--check"}, {"info", file, "--json"}, {"stats", file}, {"report", file, "-o", "p.html", "--force"}};
    }
};

TEST_F(Damage, OfAnyByteNeverCrashesACommand) {
    make_result();
    std::string const whole = file_text(path("s.nc"));
    std::vector<Outcome> before;
    for (auto const& command : readers("s.nc")) before.push_back(run(command));
    for (std::size_t at = 40; at < whole.size(); at += whole.size() / 12) {
        flip("s.nc", at, '\x7f');
        auto const commands = readers("s.nc");
        for (std::size_t i = 0; i < commands.size(); ++i) {
            Outcome const found = run(commands[i]);
            if (found.code == 4) {
                EXPECT_EQ(std::count(found.err.begin(), found.err.end(), '\n'), 1) << at << found.err;
                continue;
            }
            // As of the whole one; of few samples stats says that they are too few.
            EXPECT_EQ(found.code, before[i].code) << at << ' ' << commands[i][0] << found.err;
            EXPECT_EQ(found.out + found.err, before[i].out + before[i].err) << at;
        }
        std::ofstream(path("s.nc"), std::ios::binary) << whole;
    }
}

TEST_F(Damage, OfAnyByteIsToldOrDoesNotMatter) {
    make_result();
    std::string const file = path("s.nc").string(), whole = file_text(file);
    std::string const payload = check_result(file).payload_found;
    std::size_t refused = 0, tried = 0;
    for (std::size_t at = 1; at < whole.size(); at += 509, ++tried) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ (at % 2 ? 1 : '\xff'));
        std::ofstream(file, std::ios::binary) << changed;
        try {
            SealCheck const found = check_result(file);
            EXPECT_TRUE(!found.intact() || found.payload_found == payload) << at;
            refused += found.intact() ? 0 : 1;
        } catch (FileError const&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, tried / 2);
}

TEST_F(Damage, OfAnAttributeIsRefusedByAllReaders) {
    make_result();
    edit("s.nc", [](int file) { return nc_put_att_text(file, NC_GLOBAL, "seed", 1, "7"); });
    Outcome const info = run({"info", "s.nc"});
    EXPECT_EQ(info.code, 4);
    EXPECT_NE(info.out.find("matches the data"), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("metadata     DOES NOT MATCH: "), std::string::npos) << info.out;
    EXPECT_EQ(info.out.find("finished"), std::string::npos) << info.out;  // nothing of what can no longer be trusted
    std::string const line = "s.nc: the attributes, names or group verification do not match their hash; the file is damaged or was edited";
    EXPECT_EQ(info.err, line + "\n");
    Outcome const told = run({"info", "s.nc", "--json"});
    EXPECT_EQ(told.code, 4);
    Json const json = Json::parse(told.out);
    EXPECT_EQ(json["payload_matches"], true);
    EXPECT_EQ(json["metadata_matches"], false);
    EXPECT_EQ(json["intact"], false);
    EXPECT_FALSE(json.contains("statuses"));
    for (auto const& command : {std::vector<std::string>{"info", "s.nc", "--check"}, {"stats", "s.nc"}, {"report", "s.nc"}}) expect_refusal(4, line, command);
    expect_refusal(4, "s.nc: is damaged", {"run", "s.toml", "--no-progress", "-o", "s.nc", "--resume"});
}

TEST_F(Damage, IsNotSaidOfAWholeResult) {
    make_result();
    Json const json = Json::parse(run({"info", "s.nc", "--json"}).out);
    EXPECT_EQ(json["format_version"], 3);
    EXPECT_EQ(json["payload_matches"], true);
    EXPECT_EQ(json["metadata_matches"], true);
    EXPECT_EQ(json["metadata_hash"].get<std::string>().size(), 16u);
    EXPECT_EQ(json["intact"], true);
    EXPECT_EQ(run({"info", "s.nc", "--check"}).out, "intact       s.nc\n");
}

TEST_F(Damage, ANewerFormatIsRefusedByAllReaders) {
    make_result();
    int const next = 4;
    edit("s.nc", [&](int file) { return nc_put_att_int(file, NC_GLOBAL, "format_version", NC_INT, 1, &next); });
    for (auto const& command : readers("s.nc")) expect_refusal(4, "s.nc: is of format 4, and slideway 0.3.0 reads formats 1 to 3; ", command);
}

// The numbers are those that the file holds, as netCDF alone reads them.
TEST_F(Damage, TheFirstFormatIsReadByAllReaders) {
    fs::copy_file(std::string(SLIDEWAY_TEST_DATA) + "/formats/result_1.nc", path("one.nc"));
    int file = 0, variable = 0;
    ASSERT_EQ(nc_open(path("one.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "peak_normal_force", &variable), NC_NOERR);
    double peaks[4] = {};
    ASSERT_EQ(nc_get_var_double(file, variable, peaks), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
    Outcome const told = run({"info", "one.nc", "--json"});
    EXPECT_EQ(told.code, 0) << told.err;
    Json const json = Json::parse(told.out);
    EXPECT_EQ(json["format_version"], 1);
    EXPECT_EQ(json["payload_matches"], true);
    EXPECT_TRUE(json["metadata_hash"].is_null());
    EXPECT_TRUE(json["metadata_matches"].is_null());
    EXPECT_EQ(json["intact"], true);
    EXPECT_EQ(json["statuses"], (Json{{"finished", 4}}));
    EXPECT_EQ(json["quantities"][0]["max"], *std::max_element(peaks, peaks + 4));
    EXPECT_NEAR(json["quantities"][0]["mean"].get<double>(), (peaks[0] + peaks[1] + peaks[2] + peaks[3]) / 4, 1e-12);
    Outcome const info = run({"info", "one.nc"});
    EXPECT_EQ(info.code, 0) << info.err;
    for (char const* const word : {"format       1\n", "not covered by a hash in format 1", "<= 200 N", "Rank correlations"}) {
        EXPECT_NE(info.out.find(word), std::string::npos) << word << '\n' << info.out;
    }
    Outcome const series = run({"stats", "one.nc", "--variable", "y"});
    EXPECT_EQ(series.err, "one.nc: y: the series has 40 samples; at least 100 are needed\n");
    EXPECT_EQ(run({"report", "one.nc", "-o", "p.html"}).out, "page\n");
}

// What its numbers are called now; they are those that the file holds, as netCDF alone reads them.
TEST_F(Damage, TheSecondFormatIsReadByAllReaders) {
    fs::copy_file(std::string(SLIDEWAY_TEST_DATA) + "/formats/result_2.nc", path("two.nc"));
    int file = 0, variable = 0;
    ASSERT_EQ(nc_open(path("two.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "crank_work", &variable), NC_NOERR);
    double work[6] = {};
    ASSERT_EQ(nc_get_var_double(file, variable, work), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
    Outcome const told = run({"info", "two.nc", "--json"});
    EXPECT_EQ(told.code, 0) << told.err;
    Json const json = Json::parse(told.out);
    EXPECT_EQ(json["format_version"], 2);
    EXPECT_EQ(json["intact"], true);
    EXPECT_EQ(json["quantities"][1]["name"], "drive_work");
    EXPECT_EQ(json["quantities"][1]["max"], *std::max_element(work, work + 6));
    EXPECT_EQ(json["tolerance"]["yields"][0]["name"], "drive_work");
    Outcome const info = run({"info", "two.nc"});
    EXPECT_EQ(info.code, 0) << info.err;
    for (char const* const word : {"format       2\n", "\n  drive_work         J ", "\n  drive_work  >= 0 J "}) {
        EXPECT_NE(info.out.find(word), std::string::npos) << word << '\n' << info.out;
    }
    EXPECT_EQ(info.out.find("crank_work"), std::string::npos) << info.out;
    Outcome const table = run({"export", "two.nc", "-o", "two.csv"});
    EXPECT_EQ(table.code, 0) << table.err;
    EXPECT_NE(file_text(path("two.csv")).find(",drive_work [J],"), std::string::npos);
    EXPECT_EQ(run({"report", "two.nc", "-o", "p.html"}).out, "page\n");
}

TEST_F(Damage, OfOneFileOfTheIdentityIsMended) {
    for (char const* const name : {"run.toml", "run-copy.toml"}) {
        make_shards();
        std::string const file = std::string("s.nc.shards/") + name, whole = file_text(path(file));
        flip(file, whole.find("members: ") + 10);
        Outcome const merged = run({"merge", "s.nc.shards", "-o", "m.nc", "--force"});
        EXPECT_EQ(merged.code, 0) << merged.err;
        EXPECT_EQ(merged.err, "warning: " + file + ": was damaged or gone; it was written again from its copy\n");
        EXPECT_EQ(file_text(path(file)), whole);
        flip(file, whole.find("[study]"));
        Outcome const resumed = run_scene({"--resume", "--no-progress"});
        EXPECT_EQ(resumed.code, 0) << resumed.err;
        EXPECT_EQ(resumed.err, "warning: " + file + ": was damaged or gone; it was written again from its copy\n");
        EXPECT_EQ(hash_of("s.nc"), hash_of("m.nc"));
        EXPECT_FALSE(exists("s.nc.shards"));
        fs::remove(path("s.nc"));
    }
}

TEST_F(Damage, OfAManifestIsToldAndCostsTheMembersOfItsLineAlone) {
    ASSERT_EQ(run_scene({"--quiet", "-o", "whole.nc"}).code, 0);
    make_shards();
    flip("s.nc.shards/manifest-000001.txt", 3);
    std::string const told = "warning: s.nc.shards/manifest-000001.txt: is damaged: not all of its lines can be read; its members ";
    Outcome const merged = run({"merge", "s.nc.shards", "-o", "m.nc"});
    EXPECT_EQ(merged.code, 5);
    EXPECT_NE(merged.err.find(told + "are left out"), std::string::npos) << merged.err;
    EXPECT_NE(merged.err.find("8 of 64 members have not run"), std::string::npos) << merged.err;
    Outcome const resumed = run_scene({"--quiet", "--resume"});
    EXPECT_EQ(resumed.code, 0);
    EXPECT_NE(resumed.err.find(told + "run again\n"), std::string::npos) << resumed.err;
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
    EXPECT_FALSE(exists("s.nc.shards"));
}

TEST_F(Damage, OfBothFilesOfTheIdentityIsRefused) {
    make_shards();
    for (char const* const name : {"run.toml", "run-copy.toml"}) flip(std::string("s.nc.shards/") + name, 400);
    std::string const line = "s.nc.shards/run.toml: is damaged (its checksum differs)";
    expect_refusal(4, line, {"merge", "s.nc.shards", "-o", "m.nc"});
    expect_refusal(4, line, {"run", "s.toml", "--no-progress", "-o", "s.nc", "--resume"});
    EXPECT_EQ(shards_in("s.nc.shards"), 8u);
}

}  // namespace
}  // namespace slideway::testing::damage_test
