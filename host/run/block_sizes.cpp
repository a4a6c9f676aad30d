#include "host/run/block_sizes.hpp"

#include <algorithm>

namespace slideway {
namespace {

constexpr std::uint64_t blocks_per_worker = 2;  // of what is left, so that several workers end together
constexpr std::uint64_t enough_for_trials = 16;
// The last members of a block leave lanes idle, as much work as that of some members, whatever the block's size: 2 where all cost
// about the same, 25 where some settle and some rattle (scenes/tolerance_0.1mm.toml).
constexpr double blocks_over_idle = 40;

}  // namespace

BlockSizer::BlockSizer(BlockSizes const& sizes, std::uint64_t members, int workers)
    : sizes_(sizes), members_(members), workers_(static_cast<std::uint64_t>(workers)) {}

/// Members that make up the time that a block should take, as far as it may go.
std::uint64_t BlockSizer::in_time() const {
    auto const most = static_cast<double>(std::max<std::size_t>(sizes_.bounds.most, 1));
    return static_cast<std::uint64_t>(std::min(sizes_.seconds / seconds_per_member_, most));
}

std::uint64_t BlockSizer::next(std::uint64_t left) const {
    if (sizes_.fixed > 0) return sizes_.fixed;
    std::uint64_t const lanes = sizes_.bounds.lanes, most = std::max<std::uint64_t>(sizes_.bounds.most, 1);
    std::uint64_t const small = std::min<std::uint64_t>(sizes_.bounds.least, most);
    std::uint64_t const share = (left + workers_ - 1) / workers_;
    auto const worth_its_end = static_cast<std::uint64_t>(std::min(blocks_over_idle * idle_members_, 1e6));
    std::uint64_t const least = std::clamp<std::uint64_t>(share, 1, std::clamp(worth_its_end, small, most));
    std::uint64_t size = std::clamp<std::uint64_t>(share / (workers_ > 1 ? blocks_per_worker : 1), least, most);
    if (sizes_.bounds.shared) {
        // The first ones are no trials: they fill the machine.
        size = seconds_per_member_ > 0 ? std::max(in_time(), small) : small;
    } else if (seconds_per_member_ > 0) {
        size = std::clamp(in_time(), least, size);
    } else if (members_ >= enough_for_trials * small * workers_) {
        size = std::min(size, small);
    } else {
        // Small ensembles have no members to spare for trials.
        size = std::clamp<std::uint64_t>(untried, least, size);
    }
    std::uint64_t const rounded = (size + lanes - 1) / lanes * lanes;
    return rounded <= most ? rounded : size;
}

void BlockSizer::measured(std::uint64_t members, double seconds, double utilisation) {
    if (members == 0 || !(seconds > 0) || !(utilisation > 0)) return;
    seconds_per_member_ = seconds / static_cast<double>(members);
    // Of several blocks the dearest end counts: a later one may be as bad.
    idle_members_ = std::max(idle_members_, (1 / utilisation - 1) * static_cast<double>(members));
}

}  // namespace slideway
