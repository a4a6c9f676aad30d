// What members of a study came to, as the columns of its result have it or as running them again tells it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/progress.hpp"
#include "host/statistics/summary.hpp"
#include "host/study/tolerance_members.hpp"

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

    double total_work() const;
};

/// As many of [0, all) as are asked for, evenly over them: they stand for all.
std::vector<std::uint64_t> spread_over(std::uint64_t all, std::uint64_t count);

/// Right-hand sides of each member, a Jacobian counting one and a half.
std::vector<double> stored_work(ToleranceMembers const& members);

/// What a result says of all its members, how they end apart: that takes an evaluation each.
MemberNumbers stored_numbers(ToleranceMembers const& members, Scene const& scene);

/// Fills in how some members of a result end.  @param rows of the members
void add_end_contacts(MemberNumbers& numbers, ToleranceMembers const& members, Scene const& scene, std::vector<std::size_t> const& rows);

/// Runs members, and says what they came to in their order.
struct FreshRun {
    Backend const& backend;
    int threads = 1;
    StopRequest const* stop = nullptr;
    Progress* progress = nullptr;
    double weight = 1;  // of a member's work in the progress
};
/// @param most_steps [members] after which a member is cut short; empty: the scene's integrator.max_steps alone
MemberNumbers fresh_numbers(Scene const& scene, std::vector<std::uint64_t> const& members, FreshRun const& run, std::vector<std::uint64_t> const& most_steps = {});

}  // namespace slideway
