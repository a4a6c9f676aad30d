#include "host/sampling/sobol_points.hpp"

#include <bit>

#include <boost/random/sobol.hpp>

namespace slideway {

SobolAxis::SobolAxis(Directions const& directions, StreamKey const& key, Stream stream) : directions_{} {
    constexpr std::uint64_t top = std::uint64_t(1) << 63;
    for (int digit = 0; digit < bits; ++digit) {
        // Row of L, the first digit in the top bit: random left of the diagonal, which is 1.
        std::uint64_t const place = top >> digit;
        std::uint64_t const row =
            (key.words(stream, static_cast<std::uint64_t>(digit))[0] & ~(place | (place - 1))) | place;
        for (std::size_t r = 0; r < directions.size(); ++r) {
            if (std::popcount(row & directions[r]) % 2 == 1) directions_[r] |= place;
        }
    }
    shift_ = key.words(stream, bits)[0];
}

double SobolAxis::operator()(std::uint64_t index) const {
    std::uint64_t word = shift_;
    for (std::uint64_t gray = index ^ index >> 1; gray != 0; gray &= gray - 1) {
        word ^= directions_[static_cast<std::size_t>(std::countr_zero(gray))];
    }
    return unit_fraction(word);
}

std::size_t sobol_dimensions() { return boost::random::default_sobol_table::max_dimension; }

std::vector<SobolAxis::Directions> sobol_directions(std::size_t dimensions) {
    std::vector<SobolAxis::Directions> directions(dimensions);
    if (dimensions == 0) return directions;
    boost::random::sobol engine(dimensions);
    // Boost leaves out the point 0.  Point 2^r is v_r ⊕ v_(r−1): the Gray code of 2^r has the bits r and r − 1.
    for (std::size_t r = 0; r < SobolAxis::bits; ++r) {
        engine.seed((std::uint64_t(1) << r) - 1);
        for (auto& axis : directions) axis[r] = engine() ^ (r == 0 ? 0 : axis[r - 1]);
    }
    return directions;
}

}  // namespace slideway
