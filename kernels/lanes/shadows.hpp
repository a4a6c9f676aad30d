#pragma once

#include <type_traits>

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/lanes/saltation.hpp"
#include "kernels/lanes/shadow_offset.hpp"
#include "kernels/math/gram_schmidt.hpp"
#include "kernels/math/offset_growth.hpp"
#include "kernels/math/squared_ratios.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The shadows of the members at work.  A shadow takes its member's steps, which meet the tolerance for all of them: the numerical
/// solution is then one and the same map of member and shadow, and their offset is free of what two sequences of steps would differ
/// by.  Where steps end at events they end at those of every shadow too (which method a member is left to, and whether a stiff step
/// met an impact, is decided by the member alone: its shadows are near).  Each meets its contacts a little earlier or later than
/// its member; that is how a jump of the velocity or of the force enters the growth of the offset, and linearised equations would need
/// saltation matrices for it.  Rigid contacts have them (Saltation): steps end at the member's events alone, and what holds a shadow is what
/// holds its member.
template <class Model, class Real> class Shadows {
public:
    static constexpr int size = Model::size;
    using Shadow = typename MemberState<Model, Real>::Shadow;
    using Memory = typename Model::template Memory<Real>;
    static constexpr bool have_events = Model::has_contacts && !IsRigid<Model>;  // of their own

    /// Depth [clearances] up to which an event counts as located.  The offset's part in the positions is some 1e-5 of its length, for in
    /// an impact it is nearly all velocity; this is to be little of that, and rounding is 1e-16.
    SLIDEWAY_HD static double located(double /*alone*/) { return 1e-15; }

    explicit SLIDEWAY_HD Shadows(ShadowPlan const& plan) : plan_(plan) {}

    /// First evaluation of new members' shadows.  @param faults of the members, then with theirs  @return lanes where one has no derivative.
    SLIDEWAY_HD Mask<Real> start(Pack<Model, Real>& pack, Mask<Real> fresh, Faults<Real>& faults) {
        auto broken = mask_of<Real>(false);
        for (int s = 0; s < plan_.count; ++s) {
            auto& shadow = pack.state.shadows[s];
            faults = faults.or_else(refresh(pack, shadow, fresh));
            if constexpr (have_events && requires { pack.model.remembers(); }) {
                auto& [memory, watch] = shadow.contacts;
                auto touching = mask_of<Real>(false);
                if (pack.needs.cuts() && pack.model.remembers()) touching = watch.take_start(fresh, report_.contact, memory);
                if (any(touching)) faults = faults.or_else(evaluate(pack, shadow, touching));
            }
            broken = broken | (fresh & !is_finite(shadow.y, shadow.rates, pack.states()));
        }
        return broken;
    }

    /// All attempt their members' step.  @param step PackStep
    template <class Step> SLIDEWAY_HD void attempt(Step& step) {
        auto& pack = step.pack;
        squared_norm_ = Real(0.0);
        faults_ = Faults<Real>::none();
        finite_ = mask_of<Real>(true);
        for (int s = 0; s < plan_.count; ++s) {
            auto const& shadow = pack.state.shadows[s];
            StepStart<Model, Real> const from{pack.state.course.t, shadow.y, shadow.rates, memory_of(pack, shadow),
                                              pack.needs.template of_shadows<Model>()};
            auto& end = ends_[s];
            end.step = step.attempt.step;
            step.stepper.attempt(pack, from, end);
            if (step.adapts()) {
                squared_norm_ = larger_norm(step.squared_error(from, end), squared_norm_);
            } else {
                finite_ = finite_ & is_finite(end.end, end.end_rates, pack.states());
            }
            faults_ = faults_.or_else(end.faults);
            pack.template count_attempt<std::remove_cvref_t<decltype(step.stepper)>>(pack.busy);
        }
    }

    /// Largest of the squared errors, the member's own among them; NaN where any is.
    SLIDEWAY_HD Real larger_norm_than(Real own) const { return larger_norm(own, squared_norm_); }
    SLIDEWAY_HD Mask<Real> finite_beside(Mask<Real> own) const { return own & finite_; }
    SLIDEWAY_HD Faults<Real> faults_beside(Faults<Real> const& own) const { return own.or_else(faults_); }

    /// Least fraction of the step at which the member or a shadow has an event that ends it.
    SLIDEWAY_HD Real first_event(Pack<Model, Real> const& pack, Mask<Real> candidates, Real located_depth, Real fraction) const {
        for (int s = 0; s < plan_.count; ++s) {
            auto const& watch = pack.state.shadows[s].contacts.watch;
            fraction = min(fraction, watch.earliest(candidates, ends_[s].report.contact, ends_[s].step, located_depth, pack.needs.watching));
        }
        return fraction;
    }

    /// Lanes without a cut go on with the step that one has shortened before: events of member and shadow are next to each other, and
    /// after the second nothing would be left of the step.
    SLIDEWAY_HD void go_on(Pack<Model, Real>& pack, Real step, Mask<Real> cut, Allowance<Real>& allowed) const {
        if (!have_events) return;
        Real& uncut = pack.state.course.shadowed.uncut;
        allowed.next = select(allowed.accepted, max(allowed.next, uncut), allowed.next);
        uncut = select(allowed.accepted, Real(0.0), select(cut, max(uncut, step), uncut));
    }

    /// Moves to the end of the step; the pack's time is that of the end.
    SLIDEWAY_HD void advance(Pack<Model, Real>& pack, Mask<Real> accepted) {
        for (int s = 0; s < plan_.count; ++s) {
            auto& shadow = pack.state.shadows[s];
            auto const& end = ends_[s];
            for (int i = 0, n = pack.states(); i < n; ++i) {
                shadow.y[i] = select(accepted, end.end[i], shadow.y[i]);
                shadow.rates[i] = select(accepted, end.end_rates[i], shadow.rates[i]);
            }
            if constexpr (have_events) {
                if (!pack.needs.cuts()) continue;
                auto& [memory, watch] = shadow.contacts;
                auto const touched = watch.update(accepted, end.report.contact, memory, shadow.y, pack.needs.watching);
                if (any(touched)) evaluate(pack, shadow, touched);
            }
        }
    }

    /// Carries all through what `settle` does to their members in some lanes.  Members then go on with another derivative, from which
    /// `depart` leads.  @param y,rates,contact,memory of the members before that
    template <class Contact>
    SLIDEWAY_NOINLINE void settle(Pack<Model, Real> const& pack, Real const* y, Real const* rates, Contact const& contact, Memory const& memory,
                                  Mask<Real> in, bool at_start) {
        typename Saltation<Model, Real>::Before const event{pack.state.course.t, pack.state.constants.end, y, rates, contact, memory};
        Saltation<Model, Real> const saltation(pack.model, pack.state.constants.parameters, event, in, at_start);
        for (int s = 0; s < plan_.count; ++s) {
            for (int i = 0, n = pack.states(); i < n; ++i) carried_[s].offset[i] = pack.state.shadows[s].y[i] - y[i];
            auto const [delay, apart] = saltation.carry(carried_[s].offset);
            carried_[s].delay = delay;
            carried_[s].apart = apart;
        }
    }

    /// The shadows of members that have settled, in some lanes.
    SLIDEWAY_HD void depart(Pack<Model, Real>& pack, Mask<Real> in) {
        auto& c = pack.state.course;
        for (int s = 0; s < plan_.count; ++s) {
            auto& shadow = pack.state.shadows[s];
            auto& [offset, delay, apart] = carried_[s];
            Real square(0.0);
            int const n = pack.states();
            for (int i = 0; i < n; ++i) {
                offset[i] = fnma(c.rates[i], delay, offset[i]);
                Real const length = offset[i] / pack.state.constants.scale[i];
                square = fma(length, length, square);
            }
            // Near a graze its growth knows no bounds.
            auto const large = !(square <= Real(largest_distance * largest_distance));
            c.shadowed.grown = c.shadowed.grown + count<Real>(in & (apart | large));
            Real const shorter = select(large, Real(largest_distance) / sqrt(square), Real(1.0));
            for (int i = 0; i < n; ++i) {
                Real const moved = fma(offset[i], shorter, c.y[i]);
                shadow.y[i] = select(in, select(moved - moved == Real(0.0), moved, c.y[i]), shadow.y[i]);
            }
            evaluate(pack, shadow, in);
        }
    }

    /// At a stop: how the offsets have grown since the last one, and the shadows put back to d0 in the directions they went.  One is
    /// left alone within its bounds; several are made orthogonal, so that the j-th shows the j-th largest rate (Benettin et al. 1980).
    SLIDEWAY_NOINLINE void stop(Pack<Model, Real>& pack, Results<Model>& results, Mask<Real> at) {
        // Impact speeds differ between member and shadow as the states do, and are part of the offset: one that is measured without them goes on growing in
        // them, however it shrinks in the state.
        bool const speeds = pack.needs.cuts() && pack.needs.watching != Watching::modes;
        rescale_numbers(pack, at, pack.states() + (speeds ? Memory::speeds : 0));
        results.take_growth(pack, at);
    }

private:
    /// @param width numbers of an offset: the state's, and the impact speeds
    SLIDEWAY_HD void rescale_numbers(Pack<Model, Real>& pack, Mask<Real> at, int width) {
        Real w[most_shadows][size + Memory::speeds], length[most_shadows];
        int const n = pack.states();
        auto& counts = pack.state.course.shadowed;
        for (int s = 0; s < plan_.count; ++s) {
            Offset::read(pack, pack.state.shadows[s], width, w[s]);
            auto const large = inner_product(w[s], w[s], width) > Real(largest_distance * largest_distance);
            counts.grown = counts.grown + count<Real>(at & large);
        }
        Real const least = Offset::rounding(pack), d0(plan_.d0);
        unsigned const of_state = (1u << n) - 1;
        orthonormalise(w, plan_.count, width, least, pack.model.prescribed() | ~of_state, length);
        [[maybe_unused]] auto lost = mask_of<Real>(false);
        for (int s = 0; s < plan_.count; ++s) {
            auto& shadow = pack.state.shadows[s];
            auto const shrunk = at & (length[s] < Real(noisy) * shadow.distance);
            auto const found = offset_growth(plan_, at, length[s], shadow.distance, least);
            shadow.growth = select(at, shadow.growth + found.growth, shadow.growth);
            shadow.distance = found.distance;
            counts.lost = counts.lost + count<Real>(at & found.lost);
            lost = lost | (at & found.lost) | shrunk;
            if (none(found.moved)) continue;
            Offset::write(pack, found.moved, w[s], width, d0, shadow);
            refresh(pack, shadow, found.moved);
        }
        if constexpr (IsRigid<Model>) {
            if (any(lost)) hold(pack, lost);
        }
    }

    /// Share of an offset that may be but what rounding left of it, in directions that contacts do not allow.
    static constexpr double noisy = 1e-5;

    /// Takes from offsets along axes or from rounding, which know of no contacts, what holds them: twice, as velocities follow from where the slider is.
    SLIDEWAY_NOINLINE void hold(Pack<Model, Real>& pack, Mask<Real> in) {
        auto const& c = pack.state.course;
        auto const& memory = pack.state.contacts.memory;
        Real rates[size];
        pack.evaluate(c.t, c.y, memory, rates, true, report_);
        pack.count_evaluations(in, 1);
        for (int round = 0; round < 2; ++round) {
            settle(pack, c.y, c.rates, report_.contact, memory, in, true);
            for (int s = 0; s < plan_.count; ++s) {
                Real* const y = pack.state.shadows[s].y;
                for (int i = 0, n = pack.states(); i < n; ++i) y[i] = select(in, c.y[i] + carried_[s].offset[i], y[i]);
            }
        }
        for (int s = 0; s < plan_.count; ++s) evaluate(pack, pack.state.shadows[s], in);
    }

    using Offset = ShadowOffset<Model, Real>;

    /// What the contacts have left behind that hold it.
    SLIDEWAY_FN static Memory const& memory_of(Pack<Model, Real> const& pack, [[maybe_unused]] Shadow const& shadow) {
        if constexpr (IsRigid<Model>)
            return pack.state.contacts.memory;
        else
            return shadow.contacts.memory;
    }

    /// All that follows from a state that was put somewhere.
    SLIDEWAY_HD Faults<Real> refresh(Pack<Model, Real>& pack, Shadow& shadow, Mask<Real> in) {
        auto faults = evaluate(pack, shadow, in);
        if constexpr (have_events) {
            auto& [memory, watch] = shadow.contacts;
            if (pack.needs.cuts()) watch.begin(in, report_.contact, memory, pack.needs.watching);
            if (pack.needs.watching == Watching::modes) {
                // Other contacts are held now, and another derivative.
                faults = evaluate(pack, shadow, in);
                watch.keep(in, report_.contact);
            }
        }
        return faults;
    }

    SLIDEWAY_HD Faults<Real> evaluate(Pack<Model, Real>& pack, Shadow& shadow, Mask<Real> in) {
        Real rates[size];
        auto const faults = pack.evaluate(pack.state.course.t, shadow.y, memory_of(pack, shadow), rates,
                                          pack.needs.cuts() && !IsRigid<Model>, report_);
        pack.count_evaluations(in, 1);
        for (int i = 0, n = pack.states(); i < n; ++i) shadow.rates[i] = select(in, rates[i], shadow.rates[i]);
        return faults.within(in);
    }

    /// Of a shadow between `settle` and `depart`.
    struct Carried {
        Real offset[size], delay;
        Mask<Real> apart;
    };

    ShadowPlan const plan_;
    Attempt<Model, Real> ends_[most_shadows];
    [[no_unique_address]] PartIf<IsRigid<Model>, Carried[most_shadows]> carried_;
    typename Model::template Report<Real> report_;
    Real squared_norm_;
    Faults<Real> faults_;
    Mask<Real> finite_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
