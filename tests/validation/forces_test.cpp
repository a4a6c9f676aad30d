// Forces of faces and pins (model.md 17): statics by hand, balances of the mechanism, and how often faces are met.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/loaded_member.hpp"

namespace slideway::forces_test {
namespace {

using testing::Loaded;
using testing::options;
using testing::run;

/// What series there are of one member.
struct Sampled {
    Selection asked;
    std::vector<double> times;
    testing::EnsembleResult result;

    [[nodiscard]] double at(Series s, std::size_t sample) const {
        std::size_t row = 0;
        for (int i = 0; i < static_cast<int>(s); ++i) row += selects(asked, static_cast<Series>(i)) ? 1 : 0;
        return result.series[row * times.size() + sample];
    }
    [[nodiscard]] double last(Series s) const { return at(s, times.size() - 1); }
};

Sampled sampled(Loaded const& l, testing::RunOptions o, std::size_t samples) {
    Sampled s{info(o.parts.mechanism).series, {}, {}};
    for (std::size_t i = 0; i < samples; ++i) s.times.push_back(o.settings.end_time * static_cast<double>(i + 1) / static_cast<double>(samples));
    o.series = s.asked, o.sample_times = s.times;
    s.result = run(l, o);
    return s;
}

/// Springs and dampers at the apices, on which a slider soon lies still; its tilt, by what they give way, turns forces by 1e-8.
testing::RunOptions damped(Loaded& l, Mechanism mechanism, double seconds) {
    l.in.law_a = 1e9, l.in.law_b = 5e3;
    auto o = options(l, mechanism, seconds, 1e-10);
    o.parts.law = Law::kelvin_voigt;
    return o;
}

TEST(Forces, OfASliderAtRestAreItsWeightWhereTheTorquesAreBalanced) {
    Loaded l{{}, {{}}};
    double const weight = complete_inputs(l.in).slider_mass * l.in.gravity, a = 0.2 * l.in.slider_length, b = 0.1 * l.in.way_depth;
    // N at (a, b) on the upper face has the torques −b N about X and a N about Z.
    l.put(l.loads[0].torque, {b * weight, 0, -a * weight});
    auto const s = sampled(l, damped(l, Mechanism::free_slider, 0.2), 4);
    EXPECT_NEAR(s.last(Series::face_force_y_plus), weight, 1e-7 * weight);
    EXPECT_NEAR(s.last(Series::face_along_y_plus), a, 1e-6 * a);
    EXPECT_NEAR(s.last(Series::face_across_y_plus) - s.last(Series::z), b, 1e-6 * b) << "from the way's axis, which it drifts away from";
    EXPECT_NEAR(s.last(Series::contact_force_y), weight, 1e-7 * weight);
    for (Series const none : {Series::face_force_y_minus, Series::face_force_z_plus, Series::face_force_z_minus, Series::face_along_y_minus,
                              Series::face_across_z_plus, Series::friction_force_x, Series::contact_force_x, Series::face_pv_z_minus})
        EXPECT_EQ(s.last(none), 0) << series_table[static_cast<int>(none)].name;
    EXPECT_GE(s.result.value(0, Quantity::face_onsets, 0), 1);
    EXPECT_EQ(s.result.value(0, Quantity::face_onsets, 2), 0);
}

TEST(Forces, OfASliderPushedSidewaysAreOfASideFace) {
    Loaded l{{}, {{}}};
    double const weight = complete_inputs(l.in).slider_mass * l.in.gravity, a = 0.1 * l.in.slider_length;
    l.put(l.loads[0].force, {0, 0, -2 * weight});
    l.put(l.loads[0].torque, {0, 2 * a * weight, 0});
    auto const s = sampled(l, damped(l, Mechanism::free_slider, 0.2), 2);
    // The face Z+ pushes along +Z at x = a: −2 a M g about Y.
    EXPECT_NEAR(s.last(Series::face_force_z_plus), 2 * weight, 2e-7 * weight);
    EXPECT_NEAR(s.last(Series::face_along_z_plus), a, 1e-6 * a);
    EXPECT_NEAR(s.last(Series::contact_force_z), 2 * weight, 2e-7 * weight);
    EXPECT_NEAR(s.last(Series::contact_force_y), weight, 1e-7 * weight);
}

TEST(Forces, OfFrictionAreMuTimesNAgainstTheMotion) {
    // A carriage at constant speed: friction holds it back with μ N, and p v is N v over the area.
    Loaded l{{}, {}};
    auto o = damped(l, Mechanism::carriage, 0.1);
    o.settings.rtol = o.settings.atol = 1e-7;
    o.parts.friction = true;
    auto const in = complete_inputs(l.in, info(Mechanism::carriage));
    double const weight = in.slider_mass * in.gravity;
    auto const s = sampled(l, o, 2);
    double const v = s.last(Series::vx);
    ASSERT_GT(std::abs(v), in.friction_slip_speed);
    EXPECT_NEAR(s.last(Series::face_force_y_plus), weight, 1e-6 * weight);
    EXPECT_NEAR(s.last(Series::friction_force_x), std::copysign(in.friction_kinetic * weight, -v), 1e-6 * weight);
    EXPECT_NEAR(s.last(Series::face_pv_y_plus), weight * std::abs(v) / (in.slider_length * in.way_depth), 1e-6 * weight * std::abs(v) / (in.slider_length * in.way_depth));
}

TEST(Forces, OfPinsBalanceSliderRodAndCrank) {
    testing::Pieces const wave({{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, 1, 0, 0}}, 2, true);
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::slider_crank_motor}) {
        for (bool const shaken : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (shaken ? " shaken" : ""));
            Loaded l{{}, {{}}};
            l.in.crank_speed = 40, l.in.vy = 0.01, l.in.inclination = 0.3;
            std::array<double, 3> const push{-5, 1, 0.5};
            l.put(l.loads[0].force, push);
            if (shaken) {
                Load& ground = l.loads.emplace_back();
                ground.kind = LoadKind::ground_motion, ground.over = LoadArgument::time, ground.table = wave.table();
                l.put(ground.force, {7, -11, 5});
            }
            auto o = damped(l, mechanism, 0.2);
            o.parts.friction = true;
            if (mechanism == Mechanism::slider_crank_motor) {
                o.parts.drive.by = DriveBy::torque;
                l.in.drive_torque = 0.2, l.in.drive_inertia = 1e-3;
            }
            auto const in = complete_inputs(l.in, info(mechanism));
            auto const s = sampled(l, o, 23);
            double const beta = in.inclination, g[] = {-in.gravity * std::sin(beta), -in.gravity * std::cos(beta), 0}, shakes[] = {7, -11, 5};
            for (std::size_t i = 0; i < s.times.size(); ++i) {
                double const factor = shaken ? [&, t = s.times[i]] { return t < 0.5 ? 1 + 2 * t : 2.0; }() : 0.0;
                double felt[3], force = 0;
                for (int k = 0; k < 3; ++k) {
                    auto const of = [&](Series x) { return s.at(static_cast<Series>(static_cast<int>(x) + k), i); };
                    felt[k] = g[k] - factor * shakes[k];
                    double const balance = in.slider_mass * (of(Series::ax) - felt[k]) - of(Series::contact_force_x) - push[static_cast<std::size_t>(k)];
                    EXPECT_NEAR(of(Series::rod_force_x), balance, 1e-9 * (1 + std::abs(balance)));
                    force = std::hypot(force, of(Series::crank_pin_force_x));
                }
                if (mechanism == Mechanism::slider_crank_motor) continue;
                // The drive turns the crank: (A × F_A)_z, less the torque of the crank's weight in its middle.
                double const angle = in.start_angle + in.crank_speed * s.times[i], x = in.crank_length * std::cos(angle), y = in.crank_length * std::sin(angle);
                double const torque = x * s.at(Series::crank_pin_force_y, i) - y * s.at(Series::crank_pin_force_x, i) - 0.5 * in.crank_mass * (x * felt[1] - y * felt[0]);
                EXPECT_NEAR(s.at(Series::crank_torque, i), torque, 1e-10 * in.crank_length * (1 + force));
            }
        }
    }
}

TEST(Forces, OfFacesAreMetAsOftenAsFlightsEndByStepsAndByClocks) {
    for (Method const method : {Method::dopri5, Method::verner65}) {
        Loaded l{{}, {}};
        l.in.chi_surface = l.in.chi_line = 0.5;
        auto o = options(l, Mechanism::free_slider, 0.03, 1e-8);
        o.parts.damping = Damping::rate;
        o.settings.method = method;
        auto const r = run(l, o);
        EXPECT_EQ(r.value(0, Quantity::face_onsets, 0), r.value(0, Quantity::contact_onsets)) << "it falls flat on its upper face";
        for (int face = 1; face < 4; ++face) EXPECT_EQ(r.value(0, Quantity::face_onsets, face), 0);
        EXPECT_GE(r.value(0, Quantity::face_onsets, 0), 3);
    }
}

/// The speed of a fall, v² = v0² + 2 g s, a thousandth below and above each bin's: steps that end at touches, that do not, and clocks.
TEST(Forces, OfFacesAreMetAtTheSpeedsOfFalls) {
    struct Kind { Law law; Damping damping; Method method; };
    for (Kind const& kind : {Kind{Law::conservative, Damping::point, Method::dopri5}, Kind{Law::conservative, Damping::rate, Method::dopri5},
                             Kind{Law::conservative, Damping::rate, Method::verner65}, Kind{Law::paper, Damping::point, Method::dopri5},
                             Kind{Law::kelvin_voigt, Damping::point, Method::bs32}, Kind{Law::conservative, Damping::restitution, Method::dopri5}}) {
        for (int edge = 1; edge < impact_speed_count; ++edge) {
            for (double const share : {0.999, 1.001}) {
                double const speed = share * impact_speed_bins[edge];
                Loaded l{{}, {}};
                l.in.chi_surface = l.in.chi_line = 0.5, l.in.law_a = 1e9, l.in.law_b = 5e3, l.in.restitution = 0.5;
                // As high as there is room, at a tenth of the speed or more.
                double const fall = std::min(1e-4, 0.99 * speed * speed / (2 * l.in.gravity));
                l.in.y = fall - 1e-4, l.in.vy = -std::sqrt(speed * speed - 2 * l.in.gravity * fall);
                double const flight = (speed + l.in.vy) / l.in.gravity;
                auto o = options(l, Mechanism::free_slider, 1.02 * flight + 3e-5, 1e-8);
                o.parts.law = kind.law, o.parts.damping = kind.damping, o.settings.method = kind.method;
                auto const r = run(l, o);
                ASSERT_GE(r.value(0, Quantity::face_onsets, 0), 1) << edge;
                double of_all = 0;
                for (int bin = 0; bin < impact_speed_count; ++bin) of_all += r.value(0, Quantity::impact_speeds, bin);
                EXPECT_EQ(of_all, r.value(0, Quantity::face_onsets, 0));
                int const bin = share < 1 ? edge - 1 : edge;
                EXPECT_EQ(r.value(0, Quantity::impact_speeds, bin), 1) << info(kind.law).name << " " << static_cast<int>(kind.method) << " at " << speed;
            }
        }
    }
}

/// v_k = e^k √(2 g s), of a flat slider that falls a height s; bounces that are ended at once are none of them.
TEST(Forces, OfRigidFacesAreMetAtTheSpeedsOfBounces) {
    Loaded l{{}, {}};
    l.in.restitution = 0.5, l.in.clearance_y = 1e-3;
    double const fall = 1.5e-3;
    l.in.y = fall - l.in.clearance_y;
    auto o = options(l, Mechanism::free_slider, 0.2, 1e-8);
    o.parts.rigid = true, o.parts.damping = Damping::restitution;
    auto const r = run(l, o);
    double expected[impact_speed_count] = {};
    for (double v = std::sqrt(2 * l.in.gravity * fall); v > 1e-3; v *= l.in.restitution) {
        int bin = 0;
        while (bin + 1 < impact_speed_count && v >= impact_speed_bins[bin + 1]) ++bin;
        ++expected[bin];
    }
    for (int bin = 1; bin < impact_speed_count; ++bin) EXPECT_EQ(r.value(0, Quantity::impact_speeds, bin), expected[bin]) << bin;
    EXPECT_EQ(r.value(0, Quantity::face_onsets, 0), r.value(0, Quantity::contact_onsets));
    for (int face = 1; face < 4; ++face) EXPECT_EQ(r.value(0, Quantity::face_onsets, face), 0);
}

}  // namespace
}  // namespace slideway::forces_test
