// Growth of offsets of members with rigid contacts beside that of neighbouring orbits of a reference.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "tests/support/rigid.hpp"

namespace slideway::testing {

inline Inputs with_friction(Inputs in, double kinetic, double holding) {
    in.friction_kinetic = kinetic, in.friction_static = holding;
    return in;
}

/// An offset between two orbits, in the scales of the state.
struct OffsetLengths {
    std::vector<double> first;    // at the start, of unit length
    std::vector<double> lengths;  // at the start and at each stop
};

/// By central differences.  @param ahead, behind [stop] states of orbits that start `by` to either side of the member
template <class States> OffsetLengths offset_lengths(States const& ahead, States const& behind, double by, std::span<double const> scale) {
    OffsetLengths found;
    for (std::size_t k = 0; k < ahead.size(); ++k) {
        std::vector<double> offset;
        double square = 0;
        for (std::size_t i = 0; i < scale.size(); ++i) {
            offset.push_back(static_cast<double>((ahead[k][i] - behind[k][i]) / (2 * static_cast<long double>(by) * scale[i])));
            square += offset[i] * offset[i];
        }
        found.lengths.push_back(std::sqrt(square));
        if (k > 0) continue;
        for (double& x : offset) x /= found.lengths[0];
        found.first = offset;
    }
    return found;
}

/// A shadow grows as they do from stop to stop.
inline void expect_growth(ShadowResult const& found, OffsetLengths const& want, double tolerance) {
    auto const& lengths = want.lengths;
    ASSERT_EQ(found.records[0].status, Status::finished);
    EXPECT_EQ(found.records[0].grown_offsets + found.records[0].lost_offsets, 0u);
    ASSERT_EQ(found.growth.size() + 2, lengths.size());
    for (std::size_t k = 0; k < found.growth.size(); ++k) EXPECT_NEAR(found.growth[k], std::log(lengths[k + 2] / lengths[k + 1]), tolerance) << k + 1;
}

/// A shadow along each of some axes of a state.
inline std::vector<double> directions_along(std::span<std::size_t const> axes, std::size_t size) {
    std::vector<double> directions(axes.size() * size);
    for (std::size_t s = 0; s < axes.size(); ++s) directions[s * size + axes[s]] = 1;
    return directions;
}

}  // namespace slideway::testing
