// A contact law: compiled once per instruction set with its own flags and names (CMakeLists.txt here), and knows no other law.  The header of a
// law of one's own says itself which law it has: `#define SLIDEWAY_LAW HuntCrossley`.
#include "host/backend/kernel_tables.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/laws/law_table.hpp"
#include SLIDEWAY_HEADER

namespace slideway::inline SLIDEWAY_ISA {
namespace {

template <class Law> concept HasInfo = requires { LawInfo{Law::info}; };

/// @return whether the law has both functions with a damping that it should have; each that it lacks is one line
template <class Law, bool Wanted, class Damping> consteval bool has_functions() {
    if constexpr (Wanted) {
        constexpr bool forces = requires(FaceMotion<IsaReal> m, FaceContact<IsaReal> f, ContactParameters<IsaReal> c) { FaceForces<IsaReal>{Law::template forces<Damping>(m, f, c)}; };
        constexpr bool stiffness = requires(FaceMotion<IsaReal> m, FaceContact<IsaReal> f, ContactParameters<IsaReal> c) { FaceStiffness<IsaReal>{Law::template stiffness<Damping>(m, f, c)}; };
        static_assert(forces, "the law has no `forces<Damping>(motion, face, contact)` that gives FaceForces with a damping of its info (kernels/laws/contact.hpp)");
        static_assert(stiffness, "the law has no `stiffness<Damping>(motion, face, contact)` that gives FaceStiffness with a damping of its info (kernels/laws/contact.hpp)");
        return forces && stiffness;
    }
    return true;
}

template <class Law> struct Compiled {
    static constexpr LawTable<IsaReal> table = LawTable<IsaReal>::template of<Law>();
    static constexpr LawKernels kernels{&Law::info, {Law::info.has(Damping::point), Law::info.has(Damping::rate), Law::info.has(Damping::restitution)}, &table};
};

/// What its info lacks is one line of the compiler's, and nothing follows from it.
template <class Law> consteval LawKernels kernels_of() {
    static_assert(HasInfo<Law>, "the law has no `static constexpr LawInfo info` (kernels/laws/law_info.hpp)");
    if constexpr (HasInfo<Law>) {
        static_assert(!Law::info.name.empty() && !Law::info.words.empty(), "the law's info says no name, or no words");
        static_assert(!Law::info.needs_restitution || has_group(Law::info.groups, KeyGroup::restitution), "a law that needs a restitution has it in its groups");
        static_assert(Law::info.keys.size() <= most_own_numbers, "a law has at most sixteen numbers of its own, law_a to law_p");
        constexpr bool by_points = has_functions<Law, Law::info.has(Damping::point), PointDamping>();
        constexpr bool by_rates = has_functions<Law, Law::info.has(Damping::rate), RateDamping>();
        constexpr bool by_restitution = has_functions<Law, Law::info.has(Damping::restitution), RestitutionDamping>();
        if constexpr (by_points && by_rates && by_restitution) return Compiled<Law>::kernels;
    }
    return {};
}

}  // namespace

extern constinit LawKernels const SLIDEWAY_TABLE = kernels_of<SLIDEWAY_LAW>();

}  // namespace slideway::inline SLIDEWAY_ISA
