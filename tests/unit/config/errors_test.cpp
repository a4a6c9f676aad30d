// What a user reads: one line with file, line, key, value, why, and what to do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::errors_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::parts_with;

/// The error of one line in a table, which is line 3 of the scene.
std::string error_in(std::string_view table, std::string_view line) {
    return error_of("schema = 1\n[" + std::string(table) + "]\n" + std::string(line) + "\n");
}

TEST(SceneErrors, UnknownMechanismsAndStudies) {
    std::string known;
    for (std::string_view const kind : mechanism_kinds()) known += (known.empty() ? "" : ", ") + std::string(kind);
    EXPECT_TRUE(contains(known, "slider_crank, carriage, "));
    EXPECT_EQ(error_in("mechanism", "kind = \"lorenz\""),
              "scene.toml:3: mechanism.kind is \"lorenz\" (there is no such mechanism); use one of " + known + ", or compile your header that has it (slideway compile)");
    EXPECT_TRUE(contains(error_in("mechanism", "kind = \"slider_cranc\""), "did you mean \"slider_crank\"?"));
    EXPECT_TRUE(contains(error_in("study", "kind = \"x\""), "there is no such study"));
}

TEST(SceneErrors, NotFinite) {
    for (char const* value : {"nan", "inf", "-inf", "+nan", "\"nan m\"", "\"inf m\"", "\"-inf\"", "\"NAN m\""}) {
        std::string const error = error_in("joint", "clearance = " + std::string(value));
        EXPECT_TRUE(contains(error, "scene.toml:3: joint.clearance is ")) << error;
        EXPECT_TRUE(contains(error, "(not a finite number); use a finite number")) << error;
    }
    EXPECT_TRUE(contains(error_in("joint", "clearance = \"1e999 m\""), "beyond the range of double"));
    EXPECT_TRUE(contains(error_in("joint", "clearance = 1e999"), "scene.toml:3: "));
    EXPECT_TRUE(contains(error_in("joint", "clearance = 99999999999999999999999"), "scene.toml:3: "));
}

TEST(SceneErrors, NanAnywhere) {
    for (Key const& key : keys()) {
        auto const dot = key.name.find('.');
        std::string const line = std::string(key.name.substr(dot + 1)) + " = nan";
        Parts const parts = parts_with(key);
        if (parts.drive.by == DriveBy::profile) continue;  // which needs a file (drive_test.cpp)
        Overrides options{{"mechanism.kind", std::string(kind_of(parts.mechanism))}};
        if (parts.drive.turns_freely()) options.push_back({"drive.kind", parts.drive.by == DriveBy::torque ? "torque" : "free"});
        if (parts.drive.by == DriveBy::torque && key.name != "drive.torque") options.push_back({"drive.torque", "1"});
        if (info(parts.mechanism).spatial) options.push_back({"contact.law", std::string(info(parts.law).name)});
        std::string const error = error_of(fmt::format("schema = 1\n[{}]\n{}", key.name.substr(0, dot), line), options);
        EXPECT_EQ(error,
                  "scene.toml:3: " + std::string(key.name) + " is nan (not a finite number); use a finite number");
    }
    for (char const* key : {"integrator.rtol", "integrator.atol", "integrator.max_step", "integrator.max_steps",
                            "study.members", "study.seed", "study.revolutions", "study.duration", "study.samples",
                            "study.samples_per_revolution", "schema"}) {
        for (char const* value : {"nan", "inf", "-inf"}) {
            std::string const error = error_of("schema = 1", {{key, value}});
            EXPECT_TRUE(contains(error, std::string(key) + " is " + value)) << key << ": " << error;
        }
    }
    for (char const* argument : {"mean", "sd", "low", "high"}) {
        std::string const error =
            error_of("schema = 1\n[study.vary]\n\"initial.y\" = {dist=\"truncnorm\", mean=0, sd=1, low=-1, high=1}",
                     {{std::string("study.vary.\"initial.y\".") + argument, "nan"}});
        EXPECT_TRUE(contains(error, std::string("study.vary.initial.y.") + argument + " is nan")) << error;
    }
}

TEST(SceneErrors, Schema) {
    for (char const* value : {"2", "0", "\"1\"", "1.0", "true"}) {
        std::string const error = error_of("\nschema = " + std::string(value));
        EXPECT_TRUE(contains(error, "scene.toml:2: schema is ")) << error;
        EXPECT_TRUE(contains(error, "(this version of slideway reads schema 1); write schema = 1")) << error;
    }
}

TEST(SceneErrors, DuplicateDefinitions) {
    EXPECT_TRUE(contains(error_in("joint", "clearance = 1\nclearance = 2"), "scene.toml:4: not TOML ("));
    EXPECT_TRUE(contains(error_in("joint", "[joint]"), "scene.toml:3: not TOML ("));
    EXPECT_TRUE(contains(error_of("schema = 1\n[contact]\nrestitution = 0.4", {{"contact.eta", "0.02"}}),
                         "--set contact.eta=0.02: contact.eta is 0.02 (contact.restitution replaces it)"));
}

TEST(SceneErrors, BetweenKeys) {
    EXPECT_TRUE(contains(error_in("friction", "stick_speed = 1"), "scene.toml:3: friction.slip_speed is 0.01 m/s"));
    EXPECT_EQ(error_of("schema = 1\n[mechanism]\ncrank_length = 0.2\ncrank_speed = 0"), "");
    EXPECT_TRUE(contains(error_in("mechanism", "rod_length = 1e300"), "scene.toml:"));
}

TEST(SceneErrors, Counts) {
    for (char const* value : {"0", "-1", "1000000001", "1e300", "2.5", "\"many\"", "9223372036854775807"}) {
        std::string const error = error_in("study", "members = " + std::string(value));
        EXPECT_TRUE(contains(error, "scene.toml:3: study.members is ")) << error;
        EXPECT_TRUE(contains(error, "must be an integer from 1 to 1000000000")) << error;
    }
    EXPECT_EQ(error_in("study", "members = 1000000000"), "");
    EXPECT_TRUE(contains(error_in("study", "seed = -1"), "scene.toml:3: study.seed is -1"));
    EXPECT_TRUE(contains(error_in("study", "samples = -5"), "scene.toml:3: study.samples is -5"));
    EXPECT_TRUE(contains(error_in("study", "samples = 1"), "scene.toml:3: study.samples is 1"));
    EXPECT_TRUE(contains(error_in("study", "samples = 1000001"), "scene.toml:3: study.samples is 1000001"));
    EXPECT_TRUE(contains(error_in("study", "samples_per_revolution = -1"), "scene.toml:3: study.samples_per_rev"));
    EXPECT_TRUE(contains(error_in("study", "revolutions = 1e6\nsamples_per_revolution = 1000"),
                         "scene.toml:4: study.samples_per_revolution is 1000 (that makes "));
    EXPECT_TRUE(contains(error_in("study", "members = 1000000\nsamples = 1000000"), "scene.toml:4: study.samples is "));
    EXPECT_TRUE(contains(error_in("integrator", "max_steps = 0"), "scene.toml:3: integrator.max_steps is 0"));
}

TEST(SceneErrors, TimesAndTolerances) {
    EXPECT_TRUE(contains(error_in("study", "revolutions = 0"), "scene.toml:3: study.revolutions is 0 (out of range"));
    EXPECT_TRUE(contains(error_in("study", "revolutions = -1"), "scene.toml:3: study.revolutions is -1"));
    EXPECT_TRUE(contains(error_in("study", "duration = \"0 s\""), "scene.toml:3: study.duration is 0 s"));
    EXPECT_TRUE(contains(error_in("study", "duration = \"1 m\""), "scene.toml:3: study.duration is \"1 m\""));
    EXPECT_TRUE(contains(error_in("mechanism", "crank_speed = 1e-300"), "scene.toml:1: study.revolutions is 1"));
    EXPECT_TRUE(contains(error_of("schema = 1\n[mechanism]\ncrank_speed = 0\n[study]\nrevolutions = 2"),
                         "scene.toml:5: study.revolutions is 2 (mechanism.crank_speed is 0"));
    EXPECT_TRUE(contains(error_of("schema = 1\n[mechanism]\ncrank_speed = 0\n[study]\nsamples_per_revolution = 2"),
                         "scene.toml:5: study.samples_per_revolution is 2 (mechanism.crank_speed is 0"));
    EXPECT_TRUE(contains(error_in("integrator", "rtol = 0.2"), "scene.toml:3: integrator.rtol is 0.2"));
    EXPECT_TRUE(contains(error_in("integrator", "max_step = \"-1 ms\""), "scene.toml:3: integrator.max_step is -1 ms"));
}

TEST(SceneErrors, Distributions) {
    auto const error = [](std::string_view entry) { return error_in("study.vary", entry); };
    EXPECT_EQ(error("\"joint.clearence\" = {dist=\"const\", value=1}"),
              "scene.toml:3: study.vary.joint.clearence cannot vary (only numeric keys of the physics can); "
              "did you mean \"joint.clearance\"?");
    EXPECT_TRUE(
        contains(error("\"study.members\" = {dist=\"const\", value=1}"), "study.vary.study.members cannot vary"));
    EXPECT_EQ(error("\"joint.clearance\" = \"0.1 mm\""),
              "scene.toml:3: study.vary.joint.clearance is \"0.1 mm\" (not a distribution); "
              "write for example { dist = \"unif\", low = 0, high = 1 }");
    EXPECT_TRUE(contains(error("\"joint.clearance\" = {}"), "study.vary.joint.clearance has no dist"));
    EXPECT_TRUE(contains(error("\"initial.y\" = {dist=\"uniform\", low=0, high=1}"),
                         "study.vary.initial.y.dist is \"uniform\" (there is no such distribution); "
                         "did you mean \"unif\"?"));
    EXPECT_EQ(error("\"initial.y\" = {dist=\"unif\", low=0}"),
              "scene.toml:3: study.vary.initial.y has no high (\"unif\" needs low, high); add high = ...");
    EXPECT_EQ(error("\"initial.y\" = {dist=\"norm\", mean=0, sd=1, low=0}"),
              "scene.toml:3: study.vary.initial.y.low is 0 (no argument of \"norm\"); use mean, sd");
    EXPECT_EQ(error("\"initial.y\" = {dist=\"unif\", low=\"1 mm\", high=0}"),
              "scene.toml:3: study.vary.initial.y.high is 0 m (not above low, 0.001 m); "
              "use low < high, or dist = \"const\"");
    EXPECT_TRUE(contains(error("\"initial.y\" = {dist=\"unif\", low=1, high=1}"), "initial.y.high is 1 m (not above"));
    EXPECT_TRUE(contains(error("\"initial.y\" = {dist=\"norm\", mean=0, sd=0}"), "initial.y.sd is 0 m"));
    EXPECT_TRUE(contains(error("\"initial.y\" = {dist=\"norm\", mean=0, sd=-1}"), "initial.y.sd is -1 m"));
    EXPECT_TRUE(
        contains(error("\"initial.y\" = {dist=\"norm\", mean=\"0 rad\", sd=1}"), "initial.y.mean is \"0 rad\""));
    EXPECT_TRUE(contains(error("\"initial.y\" = {dist=\"truncnorm\", mean=100, sd=1, low=0, high=1}"),
                         "initial.y.mean is 100 m (it lies more than 30 sd outside"));
    EXPECT_EQ(error("\"joint.clearance\" = {dist=\"unif\", low=-1, high=1}"),
              "scene.toml:3: study.vary.joint.clearance.low is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm");
    EXPECT_TRUE(contains(error("\"contact.restitution\" = {dist=\"unif\", low=0.5, high=1.5}"),
                         "contact.restitution.high is 1.5"));
    EXPECT_TRUE(contains(error("\"joint.clearance\" = {dist=\"const\", value=-1}"), "clearance.value is -1 m"));
    EXPECT_TRUE(contains(error("\"joint.clearance\" = {dist=\"const\", value=1}\n"
                               "\"joint.clearance_z\" = {dist=\"const\", value=1}"),
                         "scene.toml:4: study.vary.joint.clearance_z is a table (study.vary.joint.clearance varies"));
    EXPECT_TRUE(contains(error("\"friction.static\" = {dist=\"const\", value=1}"), "friction is off"));
    EXPECT_TRUE(contains(error("\"contact.restitution\" = {dist=\"const\", value=1}\n"
                               "\"contact.eta\" = {dist=\"const\", value=1}"),
                         "scene.toml:4: study.vary.contact.eta"));
    EXPECT_TRUE(contains(error("\"contact.eta\" = {dist=\"const\", value=1}\n"
                               "\"contact.restitution\" = {dist=\"const\", value=1}"),
                         "scene.toml:4: study.vary.contact.restitution"));
    EXPECT_TRUE(contains(error_of("schema = 1\n[contact]\neta = 1\n[study.vary]\n"
                                  "\"contact.restitution\" = {dist=\"const\", value=1}"),
                         "scene.toml:3: contact.eta"));
}

TEST(SceneErrors, OptionsAreNamedByTheirText) {
    EXPECT_EQ(error_of("schema = 1", {{"joint.clearance", "-1"}}),
              "--set joint.clearance=-1: joint.clearance is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm");
    EXPECT_EQ(error_of("schema = 1", {{"initial.y", "nan"}}),
              "--set initial.y=nan: initial.y is nan (not a finite number); use a finite number");
    EXPECT_EQ(error_of("schema = 1", {{"initial.y", "1e999"}}).find("--set initial.y=1e999: initial.y is "), 0u);
    EXPECT_EQ(error_of("schema = 1", {{"initial.y", "infinity"}}).find("--set initial.y=infinity: initial.y is "), 0u);
    EXPECT_EQ(error_of("schema = 1", {{"contact.law", "papier"}}),
              "--set contact.law=papier: contact.law is \"papier\" (there is no such contact law); "
              "did you mean \"paper\"?");
    EXPECT_TRUE(contains(error_of("schema = 1", {{"contact.low", "paper"}}), "did you mean contact.law?"));
    EXPECT_EQ(error_of("schema = 1", {{"contact.law", ""}}).find("--set contact.law=: contact.law is \"\""), 0u);
    EXPECT_TRUE(
        contains(error_of("schema = 1\n[study.vary]\n\"initial.y\"={dist=\"unif\",low=0,high=1}", {{"initial.y", "0"}}),
                 "--set initial.y=0: initial.y is 0 ([study.vary] draws it for every member"));
}

TEST(SceneErrors, OptionsThatAreNoKeyAndValue) {
    for (char const* key :
         {"", " ", ".", "a b", "a.", "=", "[joint]", "a\nb", "joint.clearance = 1\n#", "\xff", "\"\u00e9"}) {
        std::string const error = error_of("schema = 1", {{key, "1"}});
        EXPECT_EQ(error.find("--set "), 0u) << key;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
    for (char const* value : {"1\nschema = 2", "\xff\xfe", "[", "\"", "{", "\x01", "1 # comment\n[joint]"}) {
        std::string const error = error_of("schema = 1", {{"contact.law", value}});
        EXPECT_EQ(error.find("--set contact.law="), 0u) << value << ": " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
}

TEST(SceneErrors, FilesThatCannotBeRead) {
    auto const error_at = [](std::string const& path) -> std::string {
        try {
            read_scene(path);
        } catch (SceneError const& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(error_at("/nowhere/a.toml"),
              "/nowhere/a.toml: the scene cannot be read (No such file or directory); "
              "check the path and its permissions");
    EXPECT_EQ(error_at("/"), "/: the scene cannot be read (it is a directory); name a scene file in it");
    EXPECT_TRUE(contains(error_at(""), "the scene cannot be read"));
    EXPECT_TRUE(contains(error_at("/dev/zero"), "larger than 1 MiB"));
    EXPECT_TRUE(contains(error_at("/dev/null"), "the file is empty"));
}

TEST(SceneErrors, FilesThatAreNoScene) {
    EXPECT_EQ(error_of("\n  \n"), "scene.toml:1: schema is missing (the file is empty); write a scene, see scenes/");
    EXPECT_TRUE(contains(error_of("schema = 1\n<html>\n"), "scene.toml:2: not TOML ("));
    EXPECT_TRUE(contains(error_of("schema = 1\n[=]\n"), "scene.toml:2: not TOML ("));
    EXPECT_TRUE(contains(error_of("schema = 1\n[joint\nclearance = 1"), "scene.toml:2: not TOML ("));
    EXPECT_TRUE(
        contains(error_of(std::string_view("schema = 1\n\0\1", 13)), "scene.toml:2: not TOML (it holds a zero"));
    EXPECT_TRUE(contains(error_of("\x89HDF\r\n\x1a\n"), "scene.toml:1: not TOML ("));
    EXPECT_TRUE(contains(error_of("schema = 1\ntitle = \"\xff\xfe\""), "scene.toml:2: not TOML ("));
    EXPECT_TRUE(contains(error_of("schema = 1\n# " + std::string(5000, 'x')), "scene.toml:2: not TOML of a scene"));
}

TEST(SceneErrors, CharactersBeyondAsciiBelongInQuotes) {
    std::string const error = error_of("schema = 1\n[joint]\nclearance = 100 \u00b5m");
    EXPECT_TRUE(contains(error, "scene.toml:3: not TOML (")) << error;
    EXPECT_TRUE(contains(error, "\u00b5")) << error;
    // what toml++ does with these by itself is undefined: a build with -fsanitize=undefined guards `shielded`
    EXPECT_TRUE(contains(error_of("schema =\u00a01"), "scene.toml:1: not TOML ("));
    EXPECT_EQ(error_of("schema = 1", {{"study.members", "\u00a01"}}).find("--set study.members=\u00a01: "), 0u);
    EXPECT_TRUE(contains(error_of("schema = 1\n\u00e9 = 1"), "scene.toml:2: not TOML ("));
    EXPECT_TRUE(contains(error_of("schema = 1\ntitle = \"\u00e9\" \u00e9"), "scene.toml:2: not TOML ("));
    for (char const* title :
         {R"("é\"é")", R"('é\')", "\"\"\"\né\"\"é\\\"\"\"\"\"", "'''é''é'''''", R"("" # é")", R"("π" # "π)"}) {
        EXPECT_EQ(error_of("# é\nschema = 1\ntitle = " + std::string(title)), "") << title;
    }
    EXPECT_TRUE(contains(error_of("schema = 1\n[joint]\nclearance = 7\"\u00b5m\""), "scene.toml:3: not TOML ("));
    EXPECT_EQ(error_of("\xef\xbb\xbfschema = 1"), "");
    EXPECT_EQ(error_of("\xef\xbb\xbf\"schema\" = 1"), "");
    EXPECT_EQ(error_of("schema = 1", {{"joint.clearance", "100 \u00b5m"}}), "");
    EXPECT_TRUE(contains(error_of("schema = 1\n\"\u00e9\u20ac\U0001f4a9\" = 1"),
                         "scene.toml:2: \u00e9\u20ac\U0001f4a9 is no key"));
    EXPECT_EQ(testing::scene_of("schema = 1\ntitle = \"\u0080\u07ff\u0800\uffff\U00010000\U0010ffff\"").title,
              "\u0080\u07ff\u0800\uffff\U00010000\U0010ffff");
    for (std::string const broken :
         {"\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xc3"}) {
        EXPECT_TRUE(contains(error_of("schema = 1\ntitle = \"" + broken + "\""), "scene.toml:2: not TOML ("));
    }
    EXPECT_EQ(error_of("schema = 1", {{"\u00e9", "1"}}).find("--set \u00e9=1: no key=value"), 0u);
}

TEST(SceneErrors, NestingCannotExhaustTheStack) {
    std::string keys = "schema = 1\n";
    for (int i = 0; i < 2000; ++i) keys += "a.";
    EXPECT_TRUE(contains(error_of(keys + "a = 1"), "scene.toml:2: a.a.a"));
    EXPECT_FALSE(error_of("schema = 1\na = " + std::string(4000, '[')).empty());
    EXPECT_FALSE(error_of("schema = 1", {{keys.substr(11) + "a", "1"}}).empty());
}

TEST(SceneErrors, NamesAndValuesStayOnOneLine) {
    std::string const error = error_of("schema = 1\n[joint]\n\"a\\nb\\u0085\" = 1");
    EXPECT_TRUE(contains(error, "scene.toml:3: joint.a\\u000ab\\u0085 is no key")) << error;
    std::string const value = error_of("schema = 1\n[contact]\nlaw = \"\"\"x\ny\"\"\"");
    EXPECT_TRUE(contains(value, "contact.law is \"x\\u000ay\"")) << value;
    EXPECT_LT(error_of("schema = 1\n[contact]\nlaw = \"" + std::string(4000, 'x') + "\"").size(), 300u);
}

}  // namespace
}  // namespace slideway::errors_test
