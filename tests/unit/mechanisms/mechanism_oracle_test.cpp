// Every number that the kernels of the mechanisms beside the slider-crank give of a state, held against the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/descriptors.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/planar.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/load_table.hpp"
#include "tests/unit/mechanisms/oracle_comparison.hpp"

namespace slideway::mechanism_oracle_test {
namespace {

using testing::compare_probe;
using testing::Comparison;

auto const isas = ::testing::ValuesIn(built_isas());

/// Of eight apices, but for the slider-crank (kernel_oracle_test.cpp).
std::vector<Mechanism> sliders_without_a_rod() {
    auto list = oracle::spatial_mechanisms();
    std::erase(list, Mechanism::slider_crank);
    return list;
}

class SlidersAgainstOracle : public ::testing::TestWithParam<std::tuple<Mechanism, Law, Isa>> {};

TEST_P(SlidersAgainstOracle, AgreeOnThousandsOfStates) {
    auto const [mechanism, law, isa] = GetParam();
    if (!is_supported(isa)) GTEST_SKIP() << "this machine lacks " << name_of(isa);
    auto const cases = oracle::make_cases(20200104, 1200, mechanism, law);  // 100 of each combination of parts
    int compared = 0;
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i)
        compared += compare_probe(isa, cases[i], "case " + std::to_string(i));
    EXPECT_GT(compared, 1100);
}

INSTANTIATE_TEST_SUITE_P(Isas, SlidersAgainstOracle,
                         ::testing::Combine(::testing::ValuesIn(sliders_without_a_rod()),
                                            ::testing::ValuesIn(oracle::every_law()), isas),
                         [](auto const& p) {
                             return oracle::name_of(std::get<0>(p.param)) + "_" +
                                    oracle::name_of(std::get<1>(p.param)) + "_" +
                                    std::string(name_of(std::get<2>(p.param)));
                         });

/// As the kernels have them: numbers in double.
std::array<double, 4> in_double(oracle::Corners const& values) {
    std::array<double, 4> result;
    std::transform(values.begin(), values.end(), result.begin(), [](long double v) { return static_cast<double>(v); });
    return result;
}

void compare_planar_probe(Isa isa, oracle::PlanarCase const& c, std::string const& what) {
    // The probe's impact speeds are their start value.
    Inputs const& in = c.inputs;
    auto const start = oracle::planar_start(in);
    double const now = 2.1;  // which loads alone hear of: the crank is at the angle of the state
    auto const r = oracle::PlanarMechanism(in, c.parts).at(start, nullptr, 0, now);
    ProbeResult p;
    find_instance(isa, c.parts).probe({&in, &now, 1, &p});
    EXPECT_EQ(p.status, Status::finished) << what;
    EXPECT_EQ(p.surfaces, r.surfaces) << what;
    EXPECT_EQ(p.points, r.points) << what;
    EXPECT_EQ(p.lines, 0) << what;

    Comparison compare(what);
    double load = 0;
    for (long double const force : r.force) load += static_cast<double>(force);
    double const weight = (in.crank_mass + in.rod_mass + in.slider_mass) * in.gravity;
    double const reach = in.crank_length + in.rod_length;
    double const lightest = std::min(in.rod_inertia, in.slider_mass * in.rod_length * in.rod_length);
    compare.group("angle rates", r.derivative.data(), p.derivative, 3);
    compare.group("angular accelerations of the links", r.derivative.data() + 3, p.derivative + 3, 2,
                  load * in.rod_length / lightest);
    compare.value("angular acceleration of the block", static_cast<double>(r.derivative[5]), p.derivative[5],
                  load * in.slider_length / in.slider_inertia_z);
    compare.group("penetrations", in_double(r.depth), p.penetration_y, 4);
    compare.group("forces", in_double(r.force), p.normal_force_y, 4);
    long double const powers[] = {r.power_drive, r.power_friction, r.power_damping, r.power_load, r.power_ground, r.loss_springs};
    double const got[] = {p.power_crank, p.power_friction, p.power_damping, p.power_load, p.power_ground, p.loss_springs};
    // A rate of penetration is a small difference of velocities, each of which is rounded.
    double const pin_speed = in.crank_length * std::abs(in.crank_speed);
    double const speed =
        pin_speed + in.rod_length * std::abs(static_cast<double>(start[4])) + in.slider_length * std::abs(in.wz);
    compare.group("powers", powers, got, 6,
                  1e-6 * load * speed + (c.parts.drive.turns_freely() ? 0 : (load + weight) * pin_speed));
    compare.value("energy", static_cast<double>(r.energy), p.energy, weight * reach);
    compare.value("potential", static_cast<double>(r.contact_potential), p.contact_potential);
    compare.value("drive torque", static_cast<double>(r.drive_torque), p.crank_torque,
                  c.parts.drive.turns_freely() ? 0 : (load + weight) * in.crank_length);
}

class PlanarKernelsAgainstOracle : public ::testing::TestWithParam<Isa> {};

TEST_P(PlanarKernelsAgainstOracle, AgreeOnThousandsOfStates) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine lacks " << name_of(GetParam());
    auto const cases = oracle::make_planar_cases(20101, 2400);
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i)
        compare_planar_probe(GetParam(), cases[i], "case " + std::to_string(i));
}

INSTANTIATE_TEST_SUITE_P(Isas, PlanarKernelsAgainstOracle, isas,
                         [](auto const& p) { return std::string(name_of(p.param)); });

/// Loads of all kinds on a case, with numbers of their own.
class RandomLoads {
public:
    explicit RandomLoads(std::uint64_t seed) : draw_(seed) {}

    /// @param weight of the mechanism [N]
    void put(Inputs& in, Parts& parts, std::size_t i, double weight) {
        int next = 0;
        bool const crank = info(parts.mechanism).drive == DriveKind::crank;
        for (Load& load : loads_) load = {};
        auto const put = [&](int (&places)[3], double size) {
            for (int& place : places) place = testing::put_load_number(in, next, size * number());
        };
        put(loads_[0].force, 3 * weight);
        put(loads_[0].point, 0.5 * in.slider_length);
        LoadArgument const over[] = {LoadArgument::time, LoadArgument::x, LoadArgument::vx, LoadArgument::crank_angle};
        loads_[0].over = over[i % (crank ? 4 : 3)];
        loads_[0].table = (i % 2 == 0 ? wave_ : ramp_).table();
        loads_[1].turns_with_slider = true;
        put(loads_[1].force, weight);
        put(loads_[1].torque, weight * in.slider_length);
        loads_[1].scale = testing::put_load_number(in, next, number());
        if (crank) loads_[2].crank_torque = testing::put_load_number(in, next, weight * in.crank_length * number());
        parts.loads = {loads_.data(), crank ? 3 : 2};
    }

private:
    double number() { return static_cast<double>(draw_() >> 11) * 0x1p-52 - 1; }

    std::mt19937_64 draw_;
    std::array<Load, 3> loads_;
    testing::Pieces wave_{{{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, 1, 0, 0}}, 2, true}, ramp_{{{-1, -2, 1, 0.1, 0.2}, {0.1, 3, 0.5, 0, 0}}, 3};
};

TEST(LoadsAgainstOracle, AgreeOnThousandsOfStates) {
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) {
        RandomLoads loads(44);
        auto cases = oracle::make_cases(20261128, 2000, mechanism);
        int compared = 0;
        for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
            loads.put(cases[i].inputs, cases[i].parts, i, cases[i].inputs.slider_mass * cases[i].inputs.gravity);
            compared += compare_probe(best_isa(), cases[i], oracle::name_of(mechanism) + " case " + std::to_string(i));
        }
        EXPECT_GT(compared, 1800);
    }
    RandomLoads loads(45);
    auto cases = oracle::make_planar_cases(20261129, 2000);
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
        loads.put(cases[i].inputs, cases[i].parts, i, cases[i].inputs.slider_mass * cases[i].inputs.gravity);
        compare_planar_probe(best_isa(), cases[i], "planar case " + std::to_string(i));
    }
}

/// θ or x over time, repeating or not: pieces of degree four.
testing::Pieces& profile(bool repeats) {
    static testing::Pieces once{{{-0.5, 0.2, 1, 0.3, -0.2, 0.1}, {0.3, 0.5, 1.5, -2, 0.4, 3}, {1.2, 1, -1, 0, 0, 0}}, 9};
    static testing::Pieces always{{{0.1, 0, 4, -3, 2, 1}, {0.6, 1.9, 2, 5, 0, -2}}, 1.1, true};
    return repeats ? always : once;
}

TEST(DrivesAgainstOracle, OfProfilesAgreeOnThousandsOfStates) {
    PieceTable turning = profile(true).table();
    turning.advance = 6.5;
    PieceTable const tables[] = {profile(false).table(), turning};
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::carriage}) {
        auto cases = oracle::make_cases(20261130, 2000, mechanism);
        int compared = 0;
        for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
            auto& [in, parts, t, state, speeds] = cases[i];
            // Where the crank is as the case has it: the joint's state belongs to that.
            parts.drive = {.by = DriveBy::profile, .table = &tables[i % 2]};
            in.drive_scale = mechanism == Mechanism::carriage ? 0.1 : 0.9;
            compared += compare_probe(best_isa(), cases[i], oracle::name_of(mechanism) + " case " + std::to_string(i));
        }
        EXPECT_GT(compared, 1800);
    }
}

TEST(DrivesAgainstOracle, OfThePlanarCrankAgreeOnThousandsOfStates) {
    testing::Pieces const falls({{0, 1, -0.01, 0, 1e-7}, {100, 0.1, 0, -1e-6, 0}}, 400), turns({{0, 1, 0.2, 0, 0}, {3, 1.6, -0.2, 0, 0}}, 6.25, true);
    testing::Pieces const profile_of({{0, 0, 3, 1, -2, 4}}, 5);
    auto cases = oracle::make_planar_cases(20261131, 2000);
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
        auto& [in, parts, speeds] = cases[i];
        if (i % 3 == 0) {
            parts.drive = {.by = DriveBy::profile, .table = &profile_of.table()};
            in.drive_scale = 2 + 0.01 * static_cast<double>(i % 7);
            in.profile_speed = 3 + 2 * 2.1 - 6 * 2.1 * 2.1 + 16 * 2.1 * 2.1 * 2.1;  // at the time of the probe
        } else {
            parts.drive = {.by = DriveBy::torque};
            if (i % 3 == 1) parts.drive.table = i % 2 == 0 ? &falls.table() : &turns.table(), parts.drive.over = i % 2 == 0 ? LoadArgument::crank_speed : LoadArgument::crank_angle;
            in.drive_torque = 0.01 * static_cast<double>(i % 11);
            in.drive_no_load_speed = static_cast<double>(i % 5) * 40;
            in.drive_viscous = 1e-4 * static_cast<double>(i % 4);
            in.drive_inertia = 1e-4 * static_cast<double>(i % 6);
        }
        compare_planar_probe(best_isa(), cases[i], "planar case " + std::to_string(i));
    }
}

/// Springs, stops and the ground's motion on a case, with numbers of their own, under gravity of any direction.
class RandomElements {
public:
    explicit RandomElements(std::uint64_t seed) : draw_(seed) {}

    /// @param x of the slider's centre
    void put(Inputs& in, Parts& parts, std::size_t i, double x) {
        in_ = &in, next_ = 0;
        axes_ = info(parts.mechanism).spatial ? 3 : 2;
        if (axes_ == 3) in.cross_inclination = 3 * number();
        weight_ = in.slider_mass * 10, size_ = in.slider_length;
        loads_.clear();
        if (i % 3 != 1) add_spring(x, i % 2 == 0);
        if (i % 3 != 2) add_stop(x, i % 2 == 0 ? 1 : -1);
        if (i % 3 != 0) add_ground();
        parts.loads = {loads_.data(), static_cast<int>(loads_.size())};
    }

private:
    double number() { return static_cast<double>(draw_() >> 11) * 0x1p-52 - 1; }
    int put(double value) { return testing::put_load_number(*in_, next_, value); }

    void add_spring(double x, bool along) {
        Load& load = loads_.emplace_back();
        load.kind = LoadKind::spring, load.along = along;
        double const place[] = {x, 0, 0};
        for (std::size_t axis = 0; axis < axes_; ++axis) {
            if (!along || axis == 0) load.anchor[axis] = put(place[axis] + 2 * size_ * number());
            load.point[axis] = put(0.5 * size_ * number());
        }
        load.stiffness = put(weight_ / size_ * std::abs(number())), load.rest_length = put(size_ * number());
        load.damping = put(weight_ * std::abs(number())), load.preload = put(weight_ * number());
    }
    /// Half of all states are in it.
    void add_stop(double x, double side) {
        Load& load = loads_.emplace_back();
        load.kind = LoadKind::stop, load.side = side;
        load.anchor[0] = put(x + 0.01 * size_ * number()), load.point[1] = put(0.3 * size_ * number());
        load.stiffness = put(1e3 * weight_ / size_ * std::abs(number()));
        load.damping = put(weight_ * std::abs(number())), load.dissipation = put(std::abs(number()));
    }
    void add_ground() {
        for (std::size_t axis = 0; axis < axes_; ++axis) {
            Load& load = loads_.emplace_back();
            load.kind = LoadKind::ground_motion, load.over = LoadArgument::time, load.table = wave_.table();
            load.force[axis] = put(20 * number());
        }
    }

    std::mt19937_64 draw_;
    Inputs* in_ = nullptr;
    int next_ = 0;
    std::size_t axes_ = 3;
    double weight_ = 0, size_ = 0;  // [N], [m]
    std::vector<Load> loads_;
    testing::Pieces wave_{{{0, 1, 2, 0, 0}, {0.5, 2, 0, -8, 0}, {1, 0, 1, 0, 0}}, 2, true};
};

/// A film of oil on a case: with gaps down to its thinnest, and of a face beyond it, with and without a tension that it bears.
class RandomFilm {
public:
    explicit RandomFilm(std::uint64_t seed) : draw_(seed) {}

    void put(Inputs& in, Parts& parts, std::size_t i) {
        int next = 0;
        auto const number = [&](double least, double most) {
            double const share = static_cast<double>(draw_() >> 11) * 0x1p-53;
            return testing::put_load_number(in, next, least * std::pow(most / least, share));
        };
        film_.kind = LoadKind::film, film_.cavitation_pressure = Load::none;
        film_.viscosity = number(1e-3, 1), film_.least_gap = number(1e-7, 0.5 * in.clearance_y);
        if (i % 3 != 0) film_.cavitation_pressure = number(1, 1e6);
        parts.loads = {&film_, 1};
    }

private:
    std::mt19937_64 draw_;
    Load film_;
};

TEST(FilmsAgainstOracle, AgreeOnThousandsOfStates) {
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) {
        RandomFilm film(51);
        auto cases = oracle::make_cases(20261128, 2000, mechanism);
        int compared = 0;
        for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
            auto& c = cases[i];
            film.put(c.inputs, c.parts, i);
            c.inputs.drive_inertia += 1e-6;  // at a dead centre nothing else turns
            compared += compare_probe(best_isa(), c, oracle::name_of(mechanism) + " case " + std::to_string(i));
        }
        EXPECT_GT(compared, 1800);
    }
}

/// Faces with clearances of their own, about a middle that keeps the case's touches where the way is not turned.
void put_face_clearances(oracle::Case& c, double share) {
    Inputs& in = c.inputs;
    double const y = 0.7 * share * in.clearance_y, z = -0.9 * share * in.clearance_z;
    in.clearance_y_plus = in.clearance_y + y, in.clearance_y_minus = in.clearance_y - y;
    in.clearance_z_plus = in.clearance_z + z, in.clearance_z_minus = in.clearance_z - z;
    if (!c.parts.misaligned_way) in.way_offset_y = in.way_offset_z = in.way_roll = in.way_yaw = in.way_pitch = 0;
    in.way_offset_y += y, in.way_offset_z += z;
    c.parts.misaligned_way = true;
}

TEST(ElementsAgainstOracle, AgreeOnThousandsOfStates) {
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) {
        RandomElements elements(46);
        auto cases = oracle::make_cases(20261130, 2000, mechanism);
        int compared = 0;
        for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
            auto& c = cases[i];
            elements.put(c.inputs, c.parts, i, oracle::evaluate(c.inputs, c.parts, c.t, c.state).x);
            compared += compare_probe(best_isa(), c, oracle::name_of(mechanism) + " case " + std::to_string(i));
        }
        EXPECT_GT(compared, 1800);
    }
    RandomElements elements(47);
    auto cases = oracle::make_planar_cases(20261131, 2000);
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
        auto& c = cases[i];
        auto const x = oracle::PlanarMechanism(c.inputs, c.parts).at(oracle::planar_start(c.inputs)).x;
        elements.put(c.inputs, c.parts, i, static_cast<double>(x));
        compare_planar_probe(best_isa(), c, "planar case " + std::to_string(i));
    }
}

/// Profiles of the way on a case, so that its apices touch as they did, or nearly: what the faces lie back at both ends of the slider, the clearances lack.
class RandomProfiles {
public:
    explicit RandomProfiles(std::uint64_t seed) : draw_(seed) {}

    /// @param x of the slider's centre
    void put(Inputs& in, Parts& parts, std::size_t i, double x) {
        int next = 0;
        double const depth = 0.3 * std::min(in.clearance_y, in.clearance_z), half = 0.5 * in.slider_length;
        in.clearance_y -= depth, in.clearance_z -= depth;
        tables_.clear(), loads_.clear();
        add(15, depth, 0, x, half);
        loads_.back().scale = testing::put_load_number(in, next, 1);
        for (int const faces : {1 + static_cast<int>(i % 15), 15 - static_cast<int>(i % 7)}) {
            add(faces, 0.03 * depth * number(), 0.03 * depth * number(), x, half);
            if (i % 2 == 0) loads_.back().scale = testing::put_load_number(in, next, std::abs(number()));
        }
        if (i % 3 == 0) {
            Load& ends = loads_.emplace_back();
            ends.kind = LoadKind::way_ends;
            if (i % 9 != 0) ends.from = testing::put_load_number(in, next, x - half * (1 + 0.4 * number()));
            if (i % 9 != 3) ends.to = testing::put_load_number(in, next, x + half * (1 + 0.4 * number()));
        }
        parts.loads = {loads_.data(), static_cast<int>(loads_.size())};
    }

private:
    double number() { return static_cast<double>(draw_() >> 11) * 0x1p-52 - 1; }

    /// Two pieces, one for each end.
    void add(int faces, double depth, double more, double x, double half) {
        double const from = x - 1.2 * half, middle = x + 0.1 * half, rear = 0.2 * half, front = 0.9 * half, steep = 0.02 * number(), bend = 0.1 * number();
        tables_.emplace_back(std::vector<PieceTable::Piece>{{from, depth - rear * steep, steep, 0, 0, 0},
                                                            {middle, depth + more - front * (front * bend - 0.5 * steep), -0.5 * steep, bend, 0, 0}},
                             x + 1.5 * half);
        Load& load = loads_.emplace_back();
        load.kind = LoadKind::way_profile, load.over = LoadArgument::x, load.table = tables_.back().table(), load.faces = faces;
    }

    std::mt19937_64 draw_;
    std::deque<testing::Pieces> tables_;
    std::vector<Load> loads_;
};

TEST(WayProfilesAgainstOracle, AgreeOnThousandsOfStates) {
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) {
        // Whose depths the law is told is no matter of the law, but that one goes by all four of a face.
        for (Law const law : {Law::paper, Law::foundation}) {
            if (law == Law::foundation && mechanism != Mechanism::slider_crank) continue;
            RandomProfiles profiles(51);
            auto cases = oracle::make_cases(20261202, 2000, mechanism, law);
            int compared = 0, pushed = 0;
            for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
                auto& c = cases[i];
                profiles.put(c.inputs, c.parts, i, oracle::evaluate(c.inputs, c.parts, c.t, c.state).x);
                auto const found = oracle::evaluate(c.inputs, c.parts, c.t, c.state);
                pushed += found.surfaces + found.lines + found.points > 0;
                compared += compare_probe(best_isa(), c, oracle::name_of(mechanism) + " case " + std::to_string(i));
            }
            EXPECT_GT(compared, 1800);
            EXPECT_GT(pushed, 1000);
        }
    }
}

/// Where mass centre and pin lie, and four faces with clearances of their own, on cases with loads, drives and the ground's motion.
TEST(OffsetSlidersAgainstOracle, AgreeOnThousandsOfStates) {
    testing::Pieces const falls({{0, 1, -0.01, 0, 1e-7}, {100, 0.1, 0, -1e-6, 0}}, 400);
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) {
        RandomLoads loads(48);
        RandomElements elements(49);
        RandomFilm film(52);
        std::mt19937_64 draw(50);
        auto const number = [&] { return static_cast<double>(draw() >> 11) * 0x1p-52 - 1; };
        auto cases = oracle::make_cases(20261201, 2000, mechanism);
        int compared = 0;
        for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
            auto& c = cases[i];
            Inputs& in = c.inputs;
            c.parts.offset_slider = true;
            double const size = 0.4 * in.slider_length;
            in.drive_inertia += 1e-6;  // at a dead centre nothing else turns
            if (i % 4 != 0) in.mass_center_x = size * number(), in.mass_center_y = size * number(), in.mass_center_z = size * number();
            if (i % 4 != 1 && mechanism != Mechanism::free_slider) in.pin_x = size * number(), in.pin_y = size * number(), in.pin_z = size * number();
            if (i % 3 == 0) loads.put(in, c.parts, i, in.slider_mass * in.gravity);
            if (i % 3 == 1) elements.put(in, c.parts, i, oracle::evaluate(in, c.parts, c.t, c.state).x);
            if (i % 3 == 2) film.put(in, c.parts, i);
            if (i % 5 == 0) put_face_clearances(c, number());
            if (c.parts.drive.turns_freely()) c.parts.drive.table = &falls.table(), c.parts.drive.over = LoadArgument::crank_speed;
            compared += compare_probe(best_isa(), c, oracle::name_of(mechanism) + " case " + std::to_string(i));
        }
        EXPECT_GT(compared, 1800);
    }
}

}  // namespace
}  // namespace slideway::mechanism_oracle_test
