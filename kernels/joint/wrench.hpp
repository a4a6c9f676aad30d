#pragma once

#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/laws/contact.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct JointParameters {
    JointGeometry<Real> geometry;
    WayParameters<Real> way;
    ContactParameters<Real> contact;
    FrictionParameters<Real> friction;
};

/// What the way does to the slider, in way coordinates.  The force is what acts on the translation: of the normal forces
/// without their component along the way's X, of friction all (model.md 4, 5).
template <class Real> struct Wrench {
    Vec3<Real> force;   // [N]
    Vec3<Real> torque;  // about the slider's centre [N m]
};

}  // namespace slideway::inline SLIDEWAY_ISA
