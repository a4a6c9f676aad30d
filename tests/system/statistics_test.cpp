// Runs that keep statistics in place of members, as a user has them, beside runs of the same scenes that keep the
// members.
#include <algorithm>
#include <cmath>

#include "kernels/status.hpp"
#include "tests/system/statistics.hpp"

namespace slideway::testing::statistics_test {
namespace {

/// A column of the members that finished.
std::vector<double> finished(std::string const& file, std::string const& variable, std::size_t column) {
    ResultReader const results(file);
    auto const status = results.values("status"), values = results.column(variable, column);
    std::vector<double> kept;
    for (std::size_t i = 0; i < status.size(); ++i) {
        if (status[i] == 0) kept.push_back(values[i]);
    }
    return kept;
}

std::pair<double, double> moments(std::vector<double> const& values) {
    long double sum = 0, squares = 0;
    for (double const value : values) sum += value;
    auto const n = static_cast<long double>(values.size());
    for (double const value : values) squares += (value - sum / n) * (value - sum / n);
    return {static_cast<double>(sum / n), static_cast<double>(std::sqrt(squares / (n - 1)))};
}

TEST_F(StatisticsRun, SaysWhatTheStoredMembersSay) {
    ASSERT_EQ(run_scene("s.nc", failing).code, 0);
    ASSERT_EQ(run_scene("m.nc", failing, stored).code, 0);
    for (std::string const quantity : {"peak_normal_force", "energy_change", "mode_time"}) {
        EXPECT_EQ(statistic("s.nc", quantity + "_count"), statistic("m.nc", quantity + "_count"));
        for (char const* const end : {"_min", "_max"}) {
            EXPECT_EQ(statistic("s.nc", quantity + end), statistic("m.nc", quantity + end));
        }
        EXPECT_EQ(statistic("s.nc", quantity + "_bin_edge").size(), statistic("m.nc", quantity + "_bin_edge").size());
        auto const mean = statistic("s.nc", quantity + "_mean"), sd = statistic("s.nc", quantity + "_sd");
        for (std::size_t i = 0; i < mean.size(); ++i) {
            // In long double: a plain sum of 400 squares can be off by more than is asked for here.
            auto const [exact_mean, exact_sd] = moments(finished(path("m.nc").string(), quantity, i));
            EXPECT_NEAR(mean[i], exact_mean, 1e-14 * std::abs(exact_mean)) << quantity;
            EXPECT_NEAR(sd[i], exact_sd, 1e-14 * exact_sd) << quantity;
        }
    }
    for (char const* const name : {"members", "draws"}) EXPECT_EQ(statistic("s.nc", name), statistic("m.nc", name));
    for (char const* const name : {"met", "trials", "all_met", "share_interval", "all_share_interval"}) {
        EXPECT_EQ(statistic("s.nc", name, "yield"), statistic("m.nc", name, "yield")) << name;
    }
    EXPECT_GT(statistic("s.nc", "all_met", "yield")[0], 0);
    EXPECT_LT(statistic("s.nc", "all_met", "yield")[0], 400);
    // Work is summed.
    ResultReader const sums(path("s.nc").string()), members(path("m.nc").string());
    for (char const* const name : {"steps_accepted", "rhs_evaluations", "stiff_steps"}) {
        double sum = 0;
        for (double const value : members.values(name)) sum += value;
        EXPECT_EQ(sums.values(name), std::vector<double>{sum});
    }
}

TEST_F(StatisticsRun, QuantilesKeepTheirPromise) {
    ASSERT_EQ(run_scene("s.nc").code, 0);
    ASSERT_EQ(run_scene("m.nc", stored).code, 0);
    ResultReader const members(path("m.nc").string());
    auto const probabilities = statistic("m.nc", "probability");
    for (std::string const quantity : {"peak_normal_force", "energy_change"}) {
        auto sorted = members.values(quantity);
        std::sort(sorted.begin(), sorted.end());
        auto const sketched = statistic("s.nc", quantity + "_quantile"),
                   exact = statistic("m.nc", quantity + "_quantile");
        for (std::size_t i = 0; i < probabilities.size(); ++i) {
            double const h = probabilities[i] * static_cast<double>(sorted.size() - 1);
            double const size = std::max(std::abs(sorted[static_cast<std::size_t>(std::floor(h))]),
                                         std::abs(sorted[static_cast<std::size_t>(std::ceil(h))]));
            EXPECT_NEAR(sketched[i], exact[i], 0x1p-10 * size) << quantity << " " << probabilities[i];
        }
        auto const bounds = statistic("s.nc", quantity + "_quantile_interval"),
                   exact_bounds = statistic("m.nc", quantity + "_quantile_interval");
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            ASSERT_EQ(std::isnan(bounds[i]), std::isnan(exact_bounds[i]));
            if (std::isnan(bounds[i])) continue;
            EXPECT_NEAR(bounds[i], exact_bounds[i], 0x1p-10 * std::abs(exact_bounds[i]));
        }
    }
    NetcdfFile const file = NetcdfFile::open(path("s.nc").string());
    EXPECT_EQ(file.group("statistics")->text(DataFile::global, "quantile_error"),
              "relative error of at most 2^-10 of a member of that rank");
}

TEST_F(StatisticsRun, FailedMembersCanBeReplayed) {
    Outcome const outcome = run_scene("a.nc", failing);
    Outcome const members = run_scene("m.nc", failing, stored);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const results(path("a.nc").string()), whole(path("m.nc").string());
    auto const status = whole.values("status"), times = whole.values("end_time");
    std::vector<double> failed, failed_times;
    for (std::size_t i = 0; i < status.size() && failed.size() < 100; ++i) {
        if (status[i] == 0) continue;
        failed.push_back(static_cast<double>(i));
        failed_times.push_back(times[i]);
    }
    ASSERT_GT(failed.size(), 0u);
    EXPECT_EQ(results.values("failed_member"), failed);
    EXPECT_EQ(results.values("failed_time"), failed_times);
    EXPECT_EQ(results.values("failed_status"), std::vector<double>(failed.size(), 2));  // max_steps
    // The command is there, and what it replays ends in the same way.
    std::string const member = std::to_string(static_cast<int>(failed.front()));
    std::string const options = " --set study.store=members --isa ";
    EXPECT_NE(outcome.out.find(options), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" --member " + member + "\n"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("a single one can be had with --member K --set study.store=members"), std::string::npos);
    ASSERT_EQ(run_scene("one.nc", failing, {"--member", member, "--set", "study.store=members"}).code, 0);
    ResultReader const one(path("one.nc").string());
    EXPECT_EQ(one.values("status"), std::vector<double>{2});
    EXPECT_EQ(one.values("end_time"), std::vector<double>{failed_times.front()});
    EXPECT_EQ(run_scene("b.nc", {"--set", "integrator.max_steps=60", "--max-failures", "0"}).code, 3);
}

TEST_F(StatisticsRun, InfoAndCheckKnowIt) {
    ASSERT_EQ(run_scene("a.nc").code, 0);
    Outcome const info = run({"info", "a.nc", "--scene"});
    EXPECT_EQ(info.code, 0) << info.err;
    for (char const* const text : {"matches the data", "finished         400",
                                   "Quantiles are sketched: relative error of at most "
                                   "2^-10",
                                   "all limits", "store = \"statistics\""}) {
        EXPECT_NE(info.out.find(text), std::string::npos) << text;
    }
    expect_refusal(2, "a.nc: keeps statistics, no series of members", {"stats", "a.nc"});
    Outcome const few = run({"check", "s.toml"}), many = run({"check", "s.toml", "--set", "study.members=100000000"});
    EXPECT_EQ(few.code, 0);
    auto const disk = [](std::string const& text) {
        auto const from = text.find("disk "), to = text.find('\n', from);
        return text.substr(from, to - from);
    };
    EXPECT_NE(disk(many.out).find(" kB for the result, at most "), std::string::npos)
        << disk(many.out);
    EXPECT_NE(disk(many.out).find(" MB for its shards"), std::string::npos) << disk(many.out);
}

TEST_F(StatisticsRun, AnEnsembleWithoutLimitsHasItsReport) {
    write("e.toml",
          "schema = 1\n[contact]\nlaw = \"paper\"\n[friction]\n[study]\nmembers = 20\nduration = \"0.1 ms\"\nquantities = [\"drive_work\", "
          "\"energy_residual\"]\nstore = \"statistics\"\n[study.vary]\n\"initial.y\" = { dist = \"unif\", low = "
          "\"-0.09 mm\", high = \"0.09 mm\" }\n");
    Outcome const outcome = run({"run", "e.toml", "--no-progress"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("Quantiles are sketched"), std::string::npos);
    EXPECT_NE(outcome.out.find("Mode switching of the paper law made"), std::string::npos);
    EXPECT_EQ(outcome.out.find("Yield"), std::string::npos);
    EXPECT_EQ(statistic("e.nc", "drive_work_count"), std::vector<double>{20});
}

}  // namespace
}  // namespace slideway::testing::statistics_test
