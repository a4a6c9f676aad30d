// What a contact law is, for those who choose, check and describe it.  Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include <span>
#include <string_view>

#include "kernels/inputs.hpp"

namespace slideway {

/// Stands in the law's own header, as `Law::info`.
struct LawInfo {
    std::string_view name;   // contact.law
    std::string_view words;  // one line: what it does
    bool switches;           // between modes, where its potential jumps: it makes energy, and steps may end there
    KeyGroups groups;        // of the keys of contacts, those that count for it
    bool of_touching_alone = false;  // forces are on the apices that touch, and depend on no depth of another
    std::span<Key const> keys = {};  // its own, on Inputs::law_a … law_d
    /// Stiffness of a face [N/m] of which all apices are in contact, for predictions.  @param surface that of its surface, E_s A/l; none: it is that
    double (*face_stiffness)(Inputs const&, double surface) = nullptr;

    /// Which kinds of damping it has: χ of surfaces, a coefficient of restitution; `point` stands for what it has without these, η of points, its own or none.
    constexpr bool has(Damping damping) const {
        switch (damping) {
            case Damping::point:
                return true;
            case Damping::rate:
                return has_group(groups, KeyGroup::surfaces);
            case Damping::restitution:
                return has_group(groups, KeyGroup::restitution);
        }
        return false;
    }
};

}  // namespace slideway
