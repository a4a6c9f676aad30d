#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One of the two lasting contacts that a block between two walls may have.
template <class Real> struct HeldContact {
    Real side;  // of the wall: 1 above, −1 below, 0 where nothing touches
    Real slip;  // the way that it slips along the wall, 1 or −1; 0 where it sticks
};

/// What the last impact came to: booked by the observer, as no integral over time sees it.
template <class Real> struct ImpactBooks {
    Real work;      // of the drive [J]
    Real friction;  // loss by friction [J]
    Real damping;   // loss by restitution [J]
    Real impulse;   // sum of the normal impulses [N s]
    Real count;     // of contacts that met their wall
    Real met;       // which, a bit each
    Real flight;    // how long the bounces that it ends would have gone on [s]
    Real capped;    // 1 where its energy was bounded (M13.7), else 0
    Real speed[face_count];  // of the fastest apex that met a face on which none had lasted [m/s]; 0 where none did

    SLIDEWAY_FN static ImpactBooks none() {
        Real const zero(0.0);
        return {zero, zero, zero, zero, zero, zero, zero, zero, {zero, zero, zero, zero}};
    }
    SLIDEWAY_FN void take(Mask<Real> in, ImpactBooks const& from) {
        using Books = ImpactBooks;
        for (auto const of : {&Books::work, &Books::friction, &Books::damping, &Books::impulse, &Books::count, &Books::met, &Books::flight, &Books::capped}) {
            this->*of = select(in, from.*of, this->*of);
        }
        for (int face = 0; face < face_count; ++face) speed[face] = select(in, from.speed[face], speed[face]);
    }
};

/// What a member with rigid contacts remembers between its steps, whatever touches.
template <class Real> struct RigidCourse {
    ImpactBooks<Real> books;
    Real begun;    // 1 after the start
    Real jammed;   // 1 where no forces satisfy the contacts
    Real last;     // time of the last event [s]
    Real at_once;  // events that followed one another in no time

    SLIDEWAY_FN void start() {
        Real const zero(0.0);
        books = ImpactBooks<Real>::none();
        begun = jammed = at_once = zero;
        last = Real(-1.0);
    }
    SLIDEWAY_FN void clear_books(Mask<Real> in) { books.take(in, ImpactBooks<Real>::none()); }
    /// An event at t of a run until `end`: too many at one time have no end.
    SLIDEWAY_FN void count_event(Mask<Real> event, Real t, Real end) {
        Real const one(1.0);
        at_once = select(event, select(t - last <= no_time(end), at_once + one, Real(0.0)), at_once);
        last = select(event, t, last);
        jammed = select(event & (at_once >= Real(most_events_at_once)), one, jammed);
    }
};

/// Of a block between two walls.
template <class Real> struct RigidMemory : RigidCourse<Real> {
    static constexpr int speeds = 0;
    HeldContact<Real> held[2];  // front and rear
};

template <class Real> SLIDEWAY_FN void start_memory(RigidMemory<Real>& memory) {
    Real const zero(0.0);
    for (auto& contact : memory.held) contact = {zero, zero};
    memory.start();
}

/// A number of the pair `number` of sixteen.
template <class Four> SLIDEWAY_FN auto& number_of(Four (&of)[face_count], int number) {
    SLIDEWAY_EXPECT(number >= 0 && number < 4 * face_count);
    auto& quad = of[number / 4];
    int const place = number % 4;
    return place == 0 ? quad.a : place == 1 ? quad.b : place == 2 ? quad.c : quad.d;
}

/// Forces of apices on their faces [N].
template <class Real> struct ApexLoads {
    Quad<Real> normal[face_count], along[2][face_count];  // along both directions of the slip: of pairs that stick

    SLIDEWAY_FN void clear() {
        Real const zero(0.0);
        for (int face = 0; face < face_count; ++face) {
            normal[face] = along[0][face] = along[1][face] = {zero, zero, zero, zero};
        }
    }
};

/// Of a slider with eight apices.
template <class Real> struct RigidJointMemory : RigidCourse<Real> {
    static constexpr int speeds = 0;
    Quad<Real> held[face_count];    // 1 where an apex lasts on its face, else 0
    Quad<Real> sticks[face_count];  // 1 where it does not slip either
    Real quick;                     // events of which each came within `quick_time` of the one before it
    ApexLoads<Real> loads;          // of those that last, where the last step ended: where the search for the next begins
};

template <class Real> SLIDEWAY_FN void start_memory(RigidJointMemory<Real>& memory) {
    Real const zero(0.0);
    for (auto& face : memory.held) face = {zero, zero, zero, zero};
    for (auto& face : memory.sticks) face = {zero, zero, zero, zero};
    memory.quick = zero;
    memory.loads.clear();
    memory.start();
}

}  // namespace slideway::inline SLIDEWAY_ISA
