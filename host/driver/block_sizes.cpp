#include "host/driver/block_sizes.hpp"

#include <algorithm>

namespace slideway {
namespace {

constexpr std::uint64_t members_per_lane =
    8;  // in a small block: few enough, and lanes seldom wait for the last member
constexpr std::uint64_t blocks_per_worker = 2;  // of what is left, so that workers end together

}  // namespace

BlockSizer::BlockSizer(BlockSizes const& sizes, std::uint64_t members, int workers)
    : sizes_(sizes), members_(members), workers_(static_cast<std::uint64_t>(workers)) {}

std::uint64_t BlockSizer::next(std::uint64_t left) const {
    if (sizes_.fixed > 0) return sizes_.fixed;
    std::uint64_t const small = members_per_lane * sizes_.lanes;
    std::uint64_t const share = (left + workers_ - 1) / workers_;
    std::uint64_t const least = std::clamp<std::uint64_t>(share, 1, small);
    std::uint64_t const most = std::max<std::uint64_t>(sizes_.most, least);
    std::uint64_t size = std::clamp<std::uint64_t>(share / blocks_per_worker, least, most);
    if (seconds_per_member_ > 0) {
        double const in_time = std::min(sizes_.seconds / seconds_per_member_, static_cast<double>(most));
        size = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(in_time), least, size);
    } else {
        // Small ensembles have no members to spare for trials.
        constexpr std::uint64_t enough_for_trials = 16, untried = 512;
        bool const trial = members_ >= enough_for_trials * small * workers_;
        size = std::clamp<std::uint64_t>(trial ? small : untried, least, size);
    }
    return (size + sizes_.lanes - 1) / sizes_.lanes * sizes_.lanes;
}

void BlockSizer::measured(std::uint64_t members, double seconds) {
    if (members > 0 && seconds > 0) seconds_per_member_ = seconds / static_cast<double>(members);
}

}  // namespace slideway
