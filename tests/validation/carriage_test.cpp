// The rig of the paper's experiment against statics and small vibrations by hand (model.md 7).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "host/chaos/power_spectrum.hpp"
#include "host/config/scene.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::carriage_test {
namespace {

/// Case 1 of Table 1, with a slope and friction as they are wanted.
Inputs rig(double inclination, double speed = 0.06) {
    Inputs in;
    in.clearance_y = in.clearance_z = 0.125e-3;
    in.inclination = inclination;
    in.carriage_speed = speed;
    in.y = -0.125e-3;
    return complete_inputs(in);
}

testing::RunOptions options(Law law, Damping damping, bool friction, double seconds) {
    testing::RunOptions o;
    o.parts = {law, damping, friction, false, Mechanism::carriage};
    o.settings.rtol = o.settings.atol = 1e-8;
    o.settings.end_time = seconds;
    return o;
}

/// The same at rest on its way: what is left of the fall after strong damping.
Inputs settled(Inputs in, bool friction) {
    in.chi_line = in.chi_surface = 1e3;
    auto const r = testing::run(best_isa(), options(Law::conservative, Damping::rate, friction, 0.1), {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    auto const& s = r.states[0];
    in.y = s[0], in.z = s[1], in.vy = s[2], in.vz = s[3];
    in.roll = s[4], in.yaw = s[5], in.pitch = s[6];
    in.wx = s[7], in.wy = s[8], in.wz = s[9];
    in.chi_line = in.chi_surface = 0;
    return in;
}

TEST(Carriage, FeelsNoAccelerationAtRestOnItsWay) {
    for (double const slope : {0.0, std::numbers::pi / 6}) {
        auto const in = settled(rig(slope), true);
        auto const r = testing::run(best_isa(), options(Law::conservative, Damping::point, true, 0.2), {in});
        ASSERT_EQ(r.records[0].status, Status::finished);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LT(r.value(0, Quantity::peak_acceleration, axis), 1e-4 * in.gravity) << "axis " << axis;
        }
        for (int channel = 0; channel < 2; ++channel) {
            EXPECT_LT(r.value(0, Quantity::peak_channel_acceleration, channel), 1e-4 * in.gravity);
        }
        EXPECT_NEAR(r.value(0, Quantity::mode_time, 0), 0, 1e-12) << "never free";
    }
}

TEST(Carriage, CarriesTheLoadsOfStaticsOnASlope) {
    double const slope = std::numbers::pi / 6;
    for (bool const friction : {false, true}) {
        auto const in = settled(rig(slope), friction);
        auto const r = testing::run(best_isa(), options(Law::conservative, Damping::point, friction, 0.2), {in});
        ASSERT_EQ(r.records[0].status, Status::finished);
        auto const apex = [&](int number) { return r.value(0, Quantity::mean_apex_force, number - 1); };
        double const weight = in.slider_mass * in.gravity, load = weight * std::cos(slope);
        // Friction at the way's top pulls back at a lever of half the hole: the rear apices carry more.
        double const drag = friction ? in.friction_kinetic * load : 0;
        double const shift = drag * (0.5 * in.way_width + in.clearance_y) / (0.5 * in.slider_length);
        double const front = apex(1) + apex(4), rear = apex(5) + apex(8);
        EXPECT_NEAR(r.value(0, Quantity::mean_normal_force), load, 1e-3 * load);
        EXPECT_NEAR(front, 0.5 * (load - shift), 1e-3 * front);
        EXPECT_NEAR(rear, 0.5 * (load + shift), 1e-3 * rear);
        EXPECT_NEAR(apex(1) + apex(5), apex(4) + apex(8), 1e-3 * load) << "left and right";
        for (int const bottom : {2, 3, 6, 7}) EXPECT_EQ(apex(bottom), 0);
        // The drive lifts the slider up the slope and drags it along.
        double const power = (weight * std::sin(slope) + drag) * in.carriage_speed;
        EXPECT_NEAR(r.value(0, Quantity::drive_work), power * 0.2, 1e-3 * power * 0.2);
        EXPECT_NEAR(r.value(0, Quantity::friction_loss), drag * in.carriage_speed * 0.2, 1e-3 * power * 0.2);
    }
}

TEST(Carriage, GoesToAndFro) {
    // Floats between its walls without weight: nothing but the drive moves it.
    auto in = rig(0);
    in.gravity = 0;
    in.y = 0;
    double const turn = in.reversal_time, stroke = in.stroke / in.carriage_speed, period = 2 * (stroke + turn);
    auto o = options(Law::conservative, Damping::point, false, 3 * period);
    o.series = selection_of(Series::x) | selection_of(Series::vx) | selection_of(Series::ax);
    o.sample_times = {0.5 * stroke,        stroke, stroke + 0.5 * turn,         stroke + turn, 1.5 * stroke + turn,
                      period - 0.5 * turn, period, 2.5 * period + 0.25 * stroke};
    o.settings.max_step = 0.1;
    auto const r = testing::run(best_isa(), o, {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    double const v = in.carriage_speed, pi = std::numbers::pi, peak = v * pi / turn;
    double const x[] = {0.5 * in.stroke, in.stroke, in.stroke + v * turn / pi, in.stroke, 0.5 * in.stroke,
                        -v * turn / pi,  0,         0.75 * in.stroke};
    double const vx[] = {v, v, 0, -v, -v, 0, v, -v};
    double const ax[] = {0, 0, -peak, 0, 0, peak, 0, 0};
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(r.series[i], x[i], 1e-12) << i;
        EXPECT_NEAR(r.series[8 + i], vx[i], 1e-11 * 1 + 1e-9 * v) << i;
        EXPECT_NEAR(r.series[16 + i], ax[i], 1e-9 * peak) << i;
    }
}

TEST(Carriage, CountsWhatItsReversalsAccelerate) {
    // As a scene asks for it, with the largest steps that it gives; ax is −v π/t_r sin(π τ/t_r) for t_r of each half period, else 0.
    for (double const reversal : {2e-3, 20e-3}) {
        Scene const scene = parse_scene(
            "schema = 1\n[mechanism]\nkind = \"carriage\"\nreversal_time = " + std::to_string(reversal) +
                "\n[contact]\nlaw = \"conservative\"\nchi_line = 1000\nchi_surface = 1000\n[initial]\ny = -1e-4\n"
                "[study]\nrevolutions = 1\nquantities = [\"rms_acceleration\", \"peak_acceleration\", "
                "\"energy_residual\"]\n",
            "scene");
        testing::RunOptions o;
        o.parts = scene.parts;
        o.settings = scene.integrator;
        Inputs const in = member_inputs(scene, 0);
        auto const r = testing::run(best_isa(), o, {in});
        ASSERT_EQ(r.records[0].status, Status::finished);
        double const peak = in.carriage_speed * std::numbers::pi / reversal;
        double const period = 2 * (in.stroke / in.carriage_speed + reversal);
        double const rms = peak * std::sqrt(reversal / period);  // two reversals, the mean of sin² being 1/2
        EXPECT_NEAR(r.value(0, Quantity::peak_acceleration, 0), peak, 1e-2 * peak);
        EXPECT_NEAR(r.value(0, Quantity::rms_acceleration, 0), rms, 2e-3 * rms);
    }
}

/// Frequency [Hz] at which a series has most of its power, between the samples of its spectrum.
double dominant_frequency(std::vector<double> const& series, double spacing) {
    auto const s = power_spectrum(series, spacing, Taper::hann);
    std::size_t top = 1;
    for (std::size_t i = 1; i + 1 < s.density.size(); ++i) {
        if (s.density[i] > s.density[top]) top = i;
    }
    // A parabola through the logarithms of the three highest.
    double const a = std::log(s.density[top - 1]), b = std::log(s.density[top]), c = std::log(s.density[top + 1]);
    return s.frequency[top] + 0.5 * (a - c) / (a - 2 * b + c) * s.frequency[1];
}

/// What a settled carriage does after a kick, by one component of its velocity or spin.
double frequency_after(Inputs const& in, Law law, Series seen) {
    auto o = options(law, Damping::point, false, 5e-3);
    o.settings.method = Method::dopri5;
    o.settings.rtol = o.settings.atol = 1e-12;
    o.quantities = 0;
    o.series = selection_of(seen);
    double const spacing = 1e-6;
    for (int i = 0; i < 4096; ++i) o.sample_times.push_back(spacing * i);
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return dominant_frequency(r.series, spacing);
}

TEST(Carriage, RingsAtTheFrequenciesOfItsFlatContact) {
    // Flat on its way under the paper's law: one surface, k = E_s L_k w_b/w_a, whose quarters stand at the four apices.
    auto in = rig(0);
    in.eta = 0;
    double const stiffness = in.slider_young_modulus * in.slider_length * in.way_depth / in.way_width;
    in.y = -in.clearance_y - in.slider_mass * in.gravity / stiffness;
    auto const along = [&](double lever, double inertia) {
        return std::sqrt(stiffness * lever * lever / inertia) / (2 * std::numbers::pi);
    };
    // Kicks so small that all four apices stay in contact.
    auto bounce = in, pitch = in, roll = in;
    bounce.vy = 1e-5;
    pitch.wz = 1e-3;
    roll.wx = 1e-3;
    double const bouncing = along(1, in.slider_mass);
    EXPECT_NEAR(bouncing, 40.995e3, 10) << "Hz: 1.242e10 N/m on 0.1872 kg";
    EXPECT_NEAR(frequency_after(bounce, Law::paper, Series::vy), bouncing, 1e-3 * bouncing);
    double const pitching = along(0.5 * in.slider_length, in.slider_inertia_z);
    EXPECT_NEAR(frequency_after(pitch, Law::paper, Series::wz), pitching, 1e-3 * pitching);
    double const rolling = along(0.5 * in.way_depth, in.slider_inertia_x);
    EXPECT_NEAR(frequency_after(roll, Law::paper, Series::wx), rolling, 1e-3 * rolling);
}

/// Natural frequencies [Hz] and modes of bounce, roll and pitch about a state, from the oracle's forces by differences.
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> small_vibrations(Inputs const& in, Parts const& parts) {
    oracle::State const at{in.y, in.z, 0, 0, in.roll, in.yaw, in.pitch};
    double const steps[] = {1e-13, 5e-12, 5e-12};
    int const places[] = {0, 4, 6};
    Eigen::Matrix3d stiffness;
    for (int j = 0; j < 3; ++j) {
        auto low = at, high = at;
        low[static_cast<std::size_t>(places[j])] -= steps[j];
        high[static_cast<std::size_t>(places[j])] += steps[j];
        auto const a = oracle::evaluate(in, parts, 0, low), b = oracle::evaluate(in, parts, 0, high);
        Eigen::Vector3d const change{b.normal_force[1] - a.normal_force[1], b.normal_torque[0] - a.normal_torque[0],
                                     b.normal_torque[2] - a.normal_torque[2]};
        stiffness.col(j) =
            -change / (high[static_cast<std::size_t>(places[j])] - low[static_cast<std::size_t>(places[j])]);
    }
    EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-3 * stiffness.norm());
    Eigen::Matrix3d const mass = Eigen::Vector3d(in.slider_mass, in.slider_inertia_x, in.slider_inertia_z).asDiagonal();
    return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(0.5 * (stiffness + stiffness.transpose()), mass);
}

TEST(Carriage, RingsAtTheFrequenciesOfTheConservativeContact) {
    auto in = settled(rig(0), false);
    in.eta = 0;
    in.vy = in.vz = in.wx = in.wy = in.wz = 0;
    auto const modes = small_vibrations(in, options(Law::conservative, Damping::point, false, 1).parts);
    ASSERT_GT(modes.eigenvalues()[0], 0) << "it rests in a minimum";
    struct Kick {
        double Inputs::*velocity;
        Series seen;
        int component;
        double size;
    };
    for (auto const& [velocity, seen, component, size] :
         {Kick{&Inputs::vy, Series::vy, 0, 1e-7}, Kick{&Inputs::wx, Series::wx, 1, 1e-5},
          Kick{&Inputs::wz, Series::wz, 2, 1e-5}}) {
        // A kick of this velocity gives mode m the share φ² M of it.
        int strongest = 0;
        for (int m = 1; m < 3; ++m) {
            if (std::abs(modes.eigenvectors()(component, m)) > std::abs(modes.eigenvectors()(component, strongest)))
                strongest = m;
        }
        double const expected = std::sqrt(modes.eigenvalues()[strongest]) / (2 * std::numbers::pi);
        auto kicked = in;
        kicked.*velocity = size;
        EXPECT_NEAR(frequency_after(kicked, Law::conservative, seen), expected, 2e-3 * expected)
            << "component " << component;
    }
}

}  // namespace
}  // namespace slideway::carriage_test
