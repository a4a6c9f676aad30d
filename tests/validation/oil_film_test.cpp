// A film of oil between slider and way (model.md 14): closed forms, the energy audit, and the methods that integrate it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/loaded_member.hpp"

namespace slideway::oil_film_test {
namespace {

using std::numbers::pi;
using testing::Loaded;
using testing::options;
using testing::run;

constexpr Mechanism sliders[] = {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::carriage, Mechanism::free_slider,
                                 Mechanism::slider_crank_motor, Mechanism::scotch_yoke_motor};

void add_film(Loaded& l, double viscosity, double least_gap, double cavitation_pressure = 0) {
    Load& load = l.loads.emplace_back();
    load.kind = LoadKind::film;
    load.viscosity = l.number(viscosity), load.least_gap = l.number(least_gap), load.cavitation_pressure = l.number(cavitation_pressure);
}

/// Of the standard slider: 40 × 30 mm over the Y faces, 40 × 20 mm over the Z faces.
constexpr double length = 0.04, width_y = 0.03, width_z = 0.02;
/// Damping of the squeeze times h³.
double squeeze_of(double viscosity, double width) { return viscosity * width * width * width * (length - 0.63 * width); }

double mass_of(Loaded const& l) { return complete_inputs(l.in).slider_mass; }

TEST(OilFilm, BrakesASliderAsCouetteSays) {
    Loaded l{{}, {}};
    l.in.gravity = 0, l.in.clearance_y = 5e-5, l.in.clearance_z = 8e-5, l.in.vx = 0.3;
    double const viscosity = 0.1, m = mass_of(l), drag = 2 * viscosity * length * (width_y / 5e-5 + width_z / 8e-5), t = 0.7 * m / drag;
    add_film(l, viscosity, 1e-6);
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-13));
    double const speed = 0.3 * std::exp(-drag * t / m), energy = 0.5 * m * 0.09;
    EXPECT_NEAR(r.states[0][11], speed, 1e-10 * 0.3);
    EXPECT_NEAR(r.states[0][10], (0.3 - speed) * m / drag, 1e-10);
    EXPECT_NEAR(r.value(0, Quantity::film_loss), 0.5 * m * (0.09 - speed * speed), 1e-10 * energy);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-12 * energy);
    EXPECT_EQ(r.value(0, Quantity::friction_loss), 0);
}

TEST(OilFilm, TakesTheWorkOfADrive) {
    // x = r cos ωt in a turn: ∫k x'² dt = π k r² ω.
    Loaded l{{}, {}};
    l.in.gravity = 0, l.in.crank_speed = 20;
    add_film(l, 0.02, 1e-6);
    double const r = l.in.crank_length, drag = 2 * 0.02 * length * (width_y + width_z) / l.in.clearance_y, work = pi * drag * r * r * 20;
    auto const result = run(l, options(l, Mechanism::scotch_yoke, 2 * pi / 20, 1e-12));
    EXPECT_NEAR(result.value(0, Quantity::film_loss), work, 1e-9 * work);
    EXPECT_NEAR(result.value(0, Quantity::drive_work), work, 1e-9 * work);
}

/// A slider that sinks through its film under its weight, level.
struct Sinking {
    Loaded l{{}, {}};
    double viscosity = 1e-3, from = 1e-4, weight = 0;

    explicit Sinking(double gravity) {
        l.in.gravity = gravity, l.in.clearance_y = l.in.clearance_z = 1e-4;
        add_film(l, viscosity, 1e-7);
        weight = mass_of(l) * gravity;
    }
    double squeeze() const { return squeeze_of(viscosity, width_y); }
    /// Of the films at its sides, which it shears.
    double drag() const { return 2 * viscosity * length * width_z / 1e-4; }
    double gap(testing::EnsembleResult const& r) const { return from + r.states[0][0]; }
    /// M v = −W t + c/2 (1/h² − 1/h0²) + k (h0 − h), M (h' − h0') with nothing left out: what of it is left over, of W t.
    double left_of_momentum(testing::EnsembleResult const& r, double t) const {
        double const h = gap(r), pushed = 0.5 * squeeze() * (1 / (h * h) - 1 / (from * from)) + drag() * (from - h);
        return (mass_of(l) * r.states[0][2] + weight * t - pushed) / (weight * t);
    }
};

TEST(OilFilm, IsSqueezedAsReynoldsSays) {
    Sinking sinking(9.81);
    double const t = 0.4;
    auto o = options(sinking.l, Mechanism::free_slider, t, 1e-10);
    auto const r = run(sinking.l, o);
    double const h = sinking.gap(r);
    EXPECT_LT(h, 0.3 * sinking.from);
    EXPECT_NEAR(sinking.left_of_momentum(r, t), 0, 1e-8);
    // The law of Stefan, without inertia and sides: t = c/(2W) (1/h² − 1/h0²).
    EXPECT_NEAR(0.5 * sinking.squeeze() / sinking.weight * (1 / (h * h) - 1 / (sinking.from * sinking.from)), t, 0.03 * t);
    double const fallen = sinking.weight * (sinking.from - h);
    EXPECT_NEAR(r.value(0, Quantity::film_loss), fallen, 1e-6 * fallen);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-8 * fallen);
    for (int const i : {1, 4, 5, 6, 10}) EXPECT_NEAR(r.states[0][static_cast<std::size_t>(i)], 0, 1e-15) << "it stays level";
}

TEST(OilFilm, BothOfThemCarryWhereTheyDoNotBreak) {
    // Between two faces the one pushes and the other pulls: M v = −W t + c/2 (1/h² − 1/h0² − 1/H² + 1/H0²) + k (h0 − h), H = 2 c − h.
    Sinking sinking(9.81);
    sinking.l.in.load_c = 1e9;
    double const t = 0.4;
    auto const r = run(sinking.l, options(sinking.l, Mechanism::free_slider, t, 1e-10));
    double const h = sinking.gap(r), other = 2e-4 - h;
    double const pushed = 0.5 * sinking.squeeze() * (1 / (h * h) - 1 / (other * other)) + sinking.drag() * (1e-4 - h);
    EXPECT_NEAR(mass_of(sinking.l) * r.states[0][2] + sinking.weight * t, pushed, 1e-8 * sinking.weight * t);
}

TEST(OilFilm, IsNoThinnerThanItsLeastGap) {
    // Below it the damping is constant: v = −W/D (1 − exp(−D t/M)).
    Loaded l{{}, {}};
    l.in.clearance_y = l.in.clearance_z = 1e-4, l.in.y = -9e-5;
    double const least = 5e-5, viscosity = 1e-3;
    add_film(l, viscosity, least);
    double const m = mass_of(l), weight = 9.81 * m, t = 3e-4;
    double const damping = squeeze_of(viscosity, width_y) / (least * least * least) + 2 * viscosity * length * width_z / 1e-4;
    auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-12));
    double const speed = weight / damping * (1 - std::exp(-damping * t / m));
    EXPECT_GT(1e-4 + r.states[0][0], 1e-6) << "it still flies";
    EXPECT_NEAR(r.states[0][2], -speed, 1e-9 * speed);
}

TEST(OilFilm, PullsNoMoreThanItBears) {
    // A force lifts the slider off a thin film: but for an instant the film bears all it can, M v = (F − p_c A) t − what sides and far face take.
    for (double const pressure : {0.0, 10.0, 50.0}) {
        Loaded l{{}, {}};
        l.in.gravity = 0, l.in.clearance_y = l.in.clearance_z = 5e-3, l.in.y = -5e-3 + 1e-5;
        double const viscosity = 1e-3, m = mass_of(l), pull = 2, t = 0.012, most = pressure * length * width_y;
        add_film(l, viscosity, 1e-7, pressure);
        l.loads.emplace_back().force[1] = l.number(pull);
        auto const r = run(l, options(l, Mechanism::free_slider, t, 1e-12));
        double const y = r.states[0][0] - l.in.y, h = 5e-3 - r.states[0][0], far = 5e-3 - l.in.y;
        double const sides = 2 * viscosity * length * width_z / 5e-3 * y, ahead = 0.5 * squeeze_of(viscosity, width_y) * (1 / (h * h) - 1 / (far * far));
        EXPECT_NEAR(m * r.states[0][2], (pull - most) * t - sides - ahead, 2e-5 * most * t + 1e-10 * pull * t) << pressure;
        EXPECT_GT(y, 5e-4);
        double const loss = r.value(0, Quantity::film_loss);
        EXPECT_GE(loss, 0.99 * most * y);
        EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-10 * pull * y);
    }
}

/// Sinks onto its way through a film, tilted, and rests there.
Loaded landing(double viscosity) {
    Loaded l{{}, {}};
    l.in.crank_speed = pi, l.in.vx = 0.05, l.in.clearance_y = l.in.clearance_z = 5e-5;
    l.in.pitch = 2e-4, l.in.roll = -3e-4, l.in.vz = 1e-3;
    l.in.chi_line = l.in.chi_surface = 10;
    add_film(l, viscosity, 1e-6, 1e4);
    return l;
}

testing::RunOptions options_of(Loaded const& l, Mechanism mechanism, Method method, double seconds, double tolerance) {
    auto o = options(l, mechanism, seconds, tolerance);
    o.parts.friction = true, o.parts.damping = Damping::rate;
    o.settings.method = method;
    o.settings.max_steps = 20'000'000;
    return o;
}

TEST(OilFilm, DrivesTheAuditOfEveryMechanismToRounding) {
    for (Mechanism const mechanism : sliders) {
        Loaded l = landing(2e-3);
        if (info(mechanism).driven_form != nullptr) l.in.drive_inertia = 0.01;
        for (bool const crooked : {false, true}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + (crooked ? " on a crooked way" : ""));
            if (crooked) l.in.way_pitch = 1e-4, l.in.way_offset_y = 1e-5, l.in.mass_center_x = 5e-3, l.in.clearance_y_plus = 4e-5, l.in.clearance_y_minus = 7e-5;
            for (double const tolerance : {1e-6, 1e-9}) {
                auto o = options_of(l, mechanism, Method::dopri5, 0.05, tolerance);
                o.parts.misaligned_way = o.parts.offset_slider = crooked;
                if (info(mechanism).driven_form != nullptr) o.parts.drive.by = DriveBy::nothing;
                auto const r = run(l, o);
                double const loss = r.value(0, Quantity::film_loss);
                EXPECT_GT(loss, 1e-6);
                EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 200 * tolerance * (loss + std::abs(r.value(0, Quantity::drive_work))));
            }
        }
    }
}

TEST(OilFilm, IsTheSameByEveryMethod) {
    Loaded const l = landing(2e-3);
    auto const reference = run(l, options_of(l, Mechanism::slider_crank, Method::dop853, 0.02, 1e-11));
    double const loss = reference.value(0, Quantity::film_loss);
    for (Method const method : {Method::automatic, Method::dopri5, Method::bs32, Method::verner65, Method::ros34pw2, Method::rk4}) {
        SCOPED_TRACE(name_of(method));
        auto o = options_of(l, Mechanism::slider_crank, method, 0.02, 1e-7);
        o.settings.fixed_step = 5e-7;
        auto const r = run(l, o);
        EXPECT_NEAR(r.states[0][0], reference.states[0][0], 1e-4 * 5e-5);
        EXPECT_NEAR(r.states[0][6], reference.states[0][6], 1e-7);
        EXPECT_NEAR(r.value(0, Quantity::film_loss), loss, 1e-4 * loss);
    }
}

TEST(OilFilm, HasAutoTurnStiffWhereItIsThick) {
    // An explicit step is bounded by M/D, here 0.3 us and less as the gap closes: the stiff method sinks on in milliseconds, without a contact.
    Sinking sinking(200);
    sinking.l.in.load_a = sinking.viscosity = 0.1;
    double const t = 1;
    auto o = options(sinking.l, Mechanism::free_slider, t, 1e-7);
    o.settings.max_step = 1e-3, o.settings.stiff_max_step = 1e-2;
    auto const r = run(sinking.l, o);
    double const h = sinking.gap(r);
    EXPECT_LT(h, 0.9 * sinking.from);
    EXPECT_NEAR(sinking.left_of_momentum(r, t), 0, 1e-5);
    EXPECT_GT(r.records[0].stiff_steps, 20u);
    EXPECT_LT(r.records[0].rhs_evaluations, 50'000u);
    EXPECT_NEAR(r.value(0, Quantity::film_loss), sinking.weight * (sinking.from - h), 1e-5 * sinking.weight * sinking.from);
}

TEST(OilFilm, IsTheSameInEveryLane) {
    for (Mechanism const mechanism : sliders) {
        for (Method const method : {Method::automatic, Method::ros34pw2, Method::verner65}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + " " + name_of(method));
            Loaded l = landing(5e-3);
            if (info(mechanism).driven_form != nullptr) l.in.drive_inertia = 0.01;
            auto o = options_of(l, mechanism, method, 0.01, 1e-6);
            if (info(mechanism).driven_form != nullptr) o.parts.drive.by = DriveBy::nothing;
            std::vector<Inputs> members(7, complete_inputs(l.in, info(mechanism)));
            for (std::size_t i = 0; i < members.size(); ++i) members[i].vy += 1e-3 * static_cast<double>(i), members[i].load_a *= 1 + static_cast<double>(i);
            testing::expect_one_motion_on_all(o, members);
        }
    }
}

}  // namespace
}  // namespace slideway::oil_film_test
