// Ways whose faces are worn, tapered or end (model.md 18): closed forms, the gradient, mirrored motion, the energy audit, lanes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/piece_function.hpp"
#include "tests/support/loaded_member.hpp"

namespace slideway::way_profile_test {
namespace {

using testing::Loaded;
using testing::options;
using testing::Pieces;
using testing::run;
using testing::RunOptions;

constexpr int y_plus = 1, y_minus = 2, y_faces = 3, all_faces = 15;

Load& add_profile(Loaded& l, PieceTable const& table, int faces) {
    Load& load = l.loads.emplace_back();
    load.kind = LoadKind::way_profile, load.over = LoadArgument::x, load.table = table, load.faces = faces;
    return load;
}

void add_ends(Loaded& l, double from, double to) {
    Load& load = l.loads.emplace_back();
    load.kind = LoadKind::way_ends;
    load.from = l.number(from), load.to = l.number(to);
}

ProbeResult probe(Loaded const& l, Parts const& parts) {
    Inputs const in = complete_inputs(l.in, info(parts.mechanism));
    double const now = 0;
    ProbeResult p;
    find_instance(best_isa(), parts).probe({&in, &now, 1, &p});
    return p;
}

Parts sliding(Loaded const& l, Law law = Law::conservative) {
    Parts parts = options(l, Mechanism::free_slider, 1, 1).parts;
    parts.law = law;
    return parts;
}

double sum(double const (&of)[8]) {
    double total = 0;
    for (double const one : of) total += one;
    return total;
}

TEST(WayProfile, OfAConstantDepthIsMoreClearance) {
    Pieces const flat({{-1, 3e-5, 0, 0, 0}}, 1);
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::carriage, Mechanism::free_slider}) {
        SCOPED_TRACE(std::string(info(mechanism).name));
        Loaded wide{{}, {}};
        wide.in.crank_speed = 40, wide.in.vz = 0.01;
        Loaded profiled = wide;
        wide.in.clearance_y = wide.in.clearance_z = 1e-4;
        profiled.in.clearance_y = profiled.in.clearance_z = 4e-5;
        add_profile(profiled, flat.table(), all_faces).scale = profiled.number(2);
        auto const fixed = [&](Loaded const& l) {
            RunOptions o = options(l, mechanism, 0.01, 1e-10);
            o.settings.method = Method::rk4, o.settings.fixed_step = 1e-6;
            o.parts.friction = true;
            return run(l, o);
        };
        auto const a = fixed(wide), b = fixed(profiled);
        EXPECT_GT(a.value(0, Quantity::contact_onsets), 0);
        for (std::size_t i = 0; i < a.states[0].size(); ++i) EXPECT_NEAR(a.states[0][i], b.states[0][i], 1e-10 * (1e-2 + std::abs(a.states[0][i]))) << i;
    }
}

/// Faces that run side by side at a slope are a way that is pitched by it.
TEST(WayProfile, OfParallelSlopesIsAPitchedWay) {
    double const slope = 1e-4, reach = 0.1;
    Pieces const rises({{-reach, 0, slope, 0, 0}}, reach), falls({{-reach, 2 * slope * reach, -slope, 0, 0}}, reach);
    Loaded profiled{{}, {}};
    add_profile(profiled, rises.table(), y_minus), add_profile(profiled, falls.table(), y_plus);
    profiled.in.clearance_y = 1e-4 - slope * reach;
    Loaded pitched{{}, {}};
    pitched.in.clearance_y = 1e-4, pitched.in.way_pitch = slope;
    Parts turned = sliding(pitched), straight = sliding(profiled);
    turned.misaligned_way = true;
    turned.friction = straight.friction = true;
    for (double const x : {-0.03, 0.0, 0.05}) {
        for (Loaded* l : {&pitched, &profiled}) l->in.x = x, l->in.y = slope * x - 1e-4 - 2e-7, l->in.pitch = slope - 3e-6, l->in.vx = 0.2, l->in.vy = -2e-3;
        ProbeResult const a = probe(pitched, turned), b = probe(profiled, straight);
        EXPECT_GT(sum(a.normal_force_y), 1);
        for (int i = 0; i < 8; ++i) {
            EXPECT_NEAR(a.penetration_y[i], b.penetration_y[i], 0.5 * slope * slope * 0.0101) << i << ": half the width, times 1 - cos";
            EXPECT_NEAR(a.normal_force_y[i], b.normal_force_y[i], 1e-3 * sum(a.normal_force_y)) << i;
        }
        for (int i = 0; i < 12; ++i) EXPECT_NEAR(a.derivative[i], b.derivative[i], 1e-3 * (std::abs(a.derivative[i]) + 1)) << i;
        EXPECT_NEAR(a.power_damping, b.power_damping, 1e-3 * std::abs(a.power_damping) + 1e-12);
    }
}

/// The force of contact is the gradient of its potential, along the way, too; so no closed path of poses does work.
TEST(WayProfile, PushesAsItsPotentialFalls) {
    Pieces const worn({{-0.03, 0, 0, 0.02, -0.3}, {0, 9.9e-6, 3.9e-4, -7e-3, 0.08}}, 0.04);
    for (Law const law : {Law::conservative, Law::kelvin_voigt, Law::foundation}) {
        SCOPED_TRACE(static_cast<int>(law));
        Loaded l{{}, {}};
        l.in.clearance_y = l.in.clearance_z = 5e-5, l.in.gravity = 0, l.in.law_a = 1e9;
        add_profile(l, worn.table(), y_minus).scale = l.number(2);
        add_profile(l, worn.table(), 4 | y_plus);
        add_ends(l, -0.015, 0.018);
        Parts const parts = sliding(l, law);
        double const m = complete_inputs(l.in, info(Mechanism::free_slider)).slider_mass;
        double largest = 0;
        for (double const x : {-4e-3, -1e-3, 3e-3, 9e-3}) {
            Loaded at = l;
            at.in.y = -6.5e-5, at.in.z = 6e-5, at.in.pitch = 4e-4, at.in.yaw = -5e-4, at.in.roll = 1e-4;
            auto const potential = [&](double place) {
                at.in.x = place;
                return probe(at, parts).contact_potential;
            };
            double const step = 2e-6, gradient = (8 * (potential(x + step) - potential(x - step)) - (potential(x + 2 * step) - potential(x - 2 * step))) / (12 * step);
            at.in.x = x;
            ProbeResult const p = probe(at, parts);
            EXPECT_NEAR(m * p.derivative[11], -gradient, 1e-6 * (sum(p.normal_force_y) + sum(p.normal_force_z)) * 1e-3) << x;
            largest = std::max(largest, std::abs(gradient));
        }
        EXPECT_GT(largest, 1e-3);
    }
}

TEST(WayProfile, MirroredMovesAsItsMirrorImage) {
    Pieces const taper({{-0.05, 0, 5e-4, 0, 0}}, 0.05), mirror({{-0.05, 5e-5, -5e-4, 0, 0}}, 0.05);
    auto const slide = [&](Pieces const& table, double sign) {
        Loaded l{{}, {}};
        l.in.x = -0.01 * sign, l.in.vx = 0.3 * sign, l.in.vz = 0.02, l.in.vy = -0.03;
        l.in.pitch = 4e-4 * sign, l.in.yaw = -3e-4 * sign, l.in.wz = 0.05 * sign, l.in.wx = 0.04;
        add_profile(l, table.table(), y_faces);
        auto o = options(l, Mechanism::free_slider, 0.007, 1e-10);  // before impacts have made much of the last bit
        o.parts.friction = true;
        return run(l, o);
    };
    auto const a = slide(taper, 1), b = slide(mirror, -1);
    EXPECT_GT(a.value(0, Quantity::contact_onsets), 0);
    double const signs[] = {1, 1, 1, 1, 1, -1, -1, 1, -1, -1, -1, -1};  // y z vy vz, roll and its rate stay
    for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(a.states[0][i], signs[i] * b.states[0][i], 1e-6 * (1e-2 + std::abs(a.states[0][i]))) << i;
}

/// A slider that lies across a way's end is held there and at its other end by the lever rule.
TEST(WayEnds, CarryWhatOverhangsThem) {
    double const to = 5e-3;
    Loaded l{{}, {}};
    add_ends(l, -1, to);
    l.in.law_a = 1e6, l.in.law_b = 300;
    l.in.y = -l.in.clearance_y;
    auto o = options(l, Mechanism::free_slider, 0.3, 1e-11);
    o.parts.law = Law::kelvin_voigt, o.parts.friction = true;
    auto const r = run(l, o);
    auto const& s = r.states[0];
    Loaded rest = l;
    rest.in.y = s[0], rest.in.z = s[1], rest.in.roll = s[4], rest.in.yaw = s[5], rest.in.pitch = s[6], rest.in.x = s[10];
    ProbeResult const p = probe(rest, o.parts);
    double front = 0, rear = 0;
    for (int i = 0; i < 8; ++i) (i < 4 ? front : rear) += p.normal_force_y[i];
    Inputs const in = complete_inputs(l.in);
    double const weight = in.slider_mass * in.gravity, behind = 0.5 * in.slider_length, ahead = to - s[10];
    EXPECT_NEAR(front + rear, weight, 1e-6 * weight);
    EXPECT_NEAR(front, weight * behind / (behind + ahead), 1e-5 * weight);
}

TEST(WayEnds, ThatASliderLeavesEndItsMember) {
    Loaded l{{}, {}};
    l.in.gravity = 0, l.in.vx = 1;
    add_ends(l, -0.1, 0.02);
    auto const o = options(l, Mechanism::free_slider, 0.2, 1e-8);
    auto const r = testing::run(best_isa(), o, {complete_inputs(l.in, info(Mechanism::free_slider))});
    EXPECT_EQ(r.records[0].status, Status::geometry);
    EXPECT_NEAR(r.records[0].time, 0.04, 1e-3) << "half its length beyond the end";
}

constexpr Mechanism of_space[] = {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::carriage, Mechanism::free_slider, Mechanism::slider_crank_motor,
                                  Mechanism::scotch_yoke_motor};

/// Worn, and shorter than the slider's travel needs it.
struct Worn {
    Loaded l{{}, {}};
    PieceFunction wear;

    explicit Worn(Mechanism mechanism) : wear(places(), depths(), Interpolation::spline, true) {
        l.in.crank_speed = 40, l.in.vy = 0.02, l.in.vz = -0.01, l.in.inclination = 0.2, l.in.cross_inclination = 0.3;
        l.in.drive_torque = 0.3, l.in.drive_no_load_speed = 60, l.in.drive_inertia = 2e-4;
        if (mechanism == Mechanism::free_slider) l.in.vx = 0.3;
        add_profile(l, wear.table(), y_minus).scale = l.number(1.5);
        add_profile(l, wear.table(), 12);
        double const at = mechanism == Mechanism::slider_crank || mechanism == Mechanism::slider_crank_motor ? l.in.crank_length + l.in.rod_length
                          : mechanism == Mechanism::scotch_yoke || mechanism == Mechanism::scotch_yoke_motor ? l.in.crank_length : 0;
        // Of a free slider both ends overhang, of a crank's the front one at the start.
        add_ends(l, mechanism == Mechanism::free_slider ? -0.018 : at - 0.13, at + 0.0185);
    }
    static std::vector<double> places() { return {0, 0.01, 0.02, 0.03, 0.04}; }
    static std::vector<double> depths() { return {0, 2e-5, 5e-6, 1e-5, 0}; }

    RunOptions run_options(Mechanism mechanism, double seconds, double tolerance) const {
        auto o = options(l, mechanism, seconds, tolerance);
        o.parts.friction = true;
        if (info(mechanism).driven_form != nullptr) o.parts.drive = {.by = DriveBy::torque};
        return o;
    }
};

TEST(WayProfile, DrivesTheAuditOfEveryMechanismToRounding) {
    for (Mechanism const mechanism : of_space) {
        SCOPED_TRACE(std::string(info(mechanism).name));
        Worn const worn(mechanism);
        for (double const tolerance : {1e-6, 1e-9}) {
            auto const r = run(worn.l, worn.run_options(mechanism, 0.05, tolerance));
            double work = std::abs(r.value(0, Quantity::energy_change));
            for (Quantity const q : {Quantity::drive_work, Quantity::friction_loss}) work += std::abs(r.value(0, q));
            EXPECT_GT(r.value(0, Quantity::contact_onsets), 0);
            EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 200 * tolerance * work) << work;
        }
    }
}

TEST(WayProfile, IsTheSameInEveryLane) {
    for (Mechanism const mechanism : of_space) {
        for (bool const stiff : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (stiff ? " stiff" : ""));
            Worn const worn(mechanism);
            auto o = worn.run_options(mechanism, 0.02, 1e-6);
            if (stiff) o.settings.method = Method::ros34pw2;
            std::vector<Inputs> members(7, complete_inputs(worn.l.in, info(mechanism)));
            for (std::size_t i = 0; i < members.size(); ++i) members[i].vy += 1e-3 * static_cast<double>(i);
            testing::expect_one_motion_on_all(o, members);
        }
    }
}

/// The stiff method's matrix knows where the segment's ends lie; it takes no more steps than on a straight way.
TEST(WayProfile, TakesTheStiffMethodsStepsAsOthers) {
    Pieces const bends({{-1, 0, 0, 0, 0}, {0.16, 0, 0, 2e-3, 0}}, 1);
    auto const with = [&](Method method, double tolerance, bool profiled) {
        Loaded l{{}, {}};
        l.in.y = -l.in.clearance_y - 1e-7, l.in.law_a = 1e9, l.in.law_b = 3e3;
        if (profiled) add_profile(l, bends.table(), y_faces), add_ends(l, -1, 0.2022);  // half of the front half overhangs
        auto o = options(l, Mechanism::slider_crank, 0.02, tolerance);
        o.parts.law = Law::kelvin_voigt, o.parts.friction = true;
        o.settings.method = method;
        return run(l, o);
    };
    auto const reference = with(Method::dop853, 1e-11, true), stiff = with(Method::ros34pw2, 1e-8, true), plain = with(Method::ros34pw2, 1e-8, false);
    for (std::size_t i : {0U, 6U}) EXPECT_NEAR(stiff.states[0][i], reference.states[0][i], 1e-8) << i;
    EXPECT_LT(stiff.records[0].steps_accepted, 3 * plain.records[0].steps_accepted);
}

}  // namespace
}  // namespace slideway::way_profile_test
