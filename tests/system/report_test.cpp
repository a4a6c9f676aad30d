#include "tests/system/process.hpp"

#include <cstdlib>

#include <netcdf.h>
#include <sys/stat.h>

namespace slideway::testing::report_test {
namespace {

/// A result, and in place of the interpreter a script: what it answers to the question for the package, and what it says then.
class Report : public Program {
protected:
    Report() {
        write("s.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nduration = \"1 ms\"\n");
        EXPECT_EQ(run({"run", "s.toml", "--no-progress"}).code, 0);
    }
    ~Report() override { unsetenv("SLIDEWAY_PYTHON"); }

    void set_interpreter(int has_package, int code = 0) const {
        std::string const script = "#!/bin/sh\n[ \"$1\" = -c ] && exit " + std::to_string(has_package ? 0 : 1) +
                                   "\nprintf '[%s]' \"$@\"\nexit " + std::to_string(code) + "\n";
        write("python", script);
        std::filesystem::permissions(path("python"), std::filesystem::perms::owner_all);
        setenv("SLIDEWAY_PYTHON", path("python").c_str(), 1);
    }
};

TEST_F(Report, HandsTheFileAndThePageOver) {
    set_interpreter(true);
    EXPECT_EQ(run({"report", "s.nc"}).out, "[-m][slideway][report][--force][--output=s.html][--][s.nc]");
    EXPECT_EQ(run({"report", "s.nc", "-o", "-page of it.html"}).out,
              "[-m][slideway][report][--force][--output=-page of it.html][--][s.nc]");
}

TEST_F(Report, EndsAsTheCompanionDoes) {
    set_interpreter(true, 4);
    EXPECT_EQ(run({"report", "s.nc"}).code, 4);
    set_interpreter(true, 0);
    EXPECT_EQ(run({"report", "s.nc"}).code, 0);
}

TEST_F(Report, SaysHowToInstallTheCompanion) {
    set_interpreter(false);
    expect_refusal(4, "pip install .", {"report", "s.nc"});
}

TEST_F(Report, SaysThatThereIsNoInterpreter) {
    setenv("SLIDEWAY_PYTHON", path("nothing").c_str(), 1);
    expect_refusal(4, "SLIDEWAY_PYTHON", {"report", "s.nc"});
}

TEST_F(Report, RefusesWhatIsNoResult) {
    set_interpreter(true);
    expect_refusal(2, "FILE", {"report"});
    expect_refusal(4, "missing.nc", {"report", "missing.nc"});
    expect_refusal(4, "s.toml: is no netCDF file", {"report", "s.toml"});
}

TEST_F(Report, RefusesADamagedResult) {
    set_interpreter(true);
    int file = 0, variable = 0;
    ASSERT_EQ(nc_open(path("s.nc").c_str(), NC_WRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "final_y", &variable), NC_NOERR);
    double const other = 1;
    std::size_t const first = 0;
    ASSERT_EQ(nc_put_var1_double(file, variable, &first, &other), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
    expect_refusal(4, "do not match their hash", {"report", "s.nc"});
}

TEST_F(Report, ReplacesFilesAlone) {
    set_interpreter(true);
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    expect_refusal(4, "is a device or a pipe", {"report", "s.nc", "-o", "pipe"});
    EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
}

TEST_F(Report, NeverReplacesTheResult) {
    set_interpreter(true);
    expect_refusal(4, "is what this command reads", {"report", "s.nc", "-o", "./s.nc"});
    std::filesystem::copy_file(path("s.nc"), path("r.html"));
    expect_refusal(4, "is what this command reads", {"report", "r.html"});
}

}  // namespace
}  // namespace slideway::testing::report_test
