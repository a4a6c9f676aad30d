#include "host/store/run_identity.hpp"

#include "host/base/error.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::run_identity_test {
namespace {

using testing::contains;

constexpr char const* sweep = R"(
schema = 1
title = "A = \"b\"  # [c]"
[study]
kind = "sweep"
members = 3
parameter = "joint.clearance"
values = ["0.5 mm", "0.4 mm", "0.3 mm"]
transient_revolutions = 0
revolutions = 2
phase = "90 deg"
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

/// What a run of the scene, with keys changed, would be.
RunIdentity identity_of(Overrides const& overrides = {}) {
    return {"slideway 1.2.3, commit abc, GNU 12", "fused", MemberSet({0, 9}),
            resolved_toml(testing::scene_of(sweep, overrides))};
}

std::string difference(Overrides const& now, Overrides const& before = {}) {
    return identity_of(now).difference(identity_of(before));
}

TEST(RunIdentity, OfTheSameRunDoesNotDiffer) {
    EXPECT_EQ(difference({}), "");
    EXPECT_EQ(difference({{"study.seed", "1"}}), "");  // what it is anyway
}

TEST(RunIdentity, HasATextThatReadsBack) {
    RunIdentity identity = identity_of();
    identity.members.add({100, 5});
    std::string const text = identity_text(identity);
    RunIdentity const back = parse_identity(text, "run.toml");
    EXPECT_EQ(back.program, identity.program);
    EXPECT_EQ(back.arithmetic, "fused");
    EXPECT_EQ(back.members, identity.members);
    EXPECT_EQ(back.scene, identity.scene);
    EXPECT_EQ(back.difference(identity), "");
}

// sm_90-fmad: of a build with SLIDEWAY_CUDA_FMAD.
TEST(RunIdentity, OfAnyArithmeticReadsBack) {
    for (auto const& [isa, arithmetic] : {std::pair{"avx2", "fused"}, std::pair{"sm_90", "fused"}, std::pair{"sm_90-fmad", "contracted"}}) {
        RunIdentity identity = identity_of();
        identity.arithmetic = arithmetic_of(isa);
        EXPECT_EQ(identity.arithmetic, arithmetic);
        RunIdentity const back = parse_identity(identity_text(identity), "run.toml");
        EXPECT_EQ(back.arithmetic, arithmetic);
        EXPECT_EQ(back.difference(identity), "");
    }
}

TEST(RunIdentity, HasATextThatIsTheSceneItself) {
    RunIdentity const identity = identity_of();
    EXPECT_EQ(resolved_toml(testing::scene_of(identity_text(identity))), identity.scene);
}

TEST(RunIdentity, NamesTheKeyThatChanged) {
    EXPECT_EQ(difference({{"mechanism.gravity", "1.62"}}), "mechanism.gravity was 9.81, is 1.62");
    EXPECT_EQ(difference({{"study.seed", "7"}}), "study.seed was 1, is 7");
    // Whether modes are located follows from the law.
    EXPECT_EQ(difference({{"contact.law", "conservative"}}),
              "contact.law was \"paper\", is \"conservative\"; integrator.locate_modes was true, is false");
    EXPECT_TRUE(contains(difference({{"title", "another"}}), "title was "));
}

TEST(RunIdentity, NamesTheClearanceInTheUnitOfTheResolvedScene) {
    std::string const plain = "schema = 1\n[joint]\nclearance = \"0.1 mm\"\n";
    auto const with = [&](Overrides const& overrides) {
        return RunIdentity{"p", "fused", MemberSet({0, 1}), resolved_toml(testing::scene_of(plain, overrides))};
    };
    EXPECT_EQ(with({{"joint.clearance_y", "0.2 mm"}}).difference(with({})), "joint.clearance_y was 0.0001, is 0.0002");
    EXPECT_EQ(with({{"joint.clearance", "0.2 mm"}}).difference(with({})),
              "joint.clearance_y was 0.0001, is 0.0002; joint.clearance_z was 0.0001, is 0.0002");
}

TEST(RunIdentity, NamesKeysThatCameAndWent) {
    std::string const key = R"(study.vary."initial.z")", value = R"({dist="norm",mean=0,sd=1e-5})";
    std::string const came = difference({{key, value}});
    EXPECT_TRUE(contains(came, "study.vary.\"initial.z\" = { dist = \"norm\"")) << came;
    EXPECT_TRUE(contains(came, "is new")) << came;
    std::string const went = difference({}, {{key, value}});
    EXPECT_TRUE(contains(went, "study.vary.\"initial.z\" = { dist = \"norm\"")) << went;
    EXPECT_TRUE(contains(went, "is gone")) << went;
}

TEST(RunIdentity, NamesWhatChangedBeforeWhatCameAlong) {
    std::pair<std::string, std::string> const no_exponents{"study.exponents", "0"};
    std::string const changed = difference({no_exponents}, {no_exponents, {"contact.law", "rigid"}, {"contact.restitution", "0.5"}});
    EXPECT_TRUE(changed.starts_with("contact.law was \"rigid\", is \"paper\"; ")) << changed;
}

TEST(RunIdentity, ComparesAnArrayOverSeveralLinesAsOneValue) {
    std::string const changed = difference({{"study.values", R"(["0.5 mm", "0.4 mm", "0.2 mm"])"}});
    EXPECT_TRUE(changed.starts_with("study.values was [")) << changed;
    EXPECT_TRUE(contains(changed, "0.0003")) << changed;
    EXPECT_TRUE(contains(changed, "0.0002")) << changed;
    EXPECT_FALSE(contains(changed, ";")) << changed;  // nothing else changed
    EXPECT_FALSE(contains(changed, "\n"));
}

TEST(RunIdentity, NamesThreeOfManyKeysAndCountsTheOthers) {
    std::string const changed = difference({{"mechanism.gravity", "1"},
                                            {"mechanism.inclination", "1"},
                                            {"contact.eta", "1"},
                                            {"contact.hertz_exponent", "1.4"},
                                            {"integrator.rtol", "1e-7"},
                                            {"integrator.atol", "1e-7"}});
    EXPECT_EQ(std::count(changed.begin(), changed.end(), ';'), 3) << changed;
    EXPECT_TRUE(changed.ends_with("; and 2 more")) << changed;
}

TEST(RunIdentity, TellsOfOtherMembersAndAnotherProgram) {
    RunIdentity const before = identity_of();
    RunIdentity other = before;
    other.members = MemberSet({0, 12});
    EXPECT_EQ(other.difference(before), "the members were 0-8, are 0-11");
    other = before;
    other.program = "slideway 1.2.4, commit def, GNU 12";
    EXPECT_EQ(other.difference(before),
              "the program was slideway 1.2.3, commit abc, GNU 12, is slideway 1.2.4, commit def, GNU 12");
}

TEST(RunIdentity, TellsOfAnotherArithmetic) {
    for (char const* const isa : {"scalar", "avx2", "avx512"}) EXPECT_EQ(arithmetic_of(isa), "fused") << isa;
    RunIdentity const before = identity_of();
    RunIdentity other = before;
    other.arithmetic = arithmetic_of("sm_90-fmad");
    EXPECT_EQ(other.difference(before), "the arithmetic was fused, is contracted (a build with SLIDEWAY_CUDA_FMAD)");
    EXPECT_EQ(before.difference(other), "the arithmetic was contracted (a build with SLIDEWAY_CUDA_FMAD), is fused");
    EXPECT_EQ(parse_identity(identity_text(other), "run.toml").difference(other), "");
}

TEST(RunIdentity, CannotBeReadFromOtherTexts) {
    std::string const text = identity_text(identity_of());
    for (std::string const& other : {std::string(), std::string("schema = 1\n"), text.substr(1), text.substr(0, 100)}) {
        EXPECT_THROW(parse_identity(other, "run.toml"), FileError) << other;
    }
    std::string damaged = text;
    auto const at = damaged.find("members: 0-8");
    ASSERT_NE(at, std::string::npos);
    damaged[at + 10] = 'x';
    EXPECT_THROW(parse_identity(damaged, "run.toml"), FileError);
    // A line where none belongs; one that says nothing known.
    damaged = text;
    damaged.insert(damaged.find("\n\n") + 1, "# more");
    EXPECT_THROW(parse_identity(damaged, "run.toml"), FileError);
    damaged = text;
    damaged.replace(damaged.find("fused"), 5, "mixed");
    EXPECT_THROW(parse_identity(damaged, "run.toml"), FileError);
}

/// A resolved scene of a table at a path, as TOML quotes it.
std::string scene_of_table(std::string const& quoted, std::string const& checksum = "0123456789abcdef") {
    return "schema = 1\ntitle = \"table = 1\"\n\n[mechanism]\nkind = \"slider_crank\"\n\n[study]\nseed = 1\ntable = " +
           quoted + "  # 3 rows, FNV-1a " + checksum + "\n\n[study.limits]\n\"table\" = { max = 1.0 }\n";
}

TEST(RunIdentity, OfATableDoesNotDependOnWhereItLies) {
    for (char const* const path :
         {"\"/a/rows.csv\"", "\"/a/\\\"  # b\\\".csv\"", "\"/[study]/table = .csv\"", "\"/a#\\n.csv\"", "\"/ä/☃ \xf0\x9f\x98\x80/rows.csv\""}) {
        std::string const text = scene_of_table(path);
        EXPECT_EQ(paths_of_tables(text), (OfTables{{"study.table", path}}));
        EXPECT_EQ(portable_scene(text), scene_of_table("\"study.table.csv\""));
        EXPECT_EQ(with_tables(portable_scene(text), {{"study.table", path}}), text);
    }
    std::string const none = identity_of().scene;
    EXPECT_EQ(portable_scene(none), none);
    // How a study is checked makes no other members of it.
    EXPECT_EQ(portable_scene("title = \"a\"\n[study]\nmembers = 3\nverify = 16  # members\nseed = 1\n"), "title = \"a\"\n[study]\nmembers = 3\nseed = 1\n");
    EXPECT_EQ(portable_scene("a = 1\n[study]\nseed = 1\nverify = 2"), "a = 1\n[study]\nseed = 1\n");
    // Of another table; a text that was edited, and is no scene.
    EXPECT_EQ(portable_scene("a = 1\n[study]\nverify = 1\nseed = 1\n[later]\nverify = 3\n"), "a = 1\n[study]\nseed = 1\n[later]\nverify = 3\n");
    char const* const twice = "a = 1\n[study]\nverify = 1\nseed = 1\nverify = 2\n";
    EXPECT_EQ(portable_scene(twice), twice);
    EXPECT_TRUE(paths_of_tables(none).empty());
}

TEST(RunIdentity, OfATableTellsThatItsContentChanged) {
    RunIdentity before = identity_of(), now = before;
    before.scene = portable_scene(scene_of_table("\"/a.csv\""));
    now.scene = portable_scene(scene_of_table("\"/c/b.csv\"", "fedcba9876543210"));
    now.tables = paths_of_tables(scene_of_table("\"/c/b.csv\""));
    EXPECT_EQ(now.difference(before),
              "study.table: b.csv has changed since the run began, from 3 rows, FNV-1a 0123456789abcdef to 3 rows, FNV-1a fedcba9876543210");
}

TEST(RunIdentity, OfLoadsHasTheirTablesEachUnderItsKey) {
    auto const scene_at = [](std::string const& gas, std::string const& members, std::string const& checksum) {
        return "schema = 1\n\n[load.gas]\ntable = " + gas + "  # 5 rows, FNV-1a " + checksum + "\nscale = 2  # 1\n\n[load.pull]\nforce_x = 1\n\n[study]\ntable = " +
               members + "  # 3 rows, FNV-1a 0123456789abcdef\n";
    };
    std::string const sum = "00000000000000aa", text = scene_at("\"/long/way/p.csv\"", "\"/m.csv\"", sum);
    EXPECT_EQ(paths_of_tables(text), (OfTables{{"load.gas.table", "\"/long/way/p.csv\""}, {"study.table", "\"/m.csv\""}}));
    EXPECT_EQ(contents_of_tables(text), (OfTables{{"load.gas.table", "5 rows, FNV-1a " + sum}, {"study.table", "3 rows, FNV-1a 0123456789abcdef"}}));
    EXPECT_EQ(portable_scene(text), scene_at("\"load.gas.table.csv\"", "\"study.table.csv\"", sum));
    EXPECT_EQ(with_tables(portable_scene(text), paths_of_tables(text)), text);
    RunIdentity before = identity_of(), now = before;
    before.scene = portable_scene(text), before.tables = paths_of_tables(text);
    std::string const other = scene_at("\"/p.csv\"", "\"/elsewhere/m.csv\"", "00000000000000bb");
    now.scene = portable_scene(other), now.tables = paths_of_tables(other);
    EXPECT_EQ(now.difference(before), "load.gas.table: p.csv has changed since the run began, from 5 rows, FNV-1a 00000000000000aa to 5 rows, FNV-1a 00000000000000bb");
    RunIdentity const back = parse_identity(identity_text(before), "run.toml");
    EXPECT_EQ(back.tables, before.tables);
    EXPECT_EQ(back.scene, before.scene);
}

TEST(RunIdentity, RemembersWhereTheTableLay) {
    RunIdentity identity = identity_of();
    identity.tables["study.table"] = "\"/a/rows.csv\"";
    RunIdentity const back = parse_identity(identity_text(identity), "run.toml");
    EXPECT_EQ(back.tables, identity.tables);
    EXPECT_EQ(back.scene, identity.scene);
    EXPECT_EQ(back.difference(identity_of()), "");
}

}  // namespace
}  // namespace slideway::run_identity_test
