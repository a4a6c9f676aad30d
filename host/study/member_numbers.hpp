// What members of a study came to, as the columns of its result have it or as running them again tells it; and which of them run again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <unordered_set>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/ensemble.hpp"
#include "host/sampling/sobol_points.hpp"
#include "host/statistics/summary.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway {

/// Numbers of members, one column a number: quantities, whether limits are met, exponents, and how many surfaces, lines and points touch at the end.
struct MemberNumbers {
    enum class Kind { quantity, limit, exponent, contacts };
    struct Column {
        std::string name, unit;
        Kind kind = Kind::quantity;
        std::vector<double> values = {};  // [members]; NaN of a member that did not finish
    };
    std::vector<Column> columns;
    std::vector<char> finished;                // [members]
    std::vector<double> work;                  // [members] right-hand sides, a Jacobian counting one and a half
    std::vector<std::uint64_t> steps = {};     // [members] tried
    std::vector<double> energy_residual = {};  // [members] J, of a check that asks for it; else empty

    double total_work() const { return std::accumulate(work.begin(), work.end(), 0.0); }
};

/// As many of [0, all) as are asked for, evenly over them: they stand for all.
std::vector<std::uint64_t> spread_over(std::uint64_t all, std::uint64_t count);

/// Right-hand sides of each member, a Jacobian counting one and a half.
std::vector<double> stored_work(ToleranceMembers const& members);

/// What a result says of all its members, how they end apart: that takes an evaluation each.
MemberNumbers stored_numbers(ToleranceMembers const& members, Scene const& scene);

/// Fills in how some members of a result end.  @param rows of the members
void add_end_contacts(MemberNumbers& numbers, ToleranceMembers const& members, Scene const& scene, std::vector<std::size_t> const& rows);

/// How members run that no result keeps.
struct FreshRun {
    Backend const& backend;
    int threads = 1;
    StopRequest const& stop = never_stops;
    Progress* progress = nullptr;
    double weight = 1;  // of a member's work in the progress
};
EnsembleTotals run_members(Scene const& scene, std::vector<std::uint64_t> const& members, FreshRun const& run, BlockSink const& sink);
/// Runs members, and says what they came to in their order.
/// @param most_steps [members] after which a member is cut short; empty: the scene's integrator.max_steps alone
MemberNumbers fresh_numbers(Scene const& scene, std::vector<std::uint64_t> const& members, FreshRun const& run, std::vector<std::uint64_t> const& most_steps = {});

// Which members of a study run again: drawn at random, and evenly over what they cost and over the values that few of them share.

/// Members of which the study says something of their own: all; those of a column of a sweep; those that share a value of a list.
struct MemberGroup {
    std::string name;       // "mechanism.crank_speed = 20"; "" of all
    std::vector<char> has;  // [rows] whether a member is in it
    std::size_t size() const { return static_cast<std::size_t>(std::ranges::count(has, 1)); }
};

/// Draws rows without putting back.  They lie in the order of their groups, and within them of their cost; draws follow a scrambled Sobol sequence
/// along that order, so that any 2^k in a row fall into as many equal stretches of it, and each row is as likely as any other.
class CheckSample {
public:
    /// @param rows that may be drawn  @param groups whose rows stay together  @param cost [all rows]
    CheckSample(std::vector<std::size_t> rows, std::vector<MemberGroup> const& groups, std::vector<double> const& cost,
                std::uint64_t seed);
    /// As many as are asked for, or are left.
    std::vector<std::size_t> next(std::size_t count);
    std::size_t left() const { return order_.size() - drawn_.size(); }

private:
    std::vector<std::size_t> order_;
    SobolAxis const axis_;
    std::uint64_t point_ = 0;
    std::unordered_set<std::size_t> drawn_;  // places in the order
};

}  // namespace slideway
