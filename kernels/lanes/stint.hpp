#pragma once

#include <type_traits>

#include "kernels/lanes/crossing_search.hpp"
#include "kernels/lanes/error_norm.hpp"
#include "kernels/lanes/event_end.hpp"
#include "kernels/lanes/fine_time.hpp"
#include "kernels/lanes/impact_rows.hpp"
#include "kernels/lanes/impact_steps.hpp"
#include "kernels/lanes/method_choice.hpp"
#include "kernels/lanes/moreau_jean_step.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/peak_search.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/lanes/shadows.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/step_control.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What finds a model's own events, if it has any.
template <class Model, class Real> struct SearchOf { struct Type {}; };
template <class Model, class Real> requires has_events<Model>
struct SearchOf<Model, Real> { using Type = typename Model::template Search<Model, Real>; };
struct NoImpactSteps {};
/// What a stepper that ends early needs to know of its last attempt.
template <class Real> struct EarlyEnds {
    Real squared_norm;                         // of its error
    Mask<Real> lanes = mask_of<Real>(false);  // whose attempt ended early
};
struct NoEarlyEnds {};
struct NoShadowSteps {
    explicit SLIDEWAY_HD NoShadowSteps(ShadowPlan const&) {}
};

/// A pack of members at work with one stepper for a number of attempts.  Nothing that happens in one lane reaches another.
template <class Stepper, class Model, class Real> class Stint {
public:
    SLIDEWAY_HD Stint(Pack<Model, Real>& pack, Results<Model>& results, IntegratorSettings const& settings)
        : pack_(pack), results_(results), settings_(settings), control_(Stepper::order(pack), by_clock ? 25 : 20),  // within an impact errors differ much
          shadows_(results.shadows()) {
        max_step_ = Stepper::stiff ? settings.stiff_max_step : settings.max_step;
    }

    /// Every lane attempts `attempts` steps, unless its member ends or leaves the stiff method before.
    SLIDEWAY_HD void work(int attempts) {
        left_ = known_ = mask_of<Real>(false);
        auto const members = pack_.busy;
        int const members_at_start = held_lanes(members);
        for (int i = 0; i < attempts && any(pack_.busy); ++i) {
            // Where nothing is decided between stints, a lane that falls free ends the stint and is filled at once.
            if ((!regroups<Model> || has_impulses<Stepper>) && held_lanes(pack_.busy) < members_at_start) break;
            auto const landing = begin();
            // Before the member: what the stepper knows of the step is then the member's.
            if constexpr (Model::has_shadows) {
                shadows_.attempt(pack_, stepper_, attempt_.step, adapts(),
                                 [&](auto const& from, auto const& attempt) { return squared_error_norm(from, attempt); });
            }
            stepper_.attempt(pack_, pack_.start(), attempt_);
            settle(landing);
        }
        pack_.busy = members & (pack_.busy | left_);
    }

private:
    static constexpr int size = Model::size;
    static constexpr int width = lanes<Real>;
    static constexpr bool shadows_have_events = Model::has_shadows && !has_impacts<Model>;
    static constexpr bool impacts_end_it = Stepper::stiff && Model::has_patterns;
    static constexpr bool by_clock = Stepper::by_clock;
    static constexpr double inside_within = 1e-3;  // of the tolerance
    static constexpr double hair = 1.000001;  // how much longer than it may be a step gets to land
    using Impacts = ImpactSteps<Stepper, Model, Real>;
    using Choice = MethodChoice<Model, Real>;

    /// A known time at which the step ends at the latest, and the lanes where it ends there.
    struct Landing {
        Real time;
        Mask<Real> lands;
    };

    /// What all of them come to.
    struct Verdict {
        Mask<Real> accepted;
        Mask<Real> rejected;
        Mask<Real> cut;        // rejected because an event must end the step
        Mask<Real> divergent;  // the error is beyond all bounds
        Mask<Real> impact;     // rejected because the stiff method would swallow an impact
        Real next;             // as of an Allowance
    };

    /// Chooses the step.
    SLIDEWAY_HD Landing begin() {
        auto& c = pack_.state.course;
        Real time = pack_.state.constants.end;
        if (results_.stops() > 0) time = min(time, results_.next_stop(pack_.state));
        if constexpr (Stepper::stiff) {
            if (results_.samples() > 0) time = results_.next_sample_times(c.sample, c.t, time);
        }
        Real const remaining = time - c.t;
        auto lands = mask_of<Real>(false);
        if constexpr (by_clock) {
            lands = impacts_.choose(pack_, stepper_, remaining);
        } else {
            Real const h = adapts() ? c.h : Real(settings_.fixed_step);
            // A last step a hair short of the end would leave a crumb below the resolution of time.
            lands = remaining <= h * Real(hair);
            attempt_.step = select(pack_.busy, select(lands, remaining, h), Real(0.0));
        }
        pack_.template count_attempt<Stepper>(pack_.busy);
        results_.count_attempt(width, held_lanes(pack_.busy));
        return {time, lands};
    }

    SLIDEWAY_HD Real squared_error_norm(StepStart<Model, Real> const& from, Attempt<Model, Real> const& to) {
        return ErrorNorm<Stepper, Model, Real>::squared(pack_, stepper_, settings_, from, to);
    }

    /// Accepts or rejects per lane.
    SLIDEWAY_HD void settle(Landing const& landing) {
        auto& c = pack_.state.course;
        auto const busy = pack_.busy;
        auto const verdict = judge(landing);
        c.accepted = c.accepted + count<Real>(verdict.accepted);
        c.rejected = c.rejected + count<Real>(verdict.rejected);
        auto failed = verdict.rejected & !verdict.cut;
        Real next_time = verdict.next, next = min(verdict.next, Real(max_step_));
        if constexpr (by_clock) {
            failed = failed | (verdict.rejected & impacts_.landed_in_contact(landing.lands));
            next_time = Impacts::time_of(stepper_, verdict.next);
        }
        c.rejections = select(busy, count<Real>(failed), c.rejections);
        Mask<Real> const still = verdict.rejected & (next_time <= resolution());
        Mask<Real> stuck = adapts() ? still : verdict.rejected;
        if constexpr (Model::has_shadows) attempt_.faults = attempt_.faults.or_else(shadows_.faults());

        auto finished = mask_of<Real>(false);
        if (any(verdict.accepted)) {
            finished = advance(verdict.accepted, landing, next);
            if constexpr (has_events<Model>) stuck = stuck | search_.piled_up(pack_, attempt_.step);
        }
        if constexpr (by_clock) {
            impacts_.keep(pack_.state, stepper_, busy, verdict.next, Real(max_step_));
        } else {
            c.h = select(busy, next, c.h);
        }
        auto const spent =
            busy & !finished & (c.accepted + c.rejected >= Real(static_cast<double>(settings_.max_steps)));
        Mask<Real> const ended = finished | stuck | spent, divergent = stuck & verdict.divergent;
        if (any(ended)) {
            results_.retire(pack_, {ended, finished, stuck, divergent}, attempt_.faults.within(stuck));
            pack_.busy = pack_.busy & !ended;
        }
        if constexpr (Stepper::stiff) {
            if (is_auto()) leave_stiffness(verdict);
        }
    }

    SLIDEWAY_HD bool adapts() const {
        if constexpr (requires { Stepper::adapts(pack_); }) return Stepper::adapts(pack_);
        else return Stepper::adaptive;
    }
    SLIDEWAY_HD bool is_auto() const { return settings_.method == Method::automatic; }

    SLIDEWAY_HD void leave_stiffness(Verdict const& verdict) {
        auto const leaving = Choice::leave_stiffness(pack_, stepper_, attempt_.step, verdict.accepted, verdict.impact, settings_.max_step);
        left_ = left_ | leaving;
        pack_.busy = pack_.busy & !leaving;
    }

    SLIDEWAY_HD FineTime<Real> fine_time() const { return {pack_.state.constants.end, shadows_have_events}; }
    SLIDEWAY_HD Real resolution() const { return fine_time().resolution(); }

    /// Folds what all who may shorten the step allow: its error first, then the events of what it may still be.
    SLIDEWAY_HD Verdict judge(Landing const& landing) {
        Verdict verdict;
        verdict.cut = verdict.impact = verdict.divergent = mask_of<Real>(false);
        Real const former_memory = pack_.state.course.error_memory;
        auto allowed = adapts() ? allowed_by_error(landing, verdict.divergent) : allowed_if_finite(verdict.divergent);
        if constexpr (Model::has_contacts && Stepper::adaptive) {
            if (pack_.needs.cuts() && adapts()) {
                auto const by_contacts = allowed_by_contacts(allowed);
                verdict.cut = allowed.accepted & !by_contacts.accepted;
                // A step that an event cuts short says nothing of its error.
                pack_.state.course.error_memory = select(verdict.cut, former_memory, pack_.state.course.error_memory);
                allowed = by_contacts;
                if constexpr (!by_clock) {
                    // An event a hair before the landing: the step would land again and be cut again, without end.
                    auto const again = verdict.cut & landing.lands & (attempt_.step <= allowed.next * Real(hair));
                    allowed.next = select(again, attempt_.step * Real(1 - 2 * (hair - 1)), allowed.next);
                }
            }
        }
        if constexpr (impacts_end_it) {
            if (is_auto()) verdict.impact = Choice::find_impacts(pack_, attempt_, allowed.accepted);
        }
        verdict.accepted = allowed.accepted & !verdict.impact;
        verdict.rejected = pack_.busy & !verdict.accepted;
        verdict.next = allowed.next;
        return verdict;
    }

    SLIDEWAY_HD Allowance<Real> allowed_by_error(Landing const& landing, Mask<Real>& divergent) {
        auto& c = pack_.state.course;
        Real squared_norm(0.0);
        if constexpr (Stepper::adaptive) squared_norm = squared_error_norm(pack_.start(), attempt_);
        if constexpr (Model::has_shadows) squared_norm = larger_norm(squared_norm, shadows_.squared_norm());
        Mask<Real> const accepted = pack_.busy & (squared_norm <= Real(1.0));
        if constexpr (Stepper::ends_early) early_.squared_norm = squared_norm;
        divergent = !(squared_norm < Real(1e300));
        // Whether what is beyond all bounds came out infinite or NaN may be the neighbours' doing.
        squared_norm = select(divergent, Real(not_a_number), squared_norm);
        Real const factor = control_.factor(squared_norm, accepted, c.rejections > Real(0.5), c.error_memory);
        Real next = attempt_.step * factor;
        if constexpr (by_clock) next = impacts_.next(pack_.state, stepper_, accepted, factor);
        // A step that was shortened to land says little of what the next may be.
        return {accepted, select(accepted & landing.lands, max(next, c.h), next)};
    }

    SLIDEWAY_HD Allowance<Real> allowed_if_finite(Mask<Real>& divergent) {
        Mask<Real> accepted = pack_.busy & is_finite(attempt_.end, attempt_.end_rates);
        if constexpr (Model::has_shadows) accepted = accepted & shadows_.finite();
        divergent = pack_.busy & !accepted;
        return {accepted, attempt_.step};
    }

    /// A touch, or a change of mode, must end its step: it sets the impact speed of what follows, or the law that holds.
    SLIDEWAY_HD Allowance<Real> allowed_by_contacts(Allowance<Real> const& before) {
        if constexpr (by_clock) return impacts_.allowed(pack_, stepper_, attempt_, before, settings_.rtol, resolution());
        Real const step = attempt_.step;
        auto const early = before.accepted & (step > resolution() * Real(64.0));
        auto const watching = pack_.needs.watching;
        Real const located = located_depth(watching);
        Real fraction = pack_.state.contacts.watch.earliest(early, attempt_.report.contact, step, located, watching);
        if constexpr (shadows_have_events) fraction = min(fraction, shadows_.earliest(pack_, early, located));
        auto cut = fraction < Real(1.0);
        if constexpr (Stepper::ends_early) {
            auto const known = cut & knows_inside(fraction) & (step * fraction > resolution() * Real(64.0));
            early_.lanes = known;
            if (any(known)) {
                early_.lanes = EventEnd<Stepper, Model, Real>(pack_, stepper_, attempt_, located).run(known, fraction);
                cut = cut & !early_.lanes;
            }
            // A shorter attempt knows its inside better, near its end above all.
            fraction = select(fraction < Real(0.6), Real(1.02) * fraction, fraction);
        }
        Allowance<Real> allowed{Mask<Real>(before.accepted & !cut),
                                select(cut, max(step * fraction, resolution() * Real(32.0)), before.next)};
        if constexpr (shadows_have_events) shadows_.go_on(pack_, step, cut, allowed);
        return allowed;
    }

    /// Whether the attempt is as exact there as at its end.  The continuous extension errs as θ²(1 − θ)², by about the error of the step at most; a
    /// bounce that ends early feels it relative to its own time θ.
    SLIDEWAY_HD Mask<Real> knows_inside(Real theta) const {
        Real const rest = Real(1.0) - theta, part = Real(6.75) * theta * (rest * rest);
        return part * part * early_.squared_norm <= Real(inside_within * inside_within);
    }

    /// Depth up to which an event of the contacts counts as located.
    SLIDEWAY_HD Real located_depth(Watching watching) const {
        auto const& constants = pack_.state.constants;
        if constexpr (has_impacts<Model>) {
            return Model::located(constants.parameters, constants.end);
        } else {
            double tolerance = Model::template Watch<Real>::tolerance(watching);
            if constexpr (Model::has_shadows) tolerance = Shadows<Model, Real>::located;
            return Real(tolerance) * Model::touch_scale(constants.parameters);
        }
    }

    /// Moves the accepted lanes to the end of their step.  @param next step, which may become shorter  @return those that reached the end time.
    SLIDEWAY_HD Mask<Real> advance(Mask<Real> accepted, Landing const& landing, Real& next) {
        auto& c = pack_.state.course;
        auto landed = accepted & landing.lands;
        if constexpr (by_clock) landed = landed & !impacts_.ended_early();
        if constexpr (Stepper::ends_early) landed = landed & !early_.lanes;
        Real t_end = select(landed, landing.time, fine_time().after(c.t, attempt_.step, c.fine_time, accepted, landed));
        if constexpr (has_events<Model>) {
            search_.run(pack_, stepper_, attempt_, accepted);
            t_end = select(search_.ended(), fma(attempt_.step, search_.fraction(), c.t), t_end);
            c.fine_time = select(search_.ended(), Real(0.0), c.fine_time);
            landed = landed & !search_.ended();
        }
        if constexpr (Model::has_crossings && !Model::has_shadows) {
            if (results_.crossings().room > 0 && !results_.crossings().of_impacts()) {
                CrossingSearch<Stepper, Model, Real>::run(pack_, results_, stepper_, attempt_, accepted);
            }
        }
        if (results_.samples() > 0) results_.take_samples(pack_, stepper_, attempt_, accepted, t_end);
        if constexpr (has_events<Model>) search_.reset(pack_, attempt_);
        observe(accepted);
        for (int i = 0; i < size; ++i) c.y[i] = select(accepted, attempt_.end[i], c.y[i]);
        c.t = select(accepted, t_end, c.t);
        if constexpr (Stepper::stiff) c.stiff_steps = c.stiff_steps + count<Real>(accepted);
        pack_.begin_next(accepted, attempt_.end_rates, attempt_.report);
        if constexpr (has_impulses<Stepper>) {
            // What touches is looked for in each step anew.
        } else if constexpr (has_impacts<Model>) {
            if constexpr (Model::has_shadows) shadows_.advance(pack_, accepted);
            settle_contacts(accepted);
        } else {
            remember_contacts(accepted, next);
            if constexpr (Model::has_shadows) shadows_.advance(pack_, accepted);
        }
        if (results_.stops() > 0) stop(landed);
        auto finished = landed & (c.t >= pack_.state.constants.end);
        if constexpr (has_events<Model>) {
            if (pack_.needs.quantities) {
                auto& observer = pack_.state.observation.observer;
                observer.settle(accepted & Model::at_rest(c.rates), c.y);
                finished = finished | (accepted & observer.complete());
            }
        }
        return finished;
    }

    SLIDEWAY_HD void observe(Mask<Real> accepted) {
        if (!pack_.needs.quantities) return;
        if constexpr (has_impulses<Stepper>) pack_.state.observation.observer.take_impulses(accepted, attempt_.report);
        if constexpr (PeakSearch<Stepper, Model, Real>::is_of_use) {
            if (pack_.needs.peaks && adapts()) PeakSearch<Stepper, Model, Real>::run(pack_, stepper_, attempt_, accepted);
        }
        pack_.state.observation.observer.accept(accepted, attempt_.step, pack_.integral, attempt_.report, attempt_.end,
                                                pack_.needs.switches);
        pack_.with_accelerations([&](auto& a) { a.accept(accepted, attempt_.step, attempt_.report); });
    }

    /// What an accepted step leaves of its contacts.
    SLIDEWAY_HD void remember_contacts([[maybe_unused]] Mask<Real> accepted, [[maybe_unused]] Real& next) {
        if constexpr (Model::has_contacts) {
            if (!pack_.needs.watch()) return;
            auto touched = mask_of<Real>(false);
            if constexpr (by_clock) {
                auto const turned = impacts_.update(pack_.state, stepper_, accepted, attempt_.report.contact, pack_.model.remembers());
                touched = pack_.needs.switches ? turned.lanes : turned.by_depth;
                turn_modes(turned.lanes);
            } else {
                auto& [memory, watch] = pack_.state.contacts;
                bool const may_shorten = !Stepper::stiff && adapts();
                Real const known_step = select(known_, attempt_.step, Real(0.0));
                touched = watch.update(accepted, attempt_.report.contact, memory, pack_.state.course.y, pack_.needs.watching, known_step,
                                       may_shorten ? &next : nullptr);
                known_ = known_ | accepted;
            }
            if (any(touched)) restart(touched);
        }
    }

    /// Impacts at the end of an accepted step, and contacts that begin or end there.
    SLIDEWAY_HD void settle_contacts(Mask<Real> accepted) {
        auto& c = pack_.state.course;
        auto& [memory, watch] = pack_.state.contacts;
        auto const& constants = pack_.state.constants;
        [[maybe_unused]] auto const before = memory;
        auto const changed = pack_.model.settle(accepted, c.t, constants.end, c.y, constants.parameters, memory, attempt_.report.contact);
        if (any(changed)) {
            if constexpr (Model::has_crossings) ImpactRows<Model, Real>::take(pack_, results_, changed, attempt_.end);
            if constexpr (Model::has_shadows) {
                using Event = typename Saltation<Model, Real>::Before;
                Event const event{c.t, constants.end, attempt_.end, attempt_.end_rates, attempt_.report.contact, before};
                shadows_.settle(pack_, event, changed, false);
            }
            auto const faults = restart(changed);
            // No step leads out of where contacts have no forces.
            auto const jams = changed & faults.contact_domain & !is_finite(c.y, attempt_.end_rates);
            memory.jammed = select(jams, Real(1.0), memory.jammed);
            if constexpr (Model::has_shadows) shadows_.depart(pack_, changed);
        }
        watch.keep(accepted, attempt_.report.contact);
    }

    /// Members that have landed at a stop: their section, and how their shadows have departed.
    SLIDEWAY_HD void stop(Mask<Real> landed) {
        auto& c = pack_.state.course;
        auto const at = landed & (c.t >= results_.next_stop(pack_.state));
        if (none(at)) return;
        results_.take_section(pack_, at);
        if constexpr (Model::has_shadows) {
            shadows_.rescale(pack_, at);
            results_.take_growth(pack_, at);
        }
        c.stop = c.stop + count<Real>(at);
    }

    /// Where other contacts are held from here on.
    SLIDEWAY_HD void turn_modes(Mask<Real> turned) {
        if (!pack_.needs.quantities || none(turned)) return;
        attempt_.report.contact.take_modes(pack_.state.contacts.memory.held);
        pack_.state.observation.observer.turn_mode(turned, attempt_.report);
    }

    /// New impact speeds or other contacts change the derivative at the same state.
    SLIDEWAY_HD Faults<Real> restart(Mask<Real> touched) {
        auto const& c = pack_.state.course;
        auto const faults = pack_.evaluate(c.t, c.y, pack_.state.contacts.memory, attempt_.end_rates, true, attempt_.report);
        pack_.count_evaluations(touched, 1);
        if (pack_.needs.quantities) {
            auto& observer = pack_.state.observation.observer;
            observer.switch_over(touched, attempt_.report, pack_.needs.switches);
        }
        pack_.begin_next(touched, attempt_.end_rates, attempt_.report);
        return faults;
    }

    Pack<Model, Real>& pack_;
    Results<Model>& results_;
    IntegratorSettings const& settings_;
    StepControl control_;
    Stepper stepper_;
    [[no_unique_address]] typename SearchOf<Model, Real>::Type search_;
    [[no_unique_address]] std::conditional_t<Model::has_shadows, Shadows<Model, Real>, NoShadowSteps> shadows_;
    [[no_unique_address]] std::conditional_t<by_clock, Impacts, NoImpactSteps> impacts_;
    [[no_unique_address]] std::conditional_t<Stepper::ends_early, EarlyEnds<Real>, NoEarlyEnds> early_;
    Attempt<Model, Real> attempt_;  // the members' own
    double max_step_;
    Mask<Real> left_, known_;  // lanes that leave the stiff method; whose watch knows their last step
};

}  // namespace slideway::inline SLIDEWAY_ISA
