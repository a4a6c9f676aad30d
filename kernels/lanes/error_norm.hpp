#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/math/squared_ratios.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What error control makes of the errors of an attempt.
template <class Stepper, class Model, class Real> struct ErrorNorm {
    /// Squared errors of the components, each against its tolerance, over the number of states, those of the audit on top.  NaN where any is NaN.
    /// Of the stiff method's errors what lasts meets the tolerance, the whole with its ringing `stiff_tolerance` at least.
    SLIDEWAY_HD static Real squared(Pack<Model, Real> const& pack, Stepper& stepper, IntegratorSettings const& settings,
                                    StepStart<Model, Real> const& from, Attempt<Model, Real> const& to) {
        int const n = pack.states();
        if constexpr (Stepper::stiff) {
            stepper.filter_error(Real(settings.stiff_max_step));
            Real whole[size], lasting[size];
            stepper.errors(to, whole);
            stepper.lasting_errors(whole, lasting);
            SquaredRatios<Real> sum;
            SLIDEWAY_UNROLL
            for (int i = 0; i < n; ++i) {
                sum.add(lasting[i], tolerance(pack, settings, from, to, i, 0.0));
                sum.add(whole[i], tolerance(pack, settings, from, to, i, settings.stiff_tolerance));
            }
            add_audit(pack, settings, from, to, pack.audit_error, sum);
            return sum.total() * Real(1.0 / n);
        } else {
            Real errors[size];
            stepper.errors(to, errors);
            Real const fine = sum_of(pack, settings, from, to, errors, pack.audit_error);
            if (!stepper.has_two_estimates()) return fine * Real(1.0 / n);
            // A norm that falls with the order of the method: a²/(a² + b²/100) of the sums of squares a of the fine estimate and b of the
            // coarse one times a² (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (1993), II.10).
            stepper.coarse_errors(to, errors);
            Real const coarse = sum_of(pack, settings, from, to, errors, pack.coarse_audit_error);
            return fine * (fine / max(Real(1e-300), fma(Real(0.01), coarse, fine))) * Real(1.0 / n);
        }
    }

private:
    static constexpr int size = Model::size;

    /// Of one component.  @param least of rtol and atol
    SLIDEWAY_FN static Real tolerance(Pack<Model, Real> const& pack, IntegratorSettings const& settings, StepStart<Model, Real> const& from,
                                      Attempt<Model, Real> const& to, int i, double least) {
        Real const amount = max(abs(from.y[i]), abs(to.end[i]));
        return fma(max(Real(settings.rtol), Real(least)), amount, max(Real(settings.atol), Real(least)) * pack.state.constants.scale[i]);
    }

    SLIDEWAY_FN static void add(Pack<Model, Real> const& pack, IntegratorSettings const& settings, StepStart<Model, Real> const& from,
                                Attempt<Model, Real> const& to, Real const* errors, int n, SquaredRatios<Real>& sum) {
        SLIDEWAY_UNROLL
        for (int i = 0; i < n; ++i) sum.add(errors[i], tolerance(pack, settings, from, to, i, 0.0));
    }
    SLIDEWAY_FN static Real sum_of(Pack<Model, Real> const& pack, IntegratorSettings const& settings, StepStart<Model, Real> const& from,
                                   Attempt<Model, Real> const& to, Real const* errors, Real const* audit_error) {
        SquaredRatios<Real> sum;
        pack.states().visit([&](auto n) { add(pack, settings, from, to, errors, n, sum); });
        add_audit(pack, settings, from, to, audit_error, sum);
        return sum.total();
    }

    /// The damping power has a kink where a contact begins, which the states hardly feel: the audit controls its own error.
    SLIDEWAY_FN static void add_audit(Pack<Model, Real> const& pack, IntegratorSettings const& settings, StepStart<Model, Real> const& from,
                                      Attempt<Model, Real> const& to, Real const* error, SquaredRatios<Real>& sum) {
        if constexpr (Pack<Model, Real>::Observer::audit_integrals > 0) {
            if (!from.needs.audit) return;
            auto const& s = pack.state;
            Real const energy = Real(settings.atol) * Model::energy_scale(s.constants.parameters), part(Stepper::stiff ? stiff_audit : 1.0);
            // Where rigid contacts slide the work of normal forces is rounding: what matters is all of the balance.
            Real least(0.0);
            if (Stepper::stiff && IsRigid<Model>) {
                pack.each_audited([&](int, int integral) { least = max(least, abs(s.observation.observer.integral(integral))); });
            }
            pack.each_audited([&](int i, int integral) {
                Real const amount = max(least, abs(s.observation.observer.integral(integral)));
                sum.add(to.step * error[i], part * fma(Real(settings.rtol), amount, energy));
            });
        }
    }

    /// Part of the tolerance that integrals have in stiff steps: the forces at their stages, which the integrals are made of, are off by more than
    /// what the states come to.
    static constexpr double stiff_audit = 0.1;
};

}  // namespace slideway::inline SLIDEWAY_ISA
