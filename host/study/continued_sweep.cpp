#include "host/study/continued_sweep.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "host/study/state_table.hpp"

namespace slideway {
namespace {

/// Where a start stands: the inputs that start in the state in which its member of the last column ended, if that one finished.
struct Place {
    Inputs there;
    bool is_known = false;
};

/// A state of a joint in another one: places from the middle between faces and velocities keep their share of the clearance, tilts that of the tighter
/// gap, less where the slider is larger.  Else one that lay on its way would begin the next column inside it, or in the air.  From or to a preload, which
/// leaves no gap to have a share of, it begins in the middle.  Where faces move otherwise than along Y and Z rules refuse the sweep.
void put(Inputs& inputs, Inputs const& there, bool spatial) {
    auto const share = [](double now, double then) { return now > 0 && then > 0 ? now / then : 0; };
    double const along_y = share(mean_clearance_y(inputs), mean_clearance_y(there)), along_z = share(mean_clearance_z(inputs), mean_clearance_z(there));
    double tilt = spatial ? std::min(along_y, along_z) : along_y;
    for (auto const length : {&Inputs::slider_length, &Inputs::way_width, &Inputs::way_depth}) tilt *= std::min(there.*length / inputs.*length, 1.0);
    auto const middle_y = [](Inputs const& in) { return in.way_offset_y + to_middle_y(in); };
    auto const middle_z = [](Inputs const& in) { return in.way_offset_z + to_middle_z(in); };
    inputs.y = middle_y(inputs) + along_y * (there.y - middle_y(there));
    inputs.z = middle_z(inputs) + along_z * (there.z - middle_z(there));
    inputs.vy = along_y * there.vy;
    inputs.vz = along_z * there.vz;
    for (auto const input : {&Inputs::roll, &Inputs::yaw, &Inputs::pitch, &Inputs::wx, &Inputs::wy, &Inputs::wz}) {
        inputs.*input = tilt * there.*input;
    }
}

/// Runs some starts through the columns.
class Chain {
public:
    Chain(Scene const& scene, BlockRequest const& request, MemberSource source, MemberSet asked, BlockKernel const& kernel, MemberEnds ends,
          StopRequest const& stop)
        : scene_(scene), request_(request), draw_(std::move(source)), asked_(std::move(asked)), kernel_(kernel), ends_(std::move(ends)), stop_(stop) {}

    /// @param kernel for the members that are asked for: progress is told of them alone
    void run(BlockKernel const& kernel, BlockBuffers& buffers, std::span<std::uint64_t const> starts, BlockEmit const& emit) const {
        std::vector<Place> places(starts.size());
        std::vector<std::vector<Turn>> const turns = turns_of(starts);
        for (std::uint64_t column = 0; column < columns(); ++column) {
            if (!run_column(column, turns[column], {kernel, buffers, emit}, starts, places)) return;
            if (stop_.reason() != StopReason::none) return;
        }
    }

private:
    std::uint64_t columns() const { return scene_.chaos.values.size(); }
    std::uint64_t member(std::uint64_t column, std::uint64_t start) const { return column * scene_.members + start; }

    /// What a column does with a start.
    enum class Turn : char { skip, recall, lead, ask };

    /// [column][start], from the last column to the first: a member runs if it is asked for, or if the next one runs
    /// and nobody knows how this one ended.
    std::vector<std::vector<Turn>> turns_of(std::span<std::uint64_t const> starts) const {
        std::vector<std::vector<Turn>> turns(columns(), std::vector<Turn>(starts.size(), Turn::skip));
        for (std::size_t i = 0; i < starts.size(); ++i) {
            bool next_runs = false;
            for (std::uint64_t column = columns(); column-- > 0;) {
                std::uint64_t const m = member(column, starts[i]);
                Turn& turn = turns[column][i];
                if (asked_.contains(m)) {
                    turn = Turn::ask;
                } else if (next_runs) {
                    turn = ends_ && ends_(m) ? Turn::recall : Turn::lead;
                }
                next_runs = turn == Turn::ask || turn == Turn::lead;
            }
        }
        return turns;
    }

    void remember(Place& place, std::uint64_t of_member, bool finished, StateNumbers const& state) const {
        place.there = member_inputs(scene_, of_member);
        place.is_known = finished;
        if (finished) set_start(info(scene_.parts.mechanism), state, place.there);
    }

    /// What runs members, and where results go; nowhere if there is no `emit`.
    struct Way {
        BlockKernel const& kernel;
        BlockBuffers& buffers;
        BlockEmit const& emit;
    };

    bool run_column(std::uint64_t column, std::vector<Turn> const& turns, Way const& way, std::span<std::uint64_t const> starts,
                    std::vector<Place>& places) const {
        std::vector<std::uint64_t> asked, leading;
        std::vector<std::size_t> place_of_asked, place_of_leading;
        for (std::size_t i = 0; i < starts.size(); ++i) {
            if (turns[i] == Turn::skip) continue;
            std::uint64_t const m = member(column, starts[i]);
            if (turns[i] == Turn::recall) {
                MemberEnd const end = ends_(m).value();
                remember(places[i], m, end.finished, end.state);
                continue;
            }
            bool const is_asked = turns[i] == Turn::ask;
            (is_asked ? asked : leading).push_back(m);
            (is_asked ? place_of_asked : place_of_leading).push_back(i);
        }
        return run_members(leading, place_of_leading, {kernel_, way.buffers, {}}, places) && run_members(asked, place_of_asked, way, places);
    }

    bool run_members(std::vector<std::uint64_t> const& members, std::vector<std::size_t> const& places_of, Way const& way, std::vector<Place>& places) const {
        auto const& [kernel, buffers, emit] = way;
        if (members.empty()) return true;
        MemberSource const source = [&](std::uint64_t m, Inputs& inputs) {
            if (!draw_(m, inputs)) return false;
            auto const at = std::lower_bound(members.begin(), members.end(), m) - members.begin();
            Place const& place = places[places_of[static_cast<std::size_t>(at)]];
            if (!place.is_known) return true;
            put(inputs, place.there, info(scene_.parts.mechanism).spatial);
            inputs.start_angle = scene_.chaos.section.level;  // where the column before has ended
            if (scene_.goes_by_turns()) inputs.crank_speed = place.there.crank_speed;
            return true;
        };
        buffers.run(kernel, request_, source, stop_, members);
        BlockResult const result = buffers.result();
        for (std::size_t i = 0; i < members.size(); ++i) {
            StateNumbers state{};
            std::copy_n(&result.final_states[i * result.states()], result.states(), state.begin());
            remember(places[places_of[i]], members[i], result.records[i].status == Status::finished, state);
        }
        return !emit || emit(buffers);
    }

    Scene const& scene_;
    BlockRequest const& request_;
    MemberSource const draw_;
    MemberSet const asked_;
    BlockKernel const kernel_;
    MemberEnds const ends_;
    StopRequest const& stop_;
};

}  // namespace

bool is_continued(Scene const& scene) { return scene.study == StudyKind::sweep && scene.chaos.continued; }

MemberSet swept_starts(Scene const& scene, MemberSet const& members) {
    MemberSet starts;
    for (MemberRange const& range : members.ranges()) {
        if (range.count >= scene.members) return MemberSet(MemberRange{0, scene.members});
        std::uint64_t const first = range.first % scene.members;
        std::uint64_t const before_turn = std::min(range.count, scene.members - first);
        starts.add({first, before_turn});
        starts.add({0, range.count - before_turn});
    }
    return starts;
}

std::uint64_t place_count(Scene const& scene, MemberSet const& members) {
    return is_continued(scene) ? swept_starts(scene, members).count() : members.count();
}

MemberSet members_of_starts(Scene const& scene, MemberSet const& starts) {
    MemberSet members;
    for (std::uint64_t column = 0; column < scene.chaos.values.size(); ++column) {
        for (MemberRange const& range : starts.ranges()) {
            members.add({column * scene.members + range.first, range.count});
        }
    }
    return members;
}

MemberSet members_before(Scene const& scene, MemberSet const& asked) {
    MemberSet before;
    for (MemberRange const& range : asked.ranges()) {
        std::uint64_t const first = std::max(range.first, scene.members);  // the first column goes on from nothing
        if (first < range.end()) before.add({first - scene.members, range.end() - first});
    }
    return before.without(asked);
}

void continue_columns(Scene const& scene, EnsemblePlan& plan, MemberSet const& asked, BlockKernel const& kernel, MemberEnds ends, StopRequest const& stop) {
    plan.members = swept_starts(scene, asked);
    auto const chain = std::make_shared<Chain>(scene, plan.request, plan.source, asked, kernel, std::move(ends), stop);
    plan.program = [chain](BlockKernel const& watched, BlockBuffers& buffers, std::span<std::uint64_t const> places, BlockEmit const& emit) {
        chain->run(watched, buffers, places, emit);
    };
}

}  // namespace slideway
