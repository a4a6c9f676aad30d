// The seeded cases reach every contact mode, depth, sliding speed, part and parameter.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/unit/oracle/oracle_fixture.hpp"

namespace random_states_test {
namespace {

using oracle::Case;
using oracle::Pairs;
using oracle::Result;
using oracle::testing::evaluate;
using oracle::testing::joined;
using oracle::testing::seed;
using oracle::testing::Triple;
using slideway::Inputs;
using slideway::Law;
using slideway::Mechanism;

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
        parts.insert(24 * static_cast<int>(c.parts.law) + 6 * c.parts.friction + 12 * c.parts.misaligned_way +
                     static_cast<int>(c.parts.damping));
        for (double rate : r.derivative) EXPECT_TRUE(std::isfinite(rate));
        EXPECT_FALSE(r.geometry || r.contact_domain);
    }
    for (int decade = -10; decade <= -6; ++decade) EXPECT_TRUE(decades.count(decade)) << "1e" << decade << " m";
    EXPECT_EQ(frictions, (std::set<int>{0, 1, 2, 3, 4}));
    EXPECT_EQ(parts.size(), 24u);
}

/// How many values each number of Inputs takes.
std::vector<std::size_t> values_of_inputs() {
    constexpr int numbers = sizeof(Inputs) / sizeof(double);
    std::array<std::set<std::uint64_t>, numbers> seen;  // bits, for one of them is NaN
    auto const see = [&seen](std::vector<Case> const& cases) {
        for (Case const& c : cases) {
            auto const values = std::bit_cast<std::array<std::uint64_t, numbers>>(c.inputs);
            for (int i = 0; i < numbers; ++i) seen[i].insert(values[i]);
        }
    };
    for (Mechanism const mechanism : oracle::spatial_mechanisms()) see(oracle::make_cases(seed, 500, mechanism));
    for (Law const law : oracle::every_law()) see(oracle::make_cases(seed, 500, Mechanism::slider_crank, law));
    std::vector<std::size_t> counts;
    for (auto const& values : seen) counts.push_back(values.size());
    return counts;
}

TEST(RandomStates, VaryEveryParameter) {
    Inputs const where;
    auto const place_of = [&where](double const& member) {
        return static_cast<std::size_t>(&member - reinterpret_cast<double const*>(&where));
    };
    std::set<std::size_t> other = {place_of(where.slider_height), place_of(where.slider_depth),  // of the planar block alone
                                   // Cases have masses and inertias.
                                   place_of(where.crank_section), place_of(where.rod_section), place_of(where.wall), place_of(where.density),
                                   place_of(where.drive_scale), place_of(where.profile_speed),  // DrivesAgainstOracle has them
                                   place_of(where.cross_inclination)};  // ElementsAgainstOracle draws it
    // OffsetSlidersAgainstOracle draws these.
    for (double const* offset : {&where.mass_center_x, &where.mass_center_y, &where.mass_center_z, &where.pin_x, &where.pin_y, &where.pin_z, &where.clearance_y_plus,
                                 &where.clearance_y_minus, &where.clearance_z_plus, &where.clearance_z_minus})
        other.insert(place_of(*offset));
    // No law of the tree has more than two numbers of its own, and no mechanism any.
    for (int i = 2; i < slideway::most_own_numbers; ++i) other.insert(place_of(where.*slideway::law_inputs[i]));
    for (auto const own : slideway::mechanism_inputs) other.insert(place_of(where.*own));
    for (auto const load : slideway::load_inputs) other.insert(place_of(where.*load));  // LoadsAgainstOracle draws them
    for (auto const number : slideway::linkage_inputs) other.insert(place_of(where.*number));  // LinkagesAgainstOracle has them
    // The start of a run: a case carries its own state.
    for (double const* start : {&where.y, &where.z, &where.vy, &where.vz, &where.roll, &where.yaw, &where.pitch,
                                &where.wx, &where.wy, &where.wz, &where.x, &where.vx})
        other.insert(place_of(*start));
    auto const counts = values_of_inputs();
    for (std::size_t i = 0; i < counts.size(); ++i)
        EXPECT_TRUE(other.contains(i) || counts[i] > 50) << "number " << i << " of Inputs";
}

TEST(RandomStates, GiveALawTheSameStatesAndNumbersOfItsOwn) {
    auto const published = oracle::make_cases(seed, 480);
    for (Law const law : oracle::every_law()) {
        auto const cases = oracle::make_cases(seed, 480, Mechanism::slider_crank, law);
        ASSERT_EQ(cases.size(), published.size());
        bool const of_apices = law == Law::kelvin_voigt, of_bed = law == Law::foundation;
        double const softest = of_bed ? 1e9 : 1e5, hardest = of_bed ? 1e14 : 1e10;
        int following = 0, given = 0, undamped = 0, damped = 0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            auto const& [in, parts, t, state, speeds] = cases[i];
            EXPECT_EQ(parts.law, law);
            EXPECT_EQ(state, published[i].state);
            EXPECT_EQ(t, published[i].t);
            EXPECT_EQ(parts.friction, published[i].parts.friction);
            EXPECT_EQ(parts.misaligned_way, published[i].parts.misaligned_way);
            following += std::isnan(in.law_a), given += in.law_a >= softest && in.law_a <= hardest;
            undamped += in.law_b == 0, damped += in.law_b >= 1 && in.law_b <= 1e4;
            EXPECT_EQ(parts.damping, of_apices ? slideway::Damping::point : published[i].parts.damping);
            if (!of_apices) {
                EXPECT_EQ(in.law_b, 0);
            }
            if (!of_apices && !of_bed) {
                EXPECT_EQ(in.law_a, 0);
            }
        }
        if (!of_apices && !of_bed) continue;
        EXPECT_EQ(following + given, 480);
        for (int const count : {following, given}) EXPECT_GT(count, 100);
        EXPECT_EQ(undamped + damped, 480);
        if (!of_apices) continue;
        for (int const count : {undamped, damped}) EXPECT_GT(count, 100);
    }
}

TEST(RandomStates, TakeTheCarriageThroughBothWaysAndBothReversals) {
    int there = 0, back = 0, turning_back = 0, turning_forth = 0;
    for (Case const& c : oracle::make_cases(seed, 500, Mechanism::carriage)) {
        auto const [x, vx, ax] = oracle::carriage_motion(c.inputs, c.t);
        there += vx == c.inputs.carriage_speed, back += vx == -c.inputs.carriage_speed;
        turning_back += ax<0, turning_forth += ax> 0;
    }
    for (int const count : {there, back, turning_back, turning_forth}) EXPECT_GT(count, 60);
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

}  // namespace
}  // namespace random_states_test
