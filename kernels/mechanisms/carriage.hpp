#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/drive.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Its period is to and fro.
struct CarriageBase : DrivenBase {
    SLIDEWAY_HD static SliderParameters<double> parameters(Inputs const& in) {
        auto p = DrivenBase::parameters(in);
        p.rate_scale = max(3.14159265358979323846 * p.stroke_rate, 1.0);
        return p;
    }
    SLIDEWAY_FN static double speed_along(SliderParameters<double> const& p) { return p.carriage_speed; }
};

/// The rig of the paper's experiment (Qian et al. 2020, section 2; model.md 7): from x = 0 at +v for T_s = stroke/v, turned round by
/// v cos(π τ/t_r) within t_r, back likewise, and so on.  Position, velocity and acceleration are continuous after the start.  Or as a
/// profile says.
struct CarriageDrive : DrivenGuide<CarriageDrive> {
    using Base = CarriageBase;
    static constexpr bool is_free = false;
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "carriage";
        info.meaning = "slider moved to and fro along the way at constant speed, as in the paper's experiment";
        info.keys |= groups_of(KeyGroup::carriage, KeyGroup::drive, KeyGroup::body, KeyGroup::pin);
        info.drive = DriveKind::carriage;
        return info;
    }();

    /// @param t time [s], at least 0.
    template <class Real>
    SLIDEWAY_FN static AlongWay<Real> motion(Real t, Real const*, SliderParameters<Real> const& p, DrivePlan const& drive) {
        if (drive.by == DriveBy::profile) {
            auto const given = profile_motion(*drive.table, t);
            return {p.motor.scale * given.place, p.motor.scale * given.velocity, p.motor.scale * given.acceleration};
        }
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

using Carriage = SpatialSlider<CarriageDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA
