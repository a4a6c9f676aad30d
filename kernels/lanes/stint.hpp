#pragma once

#include <type_traits>

#include "kernels/lanes/crank_turns.hpp"
#include "kernels/lanes/crossing_search.hpp"
#include "kernels/lanes/free_steps.hpp"
#include "kernels/lanes/clocked_steps.hpp"
#include "kernels/lanes/method_choice.hpp"
#include "kernels/lanes/pack_step.hpp"
#include "kernels/lanes/peak_search.hpp"
#include "kernels/lanes/settled_steps.hpp"
#include "kernels/lanes/touch_steps.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"
#include "kernels/steppers/step_control.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The class that says how contacts limit the steps of a model by a stepper.
template <class Stepper, class Model, class Real>
using ContactSteps = std::conditional_t<
    Stepper::by_clock, ClockedSteps<Stepper, Model, Real>,
    std::conditional_t<!Model::has_contacts || Stepper::has_impulses, FreeSteps<Stepper, Model, Real>,
                       std::conditional_t<IsRigid<Model>, SettledSteps<Stepper, Model, Real>, TouchSteps<Stepper, Model, Real>>>>;

/// A model without events of its own.  One that states `events` brings what finds them (tests/models/event_search.hpp).
template <class Model, class Real> struct Uneventful {
    template <class Stepper>
    SLIDEWAY_HD void run(Pack<Model, Real>&, Stepper&, Attempt<Model, Real> const&, Mask<Real> /*accepted*/, Real& /*t_end*/, Mask<Real>& /*landed*/) {}
    SLIDEWAY_HD void reset(Pack<Model, Real>&, Attempt<Model, Real>&) {}
    SLIDEWAY_HD Mask<Real> piled_up(Pack<Model, Real>&, Real /*step*/) const { return mask_of<Real>(false); }
    SLIDEWAY_HD Mask<Real> complete(Pack<Model, Real>&, Mask<Real> /*accepted*/) const { return mask_of<Real>(false); }
};
template <class Model, class Real> struct SearchFor { using Type = Uneventful<Model, Real>; };
template <HasEvents Model, class Real> struct SearchFor<Model, Real> { using Type = typename Model::template Search<Model, Real>; };

/// A pack of members at work with one stepper for a number of attempts.  Nothing that happens in one lane reaches another.
/// A step is chosen (`begin`), tried, judged by all who may shorten it (`judge`: its error and that of the neighbours, the contacts, the stiff method), and
/// where it is accepted taken by all who follow it (`advance`).
template <class Stepper, class Model, class Real> class Stint {
public:
    SLIDEWAY_HD Stint(Pack<Model, Real>& pack, Results<Model>& results, IntegratorSettings const& settings)
        : step_(pack, results, settings), control_(Stepper::order(pack), Contacts::control_percent) {}

    /// Every lane attempts `attempts` steps, unless its member ends or leaves the stiff method before.
    SLIDEWAY_HD void work(int attempts) {
        SLIDEWAY_EXPECT(attempts > 0);
        auto& pack = step_.pack;
        auto const members = pack.busy;
        int const members_at_start = held_lanes(members);
        for (int i = 0; i < attempts && any(pack.busy); ++i) {
            // Where nothing is decided between stints, a lane that falls free ends the stint and is filled at once.  A watch of gaps forgets the last step.
            bool const may_end = (!Regroups<Model> && pack.needs.watching != Watching::gaps) || Stepper::has_impulses;
            if (may_end && held_lanes(pack.busy) < members_at_start) break;
            begin();
            // Before the member: what the stepper knows of the step is then the member's.
            step_.neighbours.attempt(step_);
            step_.stepper.attempt(pack, pack.start(), step_.attempt);
            decide();
        }
        pack.busy = members & (pack.busy | left_);
    }

private:
    using Contacts = ContactSteps<Stepper, Model, Real>;
    using Choice = MethodChoice<Model, Real>;

    /// What is decided of an attempt.
    struct Verdict : Allowance<Real> {
        Mask<Real> rejected;
        Mask<Real> cut;        // rejected because an event must end the step
        Mask<Real> divergent;  // the error is beyond all bounds, or the end not finite
        Mask<Real> impact;     // rejected because the stiff method would swallow an impact
    };

    /// Chooses the step.
    SLIDEWAY_HD void begin() {
        auto& pack = step_.pack;
        auto& results = step_.results;
        auto& c = pack.state.course;
        Real time = pack.state.constants.end;
        if (results.by_turns()) {
            time = turns_.landing(pack.state, results, Stepper::stiff);
        } else {
            if (results.stops() > 0) time = min(time, results.next_stop(pack.state));
            if (Stepper::stiff && results.samples() > 0) time = results.next_sample_times(c.sample, c.t, time);
        }
        step_.landing = time;
        step_.lands = contacts_.choose(step_, time - c.t);
        SLIDEWAY_EXPECT(none(pack.busy & (c.t > pack.state.constants.end)) && (Stepper::by_clock || none(pack.busy & (step_.attempt.step < Real(0.0)))));
        pack.template count_attempt<Stepper>(pack.busy);
        results.count_attempt(lanes<Real>, held_lanes(pack.busy));
    }

    /// Accepts or rejects per lane.
    SLIDEWAY_HD void decide() {
        auto& pack = step_.pack;
        auto& c = pack.state.course;
        auto const verdict = judge();
        c.accepted = c.accepted + count<Real>(verdict.accepted);
        c.rejected = c.rejected + count<Real>(verdict.rejected);
        Real next = min(verdict.next, step_.longest());
        Mask<Real> const overshot = contacts_.failed_landings(step_), failed = verdict.rejected & (negation(verdict.cut) | overshot);
        c.rejections = select(pack.busy, count<Real>(failed), c.rejections);
        Mask<Real> const still = verdict.rejected & (contacts_.time_of(step_, verdict.next) <= step_.resolution());
        Mask<Real> stuck = step_.adapts() ? still : verdict.rejected & !verdict.cut;
        step_.attempt.faults = step_.neighbours.faults_beside(step_.attempt.faults);

        auto finished = mask_of<Real>(false);
        if (any(verdict.accepted)) {
            finished = advance(verdict.accepted, next);
            stuck = stuck | search_.piled_up(pack, step_.attempt.step);
        }
        contacts_.store_next(step_, verdict.next, next);
        auto spent = pack.busy & !finished & (c.accepted + c.rejected >= Real(static_cast<double>(step_.settings.max_steps)));
        if (step_.results.by_turns()) spent = spent | (pack.busy & !finished & (c.t >= pack.state.constants.end));
        Mask<Real> const ended = finished | stuck | spent, divergent = stuck & verdict.divergent;
        if (any(ended)) {
            step_.results.retire(pack, {ended, finished, stuck, divergent}, step_.attempt.faults.within(stuck));
            pack.busy = pack.busy & !ended;
        }
        if constexpr (Stepper::stiff) {
            if (!step_.is_auto()) return;
            auto const leaving = Choice::leave_stiffness(pack, step_.stepper, step_.attempt.step, verdict.accepted, verdict.impact, step_.settings.max_step);
            left_ = left_ | leaving;
            pack.busy = pack.busy & !leaving;
        }
    }

    /// Accepts or rejects by the error, then by the contacts, then by impacts in stiff steps.
    SLIDEWAY_HD Verdict judge() {
        auto& pack = step_.pack;
        Verdict verdict;
        verdict.impact = verdict.divergent = mask_of<Real>(false);
        step_.former_memory = pack.state.course.error_memory;
        auto& allowed = static_cast<Allowance<Real>&>(verdict);
        allowed = step_.adapts() ? allowed_by_error(verdict.divergent) : allowed_if_finite(verdict.divergent);
        verdict.cut = contacts_.cut(step_, allowed);
        if (step_.results.by_turns()) verdict.cut = verdict.cut | turns_.cut(step_, allowed);
        if (Stepper::stiff && step_.is_auto()) verdict.impact = Choice::find_impacts(pack, step_.attempt, allowed.accepted);
        verdict.accepted = verdict.accepted & !verdict.impact;
        verdict.rejected = pack.busy & !verdict.accepted;
        return verdict;
    }

    SLIDEWAY_HD Allowance<Real> allowed_by_error(Mask<Real>& divergent) {
        auto& c = step_.pack.state.course;
        Real squared_norm = step_.squared_error(step_.pack.start(), step_.attempt);
        squared_norm = step_.neighbours.larger_norm_than(squared_norm);
        Mask<Real> const accepted = step_.pack.busy & (squared_norm <= Real(1.0));
        step_.squared_norm = squared_norm;
        divergent = !(squared_norm < Real(1e300));
        // Whether what is beyond all bounds came out infinite or NaN may be the other lanes' doing.
        squared_norm = select(divergent, Real(not_a_number), squared_norm);
        Real const factor = control_.factor(squared_norm, accepted, c.rejections > Real(0.5), c.error_memory);
        Real const next = contacts_.next(step_, accepted, factor);
        // A step that was shortened to land says little of what the next may be.
        return {accepted, select(accepted & step_.lands, max(next, c.h), next)};
    }

    SLIDEWAY_HD Allowance<Real> allowed_if_finite(Mask<Real>& divergent) {
        auto const busy = step_.pack.busy;
        Mask<Real> const accepted = step_.neighbours.finite_beside(busy & is_finite(step_.attempt.end, step_.attempt.end_rates, step_.pack.states()));
        divergent = busy & !accepted;
        return {accepted, step_.attempt.step};
    }

    /// Moves the accepted lanes to the end of their step.  @param next step, which may become shorter  @return those that reached the end time.
    SLIDEWAY_HD Mask<Real> advance(Mask<Real> accepted, Real& next) {
        auto& pack = step_.pack;
        auto& c = pack.state.course;
        auto& attempt = step_.attempt;
        Mask<Real> landed = accepted & step_.lands & negation(contacts_.ended_early());
        Real t_end = select(landed, step_.landing, step_.fine_time().after(c.t, attempt.step, c.fine_time, accepted, landed));
        search_.run(pack, step_.stepper, attempt, accepted, t_end, landed);
        record(accepted, t_end);
        search_.reset(pack, attempt);
        observe(accepted);
        for (int i = 0, n = pack.states(); i < n; ++i) c.y[i] = select(accepted, attempt.end[i], c.y[i]);
        c.t = select(accepted, t_end, c.t);
        pack.model.project(accepted, c.t, c.y, pack.state.constants.parameters);
        if (Stepper::stiff) c.stiff_steps = c.stiff_steps + count<Real>(accepted);
        pack.begin_next(accepted, attempt.end_rates, attempt.report);
        contacts_.advance(step_, accepted, next);
        if (step_.results.stops() > 0) stop(accepted, landed);
        if (step_.results.by_turns()) return turns_.at_end(accepted, pack.state, step_.results.stops());
        return (landed & (c.t >= pack.state.constants.end)) | search_.complete(pack, accepted);
    }

    /// Crossings of a section and samples inside the step.
    SLIDEWAY_HD void record(Mask<Real> accepted, Real t_end) {
        auto& results = step_.results;
        if constexpr (Model::has_crossings && !Model::has_shadows) {
            if (results.crossings().room > 0 && !results.crossings().of_impacts()) {
                CrossingSearch<Stepper, Model, Real>::run(step_.pack, results, step_.stepper, step_.attempt, accepted);
            }
        }
        if (results.samples() == 0) return;
        auto const& s = step_.pack.state;
        using Times = typename Results<Model>::template SampleTimes<Real>;
        results.by_turns() ? results.take_samples(step_.pack, step_.stepper, step_.attempt, accepted, turns_.samples(s, step_.attempt, t_end))
                           : results.take_samples(step_.pack, step_.stepper, step_.attempt, accepted, Times{s.course.t, t_end});
    }

    SLIDEWAY_HD void observe(Mask<Real> accepted) {
        auto& pack = step_.pack;
        auto& attempt = step_.attempt;
        if (!pack.needs.quantities) return;
        if (Stepper::has_impulses) pack.state.observation.observer.take_impulses(accepted, attempt.report);
        if constexpr (PeakSearch<Stepper, Model, Real>::is_of_use) {
            if (pack.needs.peaks && step_.adapts()) PeakSearch<Stepper, Model, Real>::run(pack, step_.stepper, attempt, accepted);
        }
        pack.state.observation.observer.accept(accepted, attempt.step, pack.integral, attempt.report, attempt.end, pack.needs.switches);
        pack.with_records([&](auto& record, auto...) { record.accept(accepted, attempt.step, attempt.report); });
        if (!Stepper::by_clock) pack.with_record(pack.state.forces, pack.needs.forces, [&](auto& f) { f.see_faces(accepted, attempt.step, attempt.report); });
    }

    /// Members that have landed at a stop: their section, and how their neighbours have departed.
    SLIDEWAY_HD void stop(Mask<Real> accepted, Mask<Real> landed) {
        auto& c = step_.pack.state.course;
        auto const at = step_.results.by_turns() ? turns_.at_stop(accepted) : landed & (c.t >= step_.results.next_stop(step_.pack.state));
        if (none(at)) return;
        step_.results.take_section(step_.pack, at);
        step_.neighbours.stop(step_.pack, step_.results, at);
        c.stop = c.stop + count<Real>(at);
    }

    PackStep<Stepper, Model, Real> step_;
    StepControl control_;
    [[no_unique_address]] typename SearchFor<Model, Real>::Type search_;
    [[no_unique_address]] Contacts contacts_;
    CrankTurns<Model, Real> turns_;
    Mask<Real> left_ = mask_of<Real>(false);  // lanes that leave the stiff method
};

}  // namespace slideway::inline SLIDEWAY_ISA
