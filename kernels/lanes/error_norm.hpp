#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/math/squared_ratios.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What error control makes of the errors of an attempt.
template <class Stepper, class Model, class Real> struct ErrorNorm {
    /// Squared errors of the components, each against its tolerance, over the number of states; the integrals of the audit, where it
    /// runs, come on top.  NaN where any is NaN.
    /// Of the stiff method's errors what lasts meets the tolerance, the whole with its ringing `stiff_tolerance` at least.
    SLIDEWAY_HD static Real squared(Pack<Model, Real> const& pack, Stepper& stepper, IntegratorSettings const& settings,
                                    StepStart<Model, Real> const& from, Attempt<Model, Real> const& to) {
        Real const rtol(settings.rtol), atol(settings.atol);
        auto const& s = pack.state;
        SquaredRatios<Real> sum, coarse;
        if constexpr (Stepper::stiff) stepper.filter_error(Real(settings.stiff_max_step));
        for (int i = 0; i < Model::size; ++i) {
            Real const amount = max(abs(from.y[i]), abs(to.end[i])), scale = s.constants.scale[i];
            Real const tolerance = fma(rtol, amount, atol * scale);
            if constexpr (Stepper::stiff) {
                Real const least(settings.stiff_tolerance);
                sum.add(stepper.lasting_error(to, i), tolerance);
                sum.add(stepper.error(to, i), fma(max(rtol, least), amount, max(atol, least) * scale));
            } else {
                sum.add(stepper.error(to, i), tolerance);
                if constexpr (Stepper::has_two_estimates) coarse.add(stepper.coarse_error(to, i), tolerance);
            }
        }
        // The damping power has a kink where a contact begins, which the states hardly feel: the audit controls its own error.
        constexpr int audit_integrals = Pack<Model, Real>::Observer::audit_integrals;
        if constexpr (audit_integrals > 0) {
            if (!from.needs.audit) return mean_square(sum, coarse);
            Real const energy = atol * Model::energy_scale(s.constants.parameters), part(Stepper::stiff ? stiff_audit : 1.0);
            for (int i = 0; i < audit_integrals; ++i) {
                Real const tolerance = part * fma(rtol, abs(s.observation.observer.integral(i)), energy);
                sum.add(to.step * pack.audit_error[i], tolerance);
                if constexpr (Stepper::has_two_estimates) coarse.add(to.step * pack.coarse_audit_error[i], tolerance);
            }
        }
        return mean_square(sum, coarse);
    }

private:
    /// Part of the tolerance that integrals have in stiff steps: the forces at their stages, which the integrals are made of, are off by more than
    /// what the states come to.
    static constexpr double stiff_audit = 0.1;

    /// Of two estimates a norm that falls with the order of the method: a²/(a² + b²/100) of the sums of squares a of the fine and b of the
    /// coarse one times a² (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (1993), II.10).
    SLIDEWAY_FN static Real mean_square(SquaredRatios<Real> const& sum, SquaredRatios<Real> const& coarse) {
        Real const fine = sum.total();
        if constexpr (!Stepper::has_two_estimates) return fine * Real(1.0 / Model::size);
        Real const both = max(Real(1e-300), fma(Real(0.01), coarse.total(), fine));
        return fine * (fine / both) * Real(1.0 / Model::size);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
