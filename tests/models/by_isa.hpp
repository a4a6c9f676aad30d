// What every instruction set's namespace has, by the instruction set: for units that are compiled once and call kernels that are compiled
// for each.
#pragma once

#include <type_traits>

#include "host/backend/backend.hpp"
#include "host/backend/built_isas.hpp"

#define SLIDEWAY_DECLARED_IN(isa, Type, name) \
    namespace isa {                           \
    extern Type name;                         \
    }
#define SLIDEWAY_CASE_OF(isa, Type, name) \
    case Isa::isa:                        \
        return &isa::name;

/// Declares slideway::<isa>::name, an object or a function, for each instruction set of this build, and
/// Type* name_by_isa(Isa): what runs on this machine, nullptr of instruction sets that are not in this build.  In the namespace slideway.
#define SLIDEWAY_BY_ISA(Type, name)                             \
    SLIDEWAY_FOR_EACH_ISA(SLIDEWAY_DECLARED_IN, Type, name)     \
    inline std::add_pointer_t<Type> name##_by_isa(Isa isa) {    \
        switch (compiled_isa(isa)) {                            \
            SLIDEWAY_FOR_EACH_ISA(SLIDEWAY_CASE_OF, Type, name) \
            default:                                            \
                return nullptr;                                 \
        }                                                       \
    }
