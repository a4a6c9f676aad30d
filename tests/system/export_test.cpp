// Tables for other programs, against the numbers of the result.
#include <cmath>
#include <map>
#include <sstream>

#include "tests/system/small_run.hpp"

namespace slideway::testing::export_test {
namespace {

/// A table whose cells hold no commas, by the names of its columns.
std::map<std::string, std::vector<std::string>> columns_in(std::string const& text) {
    std::istringstream lines(text);
    std::string line, cell;
    std::vector<std::string> names;
    std::map<std::string, std::vector<std::string>> columns;
    while (std::getline(lines, line)) {
        std::istringstream cells(line + ',');
        std::size_t place = 0;
        bool const is_header = names.empty();
        while (std::getline(cells, cell, ',')) {
            if (is_header) names.push_back(cell);
            else columns[names.at(place++)].push_back(cell);
        }
    }
    return columns;
}

double number_in(std::string const& cell) { return cell.empty() ? std::nan("") : std::stod(cell); }

class Export : public SmallRun {
protected:
    std::map<std::string, std::vector<std::string>> exported(std::string const& result, std::vector<std::string> const& more = {}) const {
        std::vector<std::string> words{"export", result, "-o", "o.csv", "--force"};
        words.insert(words.end(), more.begin(), more.end());
        Outcome const outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return columns_in(file_text(path("o.csv")));
    }
    /// To the last bit, and empty where there is none.
    void expect_numbers(std::vector<std::string> const& cells, std::vector<double> const& stored, std::size_t width = 1, std::size_t place = 0) const {
        ASSERT_EQ(cells.size() * width, stored.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            double const number = stored[i * width + place];
            if (std::isnan(number)) EXPECT_EQ(cells[i], "");
            else EXPECT_EQ(number_in(cells[i]), number);
        }
    }
};

TEST_F(Export, OfMembersHasTheirNumbers) {
    ASSERT_EQ(run_scene({"--set", "integrator.max_steps=15", "--max-failures", "100%"}).code, 0);
    auto const columns = exported("s.nc");
    ResultReader const stored = results("s.nc");
    expect_numbers(columns.at("member"), stored.values("member"));
    expect_numbers(columns.at("initial.y [m]"), stored.values("initial_y"));
    expect_numbers(columns.at("drive_work [J]"), stored.values("drive_work"));
    expect_numbers(columns.at("steps_accepted"), stored.values("steps_accepted"));
    expect_numbers(columns.at("final_vy [m s-1]"), stored.values("final_vy"));
    expect_numbers(columns.at("mode_time[line] [s]"), stored.values("mode_time"), 4, 2);
    std::vector<double> const statuses = stored.values("status");
    std::size_t failed = 0;
    for (std::size_t i = 0; i < statuses.size(); ++i) {
        EXPECT_EQ(columns.at("status")[i], statuses[i] == 0 ? "finished" : "max_steps");
        failed += statuses[i] != 0;
    }
    EXPECT_GT(failed, 0u);
    EXPECT_LT(failed, statuses.size());
    EXPECT_FALSE(columns.contains("y [m]"));
}

TEST_F(Export, OfAHistogramHasAColumnForEachBin) {
    ASSERT_EQ(run_scene({"--set", "study.quantities=[\"impact_speeds\"]"}).code, 0);
    auto const columns = exported("s.nc");
    std::vector<double> const stored = results("s.nc").values("impact_speeds");
    expect_numbers(columns.at("impact_speeds[y_plus_0]"), stored, 32, 0);
    expect_numbers(columns.at("impact_speeds[z_minus_0.03]"), stored, 32, 28);
}

TEST_F(Export, OfSeriesHasARowForEachSample) {
    ASSERT_EQ(run_scene({}).code, 0);
    auto const columns = exported("s.nc", {"--series", "vy,y"});
    ResultReader const stored = results("s.nc");
    EXPECT_EQ(columns.size(), 4u);
    expect_numbers(columns.at("y [m]"), stored.values("y"));
    expect_numbers(columns.at("vy [m s-1]"), stored.values("vy"));
    std::vector<double> members, times;
    for (double const member : stored.values("member")) {
        for (double const time : stored.values("time")) members.push_back(member), times.push_back(time);
    }
    expect_numbers(columns.at("member"), members);
    expect_numbers(columns.at("time [s]"), times);
    EXPECT_EQ(exported("s.nc", {"--series", "all"}).size(), 12u);
}

TEST_F(Export, OfSectionsSaysWhoseTheyAre) {
    write("p.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[mechanism]\ncrank_speed = \"600 rpm\"\n"
                    "[study]\nkind = \"poincare\"\nmembers = 2\nrevolutions = 3\n[study.vary]\n\"initial.y\" = { dist = \"unif\", low = \"-0.01 mm\", high = \"0.01 mm\" }\n");
    ASSERT_EQ(run({"run", "p.toml", "-o", "p.nc", "--quiet"}).code, 0);
    auto const columns = exported("p.nc", {"--sections"});
    ResultReader const stored = results("p.nc");
    expect_numbers(columns.at("time [s]"), stored.values("section_time"));
    expect_numbers(columns.at("wx [rad s-1]"), stored.values("section_wx"));
    std::vector<double> const counts = stored.values("section_count");
    std::vector<double> owners(static_cast<std::size_t>(counts[0]), 0);
    owners.resize(static_cast<std::size_t>(counts[0] + counts[1]), 1);
    expect_numbers(columns.at("member"), owners);
}

TEST_F(Export, RefusesInOneLine) {
    ASSERT_EQ(run_scene({}).code, 0);
    ASSERT_EQ(run_scene({"-o", "statistics.nc", "--set", "study.store=statistics", "study.samples=0"}).code, 0);
    expect_refusal(2, "-o o.xls: export writes .csv and .mat; give a name that ends with one of them", {"export", "s.nc", "-o", "o.xls"});
    expect_refusal(2, "s.nc: has no series 'vyy'; did you mean vy?", {"export", "s.nc", "-o", "o.csv", "--series", "vyy"});
    expect_refusal(2, "--series has vy twice; name each series once", {"export", "s.nc", "-o", "o.csv", "--series", "vy,vy"});
    EXPECT_EQ(run({"export", "s.nc", "-o", "o.CSV"}).code, 0);
    expect_refusal(2, "s.nc: has no sections; run the scene with", {"export", "s.nc", "-o", "o.mat", "--sections"});
    expect_refusal(2, "two tables, and a CSV file holds one", {"export", "s.nc", "-o", "o.csv", "--sections", "--series", "y"});
    expect_refusal(2, "statistics.nc: keeps statistics, no members", {"export", "statistics.nc", "-o", "o.csv"});
    expect_refusal(4, "s.toml", {"export", "s.toml", "-o", "o.csv"});
    std::string const whole = file_text(path("s.nc"));
    write("cut.nc", whole.substr(0, whole.size() / 2));
    expect_refusal(4, "cut.nc", {"export", "cut.nc", "-o", "o.csv"});
    EXPECT_FALSE(std::filesystem::exists(path("o.csv")));
}

}  // namespace
}  // namespace slideway::testing::export_test
