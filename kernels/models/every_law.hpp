#pragma once

#include "kernels/all_laws.hpp"
#include "kernels/conditions.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

namespace detail {

/// The list ends in commas or begins with one: `void` stands before it.
template <class, class... Laws> struct ListedLaws {
    using Any = AnyLaw<Laws...>;

    SLIDEWAY_FN static bool switches(Law law) {
        int place = 0;
        bool answer = false;
        ((answer = place++ == static_cast<int>(law) ? Laws::info.switches : answer), ...);
        return answer;
    }
};

#define SLIDEWAY_TYPE(name, Type) , Type
using LawList = ListedLaws<void SLIDEWAY_LAWS(SLIDEWAY_TYPE)>;
#undef SLIDEWAY_TYPE

}  // namespace detail

/// Any law of this tree, chosen when the run begins: what a thread of a grid is compiled for.
using EveryLaw = detail::LawList::Any;

SLIDEWAY_FN Conditions<EveryLaw> conditions_with_every_law(Parts const& parts) {
    return {EveryLaw{parts.law, parts.damping}, detail::LawList::switches(parts.law), parts};
}

}  // namespace slideway::inline SLIDEWAY_ISA
