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
        std::uint32_t pattern = 0;  // touching apex–face pairs, a bit each
        double time = 0;            // how far the member is
    };

    SLIDEWAY_HD Seat& operator[](int i) { return seat_[i]; }
    SLIDEWAY_HD Seat const& operator[](int i) const { return seat_[i]; }

    /// Takes the next pack.  @param chosen [width] its seats.  @return how many, 0 if nobody is left.
    SLIDEWAY_HD int choose(int* chosen) const {
        int const leader = choose_leader();
        if (leader < 0) return 0;
        Kind const kind = seat_[leader].kind;
        bool taken[seats] = {};
        taken[leader] = true;
        chosen[0] = leader;
        int count = 1;
        while (count < width) {
            int best = -1, best_distance = 0;
            for (int i = 0; i < seats; ++i) {
                if (taken[i] || seat_[i].kind != kind) continue;
                int const distance = bits(seat_[i].pattern ^ seat_[leader].pattern);
                bool const nearer = distance < best_distance ||
                                    (distance == best_distance && best >= 0 && seat_[i].time < seat_[best].time);
                if (best < 0 || nearer) best = i, best_distance = distance;
            }
            if (best < 0) break;
            taken[best] = true;
            chosen[count++] = best;
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
            if (leader < 0 || seat_[i].time < seat_[leader].time) leader = i;
        }
        return leader;
    }

    SLIDEWAY_HD static int bits(std::uint32_t pattern) {
#if defined(__CUDA_ARCH__)
        return __popc(pattern);
#else
        return __builtin_popcount(pattern);
#endif
    }

    Seat seat_[seats];
};

}  // namespace slideway::inline SLIDEWAY_ISA
