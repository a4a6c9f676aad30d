#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/observers/sampler.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the members leave in their block: samples on the way, the rest when they end.
template <class Model> class Results {
public:
    using Block = BlockOf<typename Model::Inputs>;

    SLIDEWAY_HD Results(Block& block, Model const& model) : block_(block), sampler_(block, model), states_(model) {}

    SLIDEWAY_HD std::size_t samples() const { return block_.samples; }
    SLIDEWAY_HD std::size_t stops() const { return block_.stops.count; }
    SLIDEWAY_HD ShadowPlan const& shadows() const { return block_.shadows; }

    /// Whether members go by what their crank has turned, instead of by time; and what a state's has [rad].
    SLIDEWAY_HD bool by_turns() const { return HasCrankState<Model> && block_.by_turns; }
    template <class Real> SLIDEWAY_HD static Real turned(MemberState<Model, Real> const& s, Real const* state) {
        return abs(state[crank] - s.constants.start_angle);
    }
    /// Time of every lane's next stop; infinity after the last.
    template <class Real> SLIDEWAY_HD Real next_stop(MemberState<Model, Real> const& s) const { return next_stop(s, s.constants.first_stop); }
    /// By turns its angle.  @param side that the crank is on, 1 or −1
    template <class Real> SLIDEWAY_HD Real next_turn(MemberState<Model, Real> const& s, Real side) const {
        return next_stop(s, select(side < Real(0.0), s.constants.first_back, s.constants.first_stop));
    }
    /// Lanes that have their transient behind them at a state, which crossings are recorded from.
    template <class Real> SLIDEWAY_HD Mask<Real> records_at(MemberState<Model, Real> const& s, Real t, Real const* state) const {
        return (by_turns() ? turned(s, state) : t) >= s.constants.first_stop;
    }

    /// How far the member in a lane is on its way, from 0 to 1.
    template <class Real> SLIDEWAY_HD double share(MemberState<Model, Real> const& s, int i) const {
        double const stops = static_cast<double>(block_.stops.count);
        if (!by_turns()) return lane(s.course.t, i) / max(lane(s.constants.end, i), 1e-300);
        double const last = stops > 0 ? fma(stops - 1, lane(s.constants.stop_period, i), lane(s.constants.first_stop, i)) : lane(s.constants.turns, i);
        return min(abs(lane(s.course.y[crank], i) - lane(s.constants.start_angle, i)) / last, 1.0);
    }

    /// The states of members at a stop, if it is one of their sections.
    template <class Real> SLIDEWAY_HD void take_section(Pack<Model, Real> const& pack, Mask<Real> at) {
        StopPlan const& plan = block_.stops;
        auto const& c = pack.state.course;
        if (block_.section_values == nullptr) return;
        for (int i = 0; i < lanes<Real>; ++i) {
            std::size_t const section = plan.section_at(number(c.stop, i));
            if (!holds(at, i) || section == StopPlan::nowhere) continue;
            SLIDEWAY_EXPECT(number(c.member, i) < block_.members && section < plan.sections());
            double* const row =
                block_.section_values + (number(c.member, i) * plan.sections() + section) * width();
            row[0] = lane(c.t, i);
            for (int j = 0; j < states_; ++j) row[1 + j] = lane(c.y[j], i);
        }
    }

    SLIDEWAY_HD CrossingPlan const& crossings() const { return block_.crossings; }

    /// A crossing of the lanes in the mask.
    template <class Real>
    SLIDEWAY_HD void take_crossing(Pack<Model, Real>& pack, Mask<Real> at, Real t, Real const* state) {
        auto& c = pack.state.course;
        for (int i = 0; i < lanes<Real>; ++i) {
            std::size_t const place = number(c.crossings, i), room = block_.crossings.room;
            if (!holds(at, i) || place >= room) continue;
            double* const row = block_.section_values + (number(c.member, i) * room + place) * width();
            row[0] = lane(t, i);
            for (int j = 0; j < states_; ++j) row[1 + j] = lane(state[j], i);
        }
        c.crossings = c.crossings + count<Real>(at);
    }

    /// How the offsets of members at a stop have grown, if it ends the transient or a record.
    template <class Real> SLIDEWAY_HD void take_growth(Pack<Model, Real>& pack, Mask<Real> at) {
        StopPlan const& plan = block_.stops;
        auto& c = pack.state.course;
        auto const shadows = static_cast<std::size_t>(block_.shadows.count);
        for (int i = 0; i < lanes<Real>; ++i) {
            std::size_t const record = plan.growths_at(number(c.stop, i));
            if (!holds(at, i) || record == StopPlan::nowhere) continue;
            if (record == 0) {
                set_lane(c.shadowed.lost, i, 0.0);
                set_lane(c.shadowed.grown, i, 0.0);
                set_lane(c.shadowed.from, i, lane(c.t, i));
            }
            SLIDEWAY_EXPECT(number(c.member, i) < block_.members && record <= plan.growths() && block_.growth_values != nullptr);
            double* const rows = block_.growth_values + number(c.member, i) * plan.growths() * shadows;
            for (std::size_t j = 0; j < shadows; ++j) {
                Real& growth = pack.state.shadows[j].growth;
                if (record > 0) rows[(record - 1) * shadows + j] = lane(growth, i);
                set_lane(growth, i, 0.0);
            }
        }
    }

    SLIDEWAY_HD void count_attempt(int lanes_executed, int lanes_useful) {
        block_.lane_steps_executed += static_cast<std::uint64_t>(lanes_executed);
        block_.lane_steps_useful += static_cast<std::uint64_t>(lanes_useful);
    }

    /// Time of every lane's next sample after its time t, `last` where there is none before it; by turns angles.
    template <class Real> SLIDEWAY_HD Real next_sample_times(Real const& sample, Real const& t, Real last) const {
        for (int i = 0; i < lanes<Real>; ++i) {
            auto next = static_cast<std::size_t>(lane(sample, i));
            while (next < block_.samples && block_.sample_times[next] <= lane(t, i)) ++next;
            if (next < block_.samples && block_.sample_times[next] < lane(last, i)) {
                set_lane(last, i, block_.sample_times[next]);
            }
        }
        return last;
    }

    /// Where samples are within a step: at times.  CrankTurns has them at angles.
    template <class Real> struct SampleTimes {
        Real start, end;

        template <class Stepper>
        SLIDEWAY_HD Real share_of(Pack<Model, Real> const&, Stepper const&, Attempt<Model, Real> const& attempt, Real at, Mask<Real> accepted) const {
            return select(accepted, (at - start) / select(accepted, attempt.step, Real(1.0)), Real(0.0));
        }
        SLIDEWAY_HD Real time_of(Real, Real, Real, Real at) const { return at; }
    };

    /// Series values at the samples inside the accepted steps, from the stepper's dense output.
    template <class Stepper, class Real, class Places>
    SLIDEWAY_HD void take_samples(Pack<Model, Real>& pack, Stepper& stepper, Attempt<Model, Real> const& attempt,
                                  Mask<Real> accepted, Places const& places) {
        auto& c = pack.state.course;
        for (;;) {
            Real wanted = places.start;
            Real due_lanes(0.0);
            for (int i = 0; i < lanes<Real>; ++i) {
                auto const next = static_cast<std::size_t>(lane(c.sample, i));
                if (!holds(accepted, i) || next >= block_.samples) continue;
                double const time = block_.sample_times[next];
                if (time > lane(places.end, i)) continue;
                set_lane(due_lanes, i, 1.0);
                set_lane(wanted, i, time);
            }
            auto const due = due_lanes > Real(0.5);
            if (none(due)) return;
            stepper.prepare_dense(pack, attempt, due);
            auto const from = pack.start();
            Real const theta = places.share_of(pack, stepper, attempt, wanted, accepted), at = places.time_of(c.t, attempt.step, theta, wanted);
            Real state[Model::size];
            stepper.dense(from, attempt, theta, state);
            typename Model::template Report<Real> report;
            if (sampler_.beyond_state()) {
                Real rates[Model::size];
                pack.model.tell_forces(sampler_.has_forces());
                pack.evaluate(at, state, from.memory, rates, true, report);
                pack.model.tell_forces(pack.needs.forces);
                pack.count_evaluations(due, 1);
            }
            for (int i = 0; i < lanes<Real>; ++i) {
                if (!holds(due, i)) continue;
                sampler_.write(i, number(c.member, i), number(c.sample, i), at, state, report, pack.model);
            }
            c.sample = c.sample + due_lanes;
        }
    }

    /// How members have ended.
    template <class Real> struct Ends {
        Mask<Real> ended;
        Mask<Real> finished;   // reached their end; where the audit ran it says whether the method was in its stable range
        Mask<Real> stuck;      // their step cannot shrink further, for what the faults say; the others have spent their steps
        Mask<Real> divergent;  // of those that are stuck: their error is beyond all bounds
    };

    /// Hands over the results of members that have ended.  @param faults of those that are stuck
    template <class Real>
    SLIDEWAY_HD void retire(Pack<Model, Real> const& pack, Ends<Real> const& ends, Faults<Real> const& faults) {
        auto const& [ended, finished, stuck, divergent] = ends;
        auto const& c = pack.state.course;
        auto unstable = mask_of<Real>(false);
        if constexpr (Pack<Model, Real>::Observer::audit_integrals > 0) {
            if (pack.needs.audit && any(finished)) {
                unstable =
                    Model::left_stable_range(pack.state.observation.observer.audit(), pack.state.constants.parameters);
            }
        }
        for (int i = 0; i < lanes<Real>; ++i) {
            if (!holds(ended, i)) continue;
            auto const member = number(c.member, i);
            SLIDEWAY_EXPECT(member < block_.members);
            Status const status = holds(finished & unstable, i)     ? Status::unstable
                                  : holds(finished, i)              ? Status::finished
                                  : holds(faults.geometry, i)       ? Status::geometry
                                  : holds(faults.contact_domain, i) ? Status::contact_domain
                                  : holds(divergent, i)             ? Status::nonfinite
                                  : holds(stuck, i)                 ? Status::step_too_small
                                  : is_late(pack.state, i)          ? Status::out_of_time
                                                                    : Status::max_steps;
            double const time = lane(c.t, i);
            block_.records[member] = {status, number(c.accepted, i),  number(c.rejected, i),   number(c.evaluations, i),
                                      time,   number(c.jacobians, i), number(c.stiff_steps, i)};
            block_.records[member].crossings = number(c.crossings, i);
            if constexpr (Model::has_shadows) {
                block_.records[member].lost_offsets = number(c.shadowed.lost, i);
                block_.records[member].grown_offsets = number(c.shadowed.grown, i);
                block_.records[member].growth_from = lane(c.shadowed.from, i);
            }
            for (int j = 0; j < states_; ++j) block_.final_states[member * (width() - 1) + static_cast<std::size_t>(j)] = lane(c.y[j], i);
            if (block_.quantities != 0) {
                constexpr auto columns = Pack<Model, Real>::Observer::columns;
                pack.state.observation.observer.finish(i, time, block_.quantities,
                                                       block_.quantity_values + member * columns);
                pack.with_records([&](auto const& record, auto...) {
                    record.finish(i, time, block_.quantities, block_.quantity_values + member * columns);
                });
            }
            if (block_.samples > 0) sampler_.fill_missing(member, number(c.sample, i));
            fill_missing_stops(member, number(c.stop, i), number(c.crossings, i));
        }
    }

    /// Leaves a member that has not ended as if it had never begun.
    SLIDEWAY_HD void abandon(std::size_t member) {
        if (block_.samples > 0) sampler_.fill_missing(member, 0);
        fill_missing_stops(member, 0, 0);
    }

private:
    /// Numbers of a time and a state.
    SLIDEWAY_FN std::size_t width() const { return 1 + static_cast<std::size_t>(int(states_)); }
    static constexpr double endless = 1e300;

    template <class Real> SLIDEWAY_HD Real next_stop(MemberState<Model, Real> const& s, Real first) const {
        auto const left = s.course.stop < Real(static_cast<double>(block_.stops.count));
        return select(left, fma(s.course.stop, s.constants.stop_period, first), Real(endless));
    }
    static constexpr int crank = crank_place<Model, 0>;

    /// By turns the end of the time is no end.
    template <class Real> SLIDEWAY_HD bool is_late(MemberState<Model, Real> const& s, int i) const {
        return by_turns() && lane(s.course.t, i) >= lane(s.constants.end, i);
    }

    /// Marks what a member that ended before stop `from` and after some crossings has not come to.
    SLIDEWAY_HD void fill_missing_stops(std::size_t member, std::size_t from, std::size_t crossings) {
        StopPlan const& plan = block_.stops;
        std::size_t const past = from > plan.transient ? from - plan.transient : 0;  // recorded stops behind it
        if (block_.crossings.room > 0) {
            fill(block_.section_values, member, block_.crossings.room, crossings, width());
        } else if (block_.section_values != nullptr) {
            std::size_t const taken = (past + plan.section_every - 1) / plan.section_every;
            fill(block_.section_values, member, plan.sections(), taken, width());
        }
        if (block_.growth_values != nullptr) {
            std::size_t const from_growth = plan.growth_from() + 1;
            fill(block_.growth_values, member, plan.growths(),
                 from > from_growth ? (from - from_growth) / plan.growth_every : 0,
                 static_cast<std::size_t>(block_.shadows.count));
        }
    }

    /// Rows [from, rows) of a member become NaN.
    SLIDEWAY_HD static void fill(double* values, std::size_t member, std::size_t rows, std::size_t from,
                                 std::size_t width) {
        for (std::size_t i = (member * rows + from) * width; i < (member + 1) * rows * width; ++i) {
            values[i] = not_a_number;
        }
    }

    template <class Real> SLIDEWAY_HD static std::size_t number(Real const& value, int index) {
        return static_cast<std::size_t>(lane(value, index));
    }

    Block& block_;
    Sampler<Model> sampler_;
    StateCount<Model> states_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
