#include "host/driver/block_buffers.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace slideway {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

}  // namespace

std::uint64_t block_bytes(BlockRequest const& request, std::size_t members) {
    std::uint64_t const per_member =
        2 * sizeof(Inputs) + sizeof(char) + sizeof(std::uint32_t) + sizeof(MemberRecord) +
        sizeof(double) * (state_size + static_cast<std::uint64_t>(quantity_columns) + series_width(request));
    return members * per_member;
}

void BlockBuffers::sort_by_cost(MemberCost const& cost) {
    std::vector<double> costs(usable_.size());
    std::transform(usable_.begin(), usable_.end(), costs.begin(), cost);
    order_.resize(usable_.size());
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return costs[a] > costs[b]; });
}

void BlockBuffers::run(KernelInstance const& kernel, BlockRequest const& request, MemberSource const& source,
                       StopRequest const& stop, std::uint64_t first_member, std::size_t members) {
    drawn_.assign(members, Inputs{});
    is_usable_.assign(members, 0);
    usable_.clear();
    for (std::size_t i = 0; i < members; ++i) {
        is_usable_[i] = source(first_member + i, drawn_[i]);
        if (is_usable_[i]) usable_.push_back(drawn_[i]);
    }
    records_.assign(members, MemberRecord{});
    final_states_.assign(members * state_size, nan);
    quantities_.assign(members * static_cast<std::size_t>(quantity_columns), nan);
    series_.assign(members * series_width(request), nan);

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
    block.stop = [](void const* context) { return static_cast<StopRequest const*>(context)->reason() != StopReason::none; };
    block.stop_context = &stop;
    block.records = records_.data();
    block.final_states = final_states_.data();
    block.quantity_values = quantities_.data();
    block.series_values = series_.data();
    if (block.members > 0) kernel.run(block);
    lane_steps_executed_ = block.lane_steps_executed;
    lane_steps_useful_ = block.lane_steps_useful;

    if (usable_.size() == members) return;
    MemberRecord invalid;
    invalid.status = Status::invalid_inputs;
    std::size_t const usable = usable_.size();
    spread_rows(records_, is_usable_, usable, 1, 1, invalid);
    spread_rows(final_states_, is_usable_, usable, 1, state_size, nan);
    spread_rows(quantities_, is_usable_, usable, 1, quantity_columns, nan);
    spread_rows(series_, is_usable_, usable, static_cast<std::size_t>(std::popcount(block.series)), block.samples, nan);
}

BlockResult BlockBuffers::result(std::uint64_t first) const {
    return {first, drawn_, records_, final_states_, quantities_, series_};
}

}  // namespace slideway
