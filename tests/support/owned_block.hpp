// A block with memory of its own, and what tells the results of two such blocks apart.
#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/ensemble.hpp"

namespace slideway::testing {

/// What a block is to do.
struct BlockPlan {
    Parts parts;
    IntegratorSettings settings;
    std::vector<Inputs> members;
    Selection quantities = all_quantities & ~selections::force_quantities;  // which neither cards nor laws chosen in advance tell
    Selection series = 0;
    std::vector<double> sample_times;
    std::vector<std::uint32_t> order;
    std::vector<MemberClock> clocks;
    StopPlan stops;
    CrossingPlan crossings;
    ShadowPlan shadows;  // its directions are the block's own
};

/// A number that no run leaves: what still has it was not written.
inline constexpr double untouched = -7.25e77;

/// Numbers of one kind that a member left.
struct Left {
    char const* name;
    std::vector<double> numbers;
};

/// Everything in it is reached through `block`, as by a kernel.
class OwnedBlock {
public:
    explicit OwnedBlock(BlockPlan const& plan) : plan_(plan) {
        std::size_t const n = plan_.members.size();
        auto const shadows = static_cast<std::size_t>(plan_.shadows.count);
        std::size_t const series = static_cast<std::size_t>(std::popcount(plan_.series)) * plan_.sample_times.size();
        std::size_t const sections = plan_.crossings.room > 0 ? plan_.crossings.room : plan_.stops.sections();
        records_.resize(n);
        fill(states_, n * state_size);
        fill(quantities_, n * static_cast<std::size_t>(quantity_columns));
        fill(series_, n * series);
        fill(sections_, n * sections * (1 + state_size));
        fill(growths_, shadows > 0 ? n * plan_.stops.growths() * shadows : 0);
        for (std::size_t i = 0; i < n * shadows; ++i) add_direction(i);
        block.members = n;
        block.inputs = plan_.members.data();
        block.order = data(plan_.order);
        block.settings = plan_.settings;
        block.sample_times = plan_.sample_times.data();
        block.samples = plan_.sample_times.size();
        block.quantities = plan_.quantities;
        block.series = plan_.series;
        block.clocks = data(plan_.clocks);
        block.stops = plan_.stops;
        block.shadows = plan_.shadows;
        block.shadows.directions = data(directions_);
        block.crossings = plan_.crossings;
        block.records = records_.data();
        block.final_states = states_.data();
        block.quantity_values = quantities_.data();
        block.series_values = series_.data();
        block.section_values = data(sections_);
        block.growth_values = data(growths_);
    }
    OwnedBlock(OwnedBlock const&) = delete;

    BlockPlan const& plan() const { return plan_; }
    MemberRecord const& record(std::size_t member) const { return records_[member]; }
    double const* state(std::size_t member) const { return &states_[member * state_size]; }
    double value(std::size_t member, Quantity q) const {
        return quantities_[member * static_cast<std::size_t>(quantity_columns) +
                           static_cast<std::size_t>(quantity_column(q))];
    }

    /// All that a member left.
    std::vector<Left> left_by(std::size_t member) const {
        MemberRecord const& r = records_[member];
        std::vector<Left> all = {{"record", {static_cast<double>(r.status), r.time}}};
        for (auto const count : {r.steps_accepted, r.steps_rejected, r.rhs_evaluations, r.jacobian_evaluations,
                                 r.stiff_steps, r.crossings, r.lost_offsets, r.grown_offsets})
            all[0].numbers.push_back(static_cast<double>(count));
        all.push_back({"final state", row(states_, member)});
        all.push_back({"quantities", row(quantities_, member)});
        std::vector<double> series;
        std::size_t const samples = plan_.sample_times.size();
        for (std::size_t at = member * samples; at < series_.size(); at += records_.size() * samples)
            for (std::size_t i = 0; i < samples; ++i) series.push_back(series_[at + i]);
        all.push_back({"series", series});
        all.push_back({"sections", row(sections_, member)});
        all.push_back({"growths", row(growths_, member)});
        return all;
    }

    Block block;

private:
    static void fill(std::vector<double>& values, std::size_t count) { values.assign(count, untouched); }
    template <class T> static T* data(std::vector<T>& values) { return values.empty() ? nullptr : values.data(); }

    std::vector<double> row(std::vector<double> const& all, std::size_t member) const {
        std::size_t const width = all.size() / records_.size();
        auto const from = all.begin() + static_cast<std::ptrdiff_t>(member * width);
        return {from, from + static_cast<std::ptrdiff_t>(width)};
    }

    /// Of unit length, and no two alike.
    void add_direction(std::size_t number) {
        double direction[state_size], square = 0;
        for (int i = 0; i < state_size; ++i) {
            direction[i] = std::sin(1 + static_cast<double>(number) + 2.5 * i);
            square += direction[i] * direction[i];
        }
        for (double const x : direction) directions_.push_back(x / std::sqrt(square));
    }

    BlockPlan plan_;
    std::vector<MemberRecord> records_;
    std::vector<double> states_, quantities_, series_, sections_, growths_, directions_;
};

/// NaNs may differ in sign and payload, which say nothing.
inline bool same_number(double a, double b) {
    return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

/// The first number in which two members differ; "" if they have the same bits.
inline std::string difference(OwnedBlock const& a, std::size_t i, OwnedBlock const& b, std::size_t j) {
    auto const left = a.left_by(i), other = b.left_by(j);
    for (std::size_t kind = 0; kind < left.size(); ++kind) {
        auto const &x = left[kind].numbers, &y = other[kind].numbers;
        if (x.size() != y.size()) return std::string("how many ") + left[kind].name;
        for (std::size_t k = 0; k < x.size(); ++k) {
            if (same_number(x[k], y[k])) continue;
            return "member " + std::to_string(i) + ": " + left[kind].name + "[" + std::to_string(k) + "] is " +
                   std::to_string(x[k]) + " or " + std::to_string(y[k]);
        }
    }
    return "";
}

/// Of the members of two blocks with one plan.
inline std::string difference(OwnedBlock const& a, OwnedBlock const& b) {
    for (std::size_t i = 0; i < a.block.members; ++i) {
        if (auto const text = difference(a, i, b, i); !text.empty()) return text;
    }
    return "";
}

}  // namespace slideway::testing
