// The border between kernels and host: a block of members to integrate, and a table of states to probe.
// Plain views of memory that the host owns; the kernels allocate nothing.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/inputs.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/methods.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/status.hpp"

namespace slideway {

inline constexpr int state_size = 10;  // of a slider-crank: y z vy vz roll yaw pitch wx wy wz

struct IntegratorSettings {
    Method method = Method::automatic;
    double rtol = 1e-6;
    double atol = 1e-7;                     // relative to the joint's scales: c, c·ω, 2c/L_k, 2c/L_k·ω
    double stiff_tolerance = 1e-3;          // least rtol and atol for the ringing that the stiff method damps
    double end_time = 0;                    // [s]
    double max_step = 1e-3;                 // [s], of the explicit methods; what a step may leap over in free flight
    double stiff_max_step = 1e-2;           // [s], of the stiff method, which runs in lasting contact only
    double fixed_step = 0;                  // [s], of rk4 and moreau_jean
    bool locate_modes = false;              // steps end where the contacts change: for a law that switches
    std::uint64_t max_steps = 100'000'000;  // tried steps per member
};

/// What a member's run cost and how far it came.
struct MemberRecord {
    Status status = Status::not_run;
    std::uint64_t steps_accepted = 0;
    std::uint64_t steps_rejected = 0;  // by the error, or cut at a touch
    std::uint64_t rhs_evaluations = 0;
    double time = 0;                         // [s] where it ended
    std::uint64_t jacobian_evaluations = 0;  // each costs one to two right-hand sides
    std::uint64_t stiff_steps = 0;           // accepted steps of the stiff method
    std::uint64_t crossings = 0;             // also those for which there was no room
    std::uint64_t lost_offsets = 0;          // recorded times that a shadow's offset had shrunk into rounding
    std::uint64_t grown_offsets = 0;         // recorded times that one had grown to the size of the joint
    double growth_from = 0;                  // [s] when the growth of offsets began to be recorded
};

/// When a member ends and when its steps end on the way.
struct MemberClock {
    double end = 0;                     // [s]
    double first_stop = 0, period = 0;  // stop i is at first_stop + i · period, > 0 and <= end [s]
    // By turns (BlockBase::by_turns) stops are angles that the crank has turned [rad], and `end` is the latest time to come to the last.
    double turns = 1e300;   // where it ends, of who has no stops [rad]
    double first_back = 0;  // the first stop, where it turns back
};

/// Stops of every member of a block: known times at which a step ends, to the last bit.
struct StopPlan {
    std::size_t count = 0;
    std::size_t transient = 0;  // as many leave no record
    /// Of the later stops the first, and then each such one, is a section: its state is recorded.
    std::size_t section_every = 1;
    /// The growth of offsets is recorded from as many stops before the end of the transient on, summed over `growth_every`.
    std::size_t growth_lead = 0;
    std::size_t growth_every = 1;

    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

    constexpr std::size_t sections() const {
        return count > transient ? (count - transient - 1) / section_every + 1 : 0;
    }
    /// Which section a stop is; `nowhere` if it is none.
    constexpr std::size_t section_at(std::size_t stop) const { return place(stop, transient, section_every); }

    /// The stop with which the first recorded growth begins.
    constexpr std::size_t growth_from() const { return transient - growth_lead; }
    constexpr std::size_t growths() const {
        return count > growth_from() ? (count - growth_from() - 1) / growth_every : 0;
    }
    /// How many growths a stop has behind it if it ends one, 0 where the first begins; else `nowhere`.
    [[gnu::always_inline]] constexpr std::size_t growths_at(std::size_t stop) const { return place(stop, growth_from(), growth_every); }

private:
    static constexpr std::size_t place(std::size_t stop, std::size_t from, std::size_t every) {
        return stop >= from && (stop - from) % every == 0 ? (stop - from) / every : nowhere;
    }
};

/// A surface in state space whose crossings are recorded: a component of the state, or the gap of an apex to its Y or Z faces (the
/// penetration negated, > 0 apart), at a level; or the impacts of rigid contacts, of any pair, or of an apex on its Y or Z faces.  Of an
/// impact the state before it is recorded where gaps are to fall, the state after it where they are to rise.
struct CrossingPlan {
    enum class On { nothing, state, gap_y, gap_z, impacts, impacts_y, impacts_z } on = On::nothing;
    enum class Direction { rising, falling, both } direction = Direction::rising;
    bool turns = false;    // the component is an angle: every turn of it comes to the level
    int index = 0;         // of the component, or of the apex, P1…P8 from 0
    double level = 0;      // [unit of the component, or m]
    std::size_t room = 0;  // of each member; later crossings are counted only

    constexpr bool wants(Direction way) const { return direction == way || direction == Direction::both; }
    constexpr bool of_impacts() const { return on == On::impacts || on == On::impacts_y || on == On::impacts_z; }
};

/// Shadows: copies of a member that start a little off it and take its steps, to tell how offsets grow.  Distances are
/// dimensionless, in the scales that integrator.atol is meant against.
struct ShadowPlan {
    int count = 0;     // per member, at most `most_shadows`
    double d0 = 1e-7;  // distance after a rescaling
    double lower = 0;  // a single shadow is rescaled at a stop where its distance is not within [lower, upper]; several
    double upper = 0;  // are made orthogonal at every stop
    double const* directions = nullptr;  // [members][count][states of the model], of unit length
};
inline constexpr int most_shadows = 10;

/// Distance between member and shadow below which it is rounding [dimensionless]: what shrinks below counts as this.
inline constexpr double least_distance = 1e-15;
/// Distance from which on an offset is no longer small beside the joint: its growth ends, whatever the exponent.
inline constexpr double largest_distance = 1;

/// Members [0, members) of a block: what every model's block holds.
struct BlockBase {
    std::size_t members = 0;
    std::uint32_t const* order = nullptr;  // [members] who is taken when, dearest first; nullptr: as they stand
    std::uint64_t* taken = nullptr;        // how many are, where several share the block; nullptr: one has it alone
    std::size_t seats = 0;                 // who shares it takes so many at the start, at most; 0: as many as it can
    IntegratorSettings settings;
    double const* sample_times = nullptr;  // [samples], ascending, within [0, end_time]; by turns what the crank has turned [rad]
    std::size_t samples = 0;
    Selection quantities = 0;
    Selection series = 0;
    MemberClock const* clocks = nullptr;  // [members]; nullptr: all end at settings.end_time and nobody stops
    StopPlan stops;
    ShadowPlan shadows;      // of models with shadows
    CrossingPlan crossings;  // from each member's first_stop on; of models without shadows, and without stops
    /// Members end, stop and are sampled by what their crank has turned since the start, |θ − θ0| [rad]: of models whose state has its angle.
    bool by_turns = false;
    /// Asked now and then; true, or a flag that is not 0, ends the block at once.  Members that have not ended keep what their results
    /// held before, but that series, sections and growths of those under way are NaN.
    /// @param covered how far the block is: members that ended, and of those under way the share of their time; 0 where cards run it
    bool (*stop)(void const* context, double covered) = nullptr;
    void const* stop_context = nullptr;
    int const volatile* stop_flag = nullptr;
    // results
    MemberRecord* records = nullptr;    // [members]
    double* final_states = nullptr;     // [members][states of the model]
    double* quantity_values = nullptr;  // [members][columns of the model's observer], only selected columns written
    double* series_values = nullptr;    // [selected series, in table order][members][samples]; NaN after a failure
    double* sample_clock = nullptr;     // [members][samples], by turns: when that was [s]; NaN likewise
    /// [members][stops.sections(), or crossings.room][1 + states of the model]: time and state; NaN where there is none.
    double* section_values = nullptr;
    double* growth_values = nullptr;        // [members][stops.growths()][shadows.count], ln of the growth; NaN likewise
    std::uint64_t lane_steps_executed = 0;  // step attempts × lanes
    std::uint64_t lane_steps_useful = 0;    // those that served a member
};

/// A block of members of one model, which reads `ModelInputs` of each.
template <class ModelInputs> struct BlockOf : BlockBase {
    ModelInputs const* inputs = nullptr;  // [members]
};

/// A block of slider-cranks; their inputs are completed: nothing `follows`.
using Block = BlockOf<Inputs>;

/// Everything one state tells, as the golden tables list it (model.md 11).
struct ProbeResult {
    double derivative[most_states];  // of the mechanism's state
    double power_crank, power_friction, power_damping, power_load, power_ground, loss_springs, loss_film;  // [W]
    double penetration_y[8], penetration_z[8];          // [m], Y and Z faces, P1…P8
    double normal_force_y[8], normal_force_z[8];        // [N]
    int surfaces, lines, points;
    double energy, contact_potential;  // [J]
    double crank_torque;               // [N m], without the crank's own weight
    double signals[most_signals];      // of the mechanism's own, as many as it has
    double forces[series_count - first_force_series];  // as series have them, of a mechanism that tells them
    double approach_y[8], approach_z[8], sliding_y[8], sliding_z[8];  // δ' and V of the apices [m/s], likewise
    double torque[3];                  // of the way on the slider about its hole's centre, along the ground's axes [N m], likewise
    Status status;                     // finished, or why the state cannot be evaluated
};

struct ProbeTable {
    Inputs const* inputs = nullptr;  // [rows]; the initial state is the state to probe
    double const* times = nullptr;   // [rows], of the states [s]
    std::size_t rows = 0;
    ProbeResult* results = nullptr;  // [rows]
};

}  // namespace slideway
