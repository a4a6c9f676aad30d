#pragma once

#include <cstddef>
#include <type_traits>

#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

// A record is a structure of Reals and nothing else.  One of plain numbers is a member's, one of packs is the transpose of its lanes'
// members'; a lane is therefore moved number by number, whatever the structure.

namespace detail {

template <class Packed, class Record> inline constexpr int record_width = sizeof(Packed) / sizeof(Record);

template <class Packed, class Record> SLIDEWAY_HD constexpr std::size_t record_numbers() {
    static_assert(sizeof(Packed) % sizeof(Record) == 0 && sizeof(Record) % sizeof(double) == 0);
    static_assert(std::is_trivially_copyable_v<Packed> && std::is_trivially_copyable_v<Record>);
    return sizeof(Record) / sizeof(double);
}

}  // namespace detail

/// Moves a member's record into one lane of a pack's.
template <class Packed, class Record> SLIDEWAY_HD void load_lane(Packed& pack, int index, Record const& record) {
    constexpr int width = detail::record_width<Packed, Record>;
    SLIDEWAY_EXPECT(index >= 0 && index < width);
    auto const* from = reinterpret_cast<double const*>(&record);
    auto* to = reinterpret_cast<double*>(&pack) + index;
    for (std::size_t i = 0; i < detail::record_numbers<Packed, Record>(); ++i) to[i * width] = from[i];
}

/// Moves one lane of a pack's record into a member's.
template <class Packed, class Record> SLIDEWAY_HD void store_lane(Packed const& pack, int index, Record& record) {
    constexpr int width = detail::record_width<Packed, Record>;
    SLIDEWAY_EXPECT(index >= 0 && index < width);
    auto const* from = reinterpret_cast<double const*>(&pack) + index;
    auto* to = reinterpret_cast<double*>(&record);
    for (std::size_t i = 0; i < detail::record_numbers<Packed, Record>(); ++i) to[i] = from[i * width];
}

/// A number of a size beside which no member of another type can hide: a structure of Reals is three times as long with it as with
/// double.
struct ThreeNumbers {
    double numbers[3];
};

}  // namespace slideway::inline SLIDEWAY_ISA
