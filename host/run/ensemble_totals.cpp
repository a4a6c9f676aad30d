#include "host/run/ensemble_totals.hpp"

#include <numeric>

#include "host/run/block_buffers.hpp"

namespace slideway {

std::uint64_t EnsembleTotals::done() const { return std::accumulate(ended.begin(), ended.end(), std::uint64_t{0}); }

std::uint64_t EnsembleTotals::failed() const { return done() - ended[static_cast<std::size_t>(Status::finished)]; }

EnsembleTotals& EnsembleTotals::operator+=(EnsembleTotals const& other) {
    for (std::size_t i = 0; i < ended.size(); ++i) ended[i] += other.ended[i];
    steps_accepted += other.steps_accepted;
    steps_rejected += other.steps_rejected;
    stiff_steps += other.stiff_steps;
    rhs_evaluations += other.rhs_evaluations;
    jacobian_evaluations += other.jacobian_evaluations;
    lane_steps_executed += other.lane_steps_executed;
    lane_steps_useful += other.lane_steps_useful;
    seconds += other.seconds;
    if (stopped == StopReason::none) stopped = other.stopped;
    return *this;
}

double EnsembleTotals::lane_utilisation() const {
    return slideway::lane_utilisation(lane_steps_useful, lane_steps_executed);
}

}  // namespace slideway
