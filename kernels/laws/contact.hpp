#pragma once

#include "kernels/laws/damping.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/line.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the laws need to know of a face, beside its motion.
template <class Real> struct FaceContact {
    Real surface_stiffness;    // k = E_s A/l of all four apices [N/m]
    LineContact<Real> across;  // edges a–b and c–d
    LineContact<Real> along;   // edges b–c and d–a
};

template <class Real> struct ContactParameters {
    PointContact<Real> point;
    DampingParameters<Real> damping;
    LineContact<Real> along;          // edges along X, both kinds of face
    LineContact<Real> across_y_face;  // edges of the Y faces along Z
    LineContact<Real> across_z_face;  // edges of the Z faces along Y
    Real surface_stiffness_y;
    Real surface_stiffness_z;
    Quad<Real> of_law;  // law_a … law_d of the inputs
};

/// A law with its damping, as the joint calls it: the forces of one face, with or without their elastic part and potential, and
/// their derivatives.  Behind pointers: a mechanism is compiled once for all laws, and a law once for all mechanisms.
template <class Real> struct LawFunctions {
    using Forces = FaceForces<Real>(FaceMotion<Real> const&, FaceContact<Real> const&, ContactParameters<Real> const&);
    using Stiffness = FaceStiffness<Real>(FaceMotion<Real> const&, FaceContact<Real> const&,
                                          ContactParameters<Real> const&);
    Forces* lean_forces = nullptr;
    Forces* full_forces = nullptr;
    Stiffness* face_stiffness = nullptr;
    bool rates_couple = false;  // the rate of one apex changes the force of another

    template <bool Full>
    SLIDEWAY_FN FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                        ContactParameters<Real> const& contact) const {
        return (Full ? full_forces : lean_forces)(m, face, contact);
    }
    SLIDEWAY_FN FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                              ContactParameters<Real> const& contact) const {
        return face_stiffness(m, face, contact);
    }
    SLIDEWAY_FN bool couples() const { return rates_couple; }

    template <class Law, class Damping> static constexpr LawFunctions of() {
        return {&Law::template forces<Damping, false, Real>, &Law::template forces<Damping, true, Real>,
                &Law::template stiffness<Damping, Real>, Damping::couples};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
