// A kernel that gives each member a result that is known, and a sink that keeps them all.
#pragma once

#include <bit>
#include <chrono>
#include <map>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "host/run/ensemble.hpp"

namespace slideway {

// A kernel whose results are known: every value is made of the member's number, which travels as `y`.
inline double series_value(double member, int series, double time) { return 1000 * member + 10 * series + time; }

/// That of the member at a place of the block.
inline void known_result(Block& block, std::size_t i) {
    double const member = block.inputs[i].y;
    auto const steps = static_cast<std::uint64_t>(member) + 1;
    block.records[i] = {Status::finished, steps, 2 * steps, 7 * steps, block.settings.end_time};
    for (int k = 0; k < state_size; ++k) block.final_states[i * state_size + k] = member + k;
    block.quantity_values[i * quantity_columns + quantity_column(Quantity::drive_work)] = -member;
    int const selected = std::popcount(block.series);
    for (int s = 0; s < selected; ++s) {
        for (std::size_t t = 0; t < block.samples; ++t) {
            block.series_values[(s * block.members + i) * block.samples + t] = series_value(member, s, block.sample_times[t]);
        }
    }
}

inline void known_results(Block& block) {
    for (std::size_t i = 0; i < block.members; ++i) known_result(block, i);
    block.lane_steps_executed = 4 * block.members;
    block.lane_steps_useful = 3 * block.members;
}

inline void slow_results(Block& block) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    known_results(block);
}

inline bool draw_number(std::uint64_t member, Inputs& inputs) {
    inputs.y = static_cast<double>(member);
    return true;
}

inline bool every_third_is_unusable(std::uint64_t member, Inputs& inputs) {
    draw_number(member, inputs);
    return member % 3 != 1;
}

inline EnsemblePlan small_plan(std::uint64_t members, std::size_t block_members, int threads) {
    EnsemblePlan plan;
    plan.members = MemberSet({0, members});
    plan.blocks.fixed = block_members;
    plan.threads = plan.workers = threads;
    plan.request.integrator.end_time = 2.5;
    plan.request.sample_times = {0.0, 0.25, 0.5};
    plan.request.quantities = Selection{1} << static_cast<int>(Quantity::drive_work);
    plan.request.series = 0b11;
    plan.source = draw_number;
    return plan;
}

// All that a sink was given, by member.
struct Collected {
    struct Member {
        double drawn;
        MemberRecord record;
        std::vector<double> values;  // final state, crank work, series
    };
    std::map<std::uint64_t, Member> members;
    int calls = 0, twice = 0;

    BlockSink sink() {
        return [this](BlockResult const& block) {
            ++calls;
            std::size_t const count = block.records.size();
            std::size_t const samples = block.series.size() / count / 2;
            for (std::size_t i = 0; i < count; ++i) {
                Member member{block.inputs[i].y, block.records[i], {}};
                auto const state = block.final_states.subspan(i * state_size, state_size);
                member.values.assign(state.begin(), state.end());
                member.values.push_back(block.quantities[i * quantity_columns + quantity_column(Quantity::drive_work)]);
                for (std::size_t s = 0; s < 2; ++s) {
                    auto const row = block.series.subspan((s * count + i) * samples, samples);
                    member.values.insert(member.values.end(), row.begin(), row.end());
                }
                if (!members.emplace(block.members[i], member).second) ++twice;
            }
        };
    }
};

inline std::vector<double> known_values(double member) {
    std::vector<double> values;
    for (int k = 0; k < state_size; ++k) values.push_back(member + k);
    values.push_back(-member);
    for (int s = 0; s < 2; ++s) {
        for (double const t : {0.0, 0.25, 0.5}) values.push_back(series_value(member, s, t));
    }
    return values;
}

}  // namespace slideway
