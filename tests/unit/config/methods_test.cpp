// The keys of a scene that choose the method and its steps.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "host/config/settings.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::config_methods_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;

IntegratorSettings settings_of(std::string const& lines) {
    return scene_of("schema = 1\n[integrator]\n" + lines).integrator;
}
/// Contacts that a method is for, behind its own lines.
std::string contacts_of(std::string_view method) { return method == "moreau_jean" ? "[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n" : ""; }
std::string refusal_of(std::string const& lines) { return error_of("schema = 1\n[integrator]\n" + lines); }

TEST(SceneMethods, EveryNameIsItsMethod) {
    for (int i = 0; i < method_count; ++i) {
        auto const method = static_cast<Method>(i);
        auto const text = fmt::format("method = \"{}\"\nstep = \"2 us\"\n{}", name_of(method), contacts_of(name_of(method)));
        EXPECT_EQ(settings_of(text).method, method);
        EXPECT_EQ(settings_of(text).fixed_step, 2e-6);
    }
    EXPECT_EQ(settings_of("").method, Method::automatic);
}

TEST(SceneMethods, FixedStepsNeedAStep) {
    EXPECT_EQ(refusal_of("method = \"rk4\""),
              "scene.toml:3: integrator.method is \"rk4\" (the method has no step control); give integrator.step");
    EXPECT_EQ(refusal_of("method = \"rk4\"\nstep = 1e-6"), "");
    EXPECT_EQ(refusal_of("method = \"moreau_jean\"\n" + contacts_of("moreau_jean")),
              "scene.toml:3: integrator.method is \"moreau_jean\" (the method has no step control); give integrator.step");
    EXPECT_EQ(refusal_of("method = \"bs32\""), "");
}

TEST(SceneMethods, TimeSteppingIsOfRigidContacts) {
    std::string const method = "method = \"moreau_jean\"\nstep = 1e-5\n", rigid = contacts_of("moreau_jean");
    EXPECT_TRUE(contains(refusal_of(method), "scene.toml:3: integrator.method is \"moreau_jean\"")) << refusal_of(method);
    EXPECT_EQ(refusal_of(method + rigid), "");
    // Exponents need neighbours; orbits alone do not.
    EXPECT_TRUE(contains(refusal_of(method + rigid + "[study]\nkind = \"lyapunov\""), "scene.toml:3: integrator.method is"));
    std::string const sweep = "[study]\nkind = \"sweep\"\nexponents = {}\nparameter = \"joint.clearance\"\nvalues = [1e-4, 2e-4]";
    EXPECT_TRUE(contains(refusal_of(method + rigid + fmt::format(fmt::runtime(sweep), 1)), "scene.toml:3: integrator.method is"));
    EXPECT_EQ(refusal_of(method + rigid + fmt::format(fmt::runtime(sweep), 0)), "");
    EXPECT_EQ(refusal_of(method + rigid + "[study]\nkind = \"poincare\""), "");
}

TEST(SceneMethods, TimeSteppingHasOneCoefficientOfFriction) {
    auto const warnings = [](char const* friction) {
        return scene_of(fmt::format("schema = 1\n[integrator]\nmethod = \"moreau_jean\"\nstep = 1e-5\n{}[friction]\n{}", contacts_of("moreau_jean"), friction)).warnings;
    };
    EXPECT_TRUE(warnings("kinetic = 0.1\nstatic = 0.1").empty());
    ASSERT_EQ(warnings("kinetic = 0.1\nstatic = 0.2").size(), 1u);
    EXPECT_TRUE(contains(warnings("kinetic = 0.1\nstatic = 0.2")[0], "friction.static"));
}

TEST(SceneMethods, TimeSteppingKnowsNoForcesOfAnInstant) {
    auto const with = [](std::string const& series) {
        return refusal_of("method = \"moreau_jean\"\nstep = 1e-5\n" + contacts_of("moreau_jean") + "[study]\nsamples = 11\nquantities = [\"" + series + "\"]");
    };
    for (auto const* series : {"normal_force", "crank_torque", "surfaces", "ay"}) EXPECT_TRUE(contains(with(series), "scene.toml:10: study.quantities")) << with(series);
    for (auto const* series : {"x", "rod_angular_velocity"}) EXPECT_EQ(with(series), "");
}

TEST(SceneMethods, OfRigidContactsAreFour) {
    for (int i = 0; i < method_count; ++i) {
        auto const method = static_cast<Method>(i);
        std::string_view const name = name_of(method);
        bool const has = method == Method::automatic || method == Method::dopri5 || method == Method::verner65 || method == Method::moreau_jean;
        std::string const lines = fmt::format("method = \"{}\"\n{}", name, has_fixed_step(method) ? "step = 1e-5\n" : "");
        std::string const refusal = refusal_of(lines + contacts_of("moreau_jean"));
        EXPECT_EQ(refusal.empty(), has) << refusal;
        EXPECT_TRUE(has || refusal.ends_with("); use method \"auto\", \"dopri5\", \"verner65\" or \"moreau_jean\"")) << refusal;
    }
}

/// Where nothing drives a slider and nothing damps it, `auto` is the method that makes no energy in impacts, and says so.
TEST(SceneMethods, OfWhatBouncesForEverIsThatOfImpacts) {
    auto const method = [](std::string const& kind, std::string const& contact, std::string const& more = "") {
        return scene_of("schema = 1\n[mechanism]\nkind = \"" + kind + "\"\n[contact]\n" + contact + "\n" + more).integrator.method;
    };
    std::string const free = "free_slider";
    for (auto const* contact : {"law = \"foundation\"", "law = \"conservative\"\neta = 0", "law = \"kelvin_voigt\"", "law = \"paper\"\neta = 0",
                                "law = \"foundation\"\nrestitution = 1"}) {
        EXPECT_EQ(method(free, contact), Method::verner65) << contact;
        EXPECT_EQ(method("slider_crank", contact), Method::automatic) << contact;
        EXPECT_EQ(method(free, contact, "[integrator]\nmethod = \"dopri5\""), Method::dopri5) << contact;
    }
    for (auto const* contact : {"law = \"foundation\"\nchi_surface = 10", "law = \"foundation\"\nrestitution = 0.9", "law = \"conservative\"",
                                "law = \"kelvin_voigt\"\napex_damping = 10"}) {
        EXPECT_EQ(method(free, contact), Method::automatic) << contact;
    }
    EXPECT_EQ(method(free, "law = \"conservative\"\neta = 0", "[study]\nmembers = 2\nduration = 1\n[study.vary]\n\"contact.eta\" = { dist = \"unif\", low = 0, high = 0.1 }"),
              Method::automatic);
    auto const warned = scene_of("schema = 1\n[mechanism]\nkind = \"free_slider\"\n[contact]\nlaw = \"kelvin_voigt\"");
    EXPECT_TRUE(std::ranges::any_of(warned.warnings, [](auto const& line) { return contains(line, "verner65"); }));
}

TEST(SceneMethods, FixedStepsFindNoTouchesForRestitution) {
    EXPECT_EQ(refusal_of("method = \"rk4\"\nstep = 1e-6\n[contact]\nrestitution = 0.5"),
              "scene.toml:3: integrator.method is \"rk4\" (contact.restitution wants the speed at each touch, where "
              "the method's steps do "
              "not end); use method \"auto\", \"dopri5\", \"dop853\", \"bs32\", \"ros34pw2\" or \"verner65\"");
    EXPECT_EQ(refusal_of("method = \"dopri5\"\n[contact]\nrestitution = 0.5"), "");
}

TEST(SceneMethods, StepsAndTolerancesAreNotEverything) {
    for (char const* key : {"step", "max_step", "stiff_max_step"}) {
        for (char const* value : {"0", "-1e-6", "nan", "\"1 kg\""}) {
            EXPECT_TRUE(contains(refusal_of(fmt::format("{} = {}", key, value)), fmt::format("integrator.{}", key)))
                << key << " = " << value;
        }
        EXPECT_EQ(refusal_of(fmt::format("{} = \"1 us\"", key)), "");
    }
    for (char const* value : {"0", "1e-15", "0.2", "-1", "nan"}) {
        EXPECT_TRUE(contains(refusal_of(fmt::format("stiff_tolerance = {}", value)), "integrator.stiff_tolerance"))
            << value;
    }
    EXPECT_EQ(settings_of("stiff_tolerance = 3e-6").stiff_tolerance, 3e-6);
}

TEST(SceneMethods, StiffStepsAreTenOfTheOthersUnlessGiven) {
    EXPECT_DOUBLE_EQ(settings_of("max_step = \"0.2 ms\"").stiff_max_step, 2e-3);
    EXPECT_DOUBLE_EQ(settings_of("max_step = \"0.2 ms\"\nstiff_max_step = \"1 ms\"").stiff_max_step, 1e-3);
    EXPECT_DOUBLE_EQ(settings_of("").stiff_max_step, 10 * settings_of("").max_step);
}

TEST(SceneMethods, ReadBackFromTheResolvedScene) {
    for (char const* lines : {"method = \"rk4\"\nstep = \"3 us\"", "method = \"auto\"\nstiff_tolerance = 1e-6",
                              "method = \"ros34pw2\"\nstiff_max_step = \"5 ms\""}) {
        auto const first = settings_of(lines);
        auto const again =
            scene_of(resolved_toml(scene_of("schema = 1\n[integrator]\n" + std::string(lines)))).integrator;
        EXPECT_EQ(again.method, first.method);
        EXPECT_EQ(again.fixed_step, first.fixed_step);
        EXPECT_EQ(again.stiff_max_step, first.stiff_max_step);
        EXPECT_EQ(again.stiff_tolerance, first.stiff_tolerance);
    }
    EXPECT_FALSE(contains(resolved_toml(scene_of("schema = 1")), "\nstep = ")) << "nothing to say without one";
}

TEST(SceneMethods, FixedStepsAreAllowedAsManyAsTheyAre) {
    std::string const scene = "method = \"rk4\"\nstep = 1e-9\n{}[study]\nduration = 0.1";
    auto const with = [&](std::string const& line) { return fmt::format(fmt::runtime(scene), line); };
    std::uint64_t const allowed = settings_of(with("")).max_steps;
    EXPECT_GE(allowed, 100'000'000u);
    EXPECT_LE(allowed, 101'000'000u);
    EXPECT_EQ(settings_of(with("max_steps = 100000000\n")).max_steps, 100'000'000u);
    EXPECT_EQ(refusal_of(with("max_steps = 99999999\n")),
              "scene.toml:5: integrator.max_steps is 99999999 (the fixed steps are 100000000); use a value >= "
              "100000000, or a larger integrator.step");
    EXPECT_EQ(refusal_of("method = \"auto\"\nmax_steps = 10\n[study]\nduration = 0.1"), "");
}

TEST(SceneMethods, StepsThatNobodyCanWaitForAreRefused) {
    EXPECT_EQ(
        refusal_of("method = \"rk4\"\nstep = 1e-300\n[study]\nduration = 1"),
        "scene.toml:4: integrator.step is 1e-300 (that makes 1e+300 steps); use a larger one, or method \"auto\"");
    EXPECT_TRUE(contains(refusal_of("method = \"rk4\"\nstep = 5e-324"), "(that makes inf steps)"));
}

TEST(SceneMethods, CountsFixedStepsAsTheKernelsDo) {
    auto const steps = [](double end_time, double step) {
        IntegratorSettings settings;
        settings.end_time = end_time;
        settings.fixed_step = step;
        return fixed_steps(settings);
    };
    EXPECT_EQ(steps(0.1, 1e-9), 1e8);
    EXPECT_EQ(steps(1, 0.3), 4);
    EXPECT_EQ(steps(1, 1.0 / 3), 3);
    EXPECT_EQ(steps(0.9000000001, 0.3), 3) << "the last step stretches by a millionth";
    EXPECT_EQ(steps(1e-9, 1), 1);
}

TEST(SceneMethods, WarnOfKeysWithoutEffect) {
    struct Case {
        char const *key, *methods;  // with which it has an effect
    };
    for (auto const& [key, methods] :
         {Case{"step", "rk4 moreau_jean"}, Case{"rtol", "auto dopri5 dop853 bs32 ros34pw2 verner65"}, Case{"atol", "auto dopri5 dop853 bs32 ros34pw2 verner65"},
          Case{"max_step", "auto dopri5 dop853 bs32 ros34pw2 verner65"}, Case{"stiff_max_step", "auto ros34pw2"},
          Case{"stiff_tolerance", "auto ros34pw2"}}) {
        for (MethodInfo const& method : method_table) {
            std::string const fixed = std::string_view("rk4 moreau_jean").find(method.name) != std::string_view::npos ? "step = 1e-5\n" : "";
            std::string const line = std::string_view(key) == "step" ? "step = 1e-5\n" : fixed + key + " = 1e-5\n";
            Scene const scene =
                scene_of(fmt::format("schema = 1\n[integrator]\nmethod = \"{}\"\n{}{}", method.name, line, contacts_of(method.name)));
            bool const counts = contains(methods, method.name);
            std::vector<std::string> expected;
            if (!counts)
                expected.push_back(fmt::format("integrator.{} has no effect with method {}", key, method.name));
            EXPECT_EQ(scene.warnings, expected);
            // The resolved scene says what counts, no more; so it reads back without a warning.
            std::string const resolved = resolved_toml(scene);
            EXPECT_EQ(contains(resolved, fmt::format("\n{} = ", key)), counts) << key << " " << method.name;
            EXPECT_TRUE(scene_of(resolved).warnings.empty());
        }
    }
    EXPECT_TRUE(scene_of("schema = 1").warnings.empty());
}

}  // namespace
}  // namespace slideway::config_methods_test
