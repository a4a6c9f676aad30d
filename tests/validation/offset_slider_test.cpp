// Sliders whose centre of mass and pin do not lie in their hole's centre, and faces with clearances of their own (model.md 16): closed forms,
// the energy audit, lanes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "tests/support/loaded_member.hpp"

namespace slideway::offset_slider_test {
namespace {

using testing::afloat;
using testing::Loaded;
using testing::options;
using testing::Pieces;
using testing::run;
using testing::RunOptions;

RunOptions offset_options(Loaded const& l, Mechanism mechanism, double seconds, double tolerance) {
    RunOptions o = options(l, mechanism, seconds, tolerance);
    o.parts.offset_slider = true;
    return o;
}

/// In flight in a joint that it does not reach.
Loaded far_afloat() {
    Loaded l{afloat(), {}};
    l.in.clearance_y = l.in.clearance_z = 0.05;
    return l;
}

TEST(OffsetMassCentre, FliesStraightWhileTheSliderTurnsAboutIt) {
    Loaded l = far_afloat();
    double const sx = 0.01, sy = 0.004, sz = -0.003, wz = 1, vx = 0.02, vy = -0.01, t = 0.5;
    l.in.mass_center_x = sx, l.in.mass_center_y = sy, l.in.mass_center_z = sz;
    l.in.wz = wz, l.in.vx = vx, l.in.vy = vy, l.in.gravity = 0.05;
    auto const r = run(l, offset_options(l, Mechanism::free_slider, t, 1e-13));
    // ω × s of the centre of mass at the start.
    double const gx = sx + (vx - wz * sy) * t, gy = sy + (vy + wz * sx) * t - 0.025 * t * t, turned = wz * t;
    EXPECT_NEAR(r.states[0][6], turned, 1e-12);
    EXPECT_NEAR(r.states[0][10], gx - (sx * std::cos(turned) - sy * std::sin(turned)), 1e-12);
    EXPECT_NEAR(r.states[0][0], gy - (sx * std::sin(turned) + sy * std::cos(turned)), 1e-12);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-15);
}

/// A pin that is moved along X at constant speed, and the slider free to turn about it and to rise: with b from the pin to the centre of mass
/// across the way, (I + M b² cos² ψ) ψ'² stays as it is.
TEST(OffsetPin, SwingsAsItsFirstIntegralSays) {
    for (bool const by_mass : {false, true}) {
        Loaded l = far_afloat();
        double const b = 0.012, w = 1.5, angle = 0.4;
        (by_mass ? l.in.mass_center_y : l.in.pin_y) = b;
        if (by_mass) l.in.pin_x = 0.007, l.in.mass_center_x = 0.007;  // from pin to centre counts, whatever lies between
        l.in.wz = w, l.in.vy = by_mass ? -0.007 * w : 0;
        Inputs const all = complete_inputs(l.in);
        double const added = all.slider_mass * b * b, inertia = all.slider_inertia_z;
        // Simpson's rule.
        constexpr int parts = 2000;
        double t = 0;
        for (int i = 0; i <= parts; ++i) {
            double const c = std::cos(angle * i / parts);
            t += (i == 0 || i == parts ? 1 : i % 2 == 0 ? 2 : 4) * std::sqrt((inertia + added * c * c) / (inertia + added));
        }
        t *= angle / parts / 3 / w;
        auto const r = run(l, offset_options(l, Mechanism::carriage, t, 1e-13));
        EXPECT_NEAR(r.states[0][6], angle, 1e-11);
        EXPECT_NEAR(r.states[0][9], w * std::sqrt((inertia + added) / (inertia + added * std::cos(angle) * std::cos(angle))), 1e-10);
        EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-14);
        EXPECT_GT(std::abs(r.value(0, Quantity::drive_work)), 1e-7);
    }
}

TEST(OffsetMassCentre, IsCarriedByWhereItLies) {
    // An overhanging load comes to rest on the way's top: springs under it at both ends.
    Loaded l{{}, {}};
    double const sx = 0.006, sz = 0.004;
    l.in.mass_center_x = sx, l.in.mass_center_z = sz, l.in.mass_center_y = -0.02;
    l.in.law_a = 1e6, l.in.law_b = 300;
    l.in.y = -l.in.clearance_y, l.in.z = 0;
    auto o = offset_options(l, Mechanism::free_slider, 0.3, 1e-11);
    o.parts.law = Law::kelvin_voigt;
    auto const r = run(l, o);
    Inputs rest = complete_inputs(l.in, info(Mechanism::free_slider));
    auto const& s = r.states[0];
    rest.y = s[0], rest.z = s[1], rest.roll = s[4], rest.yaw = s[5], rest.pitch = s[6];
    double const now = 0;
    ProbeResult p;
    find_instance(best_isa(), o.parts).probe({&rest, &now, 1, &p});
    double force = 0, along = 0, across = 0;
    constexpr int signs[8][3] = {{1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, -1}, {1, -1, -1}};
    for (int i = 0; i < 8; ++i) {
        if (signs[i][0] < 0) continue;
        force += p.normal_force_y[i];
        along += p.normal_force_y[i] * signs[i][2] * 0.5 * rest.slider_length;
        across += p.normal_force_y[i] * signs[i][1] * 0.5 * rest.way_depth;
    }
    double const weight = rest.slider_mass * rest.gravity;
    EXPECT_NEAR(force, weight, 1e-6 * weight);
    EXPECT_NEAR(along / force, sx, 1e-5);
    EXPECT_NEAR(across / force, sz, 1e-5);
}

constexpr Mechanism with_a_body[] = {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::carriage, Mechanism::free_slider, Mechanism::slider_crank_motor,
                                     Mechanism::scotch_yoke_motor};

/// Off the centre in all directions, pushed, on ground that moves.
Loaded with_everything(Mechanism mechanism, PieceTable const& wave) {
    Loaded l{{}, {}};
    l.in.crank_speed = 30, l.in.vy = 0.01, l.in.inclination = 0.3, l.in.cross_inclination = 0.4;
    l.in.mass_center_x = 0.01, l.in.mass_center_y = -0.006, l.in.mass_center_z = 0.003;
    if (mechanism != Mechanism::free_slider) l.in.pin_x = -0.012, l.in.pin_y = 0.004, l.in.pin_z = 0.002;
    if (mechanism == Mechanism::free_slider) l.in.vx = 0.1;
    l.in.drive_torque = 0.3, l.in.drive_no_load_speed = 60, l.in.drive_inertia = 2e-4;
    Load& push = l.loads.emplace_back();
    push.turns_with_slider = true;
    l.put(push.force, {2, 1, -1});
    l.put(push.point, {0.02, 0.01, 0.01});
    for (std::size_t axis = 0; axis < 2; ++axis) {
        Load& ground = l.loads.emplace_back();
        ground.kind = LoadKind::ground_motion, ground.over = LoadArgument::time, ground.table = wave;
        ground.force[axis] = l.number(axis == 0 ? 10 : -5);
    }
    return l;
}

RunOptions everything_options(Loaded const& l, Mechanism mechanism, double seconds, double tolerance) {
    auto o = offset_options(l, mechanism, seconds, tolerance);
    o.parts.friction = true;
    if (info(mechanism).driven_form != nullptr) o.parts.drive = {.by = DriveBy::torque};
    return o;
}

void expect_audit(Mechanism mechanism, bool rigid, PieceTable const& wave) {
    SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
    Loaded l = with_everything(mechanism, wave);
    l.in.restitution = rigid ? 0.5 : 1;
    for (double const tolerance : {1e-6, 1e-9}) {
        auto o = everything_options(l, mechanism, 0.1, tolerance);
        o.parts.rigid = rigid;
        if (rigid) o.parts.damping = Damping::restitution;
        auto const r = run(l, o);
        double work = 0;
        for (Quantity const q : {Quantity::ground_work, Quantity::drive_work, Quantity::load_work, Quantity::friction_loss}) work += std::abs(r.value(0, q));
        EXPECT_GT(r.value(0, Quantity::contact_onsets), 0);
        EXPECT_GT(std::abs(r.value(0, Quantity::ground_work)), 1e-6);
        EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 200 * tolerance * work) << work;
    }
}

TEST(OffsetSliders, DriveTheAuditOfEveryMechanismToRounding) {
    Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, -1, 0, 1}}, 2, true);
    for (Mechanism const mechanism : with_a_body) {
        expect_audit(mechanism, false, wave.table());
        expect_audit(mechanism, true, wave.table());
    }
}

TEST(OffsetSliders, AreTheSameInEveryLane) {
    Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, -1, 0, 1}}, 2, true);
    for (Mechanism const mechanism : with_a_body) {
        for (int const way : {0, 1, 2}) {  // explicit, linearly implicit, rigid
            SCOPED_TRACE(std::string(info(mechanism).name) + " " + std::to_string(way));
            Loaded l = with_everything(mechanism, wave.table());
            l.in.restitution = way == 2 ? 0.5 : 1;
            auto o = everything_options(l, mechanism, 0.02, 1e-6);
            if (way == 1) o.settings.method = Method::ros34pw2;
            if (way == 2) o.parts.rigid = true, o.parts.damping = Damping::restitution;
            std::vector<Inputs> members(7, complete_inputs(l.in, info(mechanism)));
            for (std::size_t i = 0; i < members.size(); ++i) members[i].mass_center_x += 1e-3 * static_cast<double>(i);
            testing::expect_one_motion_on_all(o, members);
        }
    }
}

/// A linearly implicit method converges whatever its matrix; that its steps stay as large as without an offset shows that the matrix is right.
TEST(OffsetSliders, TakeTheStiffMethodsStepsAsOthers) {
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::free_slider}) {
        SCOPED_TRACE(std::string(info(mechanism).name));
        Loaded l{{}, {}};
        l.in.y = -l.in.clearance_y - 1e-7, l.in.law_a = 1e9, l.in.law_b = 3e3;
        auto const with = [&](Method method, double tolerance, bool offset) {
            Loaded member = l;
            if (offset) member.in.mass_center_x = 0.004, member.in.mass_center_y = 0.02;
            if (offset && mechanism != Mechanism::free_slider) member.in.pin_x = -0.006, member.in.pin_y = 0.003;
            auto o = offset_options(member, mechanism, 0.02, tolerance);
            o.parts.law = Law::kelvin_voigt, o.parts.offset_slider = offset, o.parts.friction = true;
            o.settings.method = method;
            return run(member, o);
        };
        auto const reference = with(Method::dop853, 1e-11, true), stiff = with(Method::ros34pw2, 1e-8, true), plain = with(Method::ros34pw2, 1e-8, false);
        for (std::size_t i : {0U, 6U}) EXPECT_NEAR(stiff.states[0][i], reference.states[0][i], 1e-9) << i;
        EXPECT_LT(stiff.records[0].steps_accepted, 3 * plain.records[0].steps_accepted);
    }
}

TEST(OffsetSliders, OfNoOffsetMoveAsOthers) {
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::carriage, Mechanism::free_slider}) {
        Loaded l{{}, {}};
        l.in.vz = 0.003;
        auto const plain = run(l, options(l, mechanism, 0.02, 1e-11)), offset = run(l, offset_options(l, mechanism, 0.02, 1e-11));
        for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(plain.states[0][i], offset.states[0][i], 1e-7 * (std::abs(plain.states[0][i]) + 1e-4)) << i;
    }
}

/// Four clearances are the same guide as two and an offset of the way, which may be turned and rigid.
TEST(FaceClearances, AreThoseOfAnOffsetWay) {
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::free_slider}) {
        for (bool const rigid : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (rigid ? " rigid" : ""));
            Loaded faces{{}, {}};
            // Numbers whose means are exact: touches make more of the last bit.
            double const c = 0x1p-14;
            faces.in.clearance_z = c, faces.in.clearance_y_plus = c, faces.in.clearance_y_minus = 3 * c, faces.in.clearance_z_minus = 0.5 * c;
            faces.in.vz = 0.01, faces.in.vy = 0.02, faces.in.restitution = 0.6;
            Loaded offset{faces};
            offset.in.clearance_y_plus = offset.in.clearance_y_minus = offset.in.clearance_z_minus = follows;
            offset.in.clearance_y = 2 * c, offset.in.clearance_z = 0.75 * c;
            offset.in.way_offset_y = c, offset.in.way_offset_z = -0.25 * c;
            double const t = rigid ? 0.02 : 0.008;
            auto of = options(faces, mechanism, t, 1e-10);
            of.parts.misaligned_way = true, of.parts.rigid = rigid;
            if (rigid) of.parts.damping = Damping::restitution;
            auto const a = run(faces, of), b = run(offset, of);
            EXPECT_GT(a.value(0, Quantity::contact_onsets), 0);
            for (std::size_t i = 0; i < a.states[0].size(); ++i) EXPECT_NEAR(a.states[0][i], b.states[0][i], 1e-12 * (1 + std::abs(b.states[0][i]))) << i;
        }
    }
}

}  // namespace
}  // namespace slideway::offset_slider_test
