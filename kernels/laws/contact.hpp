#pragma once

#include "kernels/inputs.hpp"
#include "kernels/laws/damping.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/line.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the laws need to know of a face, beside its motion: views of the ContactParameters.
template <class Real> struct FaceContact {
    Real const& surface_stiffness;    // k = E_s A/l of all four apices [N/m]
    LineContact<Real> const& across;  // edges a–b and c–d
    LineContact<Real> const& along;   // edges b–c and d–a
    Real const& area;                 // A [m²]
};

/// What a law has of its own: law_a … law_p of the inputs.
template <class Real> struct LawNumbers {
#define SLIDEWAY_MEMBER(letter) Real letter;
    SLIDEWAY_OWN_NUMBERS(SLIDEWAY_MEMBER)
#undef SLIDEWAY_MEMBER
};

template <class Real> struct ContactParameters {
    PointContact<Real> point;
    DampingParameters<Real> damping;
    LineContact<Real> along;          // edges along X, both kinds of face
    LineContact<Real> across_y_face;  // edges of the Y faces along Z
    LineContact<Real> across_z_face;  // edges of the Z faces along Y
    Real surface_stiffness_y;
    Real surface_stiffness_z;
    Real area_y;  // A of a Y face [m²]
    Real area_z;
    LawNumbers<Real> of_law;
};

}  // namespace slideway::inline SLIDEWAY_ISA
