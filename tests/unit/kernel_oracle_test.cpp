// Every number a kernel gives of a state, held against the independent oracle on thousands of states.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"

namespace slideway {
namespace {

constexpr double tolerance = 2e-8;

/// Group by group as in model.md 11: each entry against the largest of its group in the reference.
class Comparison {
public:
    explicit Comparison(std::string what) : what_(std::move(what)) {}

    template <class A, class B>
    void group(char const* name, A const& reference, B const& got, std::size_t n, double floor = 0) {
        double scale = floor;
        for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(static_cast<double>(reference[i])));
        if (scale == 0) scale = 1e-300;
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_LE(std::abs(static_cast<double>(reference[i]) - static_cast<double>(got[i])), tolerance * scale)
                << what_ << ": " << name << " " << i << " is " << got[i] << ", the oracle says " << reference[i];
        }
    }
    void value(char const* name, double reference, double got, double floor = 0) {
        group(name, &reference, &got, 1, floor);
    }

private:
    std::string what_;
};

double load_of(oracle::Result const& r) {
    double sum = 0;
    for (int i = 0; i < 8; ++i) sum += r.fn_y[static_cast<std::size_t>(i)] + r.fn_z[static_cast<std::size_t>(i)];
    return sum;
}

template <std::size_t n>
std::array<double, 2 * n> joined(std::array<double, n> const& a, std::array<double, n> const& b) {
    std::array<double, 2 * n> all;
    std::copy(a.begin(), a.end(), all.begin());
    std::copy(b.begin(), b.end(), all.begin() + n);
    return all;
}

void compare(std::string const& what, oracle::Case const& c, oracle::Result const& r, double const* d,
             double const* depths, double const* forces, double const* powers, double energy, double potential,
             double torque) {
    Comparison compare(what);
    double const load = load_of(r);
    compare.group("position rates", r.derivative.data(), d, 2);
    compare.group("accelerations", r.derivative.data() + 2, d + 2, 2, load / c.inputs.slider_mass);
    compare.group("attitude rates", r.derivative.data() + 4, d + 4, 3);
    double const inertia = std::min({c.inputs.slider_inertia_x, c.inputs.slider_inertia_y, c.inputs.slider_inertia_z});
    compare.group("angular accelerations", r.derivative.data() + 7, d + 7, 3, load * c.inputs.slider_length / inertia);
    compare.group("penetrations", joined(r.pen_y, r.pen_z), depths, 16);
    compare.group("forces", joined(r.fn_y, r.fn_z), forces, 16);
    double const reference_powers[] = {r.power_crank, r.power_friction, r.power_damping};
    compare.group("powers", reference_powers, powers, 3);
    compare.value("energy", r.energy, energy);
    // A penetration is good to about 1e-18 m, whatever its size.
    compare.value("potential", r.contact_potential, potential, load * 1e-18 / tolerance);
    compare.value("crank torque", r.crank_torque, torque);
}

class KernelsAgainstOracle : public ::testing::TestWithParam<Isa> {};

TEST_P(KernelsAgainstOracle, AgreeOnThousandsOfStates) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine lacks " << name_of(GetParam());
    auto const cases = oracle::make_cases(20200103, 4000);
    int compared = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        auto const& c = cases[i];
        // The probe's impact speeds are their start value.
        oracle::Pairs start;
        start.fill(1e-4);
        auto const r = oracle::evaluate(c.inputs, c.parts, c.t, c.state, &start);
        if (r.geometry || r.contact_domain) continue;
        Inputs in = c.inputs;
        double* const state[] = {&in.y, &in.z, &in.vy, &in.vz, &in.roll, &in.yaw, &in.pitch, &in.wx, &in.wy, &in.wz};
        for (std::size_t j = 0; j < 10; ++j) *state[j] = c.state[j];
        ProbeResult p;
        find_instance(GetParam(), c.parts).probe({&in, &c.t, 1, &p});
        std::vector<double> depths(p.penetration_y, p.penetration_y + 8),
            forces(p.normal_force_y, p.normal_force_y + 8);
        depths.insert(depths.end(), p.penetration_z, p.penetration_z + 8);
        forces.insert(forces.end(), p.normal_force_z, p.normal_force_z + 8);
        double const powers[] = {p.power_crank, p.power_friction, p.power_damping};
        auto const what = "case " + std::to_string(i);
        EXPECT_EQ(p.status, Status::finished) << what;
        EXPECT_EQ(p.surfaces, r.surfaces) << what;
        EXPECT_EQ(p.lines, r.lines) << what;
        EXPECT_EQ(p.points, r.points) << what;
        compare(what, c, r, p.derivative, depths.data(), forces.data(), powers, p.energy, p.contact_potential,
                p.crank_torque);
        ++compared;
        if (HasFailure()) break;
    }
    EXPECT_GT(compared, 3500);
}

INSTANTIATE_TEST_SUITE_P(Isas, KernelsAgainstOracle, ::testing::Values(Isa::scalar, Isa::sse2, Isa::avx2, Isa::avx512),
                         [](auto const& p) { return std::string(name_of(p.param)); });

/// The restitution memory and what only observers see, which the probe does not show: through the kernel itself.
template <class Law, class Friction, class Way>
SliderReport<double> restitution_report(oracle::Case const& c, SliderParameters<double> const& p,
                                             double (&rates)[10]) {
    using Model = SliderCrank<Law, Friction, Way, RestitutionDamping>;
    typename Model::template Memory<double> memory;
    for (int face = 0; face < face_count; ++face) {
        auto const speed = [&](int k) {
            return c.impact_speeds[static_cast<std::size_t>((face < 2 ? 0 : 8) + face_apex(face, k))];
        };
        memory.speeds[face] = {speed(0), speed(1), speed(2), speed(3)};
    }
    SliderReport<double> report;
    Model::template derivative<true>(c.t, c.state.data(), p, memory, rates, &report);
    return report;
}

template <class Law>
SliderReport<double> restitution_report(oracle::Case const& c, SliderParameters<double> const& p,
                                             double (&rates)[10]) {
    if (c.parts.friction) {
        return c.parts.misaligned_way ? restitution_report<Law, StickSlipFriction, MisalignedWay>(c, p, rates)
                                      : restitution_report<Law, StickSlipFriction, AlignedWay>(c, p, rates);
    }
    return c.parts.misaligned_way ? restitution_report<Law, NoFriction, MisalignedWay>(c, p, rates)
                                  : restitution_report<Law, NoFriction, AlignedWay>(c, p, rates);
}

void compare_restitution(oracle::Case const& c, std::string const& what) {
    auto const r = oracle::evaluate(c.inputs, c.parts, c.t, c.state, &c.impact_speeds);
    if (r.geometry || r.contact_domain) return;
    auto const p = slider_parameters(c.inputs);
    double rates[10];
    auto const report = c.parts.law == Law::paper ? restitution_report<PaperLaw>(c, p, rates)
                                                  : restitution_report<ConservativeLaw>(c, p, rates);
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
    double const powers[] = {report.crank_power, report.contact.friction_power, report.contact.damping_power};
    compare(what, c, r, rates, depths, forces, powers, report.energy, report.contact.potential, report.crank_torque);

    Comparison observed(what);
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

TEST(RestitutionKernels, AgreeWithTheOracleAtAnyImpactSpeeds) {
    int compared = 0;
    auto const cases = oracle::make_cases(7, 6000);
    for (std::size_t i = 0; i < cases.size() && !::testing::Test::HasFailure(); ++i) {
        auto const& c = cases[i];
        if (c.parts.damping != Damping::restitution) continue;
        compare_restitution(c, "case " + std::to_string(i));
        ++compared;
    }
    EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace slideway
