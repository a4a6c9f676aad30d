// Contacts that a step within an impact holds, a face of each lane at a time, against the joint that looks at all faces: the same wrench,
// the same report, whatever touches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "kernels/joint/held_face.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/compiled_laws.hpp"

namespace slideway::held_contacts_test {
namespace {

/// A state with its contacts held as they are.
class Held {
public:
    explicit Held(oracle::Case const& c) : c_(c), p_(slider_parameters(c.inputs)), block_(testing::conditions_of<double>(c.parts)) {
        start_memory(memory);
        for (int face = 0; face < face_count; ++face) {
            auto const speed = [&](int k) { return c.impact_speeds[static_cast<std::size_t>((face < 2 ? 0 : 8) + face_apex(face, k))]; };
            memory.impact_speed[face] = {speed(0), speed(1), speed(2), speed(3)};
        }
        block_.holds_contacts = true;
        auto const at_once = evaluate(false);  // nothing is held yet: what is deeper than zero touches
        auto const held = [](double depth) { return depth > 0 ? 1.0 : 0.0; };
        for (int face = 0; face < face_count; ++face) {
            auto const& d = at_once.report.contact.penetration[face];
            memory.held[face] = {held(d.a), held(d.b), held(d.c), held(d.d)};
        }
        memory.holding = 1;
        memory.touched = HeldFace<double>::first_of(HeldFace<double>::faces_of(memory), memory).packed();
    }

    struct Evaluation {
        double rates[state_size + 1] = {};
        SliderReport<double> report;
        Faults<double> faults;
    };
    /// @param by_clocks a face at a time, else all faces
    [[nodiscard]] Evaluation evaluate(bool by_clocks, bool powers_alone = false) const {
        auto block = block_;
        block.by_clocks = by_clocks;
        block.powers_alone = powers_alone;
        Evaluation e;
        e.faults = SliderCrank::derivative<true, double>(c_.t, c_.state.data(), p_, memory, block, e.rates, &e.report);
        return e;
    }
    [[nodiscard]] Evaluation lean() const {
        auto block = block_;
        block.by_clocks = true;
        Evaluation e;
        e.faults = SliderCrank::derivative<false, double>(c_.t, c_.state.data(), p_, memory, block, e.rates, nullptr);
        return e;
    }
    /// How many faces touch, and the apices of the first that does, a bit each.
    [[nodiscard]] int faces() const {
        return static_cast<int>(std::ranges::count_if(memory.held, [](Quad<double> const& face) { return sum(face) > 0; }));
    }
    [[nodiscard]] int apices() const {
        for (auto const& q : memory.held) {
            if (sum(q) > 0) return static_cast<int>(q.a + 2 * q.b + 4 * q.c + 8 * q.d);
        }
        return 0;
    }

    ContactMemory<double> memory;

private:
    oracle::Case const& c_;
    SliderParameters<double> p_;
    Conditions<LawFunctions<double>> block_;
};

/// Has a function see the numbers of two quads in turn.
template <class Function> void each(Quad<double> const& a, Quad<double> const& b, Function const& see) {
    see(a.a, b.a), see(a.b, b.b), see(a.c, b.c), see(a.d, b.d);
}

void expect_same(oracle::Case const& c, Held const& held, std::string const& what) {
    auto const want = held.evaluate(false), found = held.evaluate(true);
    ASSERT_EQ(found.faults.contact_domain, want.faults.contact_domain) << what;
    if (want.faults.contact_domain || want.faults.geometry) return;
    auto const &all = want.report.contact, &one = found.report.contact;
    double const load = all.total_force(), rounding = 2e-13;
    // The scales of accelerations are those of the loads: friction and normal forces may nearly cancel.
    double const lever = 0.5 * c.inputs.slider_length;
    double const least_inertia = std::min({c.inputs.slider_inertia_x, c.inputs.slider_inertia_y, c.inputs.slider_inertia_z});
    for (int i = 0; i < state_size; ++i) {
        double const scale = i >= 7 ? load * lever / least_inertia : load / c.inputs.slider_mass;
        EXPECT_NEAR(found.rates[i], want.rates[i], rounding * (scale + std::abs(want.rates[i]))) << what << ", rate " << i;
    }
    for (int face = 0; face < face_count; ++face) {
        each(one.penetration[face], all.penetration[face], [&](double a, double b) { EXPECT_EQ(a, b) << what << ", depth on face " << face; });
        each(one.rate[face], all.rate[face], [&](double a, double b) { EXPECT_EQ(a, b) << what << ", rate on face " << face; });
        each(one.normal_force[face], all.normal_force[face],
             [&](double a, double b) { EXPECT_NEAR(a, b, rounding * load) << what << ", force on face " << face; });
    }
    EXPECT_EQ(one.surfaces, all.surfaces) << what;
    EXPECT_EQ(one.lines, all.lines) << what;
    EXPECT_EQ(one.points, all.points) << what;
    EXPECT_NEAR(one.potential, all.potential, rounding * all.potential) << what;
    auto const speed = [](ContactReport<double> const& r) {
        double largest = 0;
        for (auto const& q : r.rate) largest = std::max({largest, std::abs(q.a), std::abs(q.b), std::abs(q.c), std::abs(q.d)});
        return largest;
    };
    // Damping may leave nothing of the elastic load.
    double const power = load * speed(all) + std::abs(all.elastic_power);
    EXPECT_NEAR(one.damping_power, all.damping_power, rounding * power) << what;
    EXPECT_NEAR(one.elastic_power, all.elastic_power, rounding * power) << what;
    EXPECT_NEAR(one.friction_power, all.friction_power, rounding * (load + std::abs(all.friction_power))) << what;
}

/// The derivative has the same bits without a report, and the powers where they are told alone.
void expect_same_bits(Held const& held, std::string const& what) {
    auto const full = held.evaluate(true), lean = held.lean(), powers = held.evaluate(true, true);
    if (full.faults.contact_domain || full.faults.geometry) return;
    for (int i = 0; i < state_size; ++i) {
        EXPECT_EQ(lean.rates[i], full.rates[i]) << what << ", rate " << i;
        EXPECT_EQ(powers.rates[i], full.rates[i]) << what << ", rate " << i;
    }
    EXPECT_EQ(powers.report.crank_power, full.report.crank_power) << what;
    EXPECT_EQ(powers.report.contact.friction_power, full.report.contact.friction_power) << what;
    EXPECT_EQ(powers.report.contact.damping_power, full.report.contact.damping_power) << what;
    EXPECT_EQ(powers.report.contact.elastic_power, full.report.contact.elastic_power) << what;
}

TEST(HeldContacts, PushAsTheJointDoesWhateverTouches) {
    std::set<int> patterns;
    int several_faces = 0;
    for (Law const law : oracle::every_law()) {
        auto const cases = oracle::make_cases(20, 1200, Mechanism::slider_crank, law);
        for (std::size_t i = 0; i < cases.size(); ++i) {
            Held const held(cases[i]);
            auto const what = oracle::name_of(law) + ", case " + std::to_string(i);
            expect_same(cases[i], held, what);
            expect_same_bits(held, what);
            patterns.insert(held.apices());
            several_faces += held.faces() > 1 ? 1 : 0;
            if (::testing::Test::HasFailure()) return;
        }
    }
    EXPECT_EQ(patterns.size(), 14U) << "every set of a face's apices but two across it alone: of a plane δ_a + δ_c = δ_b + δ_d";
    EXPECT_GT(several_faces, 100);
}

/// A pair whose depth is the clock's has its force from there, and its rate goes to the clock.
TEST(HeldContacts, TakeTheDepthOfTheClocksPairFromTheClock) {
    int seen = 0;
    auto const cases = oracle::make_cases(21, 2400, Mechanism::slider_crank, Law::conservative);
    for (auto const& c : cases) {
        Held held(c);
        if (held.faces() != 1 || c.parts.damping != Damping::point) continue;
        auto const before = held.evaluate(true);
        for (int pair = 0; pair < 16; ++pair) {
            auto const of = [&](Quad<double> const* quads) {
                auto const& q = quads[pair / 4];
                return pair % 4 == 0 ? q.a : pair % 4 == 1 ? q.b : pair % 4 == 2 ? q.c : q.d;
            };
            auto const& contact = before.report.contact;
            if (of(held.memory.held) == 0) continue;
            held.memory.clock = pair;
            held.memory.clock_depth = of(contact.penetration);
            auto const same = held.evaluate(true);
            EXPECT_EQ(same.rates[state_size], of(contact.rate)) << "pair " << pair;
            for (int i = 0; i < state_size; ++i) EXPECT_EQ(same.rates[i], before.rates[i]) << "pair " << pair << ", rate " << i;
            held.memory.clock_depth = 1e-30;  // as where it goes out
            EXPECT_LT(of(held.evaluate(true).report.contact.normal_force), 1e-15) << "pair " << pair << ": the law's force vanishes with the depth";
            held.memory.clock = -1;
            ++seen;
        }
    }
    EXPECT_GT(seen, 100);
}

}  // namespace
}  // namespace slideway::held_contacts_test
