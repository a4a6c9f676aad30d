#include "host/run/block_buffers.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "host/base/numbers.hpp"

namespace slideway {
namespace {

std::size_t series_width(BlockRequest const& request) {
    return static_cast<std::size_t>(std::popcount(request.series)) * request.sample_times.size();
}

/// Moves `tables` tables of packed rows, one row per usable member, to rows for all members.  Rows are taken from the
/// last to the first: a row never moves forward past one that still has to move, so no second buffer is needed.
template <class T>
void spread_rows(std::vector<T>& values, std::vector<char> const& is_usable, std::size_t usable, std::size_t tables,
                 std::size_t row, T const& absent) {
    std::size_t const members = is_usable.size();
    std::size_t source = tables * usable;
    for (std::size_t target = tables * members; target-- > 0;) {
        auto const to = values.begin() + static_cast<std::ptrdiff_t>(target * row);
        if (!is_usable[target % members]) {
            std::fill_n(to, row, absent);
        } else if (--source != target) {
            std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(source * row), row, to);
        }
    }
}

std::size_t section_width(BlockRequest const& request) {
    std::size_t const rows = request.crossings.room > 0 ? request.crossings.room : request.stops.sections();
    return request.sections ? rows * section_columns(request.states) : 0;
}

/// Times of samples that are taken at angles.
std::size_t clock_width(BlockRequest const& request) { return request.by_turns ? request.sample_times.size() : 0; }

std::size_t shadow_count(BlockRequest const& request) { return static_cast<std::size_t>(request.shadows.count); }

std::size_t growth_width(BlockRequest const& request) { return request.stops.growths() * shadow_count(request); }

}  // namespace

std::uint64_t block_bytes(BlockRequest const& request, std::size_t members) {
    std::uint64_t const numbers = request.columns + series_width(request) +
                                  section_width(request) + growth_width(request) + clock_width(request) +
                                  request.states * (1 + shadow_count(request));
    std::uint64_t const per_member = 2 * sizeof(Inputs) + sizeof(char) + sizeof(std::uint32_t) + sizeof(MemberRecord) +
                                     sizeof(MemberClock) + sizeof(double) * numbers;
    return members * per_member;
}

void BlockBuffers::sort_by_cost(MemberCost const& cost) {
    std::vector<double> costs(usable_.size());
    std::transform(usable_.begin(), usable_.end(), costs.begin(), cost);
    order_.resize(usable_.size());
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return costs[a] > costs[b]; });
}

void BlockBuffers::draw(BlockRequest const& request, MemberSource const& source) {
    std::size_t const members = members_.size();
    drawn_.assign(members, Inputs{});
    is_usable_.assign(members, 0);
    usable_.clear();
    clocks_.clear();
    directions_.clear();
    for (std::size_t i = 0; i < members; ++i) {
        is_usable_[i] = source(members_[i], drawn_[i]);
        if (!is_usable_[i]) continue;
        usable_.push_back(drawn_[i]);
        if (request.timing) clocks_.push_back(request.timing(drawn_[i]));
        if (request.shadows.count == 0) continue;
        std::size_t const of_member = shadow_count(request) * request.states;
        directions_.resize(usable_.size() * of_member);
        request.directions(members_[i], &directions_[(usable_.size() - 1) * of_member]);
    }
}

void BlockBuffers::run(BlockKernel const& kernel, BlockRequest const& request, MemberSource const& source,
                       StopRequest const& stop, std::span<std::uint64_t const> numbers) {
    members_.assign(numbers.begin(), numbers.end());
    std::size_t const members = members_.size();
    draw(request, source);
    records_.assign(members, MemberRecord{});
    final_states_.assign(members * request.states, nan);
    quantities_.assign(members * request.columns, nan);
    series_.assign(members * series_width(request), nan);
    sections_.assign(members * section_width(request), nan);
    growths_.assign(members * growth_width(request), nan);
    sample_clock_.assign(members * clock_width(request), nan);

    order_.clear();
    if (request.cost) sort_by_cost(request.cost);
    Block block;
    block.order = order_.empty() ? nullptr : order_.data();
    block.inputs = usable_.data();
    block.members = usable_.size();
    block.settings = request.integrator;
    block.sample_times = request.sample_times.data();
    block.samples = request.sample_times.size();
    block.quantities = request.quantities;
    block.series = request.sample_times.empty() ? Selection{0} : request.series;
    block.clocks = clocks_.empty() ? nullptr : clocks_.data();
    block.stops = request.stops;
    block.crossings = request.crossings;
    block.shadows = request.shadows;
    block.shadows.directions = directions_.data();
    block.stop = [](void const* context, double) {
        return static_cast<StopRequest const*>(context)->reason() != StopReason::none;
    };
    block.stop_context = &stop;
    block.records = records_.data();
    block.final_states = final_states_.data();
    block.quantity_values = quantities_.data();
    block.series_values = series_.data();
    block.section_values = sections_.empty() ? nullptr : sections_.data();
    block.growth_values = growths_.empty() ? nullptr : growths_.data();
    block.by_turns = request.by_turns;
    block.sample_clock = sample_clock_.data();
    if (block.members > 0) kernel(block);
    lane_steps_executed_ = block.lane_steps_executed;
    lane_steps_useful_ = block.lane_steps_useful;

    if (usable_.size() == members) return;
    MemberRecord invalid;
    invalid.status = Status::invalid_inputs;
    std::size_t const usable = usable_.size();
    spread_rows(records_, is_usable_, usable, 1, 1, invalid);
    spread_rows(final_states_, is_usable_, usable, 1, request.states, nan);
    spread_rows(quantities_, is_usable_, usable, 1, request.columns, nan);
    spread_rows(sections_, is_usable_, usable, 1, section_width(request), nan);
    spread_rows(growths_, is_usable_, usable, 1, growth_width(request), nan);
    spread_rows(sample_clock_, is_usable_, usable, 1, clock_width(request), nan);
    spread_rows(series_, is_usable_, usable, static_cast<std::size_t>(std::popcount(block.series)), block.samples, nan);
}

BlockResult BlockBuffers::result() const {
    return {members_, drawn_, records_, final_states_, quantities_, series_, sections_, growths_, sample_clock_};
}

}  // namespace slideway
