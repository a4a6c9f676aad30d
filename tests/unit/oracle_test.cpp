// The oracle itself is held against golden data, algebra and conservation laws before kernels are held against it.
#include <tests/oracle/golden_table.hpp>
#include <tests/oracle/oracle.hpp>
#include <tests/oracle/random_states.hpp>

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

namespace {

using oracle::Case;
using oracle::Pairs;
using oracle::Result;
using oracle::State;
using slideway::Damping;
using slideway::Inputs;
using slideway::Law;
using slideway::Parts;

constexpr double golden_tolerance = 2e-8;
constexpr std::uint64_t seed = 20200103717;

Result evaluate(Case const& c) { return oracle::evaluate(c.inputs, c.parts, c.t, c.state, &c.impact_speeds); }

Pairs joined(std::array<double, 8> const& y, std::array<double, 8> const& z) {
    Pairs all;
    std::copy(y.begin(), y.end(), all.begin());
    std::copy(z.begin(), z.end(), all.begin() + 8);
    return all;
}

double sum(Pairs const& values) {
    double total = 0;
    for (double value : values) total += value;
    return total;
}

/// Distance of the nearest pair from changing its contact.
double margin(Result const& r) {
    double least = std::numeric_limits<double>::infinity();
    for (double depth : joined(r.pen_y, r.pen_z)) least = std::min(least, std::abs(depth));
    return least;
}

/// (f(h) - f(-h))/2h without its h² error.
double slope(std::function<double(double)> const& f, double h) {
    auto const central = [&](double step) { return (f(step) - f(-step)) / (2 * step); };
    return (4 * central(h) - central(2 * h)) / 3;
}

// ---- golden data -------------------------------------------------------------------------------------------------

golden::Table golden_table(std::string const& name) {
    return golden::Table::read(SLIDEWAY_TEST_DATA "/golden/" + name);
}

golden::Table oracle_table(golden::Table const& reference) {
    golden::Table table(golden::computed_columns());
    for (std::size_t row = 0; row < reference.rows(); ++row) {
        golden::Case const c = golden::case_of(reference, row);
        table.add(golden::computed_row(oracle::evaluate(c.inputs, c.parts, c.t, c.state)));
    }
    return table;
}

class GoldenRows : public testing::TestWithParam<std::tuple<char const*, std::size_t>> {};

TEST_P(GoldenRows, AreMetByTheOracle) {
    auto const [name, rows] = GetParam();
    golden::Table const reference = golden_table(name);
    EXPECT_EQ(reference.rows(), rows);
    auto const worst = golden::worst_difference(reference, oracle_table(reference));
    EXPECT_LE(worst.value, golden_tolerance) << worst.where;
}

INSTANTIATE_TEST_SUITE_P(Oracle, GoldenRows,
                         testing::Values(std::tuple{"rhs_paper.csv", 300}, std::tuple{"rhs_conservative.csv", 300},
                                         std::tuple{"rhs_parameters.csv", 400}));

TEST(GoldenMeasure, SeesADigitANanAndAMissingRow) {
    golden::Table const reference = golden_table("rhs_paper.csv");
    golden::Table good(reference.columns()), wrong(reference.columns()), broken(reference.columns());
    for (std::size_t row = 0; row < reference.rows(); ++row) {
        std::vector<std::string> cells, wrong_cells, broken_cells;
        for (std::string const& column : reference.columns()) {
            cells.push_back(reference.text(row, column));
            bool const here = row == 7 && column == "energy";
            wrong_cells.push_back(here ? std::to_string(reference.number(row, column) * (1 + 1e-3)) : cells.back());
            broken_cells.push_back(row == 7 && column == "d_wx" ? "nan" : cells.back());
        }
        good.add(cells), wrong.add(wrong_cells), broken.add(broken_cells);
    }
    EXPECT_EQ(golden::worst_difference(reference, good).value, 0);
    auto const worst = golden::worst_difference(reference, wrong);
    EXPECT_NEAR(worst.value, 1e-3, 1e-4);
    EXPECT_EQ(worst.where, "energy energy row 7");
    EXPECT_TRUE(std::isnan(golden::worst_difference(reference, broken).value));
    EXPECT_THROW(golden::worst_difference(reference, golden::Table(reference.columns())), std::runtime_error);
    EXPECT_THROW(golden_table("no_such_table.csv"), std::runtime_error);
}

TEST(GoldenMeasure, HoldsTrajectoriesToTheirUncertainty) {
    golden::Table const table = golden_table("trajectories.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        State state = golden::case_of(table, row).state;
        EXPECT_EQ(golden::worst_difference(table, row, state).value, 0);
        double const allowed = 30 * table.number(row, "u_y") + 1e-7 * table.number(row, "joint.clearance");
        state[0] += 2 * allowed;
        EXPECT_NEAR(golden::worst_difference(table, row, state).value, 2, 1e-3);
    }
}

// ---- random states -----------------------------------------------------------------------------------------------

using Triple = std::tuple<int, int, int>;

/// One axis of flat parallel faces: f(s3, s) = t + a3 s3 + a s against ±1 shows every pattern that can occur.
std::set<Triple> triples_of_one_axis() {
    std::set<Triple> found;
    for (double t = -3; t <= 3; t += 0.25) {
        for (double a3 = -3.1; a3 <= 3; a3 += 0.25) {
            for (double a = -3.17; a <= 3; a += 0.25) {
                Triple triple{0, 0, 0};
                auto& [surfaces, lines, points] = triple;
                for (int side : {-1, 1}) {
                    int touching = 0;
                    for (double f : {t + a3 + a, t + a3 - a, t - a3 + a, t - a3 - a}) touching += side * f > 1;
                    surfaces += touching == 4;
                    lines += touching == 2 ? 1 : touching == 3 ? 2 : 0;
                    points += touching == 1;
                }
                found.insert(triple);
            }
        }
    }
    return found;
}

TEST(RandomStates, CoverEveryModeTripleThatFlatFacesAllow) {
    std::set<Triple> possible, hit;
    for (auto const& [s1, l1, p1] : triples_of_one_axis())
        for (auto const& [s2, l2, p2] : triples_of_one_axis()) possible.insert({s1 + s2, l1 + l2, p1 + p2});
    EXPECT_EQ(possible.size(), 27u);
    for (Case const& c : oracle::make_cases(seed, 4000)) {
        Result const r = evaluate(c);
        hit.insert({r.surfaces, r.lines, r.points});
    }
    EXPECT_EQ(hit, possible);
}

TEST(RandomStates, CoverDepthsSlidingSpeedsAndParts) {
    std::set<int> decades, frictions, parts;
    for (Case const& c : oracle::make_cases(seed, 2000)) {
        Result const r = evaluate(c);
        Pairs const depths = joined(r.pen_y, r.pen_z), slips = joined(r.slip_y, r.slip_z);
        for (int i = 0; i < 16; ++i) {
            if (depths[i] <= 0) continue;
            decades.insert(static_cast<int>(std::floor(std::log10(depths[i]))));
            frictions.insert(slips[i] == 0                                 ? 0
                             : slips[i] < c.inputs.friction_stick_speed    ? 1
                             : slips[i] <= c.inputs.friction_slip_speed    ? 2
                             : slips[i] < 3 * c.inputs.friction_slip_speed ? 3
                                                                           : 4);
        }
        parts.insert((c.parts.law == Law::paper) + 2 * static_cast<int>(c.parts.damping) + 6 * c.parts.friction +
                     12 * c.parts.misaligned_way);
        for (double rate : r.derivative) EXPECT_TRUE(std::isfinite(rate));
        EXPECT_FALSE(r.geometry || r.contact_domain);
    }
    for (int decade = -10; decade <= -6; ++decade) EXPECT_TRUE(decades.count(decade)) << "1e" << decade << " m";
    EXPECT_EQ(frictions, (std::set<int>{0, 1, 2, 3, 4}));
    EXPECT_EQ(parts.size(), 24u);
}

TEST(RandomStates, VaryEveryParameter) {
    constexpr int numbers = sizeof(Inputs) / sizeof(double);
    constexpr int initial = 10;  // the start of a run; a case carries its own state
    std::array<std::set<double>, numbers> seen;
    for (Case const& c : oracle::make_cases(seed, 500)) {
        auto const values = std::bit_cast<std::array<double, numbers>>(c.inputs);
        for (int i = 0; i < numbers; ++i) seen[i].insert(values[i]);
    }
    for (int i = 0; i < numbers - initial; ++i) EXPECT_GT(seen[i].size(), 50u) << "number " << i << " of Inputs";
}

TEST(RandomStates, AreTheSameForTheSameSeed) {
    auto const all = oracle::make_cases(seed, 200), fewer = oracle::make_cases(seed, 100);
    auto const others = oracle::make_cases(seed + 1, 100);
    int equal_to_others = 0;
    for (std::size_t i = 0; i < fewer.size(); ++i) {
        EXPECT_EQ(all[i].state, fewer[i].state);
        EXPECT_EQ(all[i].impact_speeds, fewer[i].impact_speeds);
        equal_to_others += all[i].state == others[i].state;
    }
    EXPECT_EQ(equal_to_others, 0);
}

// ---- conservation ------------------------------------------------------------------------------------------------

/// The generalised normal force along each of y z φ ϑ ψ: push and torque by the motion that the coordinate makes.
std::array<double, 5> generalised_force(Case const& c, Result const& r) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    double const angle = c.inputs.start_angle + c.inputs.crank_speed * c.t;
    double const above = c.state[0] - c.inputs.crank_length * std::sin(angle);
    double const along = r.x - c.inputs.crank_length * std::cos(angle);
    Vector3d const force(r.normal_force.data()), torque(r.normal_torque.data());
    AngleAxisd const pitch(c.state[6], Vector3d::UnitZ()), yaw(c.state[5], Vector3d::UnitY());
    Vector3d const roll_axis = pitch * (yaw * Vector3d::UnitX());
    Vector3d const yaw_axis = pitch * Vector3d::UnitY();
    return {force.y() - force.x() * above / along, force.z() - force.x() * c.state[1] / along, torque.dot(roll_axis),
            torque.dot(yaw_axis), torque.z()};
}

TEST(Oracle, NormalForceIsTheGradientOfItsPotential) {
    int held = 0;
    for (Case c : oracle::make_cases(seed, 1500)) {
        c.parts.friction = false;
        c.parts.damping = Damping::point;
        c.inputs.eta = 0;
        Result const r = evaluate(c);
        double const load = sum(joined(r.fn_y, r.fn_z));
        if (load == 0 || margin(r) < 1e-9) continue;
        ++held;
        auto const force = generalised_force(c, r);
        double const arm = c.inputs.slider_length / 2;
        constexpr int coordinates[5] = {0, 1, 4, 5, 6};
        for (int j = 0; j < 5; ++j) {
            double const lever = j < 2 ? 1 : arm;
            auto const potential = [&](double step) {
                Case moved = c;
                moved.state[coordinates[j]] += step;
                return evaluate(moved).contact_potential;
            };
            double const gradient = slope(potential, std::min(2e-3 * margin(r), 1e-7) / lever);
            EXPECT_NEAR(force[j], -gradient, 1e-6 * load * lever) << "coordinate " << j;
        }
    }
    EXPECT_GT(held, 800);
}

/// A power of two that moves no pair by more than a thousandth of its distance to the face.
double small_step(Case const& c, Result const& r) {
    double fastest = 1e-9, fiercest = 1, turning = 1 + std::abs(c.inputs.crank_speed);
    for (double rate : joined(r.rate_y, r.rate_z)) fastest = std::max(fastest, std::abs(rate));
    for (int i : {2, 3}) fiercest = std::max(fiercest, std::abs(r.derivative[i]));
    for (int i : {7, 8, 9}) fiercest = std::max(fiercest, std::abs(r.derivative[i]) * c.inputs.slider_length);
    for (int i : {7, 8, 9}) turning = std::max(turning, std::abs(c.state[i]));
    double const gap = 1e-3 * margin(r);
    return std::exp2(std::floor(std::log2(std::min({1e-4 / turning, gap / fastest, std::sqrt(gap / fiercest)}))));
}

TEST(Oracle, EnergyChangesByThePowersAlone) {
    int held = 0;
    for (Case c : oracle::make_cases(seed + 2, 1500)) {
        c.t = std::ldexp(std::round(std::ldexp(c.t, 40)), -40);  // exact in sums with the steps
        Result const r = evaluate(c);
        if (margin(r) < 1e-9) continue;
        double const step = small_step(c, r);
        auto const energy = [&](double dt) {
            Case moved = c;
            moved.t += dt;
            for (int i = 0; i < 10; ++i) moved.state[i] += dt * r.derivative[i];
            return evaluate(moved).energy;
        };
        Pairs const rates = joined(r.rate_y, r.rate_z), forces = joined(r.fn_y, r.fn_z);
        double scale = std::abs(r.power_crank) + r.power_friction + std::abs(r.power_damping);
        for (int i = 0; i < 16; ++i) scale += forces[i] * std::abs(rates[i]);
        // Of the energy, and of the moved angles: half a digit of 0.03 rad by an arm of 0.02 m against the load.
        double const rounding = (1e-15 * (std::abs(r.energy) + 0.1) + 1e-19 * sum(forces)) / step;
        if (rounding > 1e-6 * scale) continue;
        ++held;
        EXPECT_NEAR(slope(energy, step), r.power_crank - r.power_friction - r.power_damping, 3e-6 * scale);
        EXPECT_GE(r.power_friction, 0);
    }
    EXPECT_GT(held, 800);
}

TEST(Oracle, WayAndSliderTurnedTogetherPressAlike) {
    // With the crank at rest along X and no weight, a turn of everything about X changes nothing but directions.
    double const turn = 0.3;
    int touching = 0;
    for (Case c : oracle::make_cases(seed + 3, 400)) {
        c.inputs.gravity = c.inputs.start_angle = c.inputs.crank_speed = 0;
        c.inputs.way_yaw = c.inputs.way_pitch = c.inputs.way_roll = c.inputs.way_offset_y = c.inputs.way_offset_z = 0;
        c.parts.misaligned_way = false;
        Case turned = c;
        turned.parts.misaligned_way = true;
        turned.inputs.way_roll = turn;
        auto const rotate = [&](double& y, double& z) {
            std::tie(y, z) =
                std::pair{y * std::cos(turn) - z * std::sin(turn), y * std::sin(turn) + z * std::cos(turn)};
        };
        rotate(turned.state[0], turned.state[1]);
        rotate(turned.state[2], turned.state[3]);
        using Eigen::AngleAxisd;
        using Eigen::Vector3d;
        Eigen::Matrix3d const attitude =
            (AngleAxisd(turn, Vector3d::UnitX()) * AngleAxisd(c.state[6], Vector3d::UnitZ()) *
             AngleAxisd(c.state[5], Vector3d::UnitY()) * AngleAxisd(c.state[4], Vector3d::UnitX()))
                .toRotationMatrix();
        turned.state[4] = std::atan2(attitude(2, 1), attitude(2, 2));
        turned.state[5] = std::asin(-attitude(2, 0));
        turned.state[6] = std::atan2(attitude(1, 0), attitude(0, 0));

        Result straight = evaluate(c);
        Result const other = evaluate(turned);
        if (margin(straight) < 1e-8) continue;  // the turned state is rounded anew
        touching += straight.surfaces + straight.lines + straight.points > 0;
        EXPECT_EQ(straight.faces, other.faces);
        double const load = sum(joined(straight.fn_y, straight.fn_z));
        for (int i = 0; i < 8; ++i) {
            EXPECT_NEAR(straight.fn_y[i], other.fn_y[i], 1e-7 * load);
            EXPECT_NEAR(straight.fn_z[i], other.fn_z[i], 1e-7 * load);
        }
        rotate(straight.derivative[2], straight.derivative[3]);
        for (int i : {2, 3})
            EXPECT_NEAR(straight.derivative[i], other.derivative[i], 1e-6 * (1 + load / c.inputs.slider_mass));
        for (int i : {7, 8, 9})
            EXPECT_NEAR(straight.derivative[i], other.derivative[i],
                        1e-6 * (1 + load * 0.03 / c.inputs.slider_inertia_x));
    }
    EXPECT_GT(touching, 50);
}

// ---- laws --------------------------------------------------------------------------------------------------------

TEST(Oracle, FlatSliderBearsOnOneSurfaceByItsStiffness) {
    Inputs const in = oracle::completed({});
    double const depth = 2e-9;
    State state{};
    state[0] = -(in.clearance_y + depth);
    Result const r = oracle::evaluate(in, {}, 0, state);
    EXPECT_EQ((Triple{r.surfaces, r.lines, r.points}), (Triple{1, 0, 0}));
    // The way's top is pressed by the slider that came down: E_s A/l with E_s = E, A = 40 x 30 mm, l = 20 mm.
    EXPECT_EQ(r.faces[oracle::top], oracle::FaceKind::surface);
    double const force = 2.07e11 * 0.04 * 0.03 / 0.02 * depth;
    EXPECT_NEAR(r.normal_force[1], force, 1e-6 * force);
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(r.fn_y[apex - 1], force / 4, 1e-6 * force);
    EXPECT_NEAR(r.contact_potential, force * depth / 2, 1e-6 * force * depth);
}

TEST(Oracle, FrictionIsSmoothAtItsTwoSpeeds) {
    Inputs const in;
    EXPECT_EQ(oracle::friction_coefficient(in, 0), 0);
    EXPECT_NEAR(oracle::friction_coefficient(in, in.friction_stick_speed), in.friction_static, 1e-15);
    EXPECT_NEAR(oracle::friction_coefficient(in, in.friction_slip_speed), in.friction_kinetic, 1e-15);
    EXPECT_EQ(oracle::friction_coefficient(in, 1), in.friction_kinetic);
    double const middle = (in.friction_stick_speed + in.friction_slip_speed) / 2;
    EXPECT_NEAR(oracle::friction_coefficient(in, middle), (in.friction_static + in.friction_kinetic) / 2, 1e-15);
    EXPECT_NEAR(oracle::friction_coefficient(in, in.friction_stick_speed / 3), in.friction_static / 2, 1e-15);
    for (double speed : {in.friction_stick_speed, in.friction_slip_speed}) {
        double const step = 1e-6 * speed, here = oracle::friction_coefficient(in, speed);
        // Continuous, and flat: a jump or a kink of first order would show as a multiple of the step.
        EXPECT_NEAR(oracle::friction_coefficient(in, speed - step), here, 1e-11);
        EXPECT_NEAR(oracle::friction_coefficient(in, speed + step), here, 1e-11);
    }
}

TEST(Oracle, LineLoadVanishesWithItsApproachAndSolvesItsEquation) {
    Inputs const in;
    double const length = 0.03, modulus = 2.07e11 / (1 - 0.29 * 0.29) / 2;
    double previous = 0;
    for (double approach = 1e-14; approach < length * length / in.edge_radius; approach *= 10) {
        double const load = oracle::line_load(in, length, approach);
        EXPECT_GT(load, previous);
        EXPECT_LT(load, std::numbers::pi * modulus * length * approach);  // W₋₁ <= -1
        double const x = load / (std::numbers::pi * modulus * length);
        EXPECT_NEAR(x * (1 - std::log(x * in.edge_radius / (length * length))), approach, 1e-14 * approach);
        auto const potential = [&](double step) { return oracle::line_potential(in, length, approach + step); };
        EXPECT_NEAR(slope(potential, 1e-3 * approach), load, 1e-9 * load);
        previous = load;
    }
    EXPECT_LT(oracle::line_load(in, length, 1e-14), 1e-4);
    EXPECT_TRUE(std::isnan(oracle::line_load(in, length, 1.001 * length * length / in.edge_radius)));
}

TEST(Oracle, RestitutionSlopeSolvesItsEquation) {
    EXPECT_NEAR(oracle::restitution_slope(0.4), 2.082498164147, 1e-12);
    EXPECT_EQ(oracle::restitution_slope(1), 0);
    for (double e : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.9999}) {
        double const a = oracle::restitution_slope(e);
        EXPECT_GT(a, 0);
        EXPECT_LE(a, 1 / e);
        if (e >= 0.1) {
            EXPECT_NEAR(a * (1 + e), std::log1p(a) - std::log1p(-e * a), 1e-9 * a);
        }
    }
    // Just below one, two terms of the logarithms' series give 3(1 - e²)/(2(1 + e³)).
    for (double gap : {0x1p-13, 0x1p-20, 0x1p-26, 0x1p-40})
        EXPECT_NEAR(oracle::restitution_slope(1 - gap), 1.5 * gap, 3 * gap * gap);
}

/// Speed after an impact over the speed before: unit mass, Runge-Kutta, from touch to release.
double rebound(std::function<double(double)> const& elastic, double slope, double impact_speed, double duration) {
    auto const acceleration = [&](double h, double v) {
        return h > 0 ? -elastic(h) * std::max(0.0, 1 + slope * v / impact_speed) : 0.0;
    };
    double const dt = duration / 4000;
    double h = 0, v = impact_speed;
    for (int i = 0; i < 400000; ++i) {
        double const a1 = acceleration(h, v);
        double const a2 = acceleration(h + dt / 2 * v, v + dt / 2 * a1);
        double const a3 = acceleration(h + dt / 2 * (v + dt / 2 * a1), v + dt / 2 * a2);
        double const a4 = acceleration(h + dt * (v + dt / 2 * a2), v + dt * a3);
        h += dt * v + dt * dt / 6 * (a1 + a2 + a3);
        v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        if (h <= 0) return -v / impact_speed;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

TEST(Oracle, IsolatedImpactReturnsTheRestitution) {
    Inputs const in;
    for (double e : {0.1, 0.4, 0.7, 0.95, 1.0}) {
        double const a = oracle::restitution_slope(e);
        auto const spring = [](double h) { return 1e8 * h; };
        auto const hertz = [](double h) { return 1e10 * std::pow(h, 1.5); };
        auto const line = [&](double h) { return oracle::line_load(in, 0.03, h); };
        for (double speed : {1e-3, 0.5}) {
            EXPECT_NEAR(rebound(spring, a, speed, 3e-4), e, 1e-4);
            EXPECT_NEAR(rebound(hertz, a, speed, 1e-3), e, 1e-4);
            EXPECT_NEAR(rebound(line, a, speed, 1e-4), e, 1e-4);
        }
    }
}

/// Roll and pitch that leave one apex of the bottom face in contact, 1 µm deep, going in at the speed given.
Case one_point(double speed) {
    Case c;
    c.inputs = oracle::completed({});
    c.state[4] = 1e-3, c.state[6] = 1e-3;
    Pairs const level = oracle::penetrations(c.inputs, c.parts, 0, c.state);
    double const lowest = std::max({level[1], level[2], level[5], level[6]});
    // Going up deepens the pairs of the way's bottom by n_y, the Y component of the slider's Y axis.
    c.state[0] = (1e-6 - lowest) / (std::cos(1e-3) * std::cos(1e-3));
    c.state[2] = speed;
    return c;
}

TEST(Oracle, PointDampingFollowsItsKind) {
    Case c = one_point(0.02);
    Result const bare = [&] {
        Case still = c;
        still.inputs.eta = 0;
        return evaluate(still);
    }();
    ASSERT_EQ((Triple{bare.surfaces, bare.lines, bare.points}), (Triple{0, 0, 1}));
    auto const load = [](Result const& r) { return sum(joined(r.fn_y, r.fn_z)); };
    double const rate = 0.02 * std::cos(1e-3) * std::cos(1e-3);
    double const stiffness = 4.0 / 3 * (2.07e11 / (1 - 0.29 * 0.29) / 2) * std::sqrt(5e-4);
    double const depth = 1e-6;
    EXPECT_NEAR(load(bare), stiffness * std::pow(depth, 1.5), 1e-5 * load(bare));
    c.inputs.chi_line = c.inputs.chi_surface = 5;  // no line, no surface here
    c.parts.damping = Damping::rate;
    EXPECT_NEAR(load(evaluate(c)) - load(bare), 0.01 * stiffness * depth * rate, 1e-5 * load(bare));
    c.parts.damping = Damping::restitution;
    c.inputs.restitution = 0.4;
    c.impact_speeds.fill(0.05);
    EXPECT_NEAR(load(evaluate(c)) / load(bare), 1 + 2.082498164147 * rate / 0.05, 1e-5);
    c.state[2] = -1;  // torn off: no contact pulls
    EXPECT_EQ(load(evaluate(c)), 0);
}

TEST(Oracle, DissipatesLinesAndSurfacesByTheRateOfTheirApproach) {
    Inputs in = oracle::completed({});
    in.chi_surface = 7;
    in.chi_line = 3;
    State state{};
    state[0] = -(in.clearance_y + 1e-8);
    state[2] = -0.01;
    auto const force = [&](Damping damping) {
        return oracle::evaluate(in, {Law::paper, damping, false, false}, 0, state).normal_force[1];
    };
    EXPECT_NEAR(force(Damping::rate) / force(Damping::point), 1 + 7 * 0.01, 1e-9);
    state[6] = 1e-5;  // pitch lifts one end: a line is left
    EXPECT_EQ(oracle::evaluate(in, {}, 0, state).lines, 1);
    EXPECT_NEAR(force(Damping::rate) / force(Damping::point), 1 + 3 * 0.01, 1e-5);
}

TEST(Oracle, FlagsARodThatDoesNotReach) {
    Inputs const in = oracle::completed({});
    State state{};
    state[1] = 1.001 * in.rod_length;
    Result const r = oracle::evaluate(in, {}, 0, state);
    EXPECT_TRUE(r.geometry);
    EXPECT_TRUE(std::isnan(r.derivative[2]));
    EXPECT_TRUE(std::isnan(oracle::penetrations(in, {}, 0, state)[0]));
}

TEST(Oracle, FlagsALineBeyondItsDomain) {
    Inputs in = oracle::completed({});
    State state{};
    state[0] = -(in.clearance_y + 1e-6);
    state[6] = 1e-3;
    Result const inside = oracle::evaluate(in, {}, 0, state);
    ASSERT_EQ(inside.lines, 1);
    EXPECT_FALSE(inside.contact_domain);
    in.edge_radius = 1e3;  // l²/R_e = 0.9 µm
    Result const beyond = oracle::evaluate(in, {}, 0, state);
    EXPECT_TRUE(beyond.contact_domain);
    EXPECT_FALSE(beyond.geometry);
}

TEST(Oracle, CrankTorqueCarriesItsOwnWeight) {
    Inputs in = oracle::completed({});
    in.inclination = 0.4;
    double const t = 0.3, angle = in.crank_speed * t;
    Result const r = oracle::evaluate(in, {}, t, {});
    double const crank_mass = 7800 * 5e-3 * 2.5e-3 * 0.05;
    EXPECT_NEAR(r.crank_torque_with_weight - r.crank_torque, crank_mass * 9.81 * 0.025 * std::cos(angle + 0.4), 1e-15);
    EXPECT_NEAR(r.crank_torque * in.crank_speed, r.power_crank, 1e-14);
    EXPECT_NEAR(r.ideal_x, r.x, 1e-15);  // centred
    // d/dt of L sin(rod angle) = -r sin θ
    double const rod_rate =
        -0.05 * in.crank_speed * std::cos(angle) / std::sqrt(0.1422 * 0.1422 - std::pow(0.05 * std::sin(angle), 2));
    EXPECT_NEAR(r.rod_angular_velocity[2], rod_rate, 1e-14);
}

}  // namespace
