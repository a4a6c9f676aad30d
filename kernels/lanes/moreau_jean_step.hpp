#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/stepper_traits.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Time stepping by the midpoint rule of Moreau and Jean (M13.15): places go half a step with the rates of the start, what touches there has
/// impulses against the rates that the step would end with, and places go on with the rates that it does end with.  Without events; of first order, and of
/// second in flight.
/// Source: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics (1988); M. Jean, The non-smooth contact dynamics method (1999).
template <class Model, class Real> class MoreauJeanStep : public StepperTraits {
public:
    static constexpr bool has_impulses = true;
    SLIDEWAY_HD static bool adapts(Pack<Model, Real> const&) { return false; }  // and so has no errors to tell
    SLIDEWAY_FN static void errors(Attempt<Model, Real> const&, Real*) {}
    SLIDEWAY_HD static int order(Pack<Model, Real> const&) { return 2; }        // in flight
    SLIDEWAY_HD static int evaluations(Pack<Model, Real> const&) { return 2; }  // per attempt

    /// Idle lanes step in place.
    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        Real const half = Real(0.5) * to.step;
        states_ = pack.states();
        Real middle[size], start[size], moved[size];
        for (int i = 0; i < states_; ++i) {
            middle[i] = fma(half, from.rates[i], from.y[i]);
            start[i] = is_rate(i) ? from.y[i] : middle[i];
        }
        if (from.needs.stages) pack.begin_integrals(at_an_end);
        Report report;
        to.faults = pack.evaluate(from.t + half, middle, from.memory, rates_, true, report);
        for (int i = 0; i < states_; ++i) moved[i] = is_rate(i) ? fma(to.step, rates_[i], from.y[i]) : middle[i];
        auto const& p = pack.state.constants.parameters;
        auto const failed = pack.model.push(from.t + half, to.step, start, moved, p, report.contact);
        Real after[size];
        pack.model.put_place_rates(moved, p, after);
        for (int i = 0; i < states_; ++i) {
            if (!is_rate(i)) rates_[i] = after[i];
            to.end[i] = is_rate(i) ? moved[i] : fma(half, rates_[i], moved[i]);
        }
        to.faults = to.faults.or_else(pack.evaluate(from.t + to.step, to.end, from.memory, to.end_rates, from.needs.ends, to.report));
        to.faults.contact_domain = to.faults.contact_domain | failed;
        Real& last = to.end_rates[states_ - 1];
        last = select(failed, Real(not_a_number), last);
        if (from.needs.ends) tell(report.contact, to.report.contact);
        if (from.needs.stages) pack.add_integrands(at_an_end, to.report);
    }

    /// The state inside the step, at fraction θ of it: straight lines to either side of its middle, where the impulses are.
    SLIDEWAY_FN void dense(StepStart<Model, Real> const& from, Attempt<Model, Real> const& to, Real theta, Real* state) const {
        auto const early = theta < Real(0.5);
        Real const since = theta * to.step, left = to.step - since;
        for (int i = 0; i < states_; ++i) {
            Real const slope = is_rate(i) ? rates_[i] : from.rates[i];
            state[i] = select(early, fma(since, slope, from.y[i]), fnma(left, rates_[i], to.end[i]));
        }
    }

private:
    using Report = typename Model::template Report<Real>;
    static constexpr int size = Model::size;
    /// Integrals over a step are those of the trapezium: the rates of its middle jump.
    static constexpr StageWeights at_an_end{0.5, 0};

    /// Books and modes of the impulses, of which the end knows nothing.
    template <class Contact> SLIDEWAY_FN static void tell(Contact const& middle, Contact& end) {
        end.books = middle.books;
        end.surfaces = middle.surfaces;
        end.lines = middle.lines;
        end.points = middle.points;
    }

    static constexpr bool is_rate(int i) { return (Model::rate_components >> i & 1u) != 0; }

    StateCount<Model> states_;
    Real rates_[size];  // of places in the second half of the step, of rates without impulses
};

}  // namespace slideway::inline SLIDEWAY_ISA
