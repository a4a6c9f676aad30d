// Accelerations of two linkages against values worked out from a Lagrangian in 40 digits.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/backend/backend.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/linkages.hpp"
#include "host/config/scene.hpp"
#include "host/study/probe.hpp"

namespace slideway::linkage_values_test {
namespace {

ProbeResult told(Scene const& scene, std::vector<double> const& state) {
    Inputs in = member_inputs(scene, 0);
    StateNumbers numbers{};
    std::copy(state.begin(), state.end(), numbers.begin());
    set_start(info(scene.parts.mechanism), numbers, in);
    return probe(Isa::scalar, scene.parts, {in}, {0}).front();
}

void expect_relative(double got, double want, double error) { EXPECT_NEAR(got, want, error * std::abs(want)); }

/// Crank and rod, and a slider on an inclined line, whose pin is a journal with friction; the crank turns freely.
Scene crank_with_a_journal() {
    return parse_scene("schema = 1\n[mechanism]\nkind = \"linkage\"\n[drive]\nkind = \"free\"\nbody = \"crank\"\n"
                       "[body.crank]\nmass = 0.3\ninertia = 1e-4\ncenter_x = 0.02\ncenter_y = 0.003\n[body.rod]\nmass = 0.21\ninertia = 2.5e-4\ncenter_x = 0.055\ncenter_y = -0.002\n"
                       "[body.slider]\nmass = 0.14\n[link.shaft]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"crank\"\n"
                       "[link.pin]\nkind = \"revolute\"\nfirst = \"crank\"\nfirst_x = 0.05\nsecond = \"rod\"\n"
                       "[link.way]\nkind = \"prismatic\"\nfirst = \"ground\"\nfirst_x = 0.01\nfirst_y = -0.002\nsecond = \"slider\"\ndirection = 0.1\nposition = 0.15\n"
                       "[link.wrist]\nkind = \"journal\"\nfirst = \"rod\"\nfirst_x = 0.12\nsecond = \"slider\"\nsecond_x = 0.004\nsecond_y = 0.001\nclearance = 1e-4\nradius = 0.01\nstiffness = 5e9\n"
                       "[contact]\neta = 0\n[friction]\nstatic = 0.1\nkinetic = 0.05\nstick_speed = 1e-3\nslip_speed = 1e-2\n[study]\nduration = 1\n",
                       "journal", {});
}

}  // namespace

TEST(LinkageValues, OfAJournalApartAndPressed) {
    Scene const scene = crank_with_a_journal();
    struct { std::vector<double> state; double accelerations[3], energy, depth, error; } const cases[] = {
        // Crank, slider, rod: what slides stands before what turns.
        {{0.29999999999999999, 100, 0.15450001344970871, -2, -0.0026627967637510939, -40},
         {-3810.438087466523, -0.9793658173053842, 4384.576495016183}, 2.617691622336764, -5e-5, 1e-14},
        // A depth of 3 µm is known to a few roundings of a length of 0.1 m.
        {{0.29999999999999999, 100, 0.1544593500025408, -2, -0.0024120962346755319, -40},
         {-2082.805951108122, 157.4230653532171, 1196.204918623014}, 2.617552980013467, 3.000000000004902e-6, 2e-11},
    };
    for (auto const& one : cases) {
        ProbeResult const got = told(scene, one.state);
        for (int i = 0; i < 3; ++i) expect_relative(got.derivative[2 * i + 1], one.accelerations[i], one.error);
        expect_relative(got.energy, one.energy, 1e-14);
        EXPECT_NEAR(got.penetration_y[linkage_of(scene.parts.mechanism)->plan.closure[0].pair], one.depth, 1e-16);
    }
}

TEST(LinkageValues, OfASixBarWithTwoLoops) {
    std::string const text = "schema = 1\n[mechanism]\nkind = \"linkage\"\ncrank_speed = 30\n[drive]\nbody = \"b1\"\n"
                             "[body.b1]\nmass = 0.3\ninertia = 2e-4\ncenter_x = 0.03\ncenter_y = 0.001\n[body.b2]\nmass = 0.5\ninertia = 1.5e-3\ncenter_x = 0.1\ncenter_y = 0.01\nangle = 0.5\n"
                             "[body.b3]\nmass = 0.45\ninertia = 1.1e-3\ncenter_x = 0.07\ncenter_y = -0.005\nangle = 1.5\n[body.b4]\nmass = 0.35\ninertia = 1e-3\ncenter_x = 0.09\nangle = 0.2\n"
                             "[body.b5]\nmass = 0.4\ninertia = 9e-4\ncenter_x = 0.06\ncenter_y = 0.004\nangle = 1.4\n"
                             "[link.a]\nkind = \"revolute\"\nfirst = \"ground\"\nsecond = \"b1\"\n[link.b]\nkind = \"revolute\"\nfirst = \"b1\"\nfirst_x = 0.06\nsecond = \"b2\"\n"
                             "[link.c]\nkind = \"revolute\"\nfirst = \"ground\"\nfirst_x = 0.22\nsecond = \"b3\"\n[link.d]\nkind = \"revolute\"\nfirst = \"b3\"\nfirst_x = 0.12\nfirst_y = -0.05\nsecond = \"b4\"\n"
                             "[link.e]\nkind = \"revolute\"\nfirst = \"ground\"\nfirst_x = 0.45\nfirst_y = 0.02\nsecond = \"b5\"\n"
                             "[link.f]\nkind = \"revolute\"\nfirst = \"b2\"\nfirst_x = 0.2\nsecond = \"b3\"\nsecond_x = 0.14\n[link.g]\nkind = \"revolute\"\nfirst = \"b4\"\nfirst_x = 0.2\nsecond = \"b5\"\nsecond_x = 0.15\n"
                             "[study]\nduration = 1\n";
    struct { char const* angle; double places[4], rates[4], accelerations[4]; } const cases[] = {
        {"0.5", {0.58974557462255883, 1.5788578810633673, 0.24774123876717929, 1.4845243184711983}, {-9.4941998498397151, -1.3791384286160879, 0.28082812587060507, -1.0189528489041531},
         {210.3132304550489, 612.6445524867987, -124.2970915433008, 453.427225833825}},
        {"2.75", {0.42132131851334281, 2.296839928407012, 0.13766367952924757, 2.0880307694518301}, {4.1305737571524972, 9.789034147969085, -1.2667302889156196, 8.963328826295335},
         {178.7885072546479, -222.2491082244245, 29.14918619354242, -186.3509781345962}},
    };
    for (auto const& one : cases) {
        Scene const scene = parse_scene(text, "six-bar", {{"mechanism.start_angle", one.angle}});
        // The linkage goes together as it should.
        StateNumbers const state = start_of(scene.parts.mechanism, member_inputs(scene, 0));
        ProbeResult const got = told(scene, {state.begin(), state.begin() + 10});
        Linkage const& linkage = *linkage_of(scene.parts.mechanism);
        for (int i = 0; i < 4; ++i) {
            auto const body = std::ranges::find(linkage.bodies, "b" + std::to_string(i + 2)) - linkage.bodies.begin();
            auto const c = static_cast<std::size_t>(linkage.plan.body[body].coordinate);
            EXPECT_NEAR(state[2 * c], one.places[i], 1e-14);
            expect_relative(state[2 * c + 1], one.rates[i], 1e-13);
            expect_relative(got.derivative[2 * c + 1], one.accelerations[i], 1e-13);
        }
        // What the drive does is what the energy rises by along the motion.
        double energies[2];
        for (int side : {0, 1}) {
            double const h = (side == 0 ? -1 : 1) * 1e-6;
            std::vector<double> there(state.begin(), state.begin() + 10);
            for (std::size_t i = 0; i < there.size(); ++i) there[i] += h * got.derivative[i];
            energies[side] = told(scene, there).energy;
        }
        expect_relative(30 * got.crank_torque, (energies[1] - energies[0]) / 2e-6, 1e-6);
    }
}

}  // namespace slideway::linkage_values_test
