// Small models with known solutions that run through the engine's lanes, as each instruction set compiles them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "host/backend/backend.hpp"
#include "kernels/block.hpp"
#include "tests/models/map_block.hpp"

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
    double by_time = 0;             // 1: the track follows t instead of τ
    double bends = 0;               // 1: and tells the stiff method how it bends
    static constexpr int size = 2;  // y τ
};

struct ValveInputs {
    double inflow = 5;
    static constexpr int size = 3;  // x v p
};
inline constexpr int recorded_valve_events = 64;

/// The Lorenz equations.
struct LorenzInputs {
    double sigma = 10, rho = 28, beta = 8.0 / 3.0;
    double x = 10, y = 10, z = 10;
    static constexpr int size = 3;  // x y z
};

/// A ball over a vibrating table, in the table's frame: x'' = −g + a cos(ω t + φ) + b u, at x = 0 with v < 0: u ← −v, v ← −e v.
/// What it remembers is u, the speed of its last impact, 0 before the first; b [1/s] makes it matter.
struct TableBallInputs {
    double height = 1, speed = 0;
    double gravity = 1;
    double amplitude = 0, frequency = 0, phase = 0;  // a, ω, φ
    double restitution = 1;
    double thrust = 0;              // b
    static constexpr int size = 2;  // x v
};

/// The same, without thrust, by the interface of rigid contacts; it may come to rest on the table.
struct RigidBallInputs : TableBallInputs {};

/// x ← r x (1 − x).
struct LogisticInputs {
    double r = 4, x = 0.3;
    static constexpr int size = 1;
};

/// x ← 1 − a x² + y, y ← b x.
struct HenonInputs {
    double a = 1.4, b = 0.3;
    double x = 0, y = 0;
    static constexpr int size = 2;
};

/// Each instruction set has one.
struct ModelKernels {
    void (*ball)(BlockOf<BallInputs>&);
    void (*oscillator)(BlockOf<OscillatorInputs>&);
    void (*tracker)(BlockOf<TrackerInputs>&);
    void (*valve)(BlockOf<ValveInputs>&);
    void (*lorenz)(BlockOf<LorenzInputs>&);         // with shadows
    void (*table_ball)(BlockOf<TableBallInputs>&);  // with shadows
    void (*rigid_ball)(BlockOf<RigidBallInputs>&);  // with shadows
    void (*logistic)(MapBlockOf<LogisticInputs>&);
    void (*henon)(MapBlockOf<HenonInputs>&);
};
ModelKernels const& model_kernels(Isa isa);

struct ModelResult {
    std::vector<MemberRecord> records;
    std::vector<double> states;         // [member][size], at the end
    std::vector<double> quantities;     // [member][columns]
    std::vector<double> series;         // [component][member][sample]
    std::vector<double> sections;       // [member][section][size]
    std::vector<double> section_times;  // [member][section]; not of maps
    std::vector<double> growth;         // [member][interval][shadow]
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

/// How offsets from the members of a block are to be followed.
struct Following {
    std::vector<MemberClock> clocks;  // of all or one for all; in steps of a map, whose clock ends with its last stop
    StopPlan stops;
    int shadows = 0;
    double d0 = 1e-7, lower = 0, upper = 0;
    std::vector<double> directions;    // [member][shadow][size]; empty: axes
    std::vector<std::uint32_t> order;  // in which the block takes its members; empty: as they stand
};
ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<LorenzInputs> const& members,
                Following const& f);
ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<TableBallInputs> const& members,
                Following const& f);
ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<RigidBallInputs> const& members,
                Following const& f);
ModelResult run(Isa isa, std::vector<LogisticInputs> const& members, Following const& f);
ModelResult run(Isa isa, std::vector<HenonInputs> const& members, Following const& f);

/// Mean growth per interval of one member's shadow, from `first` on.
double mean_growth(ModelResult const& result, Following const& f, std::size_t member, int shadow,
                   std::size_t first = 0);

/// The events of one ball.
std::vector<BallEvent> ball_events(ModelResult const& result, std::size_t member);

/// Steps of nearly `length` whatever the error.
IntegratorSettings equal_steps(Method method, double length, double end_time);

}  // namespace slideway::testing
