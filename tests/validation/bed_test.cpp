// A slider on the elastic bed: one rest from every start, and flat impacts that return e.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::bed_test {
namespace {

/// Sliders thrown along a level way from scattered poses near it.  @param straight they neither roll nor lie to one side: what slides to the
/// side goes on doing so, and friction then tilts the loads
std::vector<Inputs> thrown(std::size_t count, bool straight) {
    auto members = testing::scattered_starts(count, 1e-4, 3.141592653589793, Law::foundation);
    for (Inputs& in : members) {
        Inputs const scattered = in;
        in = with_presets({}, Law::foundation);
        in.slider_mass = 0.2;
        in.friction_static = in.friction_kinetic = 0.4;
        in.friction_slip_speed = 2e-3;
        in.restitution = 0.6;
        in.y = -0.9e-4 + 0.1 * scattered.y;
        in.z = straight ? 0 : scattered.z;
        in.roll = straight ? 0 : 0.1 * scattered.roll;
        in.pitch = 0.1 * scattered.pitch;
        in.vx = 1;
        in = complete_inputs(in);
    }
    return members;
}

Inputs at_state(Inputs in, std::array<double, most_states> const& s) {
    double* const places[] = {&in.y, &in.z, &in.vy, &in.vz, &in.roll, &in.yaw, &in.pitch, &in.wx, &in.wy, &in.wz, &in.x, &in.vx};
    for (std::size_t i = 0; i < std::size(places); ++i) *places[i] = s[i];
    return in;
}

/// All of them end with these loads of the front and rear apices of the upper face.
void expect_loads(std::vector<Inputs> const& members, bool friction, double front, double rear) {
    testing::RunOptions o;
    o.parts = {Law::foundation, Damping::restitution, friction, false, Mechanism::free_slider};
    o.settings.end_time = 0.1;
    auto const r = testing::run(best_isa(), o, members);
    for (std::size_t i = 0; i < members.size(); ++i) {
        ASSERT_EQ(r.records[i].status, Status::finished) << i;
        Inputs const in = at_state(members[i], r.states[i]);
        double const t = 0.1;
        ProbeResult p;
        find_instance(best_isa(), o.parts).probe({&in, &t, 1, &p});
        // Apices are of the way: a slider that lies to one side of it bears on that side's.
        double const more = 2 * in.z / in.way_depth;
        EXPECT_NEAR(p.normal_force_y[0], front * (1 + more), 1e-4) << i;
        EXPECT_NEAR(p.normal_force_y[3], front * (1 - more), 1e-4) << i;
        EXPECT_NEAR(p.normal_force_y[4], rear * (1 + more), 1e-4) << i;
        EXPECT_NEAR(p.normal_force_y[7], rear * (1 - more), 1e-4) << i;
    }
}

TEST(FoundationRuns, RestOnOneSetOfLoadsFromEveryStart) {
    // Statics: the rear bears μ N (w_a/2 + c)/L_k more than the front, for friction acts that far beside the centre.
    double const weight = 0.2 * 9.81, more = 0.4 * weight * 0.0101 / 0.04, front = (weight / 2 - more) / 2, rear = (weight / 2 + more) / 2;
    EXPECT_NEAR(front, 0.3914, 1e-4);
    expect_loads(thrown(64, true), true, front, rear);
    expect_loads(thrown(64, false), false, weight / 4, weight / 4);
}

TEST(FoundationRuns, ReturnFlatImpactsTimesTheCoefficient) {
    for (double const e : {0.2, 0.4, 0.6, 0.8, 0.95, 1.0}) {
        for (double const speed : {1e-3, 0.03, 1.0}) {
            Inputs in = with_presets({}, Law::foundation);
            in.gravity = 0;
            in.restitution = e;
            in.y = -0.9e-4;
            in.vy = -speed;
            testing::RunOptions o;
            o.parts = {Law::foundation, Damping::restitution, false, false, Mechanism::free_slider};
            o.settings.rtol = o.settings.atol = 1e-9;
            o.settings.end_time = 6e-5 / speed;
            auto const r = testing::run(best_isa(), o, {complete_inputs(in)});
            EXPECT_EQ(r.value(0, Quantity::contact_onsets), 1);
            EXPECT_NEAR(r.states[0][2] / speed, e, 1e-6) << "e " << e << " speed " << speed;
        }
    }
}

TEST(FoundationRuns, AreAsStiffAsTheirBed) {
    // Half a vibration on k = κ A lasts π √(M/(κ A)).
    Inputs in = with_presets({}, Law::foundation);
    in.law_a = 2e10;
    in.gravity = 0;
    in.y = -1e-4;
    in.vy = -0.01;
    in = complete_inputs(in);
    double const half = 3.14159265358979323846 * std::sqrt(in.slider_mass / (2e10 * in.slider_length * in.way_depth));
    testing::RunOptions o;
    o.parts = {Law::foundation, Damping::point, false, false, Mechanism::free_slider};
    o.settings.rtol = o.settings.atol = 1e-9;
    o.settings.end_time = half / 2;
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_NEAR(r.states[0][2], 0, 1e-7);
    EXPECT_NEAR(r.value(0, Quantity::peak_normal_force), 0.01 * std::sqrt(2e10 * in.slider_length * in.way_depth * in.slider_mass), 1e-4);
}

}  // namespace
}  // namespace slideway::bed_test
