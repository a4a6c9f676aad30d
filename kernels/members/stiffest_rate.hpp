// How fast a slider rings on its contacts.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/laws/law_info.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

/// Rate Ω [rad/s] of the stiffest motion of a slider that lies on one of its faces: with the stiffness k of the face under the law it moves as a
/// whole at √(k/M), rocks at √(k (L_k/2)²/I) and rolls at √(k (w/2)²/I) (stability.md).
/// Of the planar block, whose corners stiffen with depth: at two corners' largest stiffness in an impact at the speed of the crank's pin,
/// M v²/2 = 2 K δ^(n+1)/(n+1); inputs complete.
static inline double stiffest_rate(MechanismInfo const& mechanism, LawInfo const& law, Inputs const& in) {
    if (!mechanism.spatial) {
        double const n = in.hertz_exponent, speed = std::max(std::abs(in.crank_speed * in.drive_scale), in.drive_no_load_speed) * in.crank_length;
        double const depth = std::pow((n + 1) * in.slider_mass * speed * speed / (4 * in.point_stiffness), 1 / (n + 1));
        double const stiffness = 2 * n * in.point_stiffness * std::pow(depth, n - 1), arm = in.slider_length / 2;
        return std::sqrt(stiffness * std::max(1 / in.slider_mass, arm * arm / in.slider_inertia_z));
    }
    double const e1 = in.slider_young_modulus, e2 = in.way_young_modulus;
    double const series = 2 * e1 * e2 / (e1 + e2);
    auto const face = [&](double width, double thickness, double rocking_inertia) {
        double const area = in.slider_length * width, surface = series * area / thickness;
        double const stiffness = law.face_stiffness != nullptr ? law.face_stiffness(in, surface, area) : surface;
        auto const turning = [&](double length, double inertia) { return stiffness * length * length / (4 * inertia); };
        return std::max({stiffness / in.slider_mass, turning(in.slider_length, rocking_inertia),
                         turning(width, in.slider_inertia_x)});
    };
    return std::sqrt(std::max(face(in.way_depth, in.thickness_y, in.slider_inertia_z),
                              face(in.way_width, in.thickness_z, in.slider_inertia_y)));
}

}  // namespace slideway
