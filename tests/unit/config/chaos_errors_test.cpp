// What a user reads where the keys of lyapunov, poincare or sweep cannot be used.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::chaos_errors_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;

/// The first of `lines` is line 4 of the scene.
std::string error(std::string const& kind, std::string const& lines, Overrides const& overrides = {}) {
    return error_of(fmt::format("schema = 1\n[study]\nkind = \"{}\"\n{}", kind, lines), overrides);
}
/// Of a sweep, whose other lines are 4 and 5: the first of `lines` is line 6.
std::string sweep_error(std::string const& lines, Overrides const& overrides = {}) {
    return error("sweep", "parameter = \"joint.clearance\"\nvalues = [1e-4, 2e-4]\n" + lines, overrides);
}

TEST(SceneChaosErrors, KeysOfOtherStudies) {
    for (char const* kind : {"lyapunov", "poincare", "sweep"}) {
        for (char const* key : {"samples", "samples_per_revolution"}) {
            EXPECT_EQ(error(kind, fmt::format("{} = 7", key)),
                      fmt::format("scene.toml:4: study.{} is 7 (kind = \"{}\" stores no time series); "
                                  "remove it, or use kind = \"ensemble\"",
                                  key, kind));
        }
    }
    EXPECT_EQ(sweep_error("transient_revolutions = 1\nrevolutions = 1\nexponents = 1"), "");
}

TEST(SceneChaosErrors, KeysThatSayTheSame) {
    struct Case {
        char const *kind, *first, *second;
    };
    for (auto const& [kind, first, second] :
         {Case{"poincare", "phase = 0", "section = {on=\"y\"}"}, Case{"poincare", "revolutions = 1", "duration = 1"},
          Case{"poincare", "Ttr = 1", "transient_revolutions = 1"},
          Case{"lyapunov", "Ttr = 1", "transient_revolutions = 1"},
          Case{"lyapunov", "dt = 1", "rescalings_per_revolution = 1"}, Case{"sweep", "values = [1]", "from = 1"},
          Case{"sweep", "values = [1]", "to = 1"}, Case{"sweep", "values = [1]", "points = 2"},
          Case{"sweep", "values = [1]", "spacing = \"log\""}}) {
        std::string const parameter = std::string_view(kind) == "sweep" ? "parameter = \"initial.y\"\n" : "";
        for (auto const& [a, b] : {std::pair{first, second}, std::pair{second, first}}) {
            std::string const line = error(kind, fmt::format("{}{}\n{}", parameter, a, b));
            EXPECT_TRUE(line.starts_with(parameter.empty() ? "scene.toml:5: study." : "scene.toml:6: study.")) << line;
            EXPECT_TRUE(contains(line, " says it too); remove one of the two")) << line;
        }
    }
}

TEST(SceneChaosErrors, Sections) {
    EXPECT_TRUE(contains(error("poincare", "section = { on = \"gap_z[P1]\", value = \"1 mm/s\" }"), "convert to m)"));
    EXPECT_TRUE(contains(error("poincare", "phase = \"1 m\""), "scene.toml:4: study.phase is \"1 m\""));
    EXPECT_TRUE(contains(error("poincare", "section = {on=\"y\"}\nmax_crossings = 0"), "study.max_crossings is 0"));
}

TEST(SceneChaosErrors, SectionsAtImpacts) {
    EXPECT_EQ(error("poincare", "section = { on = \"impacts\" }"),
              "scene.toml:4: study.section.on is \"impacts\" (impacts of compliant contacts last); use on = \"gap_y[P1]\" with value = \"1 nm\", "
              "the quantity contact_onsets, or contact.law = \"rigid\"");
    std::string const rigid = "\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n[integrator]\n";
    EXPECT_EQ(error("poincare", "section = { on = \"impacts\", value = 1 }" + rigid),
              "scene.toml:4: study.section.value is 1 (an impact has no level); remove it");
    EXPECT_EQ(error("poincare", "section = { on = \"impacts\" }" + rigid + "step = 1e-5\nmethod = \"moreau_jean\""),
              "scene.toml:10: integrator.method is \"moreau_jean\" (time stepping knows impulses of whole steps, and no impacts); "
              "use method \"auto\", \"dopri5\" or \"verner65\"");
}

TEST(SceneChaosErrors, LengthsOfTime) {
    EXPECT_TRUE(contains(error("poincare", "revolutions = 0"), "scene.toml:4: study.revolutions is 0 (out of range"));
    EXPECT_TRUE(contains(error("poincare", "duration = \"0 s\""), "study.duration is 0 s (out of range"));
    EXPECT_TRUE(contains(error("poincare", "Ttr = -1"), "study.Ttr is -1 s (out of range for the transient)"));
    EXPECT_TRUE(contains(error("poincare", "transient_revolutions = -1"), "study.transient_revolutions is -1"));
    EXPECT_TRUE(contains(error("lyapunov", "Ttr = \"1 m\""), "study.Ttr is \"1 m\""));
    EXPECT_TRUE(contains(error("lyapunov", "[mechanism]\ncrank_speed = 1e-300"),
                         "scene.toml:3: study.revolutions is not given (with the transient a member lasts"));
}

TEST(SceneChaosErrors, ACrankAtRest) {
    std::string const rest = "\n[mechanism]\ncrank_speed = 0";
    EXPECT_EQ(error("lyapunov", "revolutions = 2" + rest),
              "scene.toml:4: study.revolutions is 2 (mechanism.crank_speed is 0, so there are no revolutions); "
              "use study.duration instead");
    EXPECT_TRUE(contains(error("lyapunov", "transient_revolutions = 2" + rest), "use study.Ttr instead"));
    EXPECT_TRUE(contains(error("lyapunov", "rescalings_per_revolution = 2" + rest), "use study.dt instead"));
    EXPECT_EQ(error("poincare", rest),
              "scene.toml:3: study.phase is not given (mechanism.crank_speed is 0, so no crank angle comes round); "
              "give study.section");
    EXPECT_TRUE(contains(error("poincare", "phase = 1" + rest), "scene.toml:4: study.phase is 1 (mechanism.crank_sp"));
    EXPECT_TRUE(contains(sweep_error(rest), "give the crank a speed"));
    EXPECT_TRUE(contains(error("poincare", "[study.vary]\n\"mechanism.crank_speed\" = {dist=\"unif\",low=-1,high=1}"),
                         "mechanism.crank_speed may be 0, where revolutions do not end"));
}

TEST(SceneChaosErrors, MembersThatWouldStopUnequallyOften) {
    std::string const vary = "\n[study.vary]\n\"mechanism.crank_speed\" = {dist=\"unif\", low=3, high=4}";
    EXPECT_EQ(error("poincare", "duration = 9" + vary),
              "scene.toml:4: study.duration is 9 (mechanism.crank_speed differs between members, and so would their "
              "number of sections); use study.revolutions");
    EXPECT_TRUE(contains(error("lyapunov", "duration = 9" + vary), "number of rescalings); use study.revolutions"));
    EXPECT_TRUE(contains(error("lyapunov", "Ttr = 9" + vary), "use study.transient_revolutions"));
    EXPECT_EQ(error("lyapunov", "dt = 1e-3" + vary),
              "scene.toml:4: study.dt is 0.001 (mechanism.crank_speed differs between members, and so would their "
              "number of rescalings); use study.rescalings_per_revolution");
    EXPECT_TRUE(contains(error("sweep", "Ttr = 9\nparameter = \"mechanism.crank_speed\"\nvalues = [1, 2]"),
                         "scene.toml:4: study.Ttr is 9 (mechanism.crank_speed differs"));
}

TEST(SceneChaosErrors, Neighbours) {
    for (char const* count : {"0", "11", "-1", "1.5"}) {
        std::string const line = error("lyapunov", fmt::format("exponents = {}", count));
        EXPECT_TRUE(contains(line, "scene.toml:4: study.exponents is ")) << line;
        EXPECT_TRUE(contains(line, "must be an integer from 1 to 10")) << line;
    }
    EXPECT_TRUE(contains(sweep_error("exponents = 11"), "must be an integer from 0 to 10"));
    for (char const* value : {"0", "-1", "2", "nan", "\"1 mm\""}) {
        EXPECT_TRUE(contains(error("lyapunov", fmt::format("d0 = {}", value)), "scene.toml:4: study.d0 is ")) << value;
    }
    EXPECT_TRUE(contains(error("lyapunov", "dt = 0"), "study.dt is 0 s (out of range"));
    EXPECT_TRUE(contains(error("lyapunov", "rescalings_per_revolution = 0"), "study.rescalings_per_revolution is 0"));
    EXPECT_TRUE(contains(error("lyapunov", "rescalings_per_revolution = 1.5"), "must be an integer"));
    EXPECT_TRUE(contains(error("lyapunov", "history = -1"), "study.history is -1"));
}

TEST(SceneChaosErrors, Sizes) {
    EXPECT_TRUE(contains(error("lyapunov", "revolutions = 10000\nhistory = 6000000"),
                         "scene.toml:4: study.revolutions is 10000 (each member would hold 1.2e+07 numbers"));
    EXPECT_TRUE(contains(error("poincare", "members = 1000000000"),
                         "scene.toml:4: study.members is 1000000000 (the results would hold 1.51e+12 numbers)"));
}

TEST(SceneChaosErrors, SweptKeys) {
    EXPECT_TRUE(
        contains(error("sweep", "parameter = \"study.members\"\nvalues = [1]"), "only numeric keys of the phys"));
    EXPECT_TRUE(contains(error("sweep", "parameter = 1\nvalues = [1]"), "study.parameter is 1 (not a text)"));
    EXPECT_EQ(
        sweep_error("", {{"joint.clearance", "1e-4"}}),
        "--set joint.clearance=1e-4: joint.clearance is 0.0001 (the sweep sets it in every column, so this has no "
        "effect); use --set 'study.values=[...]'");
    EXPECT_TRUE(contains(error("sweep", "parameter = \"friction.static\"\nvalues = [1]"), "friction is off"));
    EXPECT_TRUE(contains(error("sweep", "parameter = \"contact.eta\"\nvalues = [1]\n[contact]\nrestitution = 0.5"),
                         "scene.toml:4: study.parameter is \"contact.eta\" (contact.restitution replaces it)"));
}

TEST(SceneChaosErrors, SweptValues) {
    EXPECT_TRUE(contains(error("sweep", "parameter = \"joint.clearance\"\nfrom = 1"), "study.to is missing"));
    EXPECT_TRUE(contains(error("sweep", "parameter = \"joint.clearance\"\nfrom = 1\nto = 2"),
                         "study.points is missing (how many columns there are); add points = 50"));
    auto const values = [](std::string const& text) {
        return error("sweep", "parameter = \"joint.clearance\"\nvalues = " + text);
    };
    EXPECT_EQ(values("[1e-4,\n-1]"), "scene.toml:6: study.values is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm");
    EXPECT_EQ(values("[\"1 kg\"]"),
              "scene.toml:5: study.values is \"1 kg\" (the unit \"kg\" does not convert to m); "
              "use a unit like m or mm");
    for (char const* text : {"[]", "1e-4", "{a = 1}"}) {
        EXPECT_TRUE(contains(values(text), "(not a list of 1 to 10000 values); write for example")) << text;
    }
    auto const range = [](std::string const& from, std::string const& to, std::string const& lines) {
        return error("sweep", fmt::format("parameter = \"initial.y\"\nfrom = {}\nto = {}\n{}", from, to, lines));
    };
    EXPECT_TRUE(contains(range("1", "2", "points = 1"), "scene.toml:7: study.points is 1 "));
    EXPECT_TRUE(contains(range("1", "2", "points = 10001"), "scene.toml:7: study.points is 10001 "));
    EXPECT_EQ(range("1", "1", "points = 2"),
              "scene.toml:6: study.to is 1 m (equal to study.from); use another value, or study.values");
    EXPECT_EQ(range("-1", "1", "points = 3\nspacing = \"log\""),
              "scene.toml:8: study.spacing is \"log\" (from -1 m to 1 m there is no common ratio); "
              "use ends of one sign, or \"linear\"");
    EXPECT_TRUE(contains(range("0", "1", "points = 3\nspacing = \"log\""), "no common ratio"));
    EXPECT_TRUE(contains(range("1", "2", "points = 3\nspacing = \"square\""), "there is no such spacing"));
    EXPECT_TRUE(contains(error("sweep", "parameter = \"mechanism.crank_length\"\nfrom = 0.05\nto = 0.2\npoints = 9"),
                         "scene.toml:6: study.to is 0.2"));
}

TEST(SceneChaosErrors, Columns) {
    EXPECT_TRUE(contains(sweep_error("start = \"continue\"\ntransient_revolutions = 2.5"), "use a whole number"));
    EXPECT_EQ(sweep_error("start = \"continue\"\nTtr = 0"), "");
}

TEST(SceneChaosErrors, MistypedKeysComeWithASuggestion) {
    EXPECT_TRUE(contains(error("lyapunov", "ttr = 1"), "did you mean study.Ttr?"));
    EXPECT_TRUE(contains(error("lyapunov", "exponent = 1"), "did you mean study.exponents?"));
    EXPECT_TRUE(contains(error("sweep", "paramter = \"x\""), "did you mean study.parameter?"));
    EXPECT_TRUE(contains(error("poincare", "sektion = 1"), "did you mean study.section?"));
    EXPECT_TRUE(contains(error("lyapunow", ""), "did you mean \"lyapunov\"?"));
}

}  // namespace
}  // namespace slideway::chaos_errors_test
