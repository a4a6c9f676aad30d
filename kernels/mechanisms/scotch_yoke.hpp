#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/drive.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A pin on a driven crank slides across the slider: x = r cos θ (model.md 7).
struct ScotchYokeDrive : DrivenGuide<ScotchYokeDrive> {
    using Base = DrivenBase;
    static constexpr bool is_free = false;
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "scotch_yoke";
        info.meaning = "slider moved along the way as the cosine of a crank's angle";
        info.keys |= groups_of(KeyGroup::crank, KeyGroup::drive, KeyGroup::body, KeyGroup::pin);
        info.drive = DriveKind::crank;
        return info;
    }();

    template <class Real>
    SLIDEWAY_FN static AlongWay<Real> motion(Real t, Real const*, SliderParameters<Real> const& p, DrivePlan const& drive) {
        auto const motion = driven_crank(drive, t, p);
        auto const turned = sincos(motion.place);
        Real const x = p.crank_length * turned.cos, speed = motion.velocity;
        AlongWay<Real> along{x, negated(speed * p.crank_length) * turned.sin, negated(speed * speed) * x};
        if (drive.by == DriveBy::profile) along.ax = fnma(motion.acceleration * p.crank_length, turned.sin, along.ax);
        return along;
    }
    template <class Real>
    SLIDEWAY_FN static GivenMotion<Real> crank(Real t, Real const*, SliderParameters<Real> const& p, DrivePlan const& drive) {
        return driven_crank(drive, t, p);
    }
};

using ScotchYoke = SpatialSlider<ScotchYokeDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA
