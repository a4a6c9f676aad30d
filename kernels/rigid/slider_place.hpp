#pragma once

#include "kernels/joint/way.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A slider with a rigid joint in one state.
template <class Guide, class Real> struct SliderPlace {
    typename Guide::template At<Real> guide;
    SliderTurning<Real> turning;
    JointMotion<Real> motion;
    JointPairs<Guide, Real> pairs;
    Twist<Real> velocity;
    JointGeometry<Real> const& geometry;

    SLIDEWAY_FN SliderPlace(Real t, Real const* s, SliderParameters<Real> const& p, bool misaligned, Faults<Real>& faults)
        : guide(t, s, p, faults),
          turning(SliderTurning<Real>::of(s)),
          motion(joint_motion(misaligned, turning.axes, Vec3<Real>{guide.x, s[0], s[1]}, Vec3<Real>{guide.vx, s[2], s[3]}, turning.spin,
                              p.joint.way)),
          pairs(guide, motion, turning, p, misaligned),
          velocity(pairs.velocity(s[2], s[3])),
          geometry(p.joint.geometry) {}
};

}  // namespace slideway::inline SLIDEWAY_ISA
