// Loads of pairs along the path that leads to them (model.md M13.11, M13.14): each way to follow it alone, on problems whose answers are their own proof.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "kernels/rigid/arc_path.hpp"
#include "kernels/rigid/long_steps.hpp"
#include "kernels/rigid/spring_loads.hpp"
#include "tests/support/unit_slider.hpp"

namespace slideway::load_paths_test {
namespace {

using Motion = Twist<double>;

/// Pairs of random directions on it, which can stick.
struct Problem : testing::UnitSlider {
    std::array<TouchingPair<double>, 16> rows{};
    int count;
    unsigned seed;
    Motion before, after;

    Problem(int pairs, double friction, unsigned number) : count(pairs), seed(number) {
        std::mt19937_64 draw(seed);
        auto const next = [&draw] { return std::uniform_real_distribution(-1.0, 1.0)(draw); };
        auto const motion = [&next]() -> Motion { return {{next(), next(), next()}, {next(), next(), next()}}; };
        before = motion();
        for (int k = 0; k < count; ++k) {
            auto& row = rows[static_cast<std::size_t>(k)];
            row.number = k;
            row.pair.normal = motion(), row.pair.slip[0] = motion(), row.pair.slip[1] = motion();
            row.pair.pushed = at.response(row.pair.normal);
            for (int j = 0; j < 2; ++j) row.pair.dragged[j] = at.response(row.pair.slip[j]);
            row.start(true, friction);
            row.weigh(dot(row.pair.normal, row.pushed));
            row.weigh_along();
            row.target = -0.1 * std::abs(next());  // above 0 some would have no loads
        }
        after = before;
    }

    [[nodiscard]] double size() const {
        double most = 0;
        for (int k = 0; k < count; ++k) most = std::max(most, rows[static_cast<std::size_t>(k)].target - dot(rows[static_cast<std::size_t>(k)].pair.normal, before));
        return most;
    }
    template <class Path> bool solve() {
        double const s = size();
        return !Path(at, rows.data(), count, before, true, {s, 1e-15 * s, 1e-13 * s}).solve(true, after);
    }
    /// By how much (M13.11) is missed, as motion: of the normals min(γ − target, own Λ), of friction what a step projected onto the cone would change.
    [[nodiscard]] double missed() const {
        double worst = 0;
        Motion sum = before;
        for (int k = 0; k < count; ++k) {
            auto const& row = rows[static_cast<std::size_t>(k)];
            sum = sum + at.response(row.load());
        }
        for (int k = 0; k < count; ++k) {
            auto const& row = rows[static_cast<std::size_t>(k)];
            double const own = dot(row.pair.normal, row.pair.pushed), most = row.coefficient * row.normal;
            worst = std::max(worst, std::abs(std::min(dot(row.pair.normal, sum) - row.target, own * row.normal)));
            double wish[2];
            for (int j = 0; j < 2; ++j) wish[j] = row.along[j] - dot(row.pair.slip[j], sum) / row.across;
            double const share = std::min(1.0, most / std::max(std::hypot(wish[0], wish[1]), 1e-300));
            for (int j = 0; j < 2; ++j) worst = std::max(worst, row.across * std::abs(share * wish[j] - row.along[j]));
        }
        return worst;
    }
};

/// Problems that springs do not solve, from any of their starts.
std::vector<Problem const*> hard_problems() {
    static std::vector<std::unique_ptr<Problem>> const found = [] {
        std::vector<std::unique_ptr<Problem>> hard;
        for (unsigned seed = 0; seed < 2000; ++seed) {
            int const pairs = 2 + static_cast<int>(seed % 8);
            auto problem = std::make_unique<Problem>(pairs, 0.9, seed);
            double const s = problem->size();
            if (!(s > 0)) continue;
            LoadGoal<double> const goal{s, 1e-15 * s, 1e-13 * s};
            bool open = true;
            Problem trial(pairs, 0.9, seed);
            using enum SpringLoads<double>::Start;
            for (auto const start : {loads, multipliers, all}) {
                SpringLoads<double> springs(trial.at, trial.rows.data(), trial.count, trial.before, true);
                open = open && springs.solve(true, start, 10, goal, trial.after);
            }
            if (open) hard.push_back(std::move(problem));
        }
        return hard;
    }();
    std::vector<Problem const*> all;
    for (auto const& each : found) all.push_back(each.get());
    return all;
}

/// @return the share of hard problems that a path solves
template <class Path> double solved_share() {
    int exact = 0;
    for (auto const* hard : hard_problems()) {
        Problem problem(hard->count, 0.9, hard->seed);
        if (!problem.solve<Path>()) continue;
        EXPECT_LT(problem.missed(), 2e-4 * problem.size() + 1e-9) << "seed " << hard->seed;
        exact += problem.missed() < 1e-8;
    }
    return static_cast<double>(exact) / static_cast<double>(hard_problems().size());
}

TEST(LoadPaths, OfLongStepsSolveWhatSpringsDoNot) { EXPECT_GT(solved_share<LongSteps<double>>(), 0.87); }
TEST(LoadPaths, ByTheirArcsSolveWhatSpringsDoNot) { EXPECT_GT(solved_share<ArcPath<double>>(), 0.95); }

TEST(LoadPaths, SayWhatTheyDoNotSolve) {
    // Two faces that close upon one another at once: no loads open both.
    Problem problem(2, 0.0, 1);
    problem.rows[1].pair = problem.rows[0].pair;
    problem.rows[1].pair.normal = -1.0 * problem.rows[0].pair.normal, problem.rows[1].pair.pushed = -1.0 * problem.rows[0].pair.pushed;
    problem.rows[1].act = problem.rows[1].pair.normal, problem.rows[1].pushed = problem.rows[1].pair.pushed;
    for (auto& row : problem.rows) row.target = 1;
    EXPECT_FALSE(problem.solve<LongSteps<double>>());
    EXPECT_FALSE(problem.solve<ArcPath<double>>());
}

}  // namespace
}  // namespace slideway::load_paths_test
