#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Which of the members under way work together.  A pack runs one method, and its lanes pay for every contact that any of them has:
/// so a stint takes members of one kind, and of these such as touch alike.
/// The member furthest behind leads, so that all come to their end together and no lane waits long for the last of them.
template <int seats_, int width> class Roster {
public:
    static constexpr int seats = seats_;
    enum class Kind : unsigned char { none, fresh, explicit_pair, stiff };

    struct Seat {
        Kind kind = Kind::none;
        std::uint32_t pattern = 0;  // apex–face pairs that touch, or of rigid ones those that last and those that stick, a bit each
        double share = 0;           // how far the member is on its way, from 0 to 1
    };

    SLIDEWAY_HD Seat& operator[](int i) { return seat_[i]; }
    SLIDEWAY_HD Seat const& operator[](int i) const { return seat_[i]; }

    /// Takes the next pack.  @param chosen [width] its seats.  @return how many, 0 if nobody is left.
    SLIDEWAY_HD int choose(int* chosen) const {
        int const leader = choose_leader();
        if (leader < 0) return 0;
        // The leader and those that differ from it by the fewest contacts; `far` marks other kinds.
        constexpr unsigned char far = 33;
        unsigned char distance[seats];
        int at_distance[far + 1] = {};
        for (int i = 0; i < seats; ++i) {
            bool const fits = seat_[i].kind == seat_[leader].kind;
            distance[i] = fits ? static_cast<unsigned char>(population(seat_[i].pattern ^ seat_[leader].pattern)) : far;
            ++at_distance[distance[i]];
        }
        int last = 0, nearer = 0;  // the largest distance to take from, and how many are nearer
        while (last < far - 1 && nearer + at_distance[last] < width) nearer += at_distance[last++];
        int room_at_last = last == 0 ? width - 1 : width - nearer;  // the leader has its seat
        chosen[0] = leader;
        int count = 1;
        for (int i = 0; i < seats && count < width; ++i) {
            if (i == leader || distance[i] > last) continue;
            if (distance[i] == last && room_at_last-- <= 0) continue;
            chosen[count++] = i;
        }
        return count;
    }

private:
    /// The seat furthest behind among the kinds that fill a pack; if none does, of the kind with most members.
    SLIDEWAY_HD int choose_leader() const {
        int counts[4] = {};
        for (auto const& seat : seat_) ++counts[static_cast<int>(seat.kind)];
        int most = 1;
        for (int kind = 2; kind < 4; ++kind) {
            if (counts[kind] > counts[most]) most = kind;
        }
        int leader = -1;
        for (int i = 0; i < seats; ++i) {
            auto const kind = static_cast<int>(seat_[i].kind);
            if (kind == 0 || (counts[kind] < width && kind != most)) continue;
            if (leader < 0 || seat_[i].share < seat_[leader].share) leader = i;
        }
        return leader;
    }

    Seat seat_[seats];
};

}  // namespace slideway::inline SLIDEWAY_ISA
