// The keys of a scene that choose the method and its steps.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>

#include "tests/unit/scene_fixture.hpp"

namespace slideway {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;

IntegratorSettings settings_of(std::string const& lines) {
    return scene_of("schema = 1\n[integrator]\n" + lines).integrator;
}
std::string refusal_of(std::string const& lines) { return error_of("schema = 1\n[integrator]\n" + lines); }

TEST(SceneMethods, EveryNameIsItsMethod) {
    for (int i = 0; i < method_count; ++i) {
        auto const method = static_cast<Method>(i);
        auto const text = fmt::format("method = \"{}\"\nstep = \"2 us\"", name_of(method));
        EXPECT_EQ(settings_of(text).method, method);
        EXPECT_EQ(settings_of(text).fixed_step, 2e-6);
    }
    EXPECT_EQ(settings_of("").method, Method::automatic);
}

TEST(SceneMethods, FixedStepsNeedAStep) {
    EXPECT_EQ(refusal_of("method = \"rk4\""),
              "scene.toml:3: integrator.method is \"rk4\" (the method has no step control); give integrator.step");
    EXPECT_EQ(refusal_of("method = \"rk4\"\nstep = 1e-6"), "");
    EXPECT_EQ(refusal_of("method = \"bs32\""), "");
}

TEST(SceneMethods, FixedStepsFindNoTouchesForRestitution) {
    EXPECT_EQ(refusal_of("method = \"rk4\"\nstep = 1e-6\n[contact]\nrestitution = 0.5"),
              "scene.toml:3: integrator.method is \"rk4\" (contact.restitution wants the speed at each touch, where "
              "the method's steps do "
              "not end); use method \"auto\", \"dopri5\", \"bs32\" or \"ros34pw2\"");
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

}  // namespace
}  // namespace slideway
