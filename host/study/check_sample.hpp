// Which members of a study run again: drawn at random, and evenly over what they cost and over the values that few of them share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

#include "host/config/scene.hpp"
#include "host/sampling/sobol_points.hpp"
#include "host/study/tolerance_members.hpp"

namespace slideway {

/// Members of which the study says something of their own: all; those of a column of a sweep; those that share a value of a list.
struct MemberGroup {
    std::string name;       // "mechanism.crank_speed = 20"; "" of all
    std::vector<char> has;  // [rows] whether a member is in it
    std::size_t size() const;
};

/// All, and behind it one for each value of whatever takes few: the parameter of a sweep, lists and grids with at most `most_values` of them, that is
/// two members or more to each on average.
/// @param rows those of the members that finished, which alone count
std::vector<MemberGroup> member_groups(ToleranceMembers const& members, Scene const& scene);
inline constexpr std::size_t most_values = 16;

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
