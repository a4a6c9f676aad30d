// Rigid contacts of the spatial mechanisms (model.md 13) against a reference that goes from event to event in 80-bit numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/rigid_slider.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_slider_test {
namespace {

using testing::drifting_sliders;
using testing::rigid_joint_parts;
using testing::rigid_options;

/// Largest distance of states, in clearances and what turns the slider by as much.
double distance(Inputs const& in, Parts const& parts, oracle::RigidSliderState const& a, std::vector<double> const& b) {
    long double const c = in.clearance_y, angle = 2 * c / in.slider_length;
    // A fall through the clearance takes 5 ms.
    long double const unit[12] = {c,     c,           200 * c,     200 * c,     angle, angle,
                                  angle, 200 * angle, 200 * angle, 200 * angle, c,     200 * c};
    long double most = 0;
    int const states = info(parts.mechanism).states;
    for (std::size_t i = 0; i < static_cast<std::size_t>(states); ++i) {
        long double const d = std::abs(a[i] - b[i]) / unit[i];
        if (!(d <= most)) most = d;
    }
    return static_cast<double>(most);
}

/// When the first contact began to last.
long double first_rest(oracle::RigidSliderRun const& run) {
    for (auto const& e : run.events) {
        if (e.kind != oracle::RigidSliderEvent::Kind::impact) return e.time;
    }
    return std::numeric_limits<long double>::max();
}

struct Compared {
    int impacts = 0, lasting = 0, samples = 0;  // that were compared; samples with pairs in lasting contact
    int parted = 0;                             // members that are off after their first contact that lasts
};

/// With friction after the first contact that lasts: impacts without end are ended at some 1e-6 m/s (M13.6), which is 5e-5 of the speeds.
constexpr double after_rest = 1e-5;

/// Compares with the reference at each half millisecond.  Without restitution and with friction only as long as up to three pairs last: with more the
/// reference takes minutes.
Compared expect_reference(std::vector<Inputs> const& members, Parts const& parts, int samples, double tolerance) {
    std::vector<double> times;
    for (int i = 1; i <= samples; ++i) times.push_back(5e-4 * i);
    auto o = rigid_options(parts, 1e-12, times.back());
    o.series = parts.mechanism == Mechanism::free_slider ? selections::twelve_states : selections::ten_states;
    o.sample_times = times;
    auto const r = testing::run(best_isa(), o, members);
    Compared all;
    for (std::size_t m = 0; m < members.size(); ++m) {
        EXPECT_EQ(r.records[m].status, Status::finished) << m;
        std::size_t const most_held = parts.friction && members[m].restitution < 1e-9 ? 3 : 16;
        auto const reference = oracle::rigid_slider_run(members[m], parts, {times.begin(), times.end()}, most_held);
        EXPECT_TRUE(reference.solved) << m;
        EXPECT_LT(static_cast<double>(reference.largest_gain), 1e-20) << m;
        if (parts.mechanism == Mechanism::free_slider) {
            EXPECT_LT(std::abs(static_cast<double>(reference.energy_change + reference.restitution_loss +
                                                   reference.friction_loss)),
                      1e-16)
                << m;
        }
        for (std::size_t k = 0; k < reference.samples.size() && reference.held[k].size() <= most_held; ++k) {
            std::vector<double> state;
            for (std::size_t i = 0; i < static_cast<std::size_t>(info(parts.mechanism).states); ++i) {
                state.push_back(r.series[(i * members.size() + m) * times.size() + k]);
            }
            double const d = distance(members[m], parts, reference.samples[k], state);
            if (parts.friction && times[k] > first_rest(reference) && !(d < after_rest)) {
                ++all.parted;
                break;
            }
            double const allowed = parts.friction && times[k] > first_rest(reference) ? after_rest : tolerance;
            EXPECT_LT(d, allowed) << "member " << m << " at " << times[k] << " after " << reference.impacts[k]
                                    << " impacts, " << reference.held[k].size() << " pairs last";
            if (!(d < allowed)) break;
            ++all.samples, all.lasting += reference.held[k].empty() ? 0 : 1;
            all.impacts += k == 0 ? reference.impacts[k] : reference.impacts[k] - reference.impacts[k - 1];
        }
    }
    return all;
}

class RigidSlider : public ::testing::TestWithParam<double> {};

TEST_P(RigidSlider, MovesAsTheReferenceWithoutFriction) {
    auto const seen = expect_reference(drifting_sliders(6, 7, GetParam(), 0), rigid_joint_parts(false), 40, 3e-8);
    EXPECT_EQ(seen.samples, 6 * 40);
    EXPECT_GT(seen.impacts, 6 * 12);
    EXPECT_GE(seen.lasting, GetParam() < 1 ? 6 * 5 : 0);
}

TEST_P(RigidSlider, MovesAsTheReferenceWithFriction) {
    auto const seen = expect_reference(drifting_sliders(6, 8, GetParam(), 0.1), rigid_joint_parts(true), GetParam() > 0 ? 40 : 12, 3e-8);
    EXPECT_GT(seen.samples, 6 * (GetParam() > 0 ? 39 : 7));
    EXPECT_GE(seen.lasting, GetParam() == 1 ? 0 : 6 * 2);
    EXPECT_GE(seen.impacts, 6 * (GetParam() > 0 ? 10 : 1));
    // One of the six meets two faces in turn, faster and faster, where it is ended at 1e-7 s: 3e-4 of the clearance follow.
    EXPECT_LE(seen.parted, GetParam() > 0 ? 0 : 1);
}

TEST_P(RigidSlider, OfADriveMovesAsTheReference) {
    for (Mechanism const mechanism : {Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::slider_crank}) {
        for (bool const friction : {false, true}) {
            auto const members = drifting_sliders(2, 9, GetParam(), friction ? 0.1 : 0);
            auto const seen = expect_reference(members, rigid_joint_parts(friction, false, mechanism), 30, 3e-8);
            EXPECT_GE(seen.impacts, 2 * (friction && GetParam() == 0 ? 1 : 3)) << static_cast<int>(mechanism) << friction;
            EXPECT_EQ(seen.parted, 0) << static_cast<int>(mechanism) << friction;
        }
    }
}

TEST_P(RigidSlider, OfAMisalignedWayMovesAsTheReference) {
    for (bool const friction : {false, true}) {
        auto members = drifting_sliders(3, 10, GetParam(), friction ? 0.1 : 0);
        for (auto& in : members) {
            in.way_roll = 0.3, in.way_yaw = 0.02, in.way_pitch = -0.01, in.way_offset_y = 1e-5, in.way_offset_z = -2e-5;
            in.roll += in.way_roll, in.yaw += in.way_yaw, in.pitch += in.way_pitch;
        }
        // Without restitution more than three pairs last with friction after 4 ms, and the reference becomes slow.
        auto const seen = expect_reference(members, rigid_joint_parts(friction, true), friction && GetParam() == 0 ? 8 : 30, 3e-8);
        EXPECT_GE(seen.impacts, 3 * (friction && GetParam() == 0 ? 1 : 3)) << friction;
        EXPECT_EQ(seen.parted, 0) << friction;
    }
}

TEST_P(RigidSlider, OffItsPinAndMassCentreMovesAsTheReference) {
    for (Mechanism const mechanism : {Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::slider_crank}) {
        for (bool const friction : {false, true}) {
            if (friction && GetParam() == 0) continue;  // the reference takes minutes where more than three pairs last
            SCOPED_TRACE(std::string(info(mechanism).name) + (friction ? " with friction" : ""));
            auto members = drifting_sliders(friction ? 1 : 2, 11, GetParam(), friction ? 0.1 : 0);
            for (std::size_t i = 0; i < members.size(); ++i) {
                Inputs& in = members[i];
                in.mass_center_x = i == 0 ? 0.008 : -0.003, in.mass_center_y = 0.004, in.mass_center_z = -0.005;
                if (mechanism != Mechanism::free_slider) in.pin_x = i == 0 ? -0.01 : 0, in.pin_y = -0.003, in.pin_z = i == 0 ? 0.006 : 0;
            }
            Parts parts = rigid_joint_parts(friction, false, mechanism);
            parts.offset_slider = true;
            auto const seen = expect_reference(members, parts, GetParam() == 0 ? 8 : 14, 1e-7);
            EXPECT_GE(seen.impacts, GetParam() == 0 ? 2 : 3);
            EXPECT_EQ(seen.parted, 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Restitution, RigidSlider, ::testing::Values(0.0, 0.3, 0.6, 1.0));

}  // namespace
}  // namespace slideway::rigid_slider_test
