#pragma once

#include <type_traits>

#include "kernels/lanes/crossing_search.hpp"
#include "kernels/lanes/event_search.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/lanes/shadows.hpp"
#include "kernels/lanes/stiffness.hpp"
#include "kernels/math/squared_ratios.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/step_control.hpp"

namespace slideway::inline SLIDEWAY_ISA {

struct NoSearch {};
struct NoShadowSteps {
    explicit SLIDEWAY_HD NoShadowSteps(ShadowPlan const&) {}
};

/// A pack of members at work with one stepper for a number of attempts.  Nothing that happens in one lane reaches another.
template <class Stepper, class Model, class Real> class Stint {
public:
    SLIDEWAY_HD Stint(Pack<Model, Real>& pack, Results<Model>& results, IntegratorSettings const& settings)
        : pack_(pack), results_(results), settings_(settings), shadows_(results.shadows()) {
        max_step_ = Stepper::stiff ? settings.stiff_max_step : settings.max_step;
    }

    /// Every lane attempts `attempts` steps, unless its member ends or leaves the stiff method before.
    SLIDEWAY_HD void work(int attempts) {
        left_ = mask_of<Real>(false);
        auto const members = pack_.busy;
        int const members_at_start = held_lanes(members);
        for (int i = 0; i < attempts && any(pack_.busy); ++i) {
            // Where nothing is decided between stints, a lane that falls free ends the stint and is filled at once.
            if (!Model::has_patterns && held_lanes(pack_.busy) < members_at_start) break;
            begin();
            // Before the member: what the stepper knows of the step is then the member's.
            if constexpr (Model::has_shadows) {
                shadows_.attempt(pack_, stepper_, [&] {
                    if constexpr (Stepper::adaptive) return squared_error_norm();
                });
            }
            stepper_.attempt(pack_);
            settle();
        }
        pack_.busy = members & (pack_.busy | left_);
    }

private:
    static constexpr int size = Model::size;
    static constexpr int width = lanes<Real>;
    /// Least step, in units of the end time.
    static constexpr double time_resolution = Model::has_shadows ? 1e-19 : 8 * 2.220446049250313e-16;
    static constexpr bool impacts_end_it = Stepper::stiff && Model::has_patterns;
    using Control = StepControl<Stepper::order>;

    /// Chooses the step.
    SLIDEWAY_HD void begin() {
        auto& c = pack_.state.course;
        target_ = pack_.state.constants.end;
        if (results_.stops() > 0) target_ = min(target_, results_.next_stop(pack_.state));
        if constexpr (Stepper::stiff) {
            if (results_.samples() > 0) target_ = results_.next_sample_times(c.sample, c.t, target_);
        }
        Real const remaining = target_ - c.t;
        Real const h = Stepper::adaptive ? c.h : Real(settings_.fixed_step);
        // A last step a hair short of the end would leave a crumb below the resolution of time.
        lands_ = remaining <= h * Real(1.000001);
        pack_.step = select(pack_.busy, select(lands_, remaining, h), Real(0.0));
        pack_.count_evaluations(pack_.busy, Stepper::evaluations);
        results_.count_attempt(width, held_lanes(pack_.busy));
    }

    /// Squared errors of the components, each against its tolerance, over the number of states; the integrals of the audit, where it
    /// runs, come on top.  NaN where any is NaN.
    /// Of the stiff method's errors what lasts meets the tolerance, the whole with its ringing `stiff_tolerance` at least.
    SLIDEWAY_HD Real squared_error_norm() {
        Real const rtol(settings_.rtol), atol(settings_.atol);
        auto const& s = pack_.state;
        SquaredRatios<Real> sum;
        if constexpr (Stepper::stiff) stepper_.filter_error(Real(max_step_));
        for (int i = 0; i < size; ++i) {
            Real const amount = max(abs(s.course.y[i]), abs(pack_.end[i])), scale = s.constants.scale[i];
            Real const tolerance = fma(rtol, amount, atol * scale);
            if constexpr (Stepper::stiff) {
                Real const least(settings_.stiff_tolerance);
                sum.add(stepper_.lasting_error(pack_, i), tolerance);
                sum.add(stepper_.error(pack_, i), fma(max(rtol, least), amount, max(atol, least) * scale));
            } else {
                sum.add(stepper_.error(pack_, i), tolerance);
            }
        }
        // The damping power has a kink where a contact begins, which the states hardly feel: the audit controls its own error.
        constexpr int audit_integrals = Pack<Model, Real>::Observer::audit_integrals;
        if constexpr (audit_integrals > 0) {
            if (!pack_.needs.audit) return sum.total() * Real(1.0 / size);
            Real const energy = atol * Model::energy_scale(s.constants.parameters);
            for (int i = 0; i < audit_integrals; ++i) {
                sum.add(pack_.step * pack_.audit_error[i], fma(rtol, abs(s.observation.observer.integral(i)), energy));
            }
        }
        return sum.total() * Real(1.0 / size);
    }

    /// Accepts or rejects per lane.
    SLIDEWAY_HD void settle() {
        auto& c = pack_.state.course;
        auto const busy = pack_.busy;
        Real const step = pack_.step;
        Real const resolution = Real(time_resolution) * pack_.state.constants.end;
        Mask<Real> accepted, cut = mask_of<Real>(false);
        Real wish = step;
        auto divergent = mask_of<Real>(false);
        if constexpr (Stepper::adaptive) {
            Real squared_norm = squared_error_norm();
            if constexpr (Model::has_shadows) {
                squared_norm = larger_norm(squared_norm, shadows_.squared_norm());
            }
            accepted = busy & (squared_norm <= Real(1.0));
            divergent = !(squared_norm < Real(1e300));
            // Whether what is beyond all bounds came out infinite or NaN may be the neighbours' doing.
            squared_norm = select(divergent, Real(not_a_number), squared_norm);
            Real const former_memory = c.error_memory;
            wish = step * Control::factor(squared_norm, accepted, c.rejections > Real(0.5), c.error_memory);
            // A step that was shortened to land says little of what the next may be.
            wish = select(accepted & lands_, max(wish, c.h), wish);
            if constexpr (Model::has_contacts) {
                if (pack_.needs.watch()) {
                    // A touch must end its step: it sets the impact speed of what follows, or the law that holds.
                    auto const early = accepted & (step > resolution * Real(64.0));
                    using Watch = typename Model::template Watch<Real>;
                    auto const watching = pack_.needs.watching;
                    double tolerance = Watch::tolerance(watching);
                    if constexpr (Model::has_shadows) tolerance = Shadows<Model, Real>::located;
                    Real const located = Real(tolerance) * Model::touch_scale(pack_.state.constants.parameters);
                    Real fraction =
                        pack_.state.contacts.watch.earliest(early, pack_.end_report.contact, step, located, watching);
                    if constexpr (Model::has_shadows)
                        fraction = min(fraction, shadows_.earliest(pack_, early, located));
                    cut = fraction < Real(1.0);
                    c.error_memory = select(cut, former_memory, c.error_memory);
                    accepted = accepted & !cut;
                    wish = select(cut, max(step * fraction, resolution * Real(32.0)), wish);
                    if constexpr (Model::has_shadows) {
                        // Events of member and shadow are next to each other: after the second nothing would be left of the step.
                        Real& uncut = c.shadowed.uncut;
                        wish = select(accepted, max(wish, uncut), wish);
                        uncut = select(accepted, Real(0.0), select(cut, max(uncut, step), uncut));
                    }
                }
            }
        } else {
            accepted = busy & is_finite(pack_.end, pack_.end_rates);
            if constexpr (Model::has_shadows) accepted = accepted & shadows_.finite();
            divergent = busy & !accepted;
        }
        auto impact = mask_of<Real>(false);
        if constexpr (impacts_end_it) {
            impact = find_impacts(accepted);
            accepted = accepted & !impact;
        }
        auto const rejected = busy & !accepted;
        c.accepted = c.accepted + count<Real>(accepted);
        c.rejected = c.rejected + count<Real>(rejected);
        c.rejections = select(busy, count<Real>(rejected & !cut), c.rejections);
        auto const still = rejected & (wish <= resolution);
        auto stuck = Stepper::adaptive ? still : rejected;
        if constexpr (Model::has_shadows) pack_.faults = pack_.faults.or_else(shadows_.faults());

        auto finished = mask_of<Real>(false);
        if (any(accepted)) {
            finished = advance(accepted);
            if constexpr (Model::events > 0) stuck = stuck | search_.piled_up(pack_);
        }
        c.h = select(busy, min(wish, Real(max_step_)), c.h);
        auto const spent =
            busy & !finished & (c.accepted + c.rejected >= Real(static_cast<double>(settings_.max_steps)));
        auto const ended = finished | stuck | spent;
        if (any(ended)) {
            results_.retire(pack_, ended, finished, pack_.faults.within(stuck), stuck & divergent, stuck);
            pack_.busy = pack_.busy & !ended;
        }
        if constexpr (Stepper::stiff) watch_stiffness(accepted, impact);
    }

    /// Moves the accepted lanes to the end of their step.  @return those that reached the end time.
    SLIDEWAY_HD Mask<Real> advance(Mask<Real> accepted) {
        auto& c = pack_.state.course;
        auto landed = accepted & lands_;
        Real t_end = select(landed, target_, time_after_step(accepted, landed));
        if constexpr (Model::events > 0) {
            search_.run(pack_, stepper_, accepted);
            t_end = select(search_.ended(), fma(pack_.step, search_.fraction(), c.t), t_end);
            landed = landed & !search_.ended();
        }
        if constexpr (Model::has_crossings && !Model::has_shadows) {
            if (results_.crossings().room > 0) CrossingSearch<Stepper, Model, Real>::run(pack_, results_, accepted);
        }
        if (results_.samples() > 0) results_.take_samples(pack_, stepper_, accepted, t_end);
        if constexpr (Model::events > 0) search_.reset(pack_);
        if (pack_.needs.quantities) {
            pack_.state.observation.observer.accept(accepted, pack_.step, pack_.integral, pack_.end_report, pack_.end,
                                                    pack_.needs.switches);
            pack_.with_accelerations([&](auto& a) { a.accept(accepted, pack_.step, pack_.end_report); });
        }
        for (int i = 0; i < size; ++i) c.y[i] = select(accepted, pack_.end[i], c.y[i]);
        c.t = select(accepted, t_end, c.t);
        if constexpr (Stepper::stiff) c.stiff_steps = c.stiff_steps + count<Real>(accepted);
        pack_.begin_next(accepted, pack_.end_rates);
        if constexpr (Model::has_contacts) {
            if (pack_.needs.watch()) {
                auto& [memory, watch] = pack_.state.contacts;
                auto const touched = watch.update(accepted, pack_.end_report.contact, memory, c.y, pack_.needs.watching);
                if (any(touched)) restart(touched);
            }
        }
        if constexpr (Model::has_shadows) shadows_.advance(pack_, accepted);
        if (results_.stops() > 0) stop(landed);
        auto finished = landed & (c.t >= pack_.state.constants.end);
        if constexpr (Model::events > 0) {
            if (pack_.needs.quantities) {
                auto& observer = pack_.state.observation.observer;
                observer.settle(accepted & Model::at_rest(c.rates), c.y);
                finished = finished | (accepted & observer.complete());
            }
        }
        return finished;
    }

    SLIDEWAY_HD Real time_after_step(Mask<Real> accepted, Mask<Real> landed) {
        auto& c = pack_.state.course;
        if constexpr (!Model::has_shadows) {
            return c.t + pack_.step;
        } else {
            // The sum and what it rounds off (Knuth's two-sum); a landing starts a new count.
            Real const step = pack_.step + c.shadowed.fine_time, sum = c.t + step;
            Real const of_step = sum - c.t;
            Real const rest = (c.t - (sum - of_step)) + (step - of_step);
            c.shadowed.fine_time = select(accepted, select(landed, Real(0.0), rest), c.shadowed.fine_time);
            return sum;
        }
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

    /// New impact speeds or other contacts change the derivative at the same state.
    SLIDEWAY_HD void restart(Mask<Real> touched) {
        auto const& c = pack_.state.course;
        pack_.evaluate(c.t, c.y, pack_.end_rates, true, pack_.end_report);
        pack_.count_evaluations(touched, 1);
        if (pack_.needs.quantities) pack_.state.observation.observer.resume(touched, pack_.end_report, pack_.needs.switches);
        pack_.begin_next(touched, pack_.end_rates);
    }

    /// Lanes whose step brought an apex into contact at speed.  The stiff method would swallow the impact's energy without a
    /// sign: `auto` leaves impacts to the explicit pair.  What counts is how fast the apex approached its face: a slider that glides along
    /// one, with a corner that rattles on it at next to no speed, has no impacts.
    SLIDEWAY_HD Mask<Real> find_impacts(Mask<Real> accepted) {
        auto const& s = pack_.state;
        if (settings_.method != Method::automatic) return mask_of<Real>(false);
        // At either end: a slider lifted from rest meets the other face within one long step.
        Real const squared_speed = max(Model::squared_speed(s.course.y, s.constants.scale),
                                       Model::squared_speed(pack_.end, s.constants.scale));
        auto const moves = squared_speed > Real(Stiffness::creep_below * Stiffness::creep_below);
        if (none(accepted & moves)) return mask_of<Real>(false);
        auto const& p = s.constants.parameters;
        Real const speed = pack_.model.approach_speed(s.course.t, s.course.y, pack_.step, pack_.end, p);
        return accepted & moves & (speed > Real(Stiffness::impact_above));
    }

    /// A lane leaves the stiff method where contact is lost or an impact begins, or its steps stay far below what that method is for.
    SLIDEWAY_HD void watch_stiffness(Mask<Real> accepted, Mask<Real> impact) {
        auto& c = pack_.state.course;
        Real const rate = sqrt(max(stepper_.rate_squared(), Real(0.0)));
        auto const calm = pack_.step * rate < Real(Stiffness::calm_below);
        c.stiffness = select(accepted, select(calm, c.stiffness + Real(1.0), Real(0.0)), c.stiffness);
        auto const free = stepper_.touching() < Real(0.5);
        auto const leaving = pack_.busy & (free | impact | (c.stiffness >= Real(Stiffness::calm_steps)));
        if (none(leaving) || settings_.method != Method::automatic) return;
        c.stiffness = select(leaving, Real(0.0), c.stiffness);
        c.stiff = select(leaving, Real(0.0), c.stiff);
        Real const explicit_step = min(Real(1.0) / max(rate, Real(1e-9)), Real(settings_.max_step));
        c.h = select(leaving, min(c.h, explicit_step), c.h);
        left_ = left_ | leaving;
        pack_.busy = pack_.busy & !leaving;
    }

    Pack<Model, Real>& pack_;
    Results<Model>& results_;
    IntegratorSettings const& settings_;
    Stepper stepper_;
    [[no_unique_address]] std::conditional_t<(Model::events > 0), EventSearch<Model, Real>, NoSearch> search_;
    [[no_unique_address]] std::conditional_t<Model::has_shadows, Shadows<Model, Real>, NoShadowSteps> shadows_;
    double max_step_;
    Real target_;
    Mask<Real> lands_, left_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
