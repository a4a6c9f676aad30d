#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/law_info.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A law and its damping, known when the equations are compiled: every call names its function.
template <class Law, class Damping> struct OneLaw {
    template <bool Full, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                               ContactParameters<Real> const& contact) {
        return Law::template forces<Damping, Full>(m, face, contact);
    }
    template <class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        return Law::template stiffness<Damping>(m, face, contact);
    }
    SLIDEWAY_FN static bool couples() { return Damping::couples; }
};

/// One of several laws with one of their dampings, chosen when the run begins; every call names its function.  The assembler for GPUs
/// so sees what each call needs of the registers; behind a pointer it must save half of them (docs/performance.md).  All threads of a
/// grid choose alike.
template <class... Laws> struct AnyLaw {
    Law law = Law::paper;
    Damping damping = Damping::point;

    template <bool Full, class Real>
    SLIDEWAY_FN FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                        ContactParameters<Real> const& contact) const {
        auto f = no_forces<Real>();
        visit([&]<class One>(One) { f = One::template forces<Full>(m, face, contact); });
        return f;
    }
    template <class Real>
    SLIDEWAY_FN FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                              ContactParameters<Real> const& contact) const {
        auto f = FaceStiffness<Real>::none();
        visit([&]<class One>(One) { f = One::stiffness(m, face, contact); });
        return f;
    }
    SLIDEWAY_FN bool couples() const {
        bool answer = false;
        visit([&]<class One>(One) { answer = One::couples(); });
        return answer;
    }

private:
    /// Calls the function with the `OneLaw` that is chosen.
    template <class Function> SLIDEWAY_FN void visit(Function const& function) const {
        int place = 0;
        (visit_law<Laws>(place++, function), ...);
    }
    template <class Candidate, class Function> SLIDEWAY_FN void visit_law(int place, Function const& function) const {
        if (place != static_cast<int>(law)) return;
        if constexpr (Candidate::info.has(Damping::rate)) {
            if (damping == Damping::rate) return function(OneLaw<Candidate, RateDamping>{});
        }
        if constexpr (Candidate::info.has(Damping::restitution)) {
            if (damping == Damping::restitution) return function(OneLaw<Candidate, RestitutionDamping>{});
        }
        function(OneLaw<Candidate, PointDamping>{});
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
