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
#include "tests/unit/oracle_comparison.hpp"

namespace slideway {
namespace {

using testing::compare;
using testing::compare_probe;
using testing::Comparison;
using testing::load_of;

class KernelsAgainstOracle : public ::testing::TestWithParam<Isa> {};

TEST_P(KernelsAgainstOracle, AgreeOnThousandsOfStates) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine lacks " << name_of(GetParam());
    auto const cases = oracle::make_cases(20200103, 4000);
    int compared = 0;
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i)
        compared += compare_probe(GetParam(), cases[i], "case " + std::to_string(i));
    EXPECT_GT(compared, 3500);
}

INSTANTIATE_TEST_SUITE_P(Isas, KernelsAgainstOracle, ::testing::Values(Isa::scalar, Isa::sse2, Isa::avx2, Isa::avx512),
                         [](auto const& p) { return std::string(name_of(p.param)); });

/// The restitution memory and what only observers see, which the probe does not show: through the kernel itself.
template <class Law, class Friction, class Way>
SliderReport<double> restitution_report(oracle::Case const& c, SliderParameters<double> const& p, double (&rates)[10]) {
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
SliderReport<double> restitution_report(oracle::Case const& c, SliderParameters<double> const& p, double (&rates)[10]) {
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
