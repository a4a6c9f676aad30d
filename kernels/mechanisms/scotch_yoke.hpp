#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/drive.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A pin on a crank of constant speed slides across the slider: x = r cos θ, θ = θ0 + ω t (docs/model.md 7).
struct ScotchYokeDrive : DrivenGuide<ScotchYokeDrive> {
    using Base = DrivenBase;
    static constexpr bool is_free = false;
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "scotch_yoke";
        info.meaning = "slider moved along the way as the cosine of a crank's angle";
        info.keys |= groups_of(KeyGroup::crank);
        info.drive = DriveKind::crank;
        return info;
    }();

    template <class Real>
    SLIDEWAY_FN static AlongWay<Real> motion(Real t, Real const*, SliderParameters<Real> const& p) {
        auto const crank = sincos(fma(p.crank_speed, t, p.start_angle));
        Real const x = p.crank_length * crank.cos, speed = p.crank_speed;
        return {x, negated(speed * p.crank_length) * crank.sin, negated(speed * speed) * x};
    }
};

using ScotchYoke = SpatialSlider<ScotchYokeDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA
