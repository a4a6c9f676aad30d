#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Peaks inside accepted steps.  A step may be a third of an impact, and at its ends forces are then some per cent below their peak.  Where the
/// force at its end comes near the largest so far, reports at its start and at three places inside, of the continuous extension, and the parabola
/// through a largest one and its neighbours tell the peak.
template <class Stepper, class Model, class Real> struct PeakSearch {
    /// Steps whose inside is searched: of stiff ones fast motions are damped, impacts of rigid contacts have no duration.
    static constexpr bool is_of_use = Model::has_contacts && (Pack<Model, Real>::Observer::peaks > 0) && !IsRigid<Model> &&
                                      !HasEvents<Model> && !Stepper::has_impulses && !Stepper::stiff;

    /// @param to the attempt that has been accepted
    SLIDEWAY_HD static void run(Pack<Model, Real>& pack, Stepper& stepper, Attempt<Model, Real> const& to, Mask<Real> accepted) {
        auto const near = pack.state.observation.observer.comes_near_peaks(accepted, to.step, to.report);
        if (any(near)) search(pack, stepper, to, near);
    }

private:
    static constexpr int places = 5;  // with both ends

    SLIDEWAY_NOINLINE static void search(Pack<Model, Real>& pack, Stepper& stepper, Attempt<Model, Real> const& to, Mask<Real> in) {
        using Peaks = typename Pack<Model, Real>::Peaks;
        auto const from = pack.start();
        Peaks at[places];
        stepper.prepare_dense(pack, to, in);
        for (int i = 0; i + 1 < places; ++i) {
            Real const theta(static_cast<double>(i) / (places - 1));
            Real state[Model::size], rates[Model::size];
            stepper.dense(from, to, theta, state);
            typename Model::template Report<Real> report;
            pack.evaluate(fma(theta, to.step, from.t), state, from.memory, rates, true, report);
            pack.tell_peaks(report, state, at[i]);
        }
        pack.count_evaluations(in, places - 1);
        pack.tell_peaks(to.report, to.end, at[places - 1]);
        Peaks found;
        for (int k = 0; k < pack.peaks_in_use(); ++k) {
            found.of[k] = at[0].of[k];
            for (int i = 1; i + 1 < places; ++i) found.of[k] = max(found.of[k], vertex(at[i - 1].of[k], at[i].of[k], at[i + 1].of[k]));
        }
        pack.raise_peaks(in, found);
    }

    /// The largest value of a parabola through three that are evenly spaced, if that in the middle is the largest of them; else the latter.
    SLIDEWAY_FN static Real vertex(Real before, Real here, Real after) {
        Real const rise = here - before, fall = here - after, both = rise + fall, half = Real(0.5) * (rise - fall);
        auto const is_top = (rise >= Real(0.0)) & (fall >= Real(0.0)) & (both > Real(0.0));
        return select(is_top, here + half * half / (Real(2.0) * select(is_top, both, Real(1.0))), here);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
