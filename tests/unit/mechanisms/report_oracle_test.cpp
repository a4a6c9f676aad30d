// The restitution memory and what only observers see, which the probe does not show: from the kernels themselves, held against the
// oracle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "kernels/mechanisms/carriage.hpp"
#include "kernels/mechanisms/free_slider.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/mechanisms/planar_slider_crank.hpp"
#include "kernels/mechanisms/scotch_yoke.hpp"
#include "kernels/mechanisms/scotch_yoke_motor.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/mechanisms/slider_crank_motor.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/planar.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/compiled_laws.hpp"
#include "tests/unit/mechanisms/oracle_comparison.hpp"

namespace slideway::report_oracle_test {
namespace {

using testing::compare;
using testing::Comparison;
using testing::load_of;

template <class Model> SliderReport<double> report_of_model(oracle::Case const& c, double* rates) {
    ContactMemory<double> memory;
    start_memory(memory);
    for (int face = 0; face < face_count; ++face) {
        auto const speed = [&](int k) {
            return c.impact_speeds[static_cast<std::size_t>((face < 2 ? 0 : 8) + face_apex(face, k))];
        };
        memory.impact_speed[face] = {speed(0), speed(1), speed(2), speed(3)};
    }
    SliderReport<double> report;
    Model::template derivative<true>(c.t, c.state.data(), Model::parameters(c.inputs), memory, testing::conditions_of<double>(c.parts),
                                     rates, &report);
    return report;
}

SliderReport<double> report_of(oracle::Case const& c, double* rates) {
    switch (c.parts.mechanism) {
        case Mechanism::slider_crank:
            return report_of_model<SliderCrank>(c, rates);
        case Mechanism::carriage:
            return report_of_model<Carriage>(c, rates);
        case Mechanism::scotch_yoke:
            return report_of_model<ScotchYoke>(c, rates);
        case Mechanism::free_slider:
            return report_of_model<FreeSlider>(c, rates);
        case Mechanism::slider_crank_motor:
            return report_of_model<SliderCrankMotor>(c, rates);
        case Mechanism::scotch_yoke_motor:
            return report_of_model<ScotchYokeMotor>(c, rates);
        case Mechanism::planar_slider_crank:
            break;  // has a report of its own, below
    }
    throw std::invalid_argument("no report of a slider with eight apices");
}

void compare_report(oracle::Case const& c, std::string const& what) {
    auto const r = oracle::evaluate(c.inputs, c.parts, c.t, c.state, &c.impact_speeds);
    if (r.geometry || r.contact_domain) return;
    double rates[most_states];
    auto const report = report_of(c, rates);
    double depths[16], forces[16];
    for (int face = 0; face < face_count; ++face) {
        int const base = face < 2 ? 0 : 8;
        auto const put = [&](double* to, Quad<double> const& q) {
            to[base + face_apex(face, 0)] = q.a, to[base + face_apex(face, 1)] = q.b;
            to[base + face_apex(face, 2)] = q.c, to[base + face_apex(face, 3)] = q.d;
        };
        put(depths, report.contact.penetration[face]);
        put(forces, report.contact.normal_force[face]);
    }
    double const powers[] = {report.crank_power, report.contact.friction_power, report.contact.damping_power, report.load_power,
                             report.ground_power, report.spring_loss, report.film_loss};
    compare(what, c, r, rates, depths, forces, powers, report.energy, report.contact.potential, report.crank_torque);

    Comparison observed(what);
    observed.group("acceleration", r.acceleration.data(),
                   std::array{report.acceleration.x, report.acceleration.y, report.acceleration.z}, 3,
                   load_of(r) / c.inputs.slider_mass);
    // Which rounds the spins' squares and the turned axes as well.
    double const felt = std::hypot(r.acceleration[0], r.acceleration[1], r.acceleration[2]);
    observed.value("top sensor", r.acceleration_top, report.top, felt);
    observed.value("front sensor", r.acceleration_front, report.front, felt);
    observed.value("drive torque", r.crank_torque_with_weight, report.drive_torque, std::abs(r.crank_torque));
    observed.value("x", r.x, report.x);
    observed.value("vx", r.vx, report.vx);
    auto const& w = r.rod_angular_velocity;
    observed.value("rod spin", std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]), report.rod_spin);
    observed.value("rod spin about Z", w[2], report.rod_spin_z, report.rod_spin);
    if (!std::isnan(r.ideal_x)) {
        double const y = c.state[0], z = c.state[1];
        observed.value("position error", std::hypot(r.x - r.ideal_x, y, z), report.position_error);
    }
    double total = 0;
    for (int apex = 0; apex < 8; ++apex) {
        auto const a = static_cast<std::size_t>(apex);
        total += r.fn_y[a] + r.fn_z[a];
        observed.value("apex force", r.fn_y[a] + r.fn_z[a], report.contact.apex_force(apex), load_of(r));
    }
    observed.value("total force", total, report.contact.total_force());
}

class ReportOfKernels : public ::testing::TestWithParam<std::tuple<Mechanism, Law>> {};

TEST_P(ReportOfKernels, AgreesWithTheOracleAtAnyImpactSpeeds) {
    auto const [mechanism, law] = GetParam();
    auto const cases = oracle::make_cases(7, 1500, mechanism, law);
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i)
        compare_report(cases[i], "case " + std::to_string(i));
}

INSTANTIATE_TEST_SUITE_P(Spatial, ReportOfKernels,
                         ::testing::Combine(::testing::ValuesIn(oracle::spatial_mechanisms()),
                                            ::testing::ValuesIn(oracle::every_law())),
                         [](auto const& p) {
                             return oracle::name_of(std::get<0>(p.param)) + "_" + oracle::name_of(std::get<1>(p.param));
                         });

PlanarReport<double> planar_report_of(oracle::PlanarCase const& c, double* rates) {
    ContactMemory<double, 1> memory;
    start_memory(memory);
    auto const speed = [&c](std::size_t i) { return static_cast<double>(c.impact_speeds[i]); };
    memory.impact_speed[0] = {speed(0), speed(1), speed(2), speed(3)};
    double state[PlanarSliderCrank::size];
    PlanarSliderCrank::initial_state(c.inputs, state);
    PlanarReport<double> report;
    PlanarSliderCrank::derivative<true>(0.0, state, PlanarSliderCrank::parameters(c.inputs), memory,
                                        testing::conditions_of<double>(c.parts), rates, &report);
    return report;
}

TEST(PlanarRestitutionKernels, AgreeWithTheOracleAtAnyImpactSpeeds) {
    int touching = 0;
    auto const cases = oracle::make_planar_cases(8, 3000);
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i) {
        auto const& c = cases[i];
        if (c.parts.damping != Damping::restitution) continue;
        auto const& in = c.inputs;
        auto const start = oracle::planar_start(in);
        auto const r = oracle::PlanarMechanism(in, c.parts).at(start, &c.impact_speeds);
        double rates[PlanarBase::size];
        auto const report = planar_report_of(c, rates);
        double load = 0;
        for (long double const force : r.force) load += static_cast<double>(force);
        touching += load > 0;

        Comparison compare("case " + std::to_string(i));
        auto const& force = report.contact.normal_force[0];
        compare.group("forces", r.force, std::array{force.a, force.b, force.c, force.d}, 4);
        auto const& rate = report.contact.rate[0];
        double const speed = std::abs(in.crank_length * in.crank_speed) + std::abs(in.slider_length * in.wz);
        compare.group("rates", r.rate, std::array{rate.a, rate.b, rate.c, rate.d}, 4, 1e-6 * speed);
        compare.value("x", static_cast<double>(r.x), report.x);
        compare.value("y", static_cast<double>(r.y), report.y, in.clearance_y);
        compare.value("vx", static_cast<double>(r.vx), report.vx);
        compare.value("vy", static_cast<double>(r.vy), report.vy, 1e-6 * speed);
        std::array const acceleration{r.ax, r.ay};
        // Link by link they are larger, and one's weight is in them.
        double const fierce = in.crank_length * (in.crank_speed * in.crank_speed + std::abs(rates[3])) +
                              in.rod_length * std::abs(rates[4]) + load / in.slider_mass + in.gravity;
        compare.group("acceleration", acceleration, std::array{report.acceleration.x, report.acceleration.y}, 2,
                      fierce);
        compare.value("rod's spin", std::abs(static_cast<double>(start[4])), report.rod_spin);
        double const pin = in.crank_length * std::sin(in.start_angle);
        if (std::abs(pin) < in.rod_length) {
            double const ideal =
                in.crank_length * std::cos(in.start_angle) + std::sqrt(in.rod_length * in.rod_length - pin * pin);
            double const error = std::hypot(static_cast<double>(r.x - static_cast<long double>(ideal)), in.y);
            compare.value("position error", error, report.position_error, 1e-8);
        }
    }
    EXPECT_GT(touching, 500);
}

}  // namespace
}  // namespace slideway::report_oracle_test
