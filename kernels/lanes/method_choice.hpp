#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/stiffness.hpp"
#include "kernels/lanes/work.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How `method = "auto"` changes members between explicit steps, by the clocks of impacts or plain ones, and the stiff method
/// (docs/integrators.md).
template <class Model, class Real> struct MethodChoice {
    SLIDEWAY_HD static Mask<Real> has(Pack<Model, Real> const& pack, Work work) { return pack.state.course.work == number(work); }

    /// Tolerances of steps by the clocks.
    SLIDEWAY_HD static IntegratorSettings settings_of_clocks(IntegratorSettings settings) {
        if (settings.method != Method::automatic) return settings;
        double const largest = Stiffness::largest_clock_tolerance / settings.rtol;
        double const share = settings.clock_tolerance < largest ? settings.clock_tolerance : largest;
        settings.rtol *= share;
        settings.atol *= share;
        return settings;
    }

    /// After how many of them without a flight at speed contact lasts: impacts take more where they are made more exactly.
    SLIDEWAY_HD static double lasting_steps(IntegratorSettings const& of_clocks) {
        double const finer = Stiffness::largest_clock_tolerance / of_clocks.rtol;
        return Stiffness::lasting_steps * (finer > 1 ? sqrt(sqrt(finer)) : 1.0);
    }

    /// Between stints of plain steps: who is better off with others.  Where contact lasts, that is the stiff method; clocks are for who is found in
    /// flight, after the start at speed.
    /// @param touching lanes in contact  @param fresh new ones
    SLIDEWAY_HD static void leave_plain(Pack<Model, Real>& pack, Mask<Real> touching, bool fresh) {
        auto& c = pack.state.course;
        auto const& s = pack.state;
        Real rate_squared(0.0);
        auto creeping = touching;
        if (any(touching)) {
            typename Model::template Linearisation<Real> matrix;
            pack.model.linearise(c.t, c.y, s.constants.parameters, s.contacts.memory, matrix);
            rate_squared = select(touching, matrix.rate_squared(), rate_squared);
            c.jacobians = c.jacobians + count<Real>(touching);
            Real const little =
                Real(Stiffness::creep_below * Stiffness::creep_below) * Model::energy_scale(s.constants.parameters);
            creeping = creeping & (matrix.vibration_energy(c.y) < little);
        }
        c.rate_squared =
            select(pack.busy, max(rate_squared, Real(Stiffness::memory) * c.rate_squared), c.rate_squared);
        Real const squared_step = c.h * c.h;
        auto const held_up = squared_step * rate_squared > Real(Stiffness::held_up_above * Stiffness::held_up_above);
        auto const lasting =
            touching & (squared_step * c.rate_squared > Real(Stiffness::lasting_above * Stiffness::lasting_above));
        Real const sign = select(held_up, Real(1.0), select(lasting, Real(Stiffness::lasting_share), Real(-1.0)));
        c.stiffness = max(c.stiffness + sign, Real(0.0));
        Mask<Real> const to_stiff = creeping & (c.stiffness >= Real(Stiffness::enough));
        auto to_clocks = mask_of<Real>(false);
        if constexpr (has_clocks<Model>) {
            if (pack.has_clocked_work) to_clocks = pack.busy & !touching;
            if (!fresh) to_clocks = to_clocks & moves(c.y, s);
        }
        c.work = select(to_stiff, number(Work::stiff), select(to_clocks, number(Work::clocked), c.work));
        c.stiffness = select(to_stiff | to_clocks, Real(0.0), c.stiffness);
        c.stiff_before = select(to_stiff, c.stiff_steps, c.stiff_before);
    }

    /// Counts the steps by the clocks since a member last flew at speed.
    SLIDEWAY_HD static void count_contact(Pack<Model, Real>& pack, Mask<Real> accepted) {
        auto& c = pack.state.course;
        auto const& s = pack.state;
        auto const flies = negation(Mask<Real>(s.contacts.watch.touching(s.contacts.memory) > Real(0.5)));
        c.stiffness = select(accepted, select(flies & moves(c.y, s), Real(0.0), c.stiffness + Real(1.0)), c.stiffness);
    }

    /// Between stints by the clocks: whose contact lasts, and steps plainly until it is stiff or flies.  Clocks would resolve every touch of a
    /// chatter.  @return lanes that change
    SLIDEWAY_HD static Mask<Real> leave_clocks(Pack<Model, Real>& pack, Mask<Real> touching) {
        auto& c = pack.state.course;
        Mask<Real> const due = touching & (c.stiffness >= Real(pack.lasting_steps));
        if (none(due)) return due;
        c.work = select(due, number(Work::plain), c.work);
        c.stiffness = select(due, Real(0.0), c.stiffness);
        c.h = select(due, clocked_step(pack.state), c.h);
        return due;
    }

    /// Has members go on without steps that hold their contacts, which touch where they are deep from here on.
    SLIDEWAY_HD static void release_contacts(Pack<Model, Real>& pack, Mask<Real> in) {
        Real rates[Model::size];
        typename Model::template Report<Real> report;
        pack.restart(in, rates, report);
    }

    /// Has members go on with such steps.
    SLIDEWAY_HD static void hold_contacts(Pack<Model, Real>& pack, Mask<Real> in) {
        auto& c = pack.state.course;
        auto& [memory, watch] = pack.state.contacts;
        Real rates[Model::size];
        typename Model::template Report<Real> report;
        // Which pairs touch first: rates are reported of what is held.
        memory.holding = select(in, Real(1.0), memory.holding);
        pack.evaluate(c.t, c.y, memory, rates, true, report);
        pack.count_evaluations(in, 1);
        watch.begin(in, report.contact, memory, pack.needs.watching);
        pack.restart(in, rates, report);
        watch.begin(in, report.contact, memory, pack.needs.watching);
        c.impacts.step = select(in, Real(0.0), c.impacts.step);
        c.impacts.flight_step = select(in, c.h, c.impacts.flight_step);
    }

    /// Lanes whose stiff step brought an apex into contact at speed.  The stiff method would swallow the impact's energy without a
    /// sign: `auto` leaves impacts to the explicit pair.  What counts is how fast the apex approached its face: a slider that glides along
    /// one, with a corner that rattles on it at next to no speed, has no impacts.
    SLIDEWAY_HD static Mask<Real> find_impacts(Pack<Model, Real> const& pack, Attempt<Model, Real> const& to,
                                               Mask<Real> accepted) {
        auto const& s = pack.state;
        // At either end: a slider lifted from rest meets the other face within one long step.
        Mask<Real> const may = accepted & (moves(s.course.y, s) | moves(to.end, s));
        if (none(may)) return may;
        Real const speed = pack.model.approach_speed(s.course.t, s.course.y, to.step, to.end, s.constants.parameters);
        return may & (speed > Real(Stiffness::impact_above));
    }

    /// Lanes that leave the stiff method: where contact is lost or an impact begins, or steps stay far below what that method is for.
    /// @param stepper that made the step  @param max_step of the explicit pair [s]
    template <class Stepper>
    SLIDEWAY_HD static Mask<Real> leave_stiffness(Pack<Model, Real>& pack, Stepper const& stepper, Real step,
                                                  Mask<Real> accepted, Mask<Real> impact, double max_step) {
        auto& c = pack.state.course;
        Real const rate = sqrt(max(stepper.rate_squared(), Real(0.0)));
        auto const calm = step * rate < Real(Stiffness::calm_below);
        c.stiffness = select(accepted, select(calm, c.stiffness + Real(1.0), Real(0.0)), c.stiffness);
        auto const free = stepper.touching() < Real(0.5);
        Mask<Real> const leaving = pack.busy & (free | impact | (c.stiffness >= Real(Stiffness::calm_steps)));
        if (none(leaving)) return leaving;
        c.stiffness = select(leaving, Real(0.0), c.stiffness);
        c.work = select(leaving, number(Work::plain), c.work);
        if constexpr (has_clocks<Model>) {
            // Who became stiff only just now chatters.
            auto const lay = c.stiff_steps >= c.stiff_before + Real(Stiffness::settled_steps);
            if (pack.has_clocked_work) c.work = select(leaving & lay & (impact | (free & moves(c.y, pack.state))), number(Work::clocked), c.work);
        }
        Real const explicit_step = min(Real(1.0) / max(rate, Real(1e-9)), Real(max_step));
        c.h = select(leaving, min(c.h, explicit_step), c.h);
        return leaving;
    }

private:
    using State = MemberState<Model, Real>;

    SLIDEWAY_FN static Real number(Work work) { return Real(static_cast<double>(work)); }

    /// Lanes that are faster than a creep.
    SLIDEWAY_HD static Mask<Real> moves(Real const* y, State const& s) {
        return Model::squared_speed(y, s.constants.scale) > Real(Stiffness::creep_below * Stiffness::creep_below);
    }

    /// The next step by the clocks of members in contact [s].
    SLIDEWAY_HD static Real clocked_step(State const& s) {
        if constexpr (has_clocks<Model>) {
            Real const step = s.course.impacts.step, by_clock = s.contacts.watch.clock(s.contacts.memory).time_of(step);
            return select(step > Real(0.0), by_clock, s.course.h);
        }
        return s.course.h;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
