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
    /// Between modes, where its potential jumps: it makes energy, and steps may end there.  Within a step its contacts then are held as they were at the
    /// step's beginning: `touching` may be true of an apex whose depth is no more above zero.
    bool switches;
    bool continuous = false;  // its forces are, but for those of restitution, where an apex meets its face or leaves it: steps may then end just beyond
    bool ends_steps = false;  // its forces begin and end at a jump or a bend: steps end there, with contacts held as of a law that switches, but for restitution
    KeyGroups groups;        // of the keys of contacts, those that count for it
    bool of_touching_alone = false;  // forces are on the apices that touch, and depend on no depth of another
    bool needs_restitution = false;  // contact.restitution must be given: it has no other damping
    std::span<Key const> keys = {};  // its own, on Inputs::law_a … law_p
    /// Stiffness of a face [N/m] of which all apices are in contact, for predictions; none: that of its surface.
    /// @param surface that, E_s A/l  @param area A [m²]
    double (*face_stiffness)(Inputs const&, double surface, double area) = nullptr;

    /// Which kinds of damping it has: χ of surfaces, a coefficient of restitution; `point` stands for what it has without these, η of points, its own or none.
    /// With `restitution` members remember the speed of each touch.
    constexpr bool has(Damping damping) const {
        switch (damping) {
            case Damping::point:
                return !needs_restitution;
            case Damping::rate:
                return has_group(groups, KeyGroup::surfaces) && !needs_restitution;
            case Damping::restitution:
                return has_group(groups, KeyGroup::restitution);
        }
        return false;
    }
};

}  // namespace slideway
