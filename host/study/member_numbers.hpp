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

/// Numbers of members, one column a number: quantities, exponents, and how many surfaces, lines and points touch at the end.
struct MemberNumbers {
    struct Column {
        std::string name, unit;
        bool is_exponent = false;
        std::vector<double> values;  // [members]; NaN of a member that did not finish
    };
    std::vector<Column> columns;
    std::vector<double> work;  // [members] right-hand sides, a Jacobian counting one and a half
    std::vector<double> energy_residual = {};  // [members] J, of a check that asks for it; else empty

    std::size_t finished() const;
    double total_work() const;
};

/// A number over all members of a study.
struct WholeColumn {
    Summary summary;
    double skewness;  // mean cube of what is off the mean, in standard deviations; NaN where all are alike
};
WholeColumn whole_of(std::vector<double> const& values);

/// As many of [0, all) as are asked for, evenly over them: they stand for all.
std::vector<std::uint64_t> spread_over(std::uint64_t all, std::uint64_t count);

/// Right-hand sides of each member, a Jacobian counting one and a half.
std::vector<double> stored_work(ToleranceMembers const& members);

/// What a result says of some of its members.  @param rows of the members  @param work of all of them
/// @param whole where each column goes over all members, but those of how they end
MemberNumbers stored_numbers(ToleranceMembers const& members, Scene const& scene, std::vector<std::uint64_t> const& rows,
                             std::vector<double> const& work, std::vector<WholeColumn>& whole);

/// Runs members, and says what they came to in their order.  @param stop may be nullptr  @param progress may be nullptr
/// @param weight of a member's work in the progress
MemberNumbers fresh_numbers(Scene const& scene, std::vector<std::uint64_t> const& members, Backend const& backend, int threads,
                            StopRequest const* stop, Progress* progress = nullptr, double weight = 1);

}  // namespace slideway
