#pragma once

#include "kernels/inputs.hpp"
#include "kernels/laws/law_info.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the equations of a block have beside the least: each is a function of its own, in which the others are not even a place on the stack.
enum class Extras { nothing, loads, profile };
inline constexpr int extras_count = 3;

/// What holds for all members of a block: the equations branch on it once for all lanes, and never select by it per lane.
/// @tparam Laws how the contact law is called: `OneLaw`, `AnyLaw` or `LawFunctions`
template <class Laws> struct Conditions {
    Laws law;
    bool friction = false;
    bool misaligned_way = false;
    bool offset_slider = false;
    bool switches = false;   // LawInfo::switches
    bool remembers = false;  // impact speeds: of a damping by restitution
    bool continuous = false;  // LawInfo::continuous, with this damping
    bool holds_contacts = false;  // steps of the block take their contacts as given (ContactMemory)
    bool by_clocks = false;      // and go by the clocks of impacts
    bool powers_alone = false;    // reports tell the powers of the energy audit, and nothing else
    bool tells_forces = false;    // reports that tell more have the forces of faces and pins, too
    LoadList loads;
    bool way_profile = false;  // there is one among the loads, or the way ends
    bool film = false;         // and a film
    DrivePlan drive;

    constexpr Conditions(Laws const& of_law, bool law_switches, Parts const& parts)
        : law(of_law),
          friction(parts.friction),
          misaligned_way(parts.misaligned_way),
          offset_slider(parts.offset_slider),
          switches(law_switches),
          remembers(remembers_of(parts)),
          continuous(of_law.continuous() && !remembers),
          loads(parts.loads),
          way_profile(parts.loads.find(LoadKind::way_profile) != nullptr || parts.loads.find(LoadKind::way_ends) != nullptr),
          film(parts.loads.find(LoadKind::film) != nullptr),
          drive(parts.drive) {}

    /// A law that is known with its damping says it itself: without the speeds of its impacts, one by restitution would return what it likes.
    static constexpr bool remembers_of(Parts const& parts) {
        if constexpr (requires { Laws::remembers; }) {
            if (Laws::remembers) return true;
        }
        return parts.damping == Damping::restitution;
    }

    /// Nothing where only weight and contacts act on the mechanism, it moves at constant speed, and its slider's mass centre and pin lie in its hole's centre.
    SLIDEWAY_FN Extras extras() const {
        if (way_profile) return Extras::profile;
        return loads.count == 0 && drive.by == DriveBy::speed && !offset_slider ? Extras::nothing : Extras::loads;
    }
    /// Whether there are switches that steps may end at.
    SLIDEWAY_FN bool can_locate_modes() const { return switches && !remembers; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
