#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Ends attempts of an EndingStep at the first event of their contacts inside: what the watch finds between both ends is looked up there, until
/// it is one.
template <class Stepper, class Model, class Real> class EventEnd {
public:
    /// @param located depth [m] up to which an event counts as found
    SLIDEWAY_HD EventEnd(Pack<Model, Real>& pack, Stepper& stepper, Attempt<Model, Real>& to, Real located)
        : pack_(pack), stepper_(stepper), to_(to), located_(located), whole_(to.step) {}

    /// @param in lanes with an event  @param share of the attempt at which its ends have it
    /// @return lanes whose attempt ends there, or a little before; the others are to try again
    SLIDEWAY_NOINLINE Mask<Real> run(Mask<Real> in, Real share) {
        auto const& watch = pack_.state.contacts.watch;
        Real const zero(0.0), half(0.5), one(1.0), per_whole = one / select(in, whole_, one);
        Real low = zero, high = one;  // no event is before the one, and one is before the other
        auto open = in;
        for (int i = 0; i < most_looks && any(open); ++i) {
            auto const& contact = look(open, share);
            Real const again = earliest(open, contact, share), on = per_whole * watch.way_on(contact, whole_ * share, located_);
            Mask<Real> const beyond = open & (again < one), before = open & !beyond & (on > zero);
            low = select(before, share, low);
            high = select(beyond, share, high);
            Real const next = select(beyond, share * again, share + on);
            open = beyond | before;
            share = select(open, select((next > low) & (next < high), next, half * (low + high)), share);
        }
        auto const unseen = sees ? in : open;
        if (any(unseen)) stepper_.end_early(pack_, pack_.start(), to_, unseen, share);
        auto const ended = in & !(earliest(in, to_.report.contact, share) < one);
        to_.step = select(in & !ended, whole_, to_.step);
        return ended;
    }

private:
    static constexpr int most_looks = 8;
    static constexpr bool sees = Model::sees_contacts;
    using Contact = decltype(Pack<Model, Real>::Report::contact);

    template <class Seen> SLIDEWAY_HD Real earliest(Mask<Real> in, Seen const& contact, Real share) const {
        return pack_.state.contacts.watch.earliest(in, contact, whole_ * share, located_, pack_.needs.watching);
    }

    /// What touches at a share of the attempt.
    SLIDEWAY_HD Contact const& look(Mask<Real> lanes, Real share) {
        if constexpr (sees) {
            auto const from = pack_.start();
            Real state[Model::size];
            stepper_.place(share, state);
            pack_.model.see(fma(whole_, share, from.t), state, pack_.state.constants.parameters, from.memory, seen_);
            return seen_;
        } else {
            stepper_.end_early(pack_, pack_.start(), to_, lanes, share);
            return to_.report.contact;
        }
    }

    Pack<Model, Real>& pack_;
    Stepper& stepper_;
    Attempt<Model, Real>& to_;
    Real const located_, whole_;
    Contact seen_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
