// Small models with known solutions that run through the engine's lanes, as each instruction set compiles them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "host/backend/backend.hpp"
#include "kernels/block.hpp"

namespace slideway::testing {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// A ball over a floor: x'' = j t − g, at x = 0 with v < 0: v ← −e v.  A cubic, which every method of order 3 renders exactly.
struct BallInputs {
    double height = 1, speed = 0;  // at the start
    double gravity = 10;
    double restitution = 0.8;
    double level = 1e6;             // crossings of it, up or down, are located too
    double jerk = 0;                // j
    static constexpr int size = 2;  // x v
};

/// What the ball's observer records: its first events, in their order.
struct BallEvent {
    enum Kind : int { impact, apex, level };
    Kind kind;
    double time, height, speed;  // before the impact
};
inline constexpr int recorded_ball_events = 40;

/// x'' = −ω² x + a cos t, whose stiff method sees `jacobian` times the true Jacobian.
struct OscillatorInputs {
    double frequency = 2;  // ω, not 1
    double force = 0;      // a
    double x = 1, v = 0;
    double jacobian = 1;
    static constexpr int size = 2;  // x v
};

/// y' = λ (y − sin τ) + cos τ, τ' = 1: Prothero & Robinson, Math. Comp. 28 (1974) 145–162.  From y = sin τ the solution is sin τ
/// for every λ.
struct TrackerInputs {
    double rate = -1;  // λ
    double y = 0, tau = 0;
    double wall = never;            // no derivative where y > wall
    double solvable_below = never;  // the linear equations of longer hγ count as unsolved
    static constexpr int size = 2;  // y τ
};

struct ValveInputs {
    double inflow = 5;
    static constexpr int size = 3;  // x v p
};
inline constexpr int recorded_valve_events = 64;

/// Each instruction set has one.
struct ModelKernels {
    void (*ball)(BlockOf<BallInputs>&);
    void (*oscillator)(BlockOf<OscillatorInputs>&);
    void (*tracker)(BlockOf<TrackerInputs>&);
    void (*valve)(BlockOf<ValveInputs>&);
};
ModelKernels const& model_kernels(Isa isa);

struct ModelResult {
    std::vector<MemberRecord> records;
    std::vector<double> states;      // [member][size], at the end
    std::vector<double> quantities;  // [member][columns]
    std::vector<double> series;      // [component][member][sample]
    std::uint64_t lane_steps_executed = 0, lane_steps_useful = 0;

    double utilisation() const {
        return static_cast<double>(lane_steps_useful) / static_cast<double>(lane_steps_executed);
    }
};

/// Runs members of one model through the lanes.
ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<BallInputs> const& members,
                std::vector<double> const& sample_times = {});
ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<OscillatorInputs> const& members,
                std::vector<double> const& sample_times = {});
ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<TrackerInputs> const& members,
                std::vector<double> const& sample_times = {});
ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<ValveInputs> const& members,
                std::vector<double> const& sample_times = {});

/// The events of one ball.
std::vector<BallEvent> ball_events(ModelResult const& result, std::size_t member);

/// Steps of nearly `length` whatever the error.
IntegratorSettings equal_steps(Method method, double length, double end_time);

}  // namespace slideway::testing
