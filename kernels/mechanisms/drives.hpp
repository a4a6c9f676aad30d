// What moves a slider along the way that has no crank.
#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/slider_base.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Position, velocity and acceleration along the way's nominal direction.
template <class Real> struct AlongWay { Real x, vx, ax; };

/// The rig of the paper's experiment (Qian et al. 2020, section 2; model.md 7): from x = 0 at +v for T_s = stroke/v, turned round by
/// v cos(π τ/t_r) within t_r, back likewise, and so on.  Position, velocity and acceleration are continuous after the start.
struct CarriageDrive : CarriageBase {
    static constexpr bool is_free = false;

    /// @param t time [s], at least 0.
    template <class Real>
    SLIDEWAY_FN static AlongWay<Real> along(Real t, Real const*, SliderParameters<Real> const& p) {
        Real const zero(0.0), half(0.5);
        // Half periods done; whether the last bit of t counts as the end of one or the start of the next makes no difference.
        Real const strokes = round_even(fma(t, p.stroke_rate, negated(half)));
        Real const tau = fnma(strokes, p.stroke_time + p.reversal_time, t);
        auto const back = fnma(Real(2.0), round_even(fma(half, strokes, Real(-0.25))), strokes) > half;
        Real const turning_for = tau - p.stroke_time;
        auto const turns = turning_for > zero;
        auto const turn = sincos(select(turns, turning_for * p.reversal_rate, zero));
        Real const speed = select(back, negated(p.carriage_speed), p.carriage_speed);
        Real const start = select(back, p.carriage_speed * p.stroke_time, zero);
        Real const gone = select(turns, p.stroke_time + turn.sin / p.reversal_rate, tau);
        return {fma(speed, gone, start), select(turns, speed * turn.cos, speed),
                select(turns, negated(speed * p.reversal_rate) * turn.sin, zero)};
    }
};

/// Nothing: x and vx join the state, behind the ten.
struct NoDrive : FreeSliderBase {
    static constexpr bool is_free = true;

    /// Without the acceleration, which the forces give.
    template <class Real> SLIDEWAY_FN static AlongWay<Real> along(Real, Real const* s, SliderParameters<Real> const&) {
        return {s[10], s[11], Real(0.0)};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
