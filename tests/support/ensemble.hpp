// Runs members through the compiled kernels, as the driver does, and keeps all they return.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/keys.hpp"
#include "kernels/block.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway::testing {

struct EnsembleResult {
    std::vector<MemberRecord> records;
    std::vector<std::array<double, most_states>> states;  // at the end; as many numbers as the mechanism has
    std::vector<std::array<double, quantity_columns>> quantities;
    std::vector<double> series;  // [series][member][sample]
    std::vector<double> clock;   // [member][sample], by turns
    std::uint64_t lane_steps_executed = 0, lane_steps_useful = 0;
    double value(std::size_t member, Quantity q, int column = 0) const {
        return quantities[member][static_cast<std::size_t>(quantity_column(q) + column)];
    }
};

inline constexpr Selection all_quantities = (Selection(1) << quantity_count) - 1;
inline constexpr Selection state_selection = selections::ten_states;

inline std::vector<Law> every_law() {
    std::vector<Law> all;
    for (std::size_t i = 0; i < laws().size(); ++i) all.push_back(static_cast<Law>(i));
    return all;
}

/// The inputs with what a law has of its own; those of its numbers that are 0 where nobody gives them are `strength`.
inline Inputs with_own(Inputs inputs, Law law, double strength) {
    inputs = with_presets(inputs, law);
    for (Key const& key : info(law).keys) {
        if (key.preset == 0) key.set(inputs, strength);
    }
    return inputs;
}

/// Every kind of damping that a law has.
inline std::vector<Damping> dampings_of(LawInfo const& law) {
    std::vector<Damping> all;
    for (Damping const damping : {Damping::point, Damping::rate, Damping::restitution}) {
        if (law.has(damping)) all.push_back(damping);
    }
    return all;
}

struct RunOptions {
    Parts parts;
    IntegratorSettings settings;
    Selection quantities = all_quantities;
    Selection series = 0;
    std::vector<double> sample_times;
    std::vector<std::uint32_t> order;  // in which the block takes its members; empty: as they stand
    double turns = 0;                  // by turns: what cranks turn until the end [rad]; sample times are angles
};

inline EnsembleResult run(Isa isa, RunOptions const& options, std::vector<Inputs> const& members) {
    EnsembleResult r;
    std::size_t const n = members.size();
    r.records.resize(n);
    r.states.resize(n);
    r.quantities.resize(n);
    std::size_t selected = 0;
    for (int i = 0; i < series_count; ++i) selected += selects(options.series, static_cast<Series>(i)) ? 1 : 0;
    r.series.assign(selected * n * options.sample_times.size(), -1.0);
    Block block;
    block.inputs = members.data();
    block.members = n;
    block.order = options.order.empty() ? nullptr : options.order.data();
    block.settings = options.settings;
    block.sample_times = options.sample_times.data();
    block.samples = options.sample_times.size();
    block.quantities = options.quantities;
    block.series = options.series;
    block.records = r.records.data();
    auto const width = static_cast<std::size_t>(info(options.parts.mechanism).states);
    std::vector<double> states(n * width);
    block.final_states = states.data();
    block.quantity_values = n == 0 ? nullptr : r.quantities[0].data();
    block.series_values = r.series.data();
    std::vector<MemberClock> const clocks(n, {.end = options.settings.end_time, .turns = options.turns});
    if (options.turns > 0) {
        r.clock.assign(n * options.sample_times.size(), -1.0);
        block.by_turns = true, block.clocks = clocks.data(), block.sample_clock = r.clock.data();
    }
    find_instance(isa, options.parts).run(block);
    for (std::size_t i = 0; i < n; ++i) std::copy_n(&states[i * width], width, r.states[i].begin());
    r.lane_steps_executed = block.lane_steps_executed;
    r.lane_steps_useful = block.lane_steps_useful;
    return r;
}

/// The instruction sets of this build that this machine has.
inline std::vector<Isa> supported_isas() {
    std::vector<Isa> found;
    for (Isa const isa : built_isas()) {
        if (is_supported(isa)) found.push_back(isa);
    }
    return found;
}

/// Those of them that have to have the bits of `scalar`.
inline std::vector<Isa> isas_beside_scalar() {
    auto found = supported_isas();
    std::erase(found, Isa::scalar);
    return found;
}

/// The start of golden/trajectories.csv (model.md 11): z = 0.1 c, roll 1e-4, yaw 2e-4, pitch −1e-4, at rest.
inline Inputs golden_start(double clearance, double crank_speed, Law law = Law::paper) {
    Inputs in = with_presets({}, law);
    in.clearance_y = in.clearance_z = clearance;
    in.crank_speed = crank_speed;
    in.z = 0.1 * clearance;
    in.roll = 1e-4;
    in.yaw = 2e-4;
    in.pitch = -1e-4;
    return complete_inputs(in);
}

/// Members that start without contact at scattered poses, by a fixed rule without random numbers.
inline std::vector<Inputs> scattered_starts(std::size_t count, double clearance = 1e-4,
                                            double crank_speed = 3.141592653589793, Law law = Law::paper) {
    std::vector<Inputs> members;
    for (std::size_t i = 0; i < count; ++i) {
        auto in = golden_start(clearance, crank_speed, law);
        // Multiples of irrational numbers spread evenly over (-1, 1).
        auto const spread = [&](double irrational) {
            double const x = static_cast<double>(i + 1) * irrational;
            return 2 * (x - static_cast<double>(static_cast<long long>(x))) - 1;
        };
        in.y = 0.4 * clearance * spread(0.6180339887498949);
        in.z = 0.4 * clearance * spread(0.4142135623730951);
        in.roll = 10 * clearance * spread(0.7320508075688772);
        in.yaw = 5 * clearance * spread(0.2360679774997898);
        in.pitch = 5 * clearance * spread(0.6457513110645907);
        members.push_back(in);
    }
    return members;
}

}  // namespace slideway::testing
