// Which keys count for which contact law, what a law has of its own when nobody gives it, and that what does not count is refused.
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernels/laws/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::config_laws_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;

std::string with_law(std::string_view law, std::string const& lines = "") {
    return fmt::format("schema = 1\n[contact]\nlaw = \"{}\"\n{}\n", law, lines);
}

double own(Scene const& scene, std::string_view name) { return find_key(fmt::format("contact.{}", name))->get(scene.inputs); }

TEST(SceneLaws, HaveTheirNames) {
    for (std::size_t i = 0; i < laws().size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(scene_of(with_law(laws()[i].name)).parts.law), i);
        EXPECT_EQ(static_cast<std::size_t>(scene_of("schema = 1", {{"contact.law", std::string(laws()[i].name)}}).parts.law), i);
    }
    EXPECT_EQ(error_of(with_law("hertz")),
              "scene.toml:3: contact.law is \"hertz\" (there is no such contact law); use one of paper, conservative, kelvin_voigt, foundation, rigid, or compile your header that has it (slideway compile)");
    EXPECT_TRUE(contains(error_of(with_law("kelvin_voight")), "did you mean \"kelvin_voigt\"?"));
}

TEST(SceneLaws, AreTheBedWhereNobodyNamesOneAndSaySo) {
    auto const read = [](std::string const& text) { return parse_scene(text, "scene.toml", {}); };
    Scene const plain = read("schema = 1");
    EXPECT_EQ(plain.parts.law, Law::foundation);
    std::string const which = "contact.law is not given and is \"foundation\": an elastic bed over each face, no modes; name it";
    std::string const rings = "neither contact.restitution nor contact.chi_surface is given: contacts of \"foundation\" then take no energy, and what "
                              "touches rings for ever; give one of the two";
    EXPECT_EQ(plain.warnings, (std::vector<std::string>{which, rings}));
    EXPECT_EQ(read("schema = 1\n[contact]\nrestitution = 0.6").warnings, std::vector<std::string>{which});
    EXPECT_EQ(read(with_law("foundation")).warnings, std::vector<std::string>{rings});
    // Of who says 0 or draws it nobody thinks that he forgot it; others have damping of their own, or have none to forget.
    std::string const varied = "[study]\nmembers = 2\nduration = 1\n[study.vary]\n\"contact.restitution\" = { dist = \"unif\", low = 0.5, high = 0.7 }";
    for (auto const& scene : {with_law("foundation", "restitution = 0.6"), with_law("foundation", "chi_surface = 0"), with_law("foundation", varied),
                              with_law("paper"), with_law("conservative"), with_law("kelvin_voigt"),
                              std::string("schema = 1\n[mechanism]\nkind = \"planar_slider_crank\"")}) {
        EXPECT_EQ(read(scene).warnings, std::vector<std::string>{}) << scene;
    }
}

TEST(SceneLaws, HaveKeysThatNobodyElseHas) {
    std::set<std::string_view> names;
    for (Key const& key : input_keys) names.insert(key.name);
    for (LawInfo const& law : laws()) {
        std::set<double Inputs::*, bool (*)(double Inputs::*, double Inputs::*)> members(
            [](double Inputs::*a, double Inputs::*b) {
                Inputs const in;
                return &(in.*a) < &(in.*b);
            });
        for (Key const& key : law.keys) {
            EXPECT_TRUE(key.name.starts_with("contact.")) << key.name;
            EXPECT_EQ(key.group, KeyGroup::law) << key.name;
            EXPECT_TRUE(names.insert(key.name).second) << key.name << " stands there twice";
            EXPECT_TRUE(members.insert(key.member).second) << key.name << " is the same number as another";
            // Where it does not follow from others it is a value that it may have.
            Scene const scene = scene_of(with_law(law.name));
            EXPECT_TRUE(std::isnan(key.preset) ? std::isnan(key.get(scene.inputs)) : key.get(scene.inputs) == key.preset) << key.name;
            EXPECT_EQ(defect(scene.inputs, scene.parts), std::nullopt) << key.name;
        }
    }
}

TEST(SceneLaws, ReadTheirOwnKeysInAnyOrder) {
    Scene const before = scene_of("schema = 1\n[contact]\napex_damping = 40\napex_stiffness = \"5 kN/mm\"\nlaw = \"kelvin_voigt\"\n");
    Scene const after = scene_of(with_law("kelvin_voigt", "apex_stiffness = 5e6\napex_damping = \"40 N s/m\""));
    Overrides const options{{"contact.apex_damping", "40"}, {"contact.law", "kelvin_voigt"}, {"contact.apex_stiffness", "5e6"}};
    for (Scene const& scene : {before, after, scene_of("schema = 1", options)}) {
        EXPECT_EQ(scene.parts.law, Law::kelvin_voigt);
        EXPECT_EQ(own(scene, "apex_stiffness"), 5e6);
        EXPECT_EQ(own(scene, "apex_damping"), 40);
        EXPECT_TRUE(scene.warnings.empty());
    }
    Scene const plain = scene_of(with_law("kelvin_voigt"));
    EXPECT_TRUE(std::isnan(own(plain, "apex_stiffness")));
    EXPECT_EQ(own(plain, "apex_damping"), 0);
    EXPECT_TRUE(std::isnan(own({}, "apex_stiffness")) == false) << "another law has none";
    EXPECT_TRUE(std::isnan(complete_inputs(plain.inputs).law_a)) << "each face has a stiffness of its own";
    EXPECT_EQ(error_of(with_law("kelvin_voigt", "apex_stiffness = 0")),
              "scene.toml:4: contact.apex_stiffness is 0 N/m (the stiffness of an apex must be positive); use a value > 0");
    EXPECT_EQ(error_of(with_law("kelvin_voigt", "apex_damping = -1")),
              "scene.toml:4: contact.apex_damping is -1 N s/m (the damping of an apex must be zero or positive); use a value >= 0");
}

/// A value that every key of contacts may have.
constexpr char const* some_value = "0.3";

/// Calls `given(law, key, the reason that it is refused for or "")` for every law and key of contacts.
template <class Given> void for_every_law_and_key(Given given) {
    for (std::size_t i = 0; i < laws().size(); ++i) {
        Parts parts;
        parts.law = static_cast<Law>(i);
        for (Key const& key : keys()) {
            if (!key.name.starts_with("contact.") || key.rule == Rule::hertz_exponent) continue;  // which some_value breaks
            given(laws()[i], key,
                  counts_for(key, parts) ? std::string()
                                         : fmt::format("(contact.law \"{}\" does not know it); remove it", laws()[i].name));
        }
    }
}

TEST(SceneLaws, RefuseForeignKeysOfAScene) {
    int refused = 0;
    for_every_law_and_key([&](LawInfo const& law, Key const& key, std::string const& why) {
        std::string const line = fmt::format("{} = {}", key.name.substr(8), some_value);
        EXPECT_EQ(error_of(with_law(law.name, line)),
                  why.empty() ? "" : fmt::format("scene.toml:4: {} is {} {}", key.name, some_value, why));
        refused += why.empty() ? 0 : 1;
    });
    EXPECT_GT(refused, 10);
}

TEST(SceneLaws, RefuseForeignKeysOfOptions) {
    for_every_law_and_key([](LawInfo const& law, Key const& key, std::string const& why) {
        std::string const error = error_of(with_law(law.name), {{std::string(key.name), some_value}});
        EXPECT_EQ(error, why.empty() ? "" : fmt::format("--set {0}={1}: {0} is {1} {2}", key.name, some_value, why));
    });
}

TEST(SceneLaws, RefuseForeignKeysThatVary) {
    for_every_law_and_key([](LawInfo const& law, Key const& key, std::string const& why) {
        std::string const error = error_of(
            with_law(law.name, fmt::format("[study.vary]\n\"{}\" = {{ dist = \"const\", value = 1 }}", key.name)));
        bool const poisson = contains(key.name, "poisson");  // 1 is none
        if (why.empty()) {
            EXPECT_EQ(poisson ? "" : error, "") << key.name;
        } else if (!poisson) {
            EXPECT_TRUE(error.starts_with("scene.toml:5: ")) << error;
            EXPECT_TRUE(error.ends_with(why)) << error;
        }
    });
}

TEST(SceneLaws, RefuseForeignKeysOfSweeps) {
    for_every_law_and_key([](LawInfo const& law, Key const& key, std::string const& why) {
        std::string const error = error_of(
            with_law(law.name, fmt::format("[study]\nkind = \"sweep\"\nexponents = 0\nparameter = \"{}\"\nvalues = [0.3]", key.name)));
        if (why.empty()) {
            EXPECT_EQ(error, "") << key.name;
        } else {
            EXPECT_EQ(error, fmt::format("scene.toml:7: study.parameter is \"{}\" {}", key.name, why));
        }
    });
}

TEST(SceneLaws, RefuseForeignColumnsOfTables) {
    testing::TableFolder const folder;
    folder.write("a.csv", "joint.clearance, contact.chi_line\n1e-4, 3\n");
    auto const error = [&](std::string_view law) {
        return folder.error(fmt::format("[contact]\nlaw = \"{}\"\n[study]\nduration = 1\ndesign = \"table\"\ntable = \"a.csv\"", law));
    };
    EXPECT_EQ(error("paper"), "");
    EXPECT_EQ(error("kelvin_voigt"),
              "a.csv:1: column 2 is \"contact.chi_line\" (contact.law \"kelvin_voigt\" does not know it); remove it");
    folder.write("a.csv", "contact.apex_damping, contact.apex_stiffness [kN/m]\n7, 3\n");
    Scene const scene = folder.read("[contact]\nlaw = \"kelvin_voigt\"\n[study]\ndesign = \"table\"\ntable = \"a.csv\"");
    EXPECT_EQ(member_inputs(scene, 0).law_a, 3000);
    EXPECT_EQ(member_inputs(scene, 0).law_b, 7);
    EXPECT_EQ(error("paper"),
              "a.csv:1: column 1 is \"contact.apex_damping\" (contact.law \"paper\" does not know it); remove it");
}

TEST(SceneLaws, AnOptionLeavesTheKeysOfTheFilesLawBehind) {
    Scene const scene = scene_of(with_law("paper", "eta = 0.3\nchi_line = 2\nyoung_modulus = 1e9"), {{"contact.law", "kelvin_voigt"}});
    EXPECT_EQ(scene.parts.law, Law::kelvin_voigt);
    EXPECT_EQ(scene.parts.damping, Damping::point);
    EXPECT_EQ(scene.inputs.eta, Inputs{}.eta);
    EXPECT_EQ(scene.inputs.slider_young_modulus, 1e9);
    EXPECT_EQ(scene.warnings,
              (std::vector<std::string>{
                  "scene.toml:4: contact.eta has no effect, for contact.law \"kelvin_voigt\" does not know it",
                  "scene.toml:5: contact.chi_line has no effect, for contact.law \"kelvin_voigt\" does not know it"}));
    Scene const hard = scene_of(with_law("paper", "restitution = 0.5"), {{"contact.law", "kelvin_voigt"}});
    EXPECT_EQ(hard.parts.damping, Damping::point);
    EXPECT_EQ(hard.warnings.size(), 1u);
    Scene const back = scene_of(with_law("kelvin_voigt", "apex_stiffness = 5e6"), {{"contact.law", "conservative"}});
    EXPECT_EQ(back.parts.law, Law::conservative);
    EXPECT_EQ(back.inputs.law_a, 0);
    ASSERT_EQ(back.warnings.size(), 1u);
    EXPECT_TRUE(contains(back.warnings[0], "contact.apex_stiffness has no effect"));
    // What varies would vary for nothing.
    std::string const vary = "[study.vary]\n\"contact.eta\" = { dist = \"unif\", low = 0, high = 1 }";
    EXPECT_TRUE(contains(error_of(with_law("paper", vary), {{"contact.law", "kelvin_voigt"}}), "does not know it); remove it"));
}

TEST(SceneLaws, SayWhereTheirStepsMayEnd) {
    for (LawInfo const& law : laws()) {
        EXPECT_EQ(error_of(with_law(law.name, "[integrator]\nlocate_modes = true")),
                  law.switches ? ""
                               : fmt::format("scene.toml:5: integrator.locate_modes is true (contact.law \"{}\" has no modes to "
                                             "switch between); remove it",
                                             law.name));
        EXPECT_EQ(scene_of(with_law(law.name)).integrator.locate_modes, law.switches);
    }
}

TEST(SceneLaws, ResolveToThemselves) {
    for (LawInfo const& law : laws()) {
        std::string given;
        for (Key const& key : law.keys) given += fmt::format("{} = 3\n", key.name.substr(8));
        for (std::string const& lines : {std::string(), given}) {
            Scene const scene = scene_of(with_law(law.name, lines));
            std::string const resolved = resolved_toml(scene);
            EXPECT_TRUE(contains(resolved, fmt::format("law = \"{}\"\n", law.name)));
            Scene const again = scene_of(resolved);
            EXPECT_EQ(resolved_toml(again), resolved);
            EXPECT_EQ(again.parts, scene.parts);
            for (Key const& key : keys()) {
                double const before = key.get(scene.inputs), after = key.get(again.inputs);
                EXPECT_TRUE(before == after || (std::isnan(before) && std::isnan(after))) << law.name << ": " << key.name;
                std::string const line = fmt::format("\n{} = ", key.name.substr(key.name.find('.') + 1));
                if (key.group == KeyGroup::law) {
                    EXPECT_EQ(contains(resolved, line), counts_for(key, scene.parts) && !std::isnan(before)) << key.name;
                }
            }
        }
    }
    std::string const resolved = resolved_toml(scene_of(with_law("kelvin_voigt")));
    EXPECT_TRUE(contains(resolved, "\n# apex_stiffness  # derived: E_s A / (4 l) of its face\napex_damping = 0.0  # N s/m\n")) << resolved;
    EXPECT_FALSE(contains(resolved, "eta = "));
    EXPECT_FALSE(contains(resolved, "edge_radius"));
}

}  // namespace
}  // namespace slideway::config_laws_test
