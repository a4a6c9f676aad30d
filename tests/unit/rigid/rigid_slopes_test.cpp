// Slopes of the motion after impacts of several apices with friction (model.md 13, offsets) against differences of motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kernels/math/tangent.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/rigid_free_slider.hpp"

namespace slideway::rigid_slopes_test {
namespace {

constexpr std::size_t size = 12;  // y z vy vz roll yaw pitch wx wy wz x vx
using State = std::array<double, size>;
using Motion = std::array<double, 6>;

/// A free slider in a state, and the pairs that meet.
struct Collision {
    char const* what;
    State state;
    std::vector<int> pairs;
    double friction, restitution;
    int slips;  // that are left
};

/// Tilts up to a milliradian: an apex, an edge and a face that are hit while they slip along, across and around.
std::vector<Collision> collisions() {
    State const along{0, 0, -0.03, 0.01, 1e-3, 0.7e-3, -1.2e-3, 0.3, -0.4, 0.2, 0, 0.3};
    State across = along, still = along;
    across[3] = -0.02, across[7] = -0.5, across[8] = 1.1, across[11] = -0.15;
    still[7] = still[8] = 0, still[11] = still[3] = 0.001, still[9] = 4;
    return {
        {"an edge of a face", along, {0, 1}, 0.2, 0.5, 2},
        {"an apex of each of two faces", across, {1, 9}, 0.25, 0.6, 2},
        {"a face", across, {0, 1, 2, 3}, 0.3, 0, 4},
        {"edges of two faces", across, {0, 1, 8, 9}, 0.15, 0.3, 3},
        {"an edge that sticks", still, {0, 1}, 0.2, 0.5, 0},
        // Found by a random search: interior points end some 1e-6 of the motion beside the solution.
        {"two apices that stick",
         {0, 0, -0.00581022, -0.0454579, 0.000181715, -0.00038301, -0.000698, -0.838998, 0.473131, 0.996151, 0,
          0.0173029},
         {9, 11},
         0.5723,
         0.7967,
         0},
        {"two that stick across a face",
         {0, 0, -0.0419627, -0.0166851, -0.000316738, 0.000109648, -0.000168727, -0.897049, 0.957409, -0.0261317, 0,
          -0.00369738},
         {0, 2},
         0.493928,
         0.848763,
         0},
    };
}

/// `slope` for each number of the state is that of its direction.
template <class Real> Real number(double value, double slope) {
    if constexpr (is_tangent<Real>)
        return {value, slope};
    else
        return value;
}

/// The motion after it.  @param slips counts pairs that push and still slip
template <class Real>
std::array<Real, 6> motion_after(Collision const& of, State const& direction, int* slips = nullptr) {
    Inputs in;
    in.friction_static = in.friction_kinetic = of.friction;
    auto const plain = RigidFreeSlider::parameters(complete_inputs(in));
    SliderParameters<Real> p;
    auto const* const from = reinterpret_cast<double const*>(static_cast<SliderParameters<double> const*>(&plain));
    auto* const to = reinterpret_cast<Real*>(&p);
    static_assert(sizeof(p) / sizeof(Real) == sizeof(SliderParameters<double>) / sizeof(double));
    for (std::size_t i = 0; i < sizeof(p) / sizeof(Real); ++i) to[i] = Real(from[i]);
    Real s[size];
    for (std::size_t i = 0; i < size; ++i) s[i] = number<Real>(of.state[i], direction[i]);
    auto faults = Faults<Real>::none();
    NoDrive::At<Real> const guide(Real(0.0), s, p, DrivePlan{}, faults);
    JointPairs<Real> const at(guide.centre(p), guide.x, guide.vx, s, p, false);
    Mask<Real> near[pair_count];
    for (auto& each : near) each = false;
    for (int const pair : of.pairs) near[pair] = true;
    Real const coefficient(of.friction);
    JointImpact<Real> impact(at, at.velocity, near, &coefficient, Real(1e-12));
    Real restitution[pair_count];
    for (auto& e : restitution) e = Real(of.restitution);
    impact.solve(true, restitution);
    EXPECT_FALSE(impact.pairs.failed);
    if constexpr (!is_tangent<Real>) {
        for (int k = 0; slips != nullptr && k < impact.pairs.count(); ++k) {
            auto const& row = impact.pairs.row(k);
            double const slip =
                std::hypot(dot(row.pair.slip[0], impact.pairs.after), dot(row.pair.slip[1], impact.pairs.after));
            *slips += row.normal > 0 && slip > 1e-3;
        }
    }
    auto const& u = impact.pairs.after;
    return {u.linear.x, u.linear.y, u.linear.z, u.angular.x, u.angular.y, u.angular.z};
}

/// By central differences of fourth order.
Motion differences(Collision const& of, State const& direction) {
    constexpr double by = 1e-4;
    auto const beside = [&](double steps) {
        Collision moved = of;
        for (std::size_t i = 0; i < size; ++i) moved.state[i] += steps * by * direction[i];
        return motion_after<double>(moved, direction);
    };
    auto const a = beside(-2), b = beside(-1), c = beside(1), d = beside(2);
    Motion slopes;
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = (8 * (c[i] - b[i]) - (d[i] - a[i])) / (12 * by);
    return slopes;
}

TEST(RigidSlopes, OfImpactsOfSeveralPairsWithFrictionAreThoseOfNeighbours) {
    // Of place and of motion, a thousandth of what the state has.
    State const directions[] = {{0, 0, 0.01, -0.02, 0, 0, 0, 0.1, 0.3, -0.2, 0, 0.015},
                                {1e-6, -1e-6, 0, 0, 2e-4, -3e-4, 1e-4, 0, 0, 0, 0, 0},
                                {0, 0, -0.01, 0.005, 1e-4, 1e-4, -2e-4, -0.2, 0.1, 0.3, 0, -0.01}};
    for (auto const& collision : collisions()) {
        int slips = 0;
        motion_after<double>(collision, {}, &slips);
        EXPECT_EQ(slips, collision.slips) << collision.what;
        for (auto const& direction : directions) {
            auto const found = motion_after<Tangent<double>>(collision, direction);
            auto const want = differences(collision, direction);
            // As long at least as what a flight would have.
            double const length =
                std::max(1e-3, std::abs(*std::ranges::max_element(want, {}, [](double of) { return std::abs(of); })));
            for (std::size_t i = 0; i < want.size(); ++i)
                EXPECT_NEAR(found[i].slope, want[i], 1e-6 * length) << collision.what << ", number " << i;
        }
    }
}

}  // namespace
}  // namespace slideway::rigid_slopes_test
