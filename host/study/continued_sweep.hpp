// A sweep whose columns go on from each other.
#pragma once

#include <functional>
#include <optional>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/ensemble.hpp"
#include "kernels/members/start.hpp"

namespace slideway {

/// How a member ended in an earlier run.
struct MemberEnd {
    bool finished;
    StateNumbers state;
};
using MemberEnds = std::function<std::optional<MemberEnd>(std::uint64_t member)>;

/// A sweep whose members begin where those of the column before have ended.
bool is_continued(Scene const& scene);

/// The starts that members belong to.
MemberSet swept_starts(Scene const& scene, MemberSet const& members);

/// What workers of a run take: members, of a continued sweep its starts, for their columns follow one another.
std::uint64_t place_count(Scene const& scene, MemberSet const& members);

/// The members of starts, in all columns.
MemberSet members_of_starts(Scene const& scene, MemberSet const& starts);

/// Members of earlier runs from whose ends those asked for go on: what a run that is resumed has to recall, one of each
/// start, or as many as there are gaps in what had finished.
MemberSet members_before(Scene const& scene, MemberSet const& asked);

/// Starts do not depend on each other: a worker takes some and runs them through the columns.
/// The plan of the members `asked` becomes one whose places are their `swept_starts`.  Members before those asked for,
/// which only lead to them, run too, but are not handed on.
/// @param ends of members that ran before and need not run again, nor those that led to them; at least
/// `members_before`, or nothing where these are to run
void continue_columns(Scene const& scene, EnsemblePlan& plan, MemberSet const& asked, BlockKernel const& kernel,
                      MemberEnds ends, StopRequest const& stop);

}  // namespace slideway
