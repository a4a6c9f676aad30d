#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/joint/held_face.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_clock.hpp"
#include "kernels/steppers/gap_history.hpp"
#include "kernels/steppers/watching.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Ends steps where pairs touch or part, and keeps what a member remembers of it.
/// With `modes` what is held is always the sign of the depth at the start.  A pair may change twice in a step and seem untouched at its end, and
/// error control would never know: what is held apart exerts no force.
/// @tparam quads of pairs, as of GapHistory
template <class Real, int quads = face_count> class ContactWatch : public GapHistory<Real, quads> {
public:
    using Memory = ContactMemory<Real, quads>;

    /// Depth [clearances] up to which an event counts as located: below it a touch has no force, and a switch next to no jump.
    static constexpr double tolerance(Watching watching) { return watching == Watching::modes ? 1e-12 : 1e-8; }

    /// What the first step starts from.
    template <class Contact> SLIDEWAY_FN void begin(Mask<Real> fresh, Contact const& r, Memory& memory, Watching watching) {
        if (holds_contacts(watching)) {
            memory.holding = select(fresh, Real(1.0), memory.holding);
            turn_pairs(fresh, r, memory);
        }
        this->keep(fresh, r);
        if (watching == Watching::clocks) note_face(memory);
    }

    /// Pairs that touch at the start have met as fast as they then move.  @return lanes with some, where the derivative is another
    template <class Contact> SLIDEWAY_FN Mask<Real> take_start(Mask<Real> fresh, Contact const& r, Memory& memory) const {
        auto touching = mask_of<Real>(false);
        for (int face = 0; face < quads; ++face) {
            auto const take = [&](Real, Real depth, Real rate, Real& speed) {
                auto const meets = fresh & (depth > Real(0.0)) & (rate > speed);
                speed = select(meets, rate, speed);
                touching = touching | meets;
            };
            each_pair(face, take, r.penetration[face], r.rate[face], memory.impact_speed[face]);
        }
        return touching;
    }

    /// The clock of the next step: the shallowest of the pairs that touch, none where a member flies.
    SLIDEWAY_FN ContactClock<Real> clock(Memory const& memory) const {
        Real depth(1e300);
        ContactClock<Real> found{Real(-1.0), Real(0.0), Real(0.0)};
        for (int face = 0; face < quads; ++face) {
            auto const look = [&](Real number, Real depth_here, Real rate_here, Real is_held) {
                auto const shallower = (is_held > Real(0.5)) & (depth_here < depth);
                depth = select(shallower, depth_here, depth);
                found.pair = select(shallower, number, found.pair);
                found.rate = select(shallower, rate_here, found.rate);
            };
            each_pair(face, look, this->start_depth_[face], this->start_rate_[face], memory.held[face]);
        }
        found.root = select(found.runs(), sqrt(max(depth, Real(0.0))), found.root);
        return found;
    }

    /// How many pairs are held to touch.
    SLIDEWAY_FN static Real touching(Memory const& memory) {
        Real held(0.0);
        for (auto const& face : memory.held) held = held + sum(face);
        return held;
    }

    /// As `earliest`, of a step by a clock: fraction of what it is by the clock.  A pair that is held apart may start within its face by what its
    /// parting was located to, or by the error of the step before: it counts from where it starts.
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Memory const& memory, Contact const& end, ClockedStep<Real> const& step,
                              Real located) const {
        auto const& from = step.start;
        auto const& to = step.end;
        Real const pace0 = step.pace_at_start(), pace1 = step.pace_at_end();
        typename GapHistory<Real, quads>::FirstChange changes;
        auto const add = [&](Mask<Real> in, Real d0, Real v0, Real d1, Real v1, Real within) {
            changes.add(GapHistory<Real, quads>::passage(in, d0, v0, d1, v1, step.own, within));
        };
        Mask<Real> const by_clock = candidates & from.runs();
        add(by_clock & !step.parts(), from.root, step.root_rate(from.root, from.rate), to.root, step.root_rate(to.root, to.rate), Real(0.0));
        auto const one = like_the_clocks(step, end);
        for (int face = 0; face < quads; ++face) {
            auto const look = [&](Real, Real d0, Real v0, Real d1, Real v1, Real is_held) {
                Real const s0 = pace0 * v0, s1 = pace1 * v1, zero(0.0);
                Mask<Real> const touches = is_held > Real(0.5);
                Mask<Real> const in = candidates & GapHistory<Real, quads>::may_change(touches, d0, s0, d1, s1, step.own, located);
                if (none(in)) return;
                Real const from = select(touches, zero, max(d0, zero));
                add(in & !one(d0, d1), d0 - from, s0, d1 - from, s1, located);
            };
            each_pair(face, look, this->start_depth_[face], this->start_rate_[face], end.penetration[face], end.rate[face], memory.held[face]);
        }
        return changes.of_all();
    }

    /// Whether a step by a clock ends at a touch or a parting, so that `update` will turn a pair over.
    template <class Contact>
    SLIDEWAY_FN Mask<Real> turns(Memory const& memory, Contact const& end, ClockedStep<Real> const& step) const {
        auto turned = mask_of<Real>(false);
        each_after(end, step, memory, [&](Real now, Real is_held, Mask<Real>, Real, Real) { turned = turned | (now != is_held); });
        return turned;
    }

    /// How far it is by the clock, from the end of a step on, to the next touch or parting if all rates stay as they are.
    template <class Contact>
    SLIDEWAY_FN Real way_to_turn(Memory const& memory, Contact const& end, ClockedStep<Real> const& step, Real located) const {
        auto const way = [](Mask<Real> counts, Real gap, Real speed) {
            Mask<Real> const nears = counts & (gap > Real(0.0)) & (speed > Real(0.0));
            return select(nears, gap / select(nears, speed, Real(1.0)), Real(1e300));
        };
        auto const& to = step.end;
        Real const pace = step.pace_at_end(), target = Real(0.5) * located;
        Real least = way(step.start.runs(), to.root, negated(step.root_rate(to.root, to.rate)));
        auto const one = like_the_clocks(step, end);
        for (int face = 0; face < quads; ++face) {
            auto const look = [&](Real, Real before, Real depth, Real rate, Real is_held) {
                Mask<Real> const touches = is_held > Real(0.5), counts = !one(before, depth);
                Real const gap = target - select(touches, negated(depth), depth - max(before, Real(0.0)));
                least = min(least, way(counts, gap, pace * select(touches, negated(rate), rate)));
            };
            each_pair(face, look, this->start_depth_[face], end.penetration[face], end.rate[face], memory.held[face]);
        }
        return least;
    }

    /// As `update`, after a step by a clock.  A pair touches where it comes nearer: one that has just parted may be left within its face by
    /// what its parting was located to.  That of the clock parts where its clock says so, for its depth in the state is off by what the
    /// step's error is.
    struct Turned {
        Mask<Real> lanes;
        Mask<Real> by_depth;  // those where a pair has parted that is not the clock's
    };
    template <class Contact>
    SLIDEWAY_FN Turned update(Mask<Real> accepted, Contact const& end, Memory& memory, ClockedStep<Real> const& step, bool remembers) {
        Turned turned{mask_of<Real>(false), mask_of<Real>(false)};
        auto const turn = [&](Real now, Real& is_held, Mask<Real> by_clock, Real rate, Real& speed) {
            auto const differs = accepted & (now != is_held);
            turned.lanes = turned.lanes | differs;
            turned.by_depth = turned.by_depth | (differs & (is_held > now) & negation(by_clock));
            if (remembers) speed = select(differs & (now > is_held), max(rate, Real(least_impact_speed)), speed);
            is_held = select(accepted, now, is_held);
        };
        each_after(end, step, memory, turn);
        this->keep(accepted, end);
        if (any(turned.lanes)) note_face(memory);
        return turned;
    }

    /// Fraction of the step at which the first pair touches or parts, 1 where none does before the end or the end is the event.
    /// @param located depth [m] up to which it counts as that
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located, Watching watching) const {
        bool const touches_alone = watching == Watching::touches;
        Real fraction(1.0);
        // Sixteen pairs: g++ may call it for each, which costs a fiftieth of an audited run.
        auto const of_pair = [&](Real d0, Real v0, Real d1, Real v1) SLIDEWAY_INLINED {
            auto const change = GapHistory<Real, quads>::first_change(candidates, d0, v0, d1, v1, step, located);
            if (!touches_alone) return change.fraction;
            // A pair that parts needs no end of its own, unless it touches again in the same step: then the step ends at the parting,
            // and a later one at the touch.
            return select((d0 <= Real(0.0)) | change.returns, change.fraction, Real(1.0));
        };
        for (int face = 0; face < quads; ++face) fraction = min(fraction, this->least_of_face(face, end, of_pair));
        return fraction;
    }

    /// After an accepted step: remembers what has just happened.  @param step that has been made [s]  @param next step, of a method that may shorten it; else
    /// nullptr  @return lanes where it changes the derivative.
    template <class Contact>
    SLIDEWAY_FN Mask<Real> update(Mask<Real> accepted, Contact const& end, Memory& memory, Real*, Watching watching, Real step = Real(0.0),
                                  Real* next = nullptr) {
        auto changed = mask_of<Real>(false);
        if (watching != Watching::gaps) changed = watching == Watching::modes ? turn_pairs(accepted, end, memory) : take_speeds(accepted, end, memory);
        if (next != nullptr && looks_ahead(watching)) *next = select(accepted, this->next_step(end, step, *next), *next);
        this->keep(accepted, end);
        return changed;
    }

private:
    /// Has a function see each pair of a face: its number, and what it has in each of the quads.
    template <class Function, class... Quads> SLIDEWAY_FN static void each_pair(int face, Function const& see, Quads&... of) {
        double const first = 4.0 * face;
        see(Real(first), of.a...);
        see(Real(first + 1), of.b...);
        see(Real(first + 2), of.c...);
        see(Real(first + 3), of.d...);
    }

    /// Has a function see what pairs that may change will be held to be after a step by a clock, what they are held to be, and their speeds.
    template <class Contact, class Memories, class Function>
    SLIDEWAY_FN void each_after(Contact const& end, ClockedStep<Real> const& step, Memories& memory, Function const& see) const {
        Mask<Real> const over = step.parts();
        auto const one = like_the_clocks(step, end);
        for (int face = 0; face < quads; ++face) {
            auto const look = [&](Real, Real before, Real depth, Real rate, auto& is_held, auto& speed) {
                Mask<Real> const touches = is_held > Real(0.5), is_in = depth > Real(0.0);
                if (none((touches ^ is_in) | (touches & over))) return;
                Mask<Real> const parts = over & one(before, depth), apart = !touches, remains = !parts;
                Mask<Real> const stays = touches & is_in & remains, begins = apart & is_in & (rate > Real(0.0));
                see(select(stays | begins, Real(1.0), Real(0.0)), is_held, parts, rate, speed);
            };
            each_pair(face, look, this->start_depth_[face], end.penetration[face], end.rate[face], memory.held[face], memory.impact_speed[face]);
        }
    }

    /// Says which pairs move as one with that of the clock: at both ends of a step they are as deep, to the last bit.
    template <class Contact> SLIDEWAY_FN auto like_the_clocks(ClockedStep<Real> const& step, Contact const& end) const {
        Real const before = depth_of(step.start.pair, this->start_depth_), after = depth_of(step.start.pair, end.penetration);
        return [=](Real d0, Real d1) { return Mask<Real>((d0 == before) & (d1 == after)); };
    }

    /// What a pair has of the depths; 1e300 where there is none.
    SLIDEWAY_FN static Real depth_of(Real pair, Quad<Real> const* depths) {
        Real depth(1e300);
        for (int face = 0; face < quads; ++face) {
            auto const look = [&](Real number, Real here) { depth = select(pair == number, here, depth); };
            each_pair(face, look, depths[face]);
        }
        return depth;
    }

    SLIDEWAY_FN static void note_face(Memory& memory) {
        if constexpr (quads == face_count) {
            memory.touched = HeldFace<Real>::first_of(HeldFace<Real>::faces_of(memory), memory).packed();
        }
    }

    /// Sets the impact speed of pairs that have just touched.
    template <class Contact>
    SLIDEWAY_FN Mask<Real> take_speeds(Mask<Real> accepted, Contact const& end, Memory& memory) const {
        auto touched = mask_of<Real>(false);
        for (int face = 0; face < quads; ++face) {
            auto const take = [&](Real, Real before, Real after, Real rate, Real& speed) {
                auto const now = accepted & (before <= Real(0.0)) & (after > Real(0.0));
                speed = select(now, max(rate, Real(least_impact_speed)), speed);
                touched = touched | now;
            };
            each_pair(face, take, this->start_depth_[face], end.penetration[face], end.rate[face], memory.impact_speed[face]);
        }
        return touched;
    }

    /// Turns over the pairs that have changed.
    template <class Contact>
    SLIDEWAY_FN static Mask<Real> turn_pairs(Mask<Real> accepted, Contact const& end, Memory& memory) {
        auto changed = mask_of<Real>(false);
        for (int face = 0; face < quads; ++face) {
            auto const turn_over = [&](Real, Real depth, Real& is_held) {
                Real const now = select(depth > Real(0.0), Real(1.0), Real(0.0));
                changed = changed | (accepted & (now != is_held));
                is_held = select(accepted, now, is_held);
            };
            each_pair(face, turn_over, end.penetration[face], memory.held[face]);
        }
        return changed;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
