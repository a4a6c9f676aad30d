#include "host/study/tolerance_report.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "host/store/result_seal.hpp"
#include "tests/support/tolerance_file.hpp"

namespace slideway::testing::statistics_groups_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using StatisticsGroups = ToleranceFile;

struct Stored {
    std::vector<double> values;
    std::vector<std::size_t> shape;
    std::string unit, long_name, coordinates;
};

Stored stored(DataFile const& group, std::string const& name) {
    for (auto const& variable : group.variables()) {
        if (variable.name != name) continue;
        Stored result{std::vector<double>(variable.size()), variable.shape, group.text(variable.id, "units"),
                      group.text(variable.id, "long_name"), group.text(variable.id, "coordinates")};
        std::vector<std::size_t> const start(variable.shape.size() + 1, 0);
        std::span const origin = std::span(start).first(variable.shape.size());
        std::span const count(variable.shape.empty() ? start.data() : variable.shape.data(), variable.shape.size());
        if (variable.type == DataFile::Type::float64) {
            group.read(variable.id, origin, count, result.values.data());
        } else if (variable.type == DataFile::Type::int32) {
            std::vector<int> whole(variable.size());
            group.read(variable.id, origin, count, whole.data());
            result.values.assign(whole.begin(), whole.end());
        }
        return result;
    }
    ADD_FAILURE() << "no variable " << name;
    return {};
}

std::vector<std::string> texts(DataFile const& group, std::string const& name) {
    for (auto const& variable : group.variables()) {
        if (variable.name != name) continue;
        std::vector<char> letters(variable.size());
        group.read(variable.id, std::array<std::size_t, 2>{0, 0}, variable.shape, letters.data());
        std::vector<std::string> result;
        std::size_t const width = variable.shape[1];
        for (std::size_t i = 0; i < variable.shape[0]; ++i) {
            std::string const text(letters.data() + i * width, width);
            result.push_back(text.substr(0, text.find('\0')));
        }
        return result;
    }
    return {};
}

TEST_F(StatisticsGroups, HoldTheReportOfARandomDesign) {
    Scene study = scene(DesignKind::mc, 5000);
    study.limits = {limit("peak_normal_force", "", -infinity, 1499), limit("mode_time", "line", 2200, infinity)};
    NetcdfFile file = write(numbered_members(1000, 1000));
    std::string const before = payload_hash(file);
    ToleranceReport const report = tolerance_report(ResultView(file), study);
    write_statistics(file, report);
    EXPECT_NE(payload_hash(file), before);
    file.close();

    NetcdfFile const back = NetcdfFile::open(path());
    EXPECT_EQ(back.groups(), (std::vector<std::string>{"statistics", "yield", "sensitivity"}));
    for (std::string const& name : back.groups()) {
        auto const held_group = back.group(name);
        DataFile const& group = *held_group;
        EXPECT_EQ(group.text(DataFile::global, "policy"), report.policy);
        EXPECT_EQ(group.text(DataFile::global, "design"), "mc");
        for (auto const& variable : group.variables()) {
            EXPECT_NE(group.text(variable.id, "long_name"), "") << variable.name;
        }
    }
    auto const held_statistics = back.group("statistics");
    DataFile const& statistics = *held_statistics;
    Stored const mean = stored(statistics, "mode_time_mean");
    EXPECT_EQ(mean.shape, (std::vector<std::size_t>{4}));
    EXPECT_EQ(mean.values[2], report.columns[3].summary.mean);
    EXPECT_EQ(mean.unit, "s");
    EXPECT_EQ(mean.long_name, "mean: time spent in the mode class");
    EXPECT_EQ(mean.coordinates, "mode_class_name");
    EXPECT_TRUE(stored(statistics, "peak_normal_force_mean").shape.empty());
    Stored const quantiles = stored(statistics, "mode_time_quantile_interval");
    EXPECT_EQ(quantiles.shape, (std::vector<std::size_t>{4, 9, 2}));
    EXPECT_EQ(quantiles.values[(2 * 9 + 4) * 2 + 1], report.columns[3].quantiles[4].interval.high);
    EXPECT_EQ(stored(statistics, "probability").values[1], 0.01);
    EXPECT_EQ(texts(statistics, "bound_name"), (std::vector<std::string>{"low", "high"}));
    EXPECT_EQ(texts(statistics, "ending_name"),
              (std::vector<std::string>{"finished", "max_steps", "geometry"}));
    EXPECT_EQ(stored(statistics, "members").values, (std::vector<double>{800, 50, 50}));
    Stored const bins = stored(statistics, "peak_normal_force_bin_count");
    EXPECT_EQ(bins.values.size(), 64u);
    EXPECT_EQ(std::accumulate(bins.values.begin(), bins.values.end(), 0.0), 800);
    Stored const edges = stored(statistics, "peak_normal_force_bin_edge");
    EXPECT_EQ(edges.values[0], 1000);
    EXPECT_EQ(edges.unit, "N");
    EXPECT_TRUE(std::isnan(edges.values.back()));

    auto const held_yield = back.group("yield");
    DataFile const& yield = *held_yield;
    EXPECT_EQ(texts(yield, "limit_name"), (std::vector<std::string>{"peak_normal_force", "mode_time[line]"}));
    EXPECT_EQ(texts(yield, "unit_name"), (std::vector<std::string>{"N", "s"}));
    EXPECT_EQ(stored(yield, "met").values, (std::vector<double>{400, 720}));
    EXPECT_EQ(stored(yield, "high").values, (std::vector<double>{1499, infinity}));
    EXPECT_EQ(stored(yield, "all_met").values, (std::vector<double>{320}));
    EXPECT_EQ(stored(yield, "trials").values, (std::vector<double>{900}));
    EXPECT_EQ(stored(yield, "all_share_interval").values[1], report.all_met->interval.high);

    auto const held_sensitivity = back.group("sensitivity");
    DataFile const& sensitivity = *held_sensitivity;
    EXPECT_EQ(texts(sensitivity, "input_name"), (std::vector<std::string>{"joint.clearance", "contact.eta"}));
    Stored const ranks = stored(sensitivity, "mode_time_rank_correlation");
    EXPECT_EQ(ranks.shape, (std::vector<std::size_t>{4, 2}));
    EXPECT_EQ(ranks.coordinates, "mode_class_name input_name");
    EXPECT_NEAR(ranks.values[3 * 2], -1, 1e-14);
    EXPECT_EQ(stored(sensitivity, "peak_normal_force_rank").values, (std::vector<double>{1, 2}));
}

TEST_F(StatisticsGroups, HoldIndices) {
    NetcdfFile file = write(radial_members(0, 100));
    ToleranceReport const report = tolerance_report(ResultView(file), scene(DesignKind::saltelli, 400));
    write_statistics(file, report);
    EXPECT_FALSE(file.has_group("yield"));
    auto const held_sensitivity = file.group("sensitivity");
    DataFile const& sensitivity = *held_sensitivity;
    EXPECT_EQ(stored(sensitivity, "rows_used").values, (std::vector<double>{100}));
    EXPECT_EQ(stored(sensitivity, "mode_time_total").shape, (std::vector<std::size_t>{4, 2}));
    EXPECT_EQ(stored(sensitivity, "mode_time_total").values[1], report.indices->columns[1].indices.total[1].value);
    EXPECT_EQ(stored(sensitivity, "peak_normal_force_first_interval").values[2],
              report.indices->columns[0].indices.first[1].interval.low);
    EXPECT_EQ(stored(sensitivity, "mode_time_rank").values, (std::vector<double>{2, 1, 2, 1, 0, 0, 1, 2}));
    EXPECT_EQ(stored(sensitivity, "peak_normal_force_first_sum").values[0],
              report.indices->columns[0].indices.first_sum.value);
}

}  // namespace
}  // namespace slideway::testing::statistics_groups_test
