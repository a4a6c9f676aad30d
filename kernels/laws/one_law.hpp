// How the joint calls a contact law: a law and its damping known by name, one of several by a choice, or behind pointers.
#pragma once

#include "kernels/laws/contact.hpp"
#include "kernels/laws/law_info.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the derivative alone needs of a law.
template <class Real> struct FaceNormals {
    Quad<Real> normal;   // F [N], damping included, >= 0
    Mask<Real> outside;  // as of FaceForces
};

/// A law and its damping, known when the equations are compiled: every call names its function.  Functions of their own: the joint calls
/// them for four faces, and the code would multiply.
template <class Law, class Damping> struct OneLaw {
    static constexpr bool remembers = Damping::remembers;

    template <class Real>
    SLIDEWAY_NOINLINE static FaceNormals<Real> normals(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                       ContactParameters<Real> const& contact) {
        auto f = Law::template forces<Damping>(m, face, contact);
        return {f.normal, f.outside};
    }
    template <class Real>
    SLIDEWAY_NOINLINE static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto f = Law::template forces<Damping>(m, face, contact);
        // Made anew, so that the sums above live in registers and not in the caller's memory.
        return {f.normal, f.elastic, f.potential, f.outside};
    }
    template <class Real>
    SLIDEWAY_NOINLINE static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                           ContactParameters<Real> const& contact) {
        return Law::template stiffness<Damping>(m, face, contact);
    }
    SLIDEWAY_FN static bool couples() { return Damping::couples; }
    SLIDEWAY_FN static bool of_touching_alone() { return Law::info.of_touching_alone; }
    SLIDEWAY_FN static constexpr bool continuous() { return Law::info.continuous; }
    SLIDEWAY_FN static constexpr bool ends_steps() { return Law::info.ends_steps; }
};

/// One of several laws with one of their dampings, chosen when the run begins; every call names its function.  The assembler for GPUs
/// so sees what each call needs of the registers; behind a pointer it must save half of them (performance.md).  All threads of a
/// grid choose alike.
template <class... Laws> struct AnyLaw {
    Law law{};
    Damping damping = Damping::point;

    // One place to call the laws from, and a result that every path sets: otherwise the assembler keeps it in memory.
    template <class Real>
    SLIDEWAY_CARD_CALL FaceNormals<Real> normals(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                 ContactParameters<Real> const& contact) const {
        auto const nothing = no_forces<Real>();
        FaceNormals<Real> f{nothing.normal, nothing.outside};
        visit([&]<class One>(One) { f = One::normals(m, face, contact); });
        return f;
    }
    template <class Real>
    SLIDEWAY_CARD_CALL FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                               ContactParameters<Real> const& contact) const {
        auto f = no_forces<Real>();
        visit([&]<class One>(One) { f = One::forces(m, face, contact); });
        return f;
    }
    template <class Real>
    SLIDEWAY_CARD_CALL FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) const {
        auto f = FaceStiffness<Real>::none();
        visit([&]<class One>(One) { f = One::stiffness(m, face, contact); });
        return f;
    }
    SLIDEWAY_FN bool couples() const { return said([]<class One>(One) { return One::couples(); }); }
    SLIDEWAY_FN bool of_touching_alone() const { return said([]<class One>(One) { return One::of_touching_alone(); }); }
    SLIDEWAY_FN bool continuous() const { return said([]<class One>(One) { return One::continuous(); }); }
    SLIDEWAY_FN bool ends_steps() const { return said([]<class One>(One) { return One::ends_steps(); }); }

private:
    template <class Of> SLIDEWAY_FN bool said(Of const& of) const {
        bool answer = false;
        visit([&]<class One>(One one) { answer = of(one); });
        return answer;
    }
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

/// A law with its damping behind pointers: a mechanism is compiled once for all laws, and a law once for all mechanisms.
template <class Real> struct LawFunctions {
    template <class Result>
    using Of = Result(FaceMotion<Real> const&, FaceContact<Real> const&, ContactParameters<Real> const&);
    Of<FaceNormals<Real>>* normals = nullptr;
    Of<FaceForces<Real>>* forces = nullptr;
    Of<FaceStiffness<Real>>* stiffness = nullptr;
    bool rates_couple = false, touching_alone = false, is_continuous = false, at_ends = false;

    SLIDEWAY_FN bool couples() const { return rates_couple; }
    SLIDEWAY_FN bool of_touching_alone() const { return touching_alone; }
    SLIDEWAY_FN constexpr bool continuous() const { return is_continuous; }
    SLIDEWAY_FN constexpr bool ends_steps() const { return at_ends; }

    template <class Law, class Damping> static constexpr LawFunctions of() {
        using One = OneLaw<Law, Damping>;
        return {&One::template normals<Real>, &One::template forces<Real>, &One::template stiffness<Real>, Damping::couples,
                Law::info.of_touching_alone, Law::info.continuous, Law::info.ends_steps};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
