// Runs that round differently: close until trajectories part, and of one distribution after.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway::testing {

/// The largest distance between the distributions of two samples.
inline double kolmogorov_distance(std::vector<double> a, std::vector<double> b) {
    std::ranges::sort(a);
    std::ranges::sort(b);
    double distance = 0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        double const x = std::min(a[i], b[j]);
        while (i < a.size() && a[i] <= x) ++i;
        while (j < b.size() && b[j] <= x) ++j;
        distance = std::max(distance, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                               static_cast<double>(j) / static_cast<double>(b.size())));
    }
    return distance;
}

/// How likely two samples of one distribution are as far apart, for many draws.  Source: Stephens, J. R. Stat. Soc. B 32 (1970) 115:
/// Q(λ) = 2 Σ (−1)^(k−1) exp(−2 k² λ²) at λ = (√n + 0.12 + 0.11/√n) D, 1/n = 1/n₁ + 1/n₂.
inline double smirnov_probability(double distance, std::size_t first, std::size_t second) {
    double const n = 1 / (1 / static_cast<double>(first) + 1 / static_cast<double>(second));
    double const lambda = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
    if (lambda < 0.2) return 1;  // to twelve digits, where the series converges slowly
    double sum = 0;
    for (int k = 1; k <= 100; ++k) sum += (k % 2 ? 2 : -2) * std::exp(-2 * k * k * lambda * lambda);
    return std::clamp(sum, 0.0, 1.0);
}

/// Members that come into contact.  Their steps are fixed: a step control that rounds differently soon takes other steps.
inline BlockPlan touching_block(Law law) {
    BlockPlan plan;
    plan.parts = {law, Damping::point, true, false};
    plan.members = varied_members(60, plan.parts);
    plan.settings.method = Method::rk4;
    plan.settings.fixed_step = 1e-6;
    plan.settings.end_time = 5e-3;
    return plan;
}

/// Members that have lost what they knew of their start.
inline BlockPlan parted_block(Law law) {
    BlockPlan plan;
    plan.parts = {law, Damping::point, law == Law::conservative, false};
    plan.members = varied_members(200, plan.parts);
    for (Inputs& member : plan.members) member.crank_speed *= 30;
    plan.settings.rtol = plan.settings.atol = 1e-6;
    plan.settings.end_time = 0.02;
    return plan;
}

inline void expect_close(OwnedBlock const& a, OwnedBlock const& b) {
    double largest[state_size] = {};
    double onsets = 0;
    for (std::size_t i = 0; i < a.block.members; ++i) {
        ASSERT_EQ(a.record(i).status, Status::finished) << i;
        ASSERT_EQ(b.record(i).status, Status::finished) << i;
        for (int j = 0; j < state_size; ++j) largest[j] = std::max(largest[j], std::abs(a.state(i)[j]));
        onsets += a.value(i, Quantity::contact_onsets);
    }
    EXPECT_GT(onsets, static_cast<double>(a.block.members) / 2);
    for (std::size_t i = 0; i < a.block.members; ++i) {
        for (int j = 0; j < state_size; ++j)
            EXPECT_LE(std::abs(a.state(i)[j] - b.state(i)[j]), 1e-10 * largest[j]) << "member " << i << ", state " << j;
    }
}

/// @param are_parted whether they must have parted, or they are the same run
inline void expect_one_distribution(OwnedBlock const& a, OwnedBlock const& b, bool are_parted) {
    std::size_t const n = a.block.members;
    std::size_t parted = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (std::abs(a.state(i)[0] - b.state(i)[0]) > 1e-3 * a.plan().members[i].clearance_y) ++parted;
    }
    EXPECT_GE(parted, are_parted ? n / 2 : 0);
    for (Quantity const q : {Quantity::peak_normal_force, Quantity::mean_normal_force, Quantity::energy_change,
                             Quantity::rms_position_error}) {
        std::vector<double> x, y;
        for (std::size_t i = 0; i < n; ++i) x.push_back(a.value(i, q)), y.push_back(b.value(i, q));
        double const distance = kolmogorov_distance(x, y);
        EXPECT_GT(smirnov_probability(distance, n, n), 1e-3)
            << quantity_table[static_cast<int>(q)].name << ": " << distance;
    }
}

}  // namespace slideway::testing
