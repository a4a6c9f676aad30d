#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "host/base/text.hpp"
#include "host/config/keys.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::keys_test {
namespace {

TEST(Keys, EveryInputHasOneKey) {
    std::set<std::string_view> names;
    std::set<double const*> members, of_laws;
    Inputs const inputs;
    std::size_t count = 0;
    for (Key const& key : keys()) {
        EXPECT_TRUE(names.insert(key.name).second) << key.name << " stands there twice";
        EXPECT_EQ(key.twin, nullptr);
        if (key.group == KeyGroup::law) {
            of_laws.insert(&(inputs.*key.member));
            continue;
        }
        EXPECT_TRUE(members.insert(&(inputs.*key.member)).second) << key.name;
        ++count;
    }
    std::set<double const*> law_numbers;
    for (auto const member : law_inputs) law_numbers.insert(&(inputs.*member));
    EXPECT_EQ(law_numbers.size(), 16u);
    // Mechanisms of the tree have none of their own, and what a profile begins with has no key.
    EXPECT_EQ(count + 1, sizeof(Inputs) / sizeof(double) - law_numbers.size() - std::size(mechanism_inputs) - std::size(load_inputs) - std::size(linkage_inputs));
    for (double const* const number : of_laws) EXPECT_TRUE(law_numbers.contains(number));
    for (double const* const number : law_numbers) EXPECT_FALSE(members.contains(number));
}

TEST(Keys, CoverTheParametersOfTheGoldenTables) {
    int parameters = 0;
    for (char const* file : {"rhs_paper.csv", "rhs_conservative.csv", "rhs_parameters.csv", "rhs_kelvin_voigt.csv",
                             "rhs_kelvin_voigt_parameters.csv", "rhs_foundation.csv", "rhs_foundation_parameters.csv"}) {
        std::ifstream table(std::string(SLIDEWAY_TEST_DATA "/golden/") + file);
        std::string header, column;
        ASSERT_TRUE(std::getline(table, header)) << file;
        std::istringstream columns(header);
        while (std::getline(columns, column, ',')) {
            if (column.find('.') == std::string::npos || column == "contact.law") continue;
            EXPECT_NE(find_key(column), nullptr) << column;
            ++parameters;
        }
    }
    EXPECT_GT(parameters, 40);
}

TEST(Keys, TwinKeysSetBothInputs) {
    Inputs inputs;
    ASSERT_NE(find_key("joint.clearance"), nullptr);
    find_key("joint.clearance")->set(inputs, 3e-4);
    EXPECT_EQ(inputs.clearance_y, 3e-4);
    EXPECT_EQ(inputs.clearance_z, 3e-4);
    find_key("contact.young_modulus")->set(inputs, 1e9);
    EXPECT_EQ(inputs.slider_young_modulus, 1e9);
    EXPECT_EQ(inputs.way_young_modulus, 1e9);
    EXPECT_TRUE(find_key("joint.clearance")->overlaps(*find_key("joint.clearance_z")));
    EXPECT_TRUE(find_key("joint.clearance_z")->overlaps(*find_key("joint.clearance")));
    EXPECT_FALSE(find_key("joint.clearance_y")->overlaps(*find_key("joint.clearance_z")));
    EXPECT_EQ(find_key("joint.clearence"), nullptr);
}

TEST(Keys, MassesFollowFromSteelBodies) {
    Inputs const in = complete_inputs({});
    EXPECT_NEAR(in.slider_mass, 0.1872, 1e-15);                // 7800 · 0.04 · 0.02 · 0.03
    EXPECT_NEAR(in.crank_mass, 0.004875, 1e-17);               // 7800 · 0.05 · 0.005 · 0.0025
    EXPECT_NEAR(in.rod_mass, 0.1118255112, 1e-15);             // 7800 · 0.1422 · 0.0142 · 0.0071
    EXPECT_NEAR(in.rod_inertia, 0.000188433814157784, 1e-15);  // m L²/12
    EXPECT_NEAR(in.slider_inertia_x, 2.028e-5, 1e-19);         // 0.1872 (0.02² + 0.03²)/12
    EXPECT_NEAR(in.slider_inertia_y, 3.9e-5, 1e-19);           // 0.1872 (0.04² + 0.03²)/12
    EXPECT_NEAR(in.slider_inertia_z, 3.12e-5, 1e-19);          // 0.1872 (0.04² + 0.02²)/12
    EXPECT_EQ(in.thickness_y, 0.02);
    EXPECT_EQ(in.thickness_z, 0.03);
    EXPECT_NEAR(in.crank_inertia, 1.015625e-6, 1e-20);  // 0.004875 · 0.05²/12
}

TEST(Keys, WhatFollowsFollowsWhatIsGiven) {
    Inputs given;
    given.rod_length = 0.2844;
    given.slider_mass = 0.3744;
    given.way_width = 0.05;
    given.thickness_z = 0.007;
    Inputs const in = complete_inputs(given);
    EXPECT_NEAR(in.rod_mass, 2 * 0.1118255112, 1e-15);
    EXPECT_NEAR(in.rod_inertia, 8 * 0.000188433814157784, 1e-14);
    EXPECT_EQ(in.slider_mass, 0.3744);
    EXPECT_NEAR(in.slider_inertia_x, 0.3744 * (0.05 * 0.05 + 0.03 * 0.03) / 12, 1e-18);
    EXPECT_EQ(in.thickness_y, 0.05);
    EXPECT_EQ(in.thickness_z, 0.007);
}

TEST(Keys, ThePointStiffnessFollowsFromTheModuliAndTheRadius) {
    // 1/E* = 2 (1 − 0.29²)/2.07e11, K = 4/3 E* √R_p (model.md 2).
    EXPECT_NEAR(complete_inputs({}).point_stiffness, 4.0 / 3 * 2.07e11 / (2 * 0.9159) * std::sqrt(5e-4), 1);
    Inputs given;
    given.apex_radius = 2e-3;
    EXPECT_NEAR(complete_inputs(given).point_stiffness, 2 * complete_inputs({}).point_stiffness, 1);
    given.point_stiffness = 1e11;
    EXPECT_EQ(complete_inputs(given).point_stiffness, 1e11);
}

TEST(Keys, DefaultsHaveNoDefect) { EXPECT_EQ(defect({}), std::nullopt); }

TEST(Keys, ExtremesThatEndWithAStatusHaveNoDefect) {
    Inputs in;
    in.crank_speed = 500;
    in.clearance_y = in.clearance_z = 5e-3;
    in.slider_young_modulus = in.way_young_modulus = 1e13;
    in.friction_static = in.friction_kinetic = 2;
    in.y = 1;  // beyond the rod's reach
    EXPECT_EQ(defect(in), std::nullopt);
    in.crank_speed = 0;
    in.clearance_y = in.clearance_z = 1e-7;
    in.slider_young_modulus = in.way_young_modulus = 1e5;
    in.friction_static = in.friction_kinetic = 0;
    EXPECT_EQ(defect(in), std::nullopt);
}

TEST(Keys, DefectNamesKeyValueReasonAndAdvice) {
    Inputs in;
    in.clearance_y = -1;
    EXPECT_EQ(defect(in), "joint.clearance_y is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm");
}

struct RuleCase {
    char const* key;
    double good;
    double bad;
};

TEST(Keys, RulesHoldAtTheirLimits) {
    double const tiny = std::numeric_limits<double>::denorm_min();
    RuleCase const cases[] = {
        {"mechanism.crank_length", 1e-6, 0},
        {"mechanism.slider_mass", 1e-9, -1},
        {"mechanism.rod_inertia", 0, -tiny},
        {"mechanism.rod_mass_center", 0, -tiny},
        {"mechanism.rod_mass_center", 1, std::nextafter(1, 2)},
        {"mechanism.inclination", -1.57, -1.58},
        {"mechanism.inclination", 1.57, 1.58},
        {"joint.clearance_z", -1e-4, -1.01e-4},
        {"joint.thickness_y", 1e-3, 0},
        {"contact.way_young_modulus", 1e5, 0},
        {"contact.slider_poisson_ratio", -0.999, -1},
        {"contact.way_poisson_ratio", 0.5, 0.501},
        {"contact.hertz_exponent", 1, 0.999},
        {"contact.hertz_exponent", 3, 3.001},
        {"contact.eta", 0, -tiny},
        {"contact.chi_line", 0, -1},
        {"contact.restitution", 1, 1.001},
        {"contact.restitution", 0, -tiny},
        {"friction.static", 0, -0.1},
        {"friction.kinetic", 2, -0.1},
        {"friction.stick_speed", 1e-6, 0},
        {"friction.slip_speed", 1.1e-3, 1e-3},   // must be above stick_speed
        {"mechanism.rod_length", 0.0501, 0.05},  // must be longer than the crank
        {"initial.y", -1, std::numeric_limits<double>::infinity()},
        {"mechanism.gravity", -9.81, -std::numeric_limits<double>::infinity()},
    };
    for (RuleCase const& c : cases) {
        Key const* const key = find_key(c.key);
        ASSERT_NE(key, nullptr) << c.key;
        Inputs in;
        key->set(in, c.good);
        EXPECT_EQ(defect(in), std::nullopt) << c.key << " = " << c.good;
        key->set(in, c.bad);
        auto const why = defect(in);
        ASSERT_TRUE(why.has_value()) << c.key << " = " << c.bad;
        EXPECT_EQ(why->find(c.key), 0u) << *why;
    }
}

TEST(Keys, EveryKeyThatCountsRefusesNanAndInfinity) {
    int compared = 0;
    for (Key const& key : keys()) {
        for (Parts const& parts : testing::mechanisms_and_laws()) {
            std::string const what = testing::name_of(key, parts);
            // Laws have different keys on the same input.
            Key const* one = nullptr;
            for (Key const& other : keys()) {
                if (other.member == key.member && counts_for(other, parts)) one = &other;
            }
            bool const counts = one != nullptr;
            Inputs in = with_presets({}, parts.law);
            key.set(in, std::numeric_limits<double>::infinity());
            EXPECT_EQ(defect(in, parts).has_value(), counts) << what;
            bool const may_follow = counts && std::isnan(one->preset);
            key.set(in, std::numeric_limits<double>::quiet_NaN());
            EXPECT_EQ(defect(in, parts).has_value(), counts && !may_follow) << what;
            compared += counts ? 1 : 0;
        }
    }
    EXPECT_GT(compared, 500);
}

TEST(Keys, EachCountsForAMechanismAndALaw) {
    for (auto const table : {keys(), twin_keys()}) {
        for (Key const& key : table) EXPECT_NO_THROW(testing::parts_with(key)) << key.name;
    }
    // What a law or a mechanism claims to have, a key is in.
    KeyGroups used = groups_of(KeyGroup::law);
    for (Key const& key : input_keys) used |= groups_of(key.group);
    for (LawInfo const& law : laws()) {
        EXPECT_EQ(law.groups & ~(used & contact_groups), 0u) << law.name;
        EXPECT_EQ(has_group(law.groups, KeyGroup::law), false) << law.name << ": its own keys count for it anyway";
    }
    for (MechanismInfo const& mechanism : mechanisms()) EXPECT_EQ(mechanism.keys & ~used, 0u) << mechanism.name;
}

TEST(Keys, HugeSizesWhoseMassesOverflowAreRefused) {
    Inputs in;
    in.rod_length = 1e300;
    EXPECT_TRUE(defect(in).has_value());
}

TEST(Keys, AShortRodMayStandStill) {
    Inputs in;
    in.rod_length = 0.04;
    EXPECT_TRUE(defect(in).has_value());
    in.crank_speed = 0;
    EXPECT_EQ(defect(in), std::nullopt);
}

Parts parts_of(Mechanism mechanism) {
    Parts parts;
    parts.mechanism = mechanism;
    return parts;
}

TEST(Keys, ARodCountsWhereThereIsACrank) {
    Inputs in;
    in.rod_length = 0.04;
    EXPECT_TRUE(defect(in, parts_of(Mechanism::planar_slider_crank)).has_value());
    EXPECT_EQ(defect(in, parts_of(Mechanism::carriage)), std::nullopt);
    EXPECT_EQ(defect(in, parts_of(Mechanism::free_slider)), std::nullopt);
}

TEST(Keys, ThePlanarRodHasToReachTheStart) {
    Parts const planar = parts_of(Mechanism::planar_slider_crank);
    Inputs in;  // the crank's pin is at y = 0.05, the rod 0.1422 m long
    in.start_angle = std::asin(1.0);
    in.y = 0.19;
    EXPECT_EQ(defect(in, planar), std::nullopt);
    in.y = 0.193;
    EXPECT_EQ(defect(in, planar)->substr(0, 44), "initial.y is 0.193 m (the rod of 0.1422 m do");
    EXPECT_EQ(defect(in), std::nullopt) << "in space a member ends with a status";
    in.y = -0.09;
    EXPECT_EQ(defect(in, planar), std::nullopt);
    in.y = -0.093;
    EXPECT_TRUE(defect(in, planar).has_value());
}

TEST(Keys, RequireTheKernelPartsTheyNeed) {
    Parts parts;
    require_part(parts, *find_key("joint.clearance"));
    require_part(parts, *find_key("contact.eta"));
    EXPECT_EQ(parts, Parts{});
    require_part(parts, *find_key("way.roll"));
    EXPECT_TRUE(parts.misaligned_way);
    require_part(parts, *find_key("contact.chi_line"));
    EXPECT_EQ(parts.damping, Damping::rate);
    require_part(parts, *find_key("contact.restitution"));
    require_part(parts, *find_key("contact.chi_surface"));
    EXPECT_EQ(parts.damping, Damping::restitution);
    EXPECT_FALSE(parts.friction);
    require_part(parts, *find_key("friction.static"));
    EXPECT_TRUE(parts.friction);
}

TEST(Suggestion, DistanceCountsSwapsAsOne) {
    EXPECT_EQ(edit_distance("clearance", "clearance"), 0);
    EXPECT_EQ(edit_distance("clearance", "clearence"), 1);
    EXPECT_EQ(edit_distance("claerance", "clearance"), 1);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
    EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(Suggestion, IsNearOrNothing) {
    std::string_view const names[] = {"joint.clearance", "contact.law", "study.members"};
    EXPECT_EQ(nearest_name("joint.clearence", names), "joint.clearance");
    EXPECT_EQ(nearest_name("members", names), "study.members");
    EXPECT_EQ(nearest_name("contact.clearance", names), "joint.clearance");
    EXPECT_EQ(nearest_name("st", names), "");
    EXPECT_EQ(nearest_name("study.mem", names), "study.members");
    EXPECT_EQ(nearest_name("joint.colour", names), "");
    EXPECT_EQ(nearest_name(std::string(100000, 'x'), names), "");
}

}  // namespace
}  // namespace slideway::keys_test
