#include <sstream>

#include <fmt/format.h>

#include "tests/unit/chaos/series.hpp"
#include <netcdf.h>

#include "tests/system/process.hpp"

namespace slideway::testing::stats_test {
namespace {

class Stats : public Program {
protected:
    Stats() {
        std::string with_header = "time,rounds,x\n", bare;
        auto const x = lorenz_series(3000, 0.02);
        for (std::size_t i = 0; i < x.size(); ++i) {
            with_header += fmt::format("{:.2f},{},{:.10g}\n", 0.02 * static_cast<double>(i), i % 7, x[i]);
            bare += fmt::format("{:.10g}\n", x[i]);
        }
        write("lorenz.csv", with_header);
        write("bare.csv", bare);
    }

    void write_result() const {
        write("s.toml", R"(
schema = 1
[contact]
law = "paper"
[study]
members = 3
duration = "20 ms"
samples = 201
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)");
        Outcome const outcome = run({"run", "s.toml", "--no-progress", "-o", "s.nc"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
};

/// The text behind a label at the start of a line.
std::string field(std::string const& out, std::string const& label) {
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(label + " ")) return line.substr(line.find_first_not_of(' ', label.size()));
    }
    return "";
}

TEST_F(Stats, OfATableWithTimes) {
    Outcome const outcome = run({"stats", "lorenz.csv"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(field(outcome.out, "series"), "x of lorenz.csv");
    EXPECT_EQ(field(outcome.out, "points"), "3000, every 0.02 s");
    EXPECT_NEAR(std::stod(field(outcome.out, "exponent")), 0.9056, 0.25) << outcome.out;
    EXPECT_NE(field(outcome.out, "exponent").find(" ± "), std::string::npos);
    EXPECT_NE(outcome.out.find(" (statistical), ± "), std::string::npos) << outcome.out;
    // 3,000 samples, thinned to four a period, are fewer than the 300 of the 0–1 test.
    EXPECT_TRUE(field(outcome.out, "0-1 test").starts_with("none from")) << outcome.out;
    EXPECT_TRUE(field(outcome.out, "verdict").starts_with("neighbours part exponentially")) << outcome.out;
    for (char const* const label :
         {"average period", "C-C method", "delay", "dimension", "window", "Theiler window", "fit window", "0-1 test"}) {
        EXPECT_NE(field(outcome.out, label), "") << label;
    }
}

TEST_F(Stats, OfABareColumnAreTheSame) {
    auto const table = run({"stats", "lorenz.csv"}), bare = run({"stats", "bare.csv", "--dt", "0.02"});
    ASSERT_EQ(bare.code, 0) << bare.err;
    EXPECT_EQ(field(bare.out, "series"), "column 1 of bare.csv");
    EXPECT_EQ(field(bare.out, "fit window"), field(table.out, "fit window"));
    EXPECT_EQ(field(bare.out, "exponent"), field(table.out, "exponent"));
    // Time is what --dt says: the exponent is per second.
    auto const slow = run({"stats", "bare.csv", "--dt", "0.2"});
    EXPECT_NEAR(std::stod(field(slow.out, "exponent")) * 10, std::stod(field(bare.out, "exponent")), 0.01);
}

TEST_F(Stats, KeepsWhatIsGiven) {
    Outcome const outcome = run({"stats", "lorenz.csv", "--delay", "6", "--dimension", "4", "--theiler", "50", "--fit",
                                 "20..90", "--skip", "10", "--max-points", "2000"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(field(outcome.out, "points"), "2000, every 0.02 s");
    EXPECT_EQ(field(outcome.out, "delay"), "6 samples (0.12 s), as given");
    EXPECT_EQ(field(outcome.out, "dimension"), "4, as given");
    EXPECT_EQ(field(outcome.out, "window"), "18 samples (0.36 s)");
    EXPECT_EQ(field(outcome.out, "Theiler window"), "50 samples (1 s), as given");
    EXPECT_TRUE(field(outcome.out, "fit window").starts_with("samples 20 to 90, as given")) << outcome.out;
    auto const skipped = run({"stats", "lorenz.csv", "--skip", "10"}),
               by_samples = run({"stats", "lorenz.csv", "--skip-samples", "500"});
    EXPECT_EQ(field(skipped.out, "points"), "2500, every 0.02 s");
    EXPECT_EQ(skipped.out, by_samples.out);
}

TEST_F(Stats, WritesItsCurves) {
    ASSERT_EQ(run({"stats", "lorenz.csv", "-o", "curves.csv"}).code, 0);
    std::istringstream lines(file_text(path("curves.csv")));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "sample,time,S,delta_S,S_cor,mean_log_distance,pairs");
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("0,0,,,,")) << line;
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("1,0.02")) << line;
    do {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 6) << line;
    } while (std::getline(lines, line));
    expect_refusal(4, "missing/curves.csv: cannot create", {"stats", "lorenz.csv", "-o", "missing/curves.csv"});
}

TEST_F(Stats, OfAResultAreThoseOfOneMember) {
    write_result();
    Outcome const first = run({"stats", "s.nc"});
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(field(first.out, "series"), "y of s.nc");
    EXPECT_EQ(field(first.out, "points"), "201, every 0.0001 s");
    EXPECT_EQ(run({"stats", "s.nc", "--member", "0", "--variable", "y"}).out, first.out);
    EXPECT_NE(run({"stats", "s.nc", "--member", "2"}).out, first.out);
    EXPECT_EQ(field(run({"stats", "s.nc", "--variable", "vy"}).out, "series"), "vy of s.nc");
    expect_refusal(2, "s.nc: has no member 3; it has 0 to 2", {"stats", "s.nc", "--member", "3"});
    expect_refusal(2, "s.nc: has no series 'q'; use one of y, z,", {"stats", "s.nc", "--variable", "q"});
    expect_refusal(2, "--column is for tables", {"stats", "s.nc", "--column", "1"});
    expect_refusal(2, "--dt is for tables", {"stats", "s.nc", "--dt", "1"});
}

TEST_F(Stats, OfAFailedMemberAreRefused) {
    write("s.toml",
          "schema = 1\n[contact]\nlaw = \"paper\"\n[initial]\ny = \"0.02 mm\"\n[integrator]\nmax_steps = 3\n[study]\nduration = \"20 ms\"\nsamples "
          "= 201\n");
    run({"run", "s.toml", "--no-progress", "-o", "s.nc"});
    expect_refusal(2, "samples are no finite numbers", {"stats", "s.nc"});
}

TEST_F(Stats, OfADamagedResultAreRefused) {
    write_result();
    int file = 0, variable = 0;
    ASSERT_EQ(nc_open(path("s.nc").c_str(), NC_WRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "y", &variable), NC_NOERR);
    double const other = 1;
    std::size_t const place[] = {2, 100};
    ASSERT_EQ(nc_put_var1_double(file, variable, place, &other), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
    expect_refusal(4, "do not match their hash", {"stats", "s.nc", "--member", "0"});
}

TEST_F(Stats, OfWhatHasNoLinesEnd) { expect_refusal(4, "/dev/zero: is larger than 256 MiB; give the name of a file", {"stats", "/dev/zero"}); }

TEST_F(Stats, RefusesWithOneLine) {
    write("short.csv", "1\n2\n3\n");
    write("uneven.csv", "t,y\n0,1\n1,2\n3,3\n");
    std::string constant, broken;
    for (int i = 0; i < 200; ++i) {
        constant += "1.5\n";
        broken += i == 50 ? "nan\n" : fmt::format("{}\n", i % 17);
    }
    write("constant.csv", constant);
    write("broken.csv", broken);
    expect_refusal(4, "none.csv: cannot read: No such file", {"stats", "none.csv"});
    expect_refusal(4, "cannot read", {"stats", "."});
    expect_refusal(2, "FILE", {"stats"});
    expect_refusal(2, "short.csv: column 1: the series has 3 samples", {"stats", "short.csv", "--dt", "1"});
    expect_refusal(2, "constant.csv: column 1: the series is constant", {"stats", "constant.csv", "--dt", "1"});
    expect_refusal(2, "broken.csv:51: column 1 is \"nan\" (a missing value)", {"stats", "broken.csv", "--dt", "1"});
    expect_refusal(2, "uneven.csv: the times are not equally spaced", {"stats", "uneven.csv"});
    expect_refusal(2, "give --dt SECONDS", {"stats", "bare.csv"});
    expect_refusal(2, "lorenz.csv: there is no column 'y'", {"stats", "lorenz.csv", "--column", "y"});
    expect_refusal(2, "--variable is for result files", {"stats", "lorenz.csv", "--variable", "y"});
    expect_refusal(2, "--member is for result files", {"stats", "lorenz.csv", "--member", "1"});
    expect_refusal(2, "--dt x: give", {"stats", "bare.csv", "--dt", "x"});
    expect_refusal(2, "--delay 0: give", {"stats", "lorenz.csv", "--delay", "0"});
    expect_refusal(2, "--fit 9..3: give", {"stats", "lorenz.csv", "--fit", "9..3"});
    expect_refusal(2, "exclude each other", {"stats", "lorenz.csv", "--skip", "1", "--skip-samples", "5"});
    expect_refusal(2, "nothing is left", {"stats", "lorenz.csv", "--skip", "60"});
}

}  // namespace
}  // namespace slideway::testing::stats_test
