#pragma once

#include <type_traits>

#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/mechanisms/slider_crank_linearisation.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/observers/slider_crank_observer.hpp"
#include "kernels/steppers/mode_locator.hpp"
#include "kernels/steppers/no_watch.hpp"
#include "kernels/steppers/touch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The slider-crank as the lanes integrate it (kernels/integrate.hpp): its equations, what is observed, and what the stiff method
/// and the location of touches need.
template <class Law, class Friction, class Way, class Damping>
struct SliderCrankModel : SliderCrank<Law, Friction, Way, Damping> {
    using Mechanism = SliderCrank<Law, Friction, Way, Damping>;
    static constexpr int series = series_count;
    static constexpr int events = 0;
    static constexpr bool has_patterns = true;
    static constexpr bool has_linearisation = true;
    template <class Real> using Observer = SliderCrankObserver<Real, Mechanism::conserving>;
    template <class Real>
    using Watch = std::conditional_t<Mechanism::has_memory, TouchLocator<Real>,
                                     std::conditional_t<Mechanism::can_hold, ModeLocator<Real>, NoWatch<Real>>>;
    template <class Real> using Linearisation = SliderCrankLinearisation<Real>;

    /// Members whose energy audit says that their method left its stable range.
    template <class Real>
    SLIDEWAY_HD static Mask<Real> left_stable_range(EnergyAudit<Real> const& audit,
                                                    SliderCrankParameters<Real> const& p) {
        return slideway::left_stable_range(audit, Mechanism::energy_scale(p));
    }

    /// Largest of the squared velocities and rates, each in its scale.
    template <class Real> SLIDEWAY_HD static Real squared_speed(Real const* state, Real const* scale) {
        Real largest(0.0);
        for (int i : {2, 3, 7, 8, 9}) {
            Real const speed = state[i] / scale[i];
            largest = max(largest, speed * speed);
        }
        return largest;
    }

    template <class Real>
    SLIDEWAY_HD static void linearise(Real t, Real const* state, SliderCrankParameters<Real> const& p,
                                      typename Mechanism::template Memory<Real> const& memory,
                                      SliderCrankLinearisation<Real>& out) {
        slideway::linearise<Mechanism>(t, state, p, memory, out);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
