// How the forces of one face answer to its motion: what an implicit step needs of a contact law.
#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Derivatives of one apex's force by the penetrations of the face's four apices: its own, those at the other ends of its
/// edges across and along the way, and the one across the face's diagonal.
template <class Real> struct ApexSlopes { Real own, across, along, opposite; };

/// What a law's stiffness returns for a face.  Row i of the matrices ∂F_i/∂δ_j and ∂F_i/∂δ'_j is member i of the quads.
template <class Real> struct FaceStiffness {
    Quad<Real> normal;                // F [N], damping included
    Quad<ApexSlopes<Real>> by_depth;  // ∂F/∂δ [N/m]
    Quad<ApexSlopes<Real>> by_rate;   // ∂F/∂δ' [N s/m]

    SLIDEWAY_FN static FaceStiffness none() {
        Real const zero(0.0);
        ApexSlopes<Real> const row{zero, zero, zero, zero};
        return {{zero, zero, zero, zero}, {row, row, row, row}, {row, row, row, row}};
    }
};

/// Both derivatives of the forces of a `Law` (PaperLaw, ConservativeLaw):
/// `template <class Damping, class Real> static FaceStiffness<Real> face(FaceMotion, FaceContact, ContactParameters)`.
template <class Law> struct LawStiffness;

}  // namespace slideway::inline SLIDEWAY_ISA
