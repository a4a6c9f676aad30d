// Laws and mechanisms of one's own: compiled by the program, named in scenes, part of a run's identity; and what is refused.
#include <dlfcn.h>

#include <csignal>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/backend/kernel_sources.hpp"
#include "tests/system/own_module_fixture.hpp"

namespace slideway::testing::own_modules_test {
namespace {

namespace fs = std::filesystem;

/// A law of the tree under another name, with its keys.
constexpr char const* twin = R"(
    #include "kernels/laws/kelvin_voigt.hpp"
    namespace slideway::inline SLIDEWAY_ISA {
    struct Twin : KelvinVoigt {
        static constexpr LawInfo info = [] {
            auto info = KelvinVoigt::info;
            info.name = "twin";
            return info;
        }();
    };
    }
    #define SLIDEWAY_LAW Twin
)";

constexpr char const* scene = R"(
schema = 1
[modules]
search = ["own"]
[contact]
law = "twin"
apex_damping = 300
[study]
members = 24
duration = "20 ms"
samples = 3
quantities = ["contact_onsets", "damping_loss"]
verify = 0
[study.vary]
"contact.apex_stiffness" = { dist = "unif", low = 1e7, high = 3e7 }
)";

class OwnModules : public ProgramWithOwnModules {
protected:
    OwnModules() { write("s.toml", scene); }

    std::string file(std::string const& isa) const { return fmt::format("own/slideway_law_twin_{}.so", isa); }

    /// For the instruction set that is compiled soonest, where nothing else is asked for; runs take what there is.
    void compile(std::string const& text, std::vector<std::string> options = {"-o", "own", "--isa", "scalar"}) const {
        write("twin.hpp", text);
        options.insert(options.begin(), {"compile", "twin.hpp"});
        Outcome const outcome = run(options);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }
    /// Refused with one line behind what the compiler says.
    Outcome refused(std::string const& text, std::string const& part) const {
        write("bad.hpp", text);
        // Soonest compiled, above all without the headers of SIMD: nothing that is refused runs.
        setenv("CXX", "g++ -DSLIDEWAY_NO_SIMD", 1);
        Outcome outcome = run({"compile", "bad.hpp", "-o", "bad", "--isa", "scalar"});
        unsetenv("CXX");
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(!fs::exists(path("bad")) || fs::is_empty(path("bad"))) << "nothing is left";
        return outcome;
    }
    std::string text_of(std::string const& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

TEST_F(OwnModules, HaveTheBitsOfTheSameLawInTheTree) {
    compile(twin, {"-o", "own"});
    for (Isa const isa : built_isas()) {
        if (!is_supported(isa) || isa == Isa::scalar_libm) continue;
        SCOPED_TRACE(name_of(isa));
        std::vector<std::string> const on{"--force", "--isa", std::string(name_of(isa))};
        ASSERT_EQ(run_scene(on, "own.nc").code, 0);
        auto in_tree = on;
        in_tree.insert(in_tree.end(), {"--set", "contact.law=kelvin_voigt"});
        ASSERT_EQ(run_scene(in_tree, "tree.nc").code, 0);
        EXPECT_EQ(hash_of("own.nc"), hash_of("tree.nc"));
        EXPECT_GT(results("own.nc").values("damping_loss").front(), 0) << "its numbers have an effect";
    }
}

/// clang and g++ before 12 know less flags than the g++ that slideway is compiled with; the bits do not depend on those.
TEST_F(OwnModules, AreCompiledByOtherCompilersWithTheSameBits) {
    write("older", "#!/bin/bash\nfor word; do\n[[ $word != -m*-max=* ]] || { echo \"error: unrecognized option '$word'\"; exit 1; }\ndone\nexec g++ \"$@\"\n");
    fs::permissions(path("older"), fs::perms::owner_all);
    setenv("CXX", path("older").c_str(), 1);
    compile(twin, {"-o", "own", "--isa", best()});
    ASSERT_EQ(run_scene({"--isa", best()}, "own.nc").code, 0);
    ASSERT_EQ(run_scene({"--isa", best(), "--set", "contact.law=kelvin_voigt"}, "tree.nc").code, 0);
    EXPECT_EQ(hash_of("own.nc"), hash_of("tree.nc"));
    unsetenv("CXX");
}

TEST_F(OwnModules, ArePartOfARunsIdentityByTheirSource) {
    compile(twin);
    // What the tree knows of its own law, that nothing damps it, it cannot know of this one.
    auto const bounces_for_ever = [&](std::string const& law) {
        Outcome const checked = run({"check", "s.toml", "--set", "mechanism.kind=free_slider", "--set", "contact.apex_damping=0", "--set", "contact.law=" + law});
        EXPECT_EQ(checked.code, 0) << checked.err;
        return (checked.out + checked.err).find("verner65") != std::string::npos;
    };
    EXPECT_TRUE(bounces_for_ever("kelvin_voigt"));
    EXPECT_FALSE(bounces_for_ever("twin"));
    ASSERT_EQ(run_scene({}, "whole.nc").code, 0);
    ASSERT_EQ(run_scene({"--shard", "1/2"}).code, 0);
    // Not the same source, though it does the same.
    fs::rename(path("own"), path("moved"));
    compile(std::string(twin) + "// changed\n");
    for (std::vector<std::string> const& options : {std::vector<std::string>{"--shard", "2/2"}, {"--resume"}}) {
        Outcome const other = run_scene(options);
        EXPECT_EQ(other.code, 2) << other.err;
        EXPECT_NE(other.err.find("contact.law was \"twin\"  # source "), std::string::npos) << other.err;
    }
    fs::remove_all(path("own"));
    // Where it lies does not matter, nor which way leads there.
    setenv("SLIDEWAY_MODULES", path("moved").c_str(), 1);
    ASSERT_EQ(run_scene({"--shard", "2/2", "--set", "modules.search=[]"}).code, 0);
    unsetenv("SLIDEWAY_MODULES");
    Outcome const lost = run({"merge", "s.nc.shards", "-o", "s.nc"});
    EXPECT_EQ(lost.code, 2) << lost.err;
    EXPECT_NE(lost.err.find("there is no such contact law"), std::string::npos) << lost.err;
    setenv("SLIDEWAY_MODULES", path("moved").c_str(), 1);
    EXPECT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 0);
    unsetenv("SLIDEWAY_MODULES");
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
    // A result is told of and checked without them.
    Outcome const told = run({"info", "s.nc"});
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_EQ(run({"info", "s.nc", "--check"}).code, 0);
    EXPECT_NE(told.out.find("law twin: source "), std::string::npos) << told.out;
}

TEST_F(OwnModules, IncludeFilesThatAreOfTheirSourceToo) {
    write("part.hpp", "#pragma once\n");
    std::string const text = "#include \"part.hpp\"\n" + std::string(twin);
    auto const source = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"compile", "including.hpp"});
        Outcome const outcome = run(options);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out.substr(0, outcome.out.find('\n'));
    };
    write("including.hpp", text);
    std::string const before = source({"-o", "own"});
    EXPECT_EQ(source({"-o", "other", "--isa", "scalar"}), before);
    write("part.hpp", "#pragma once\n// changed\n");
    EXPECT_NE(source({"-o", "own", "--isa", "scalar"}), before);
    // Of the former source nothing is left under its name.
    for (Isa const isa : built_isas()) EXPECT_EQ(fs::exists(path(file(std::string(name_of(isa))))), isa == Isa::scalar) << name_of(isa);
    write("part.hpp", "#pragma once\n#ifdef __AVX512F__\n#include <cmath>\n#include \"more.hpp\"\n#endif\n");
    write("more.hpp", "#pragma once\n");
    if (is_built(Isa::avx512) && is_supported(Isa::avx512) && is_built(Isa::scalar))
        expect_refusal(2, "another source for", {"compile", "including.hpp", "-o", "own"});
}

/// Crank angle and speed are states that a motor moves: its energy is balanced, its neighbours have exponents, its parts are merged.
TEST_F(OwnModules, OfAMechanismWithStatesOfItsOwnAreStudiedAsAnyOther) {
    provide_motor();
    write("s.toml", R"(
schema = 1
[modules]
search = ["own"]
[mechanism]
kind = "motor_yoke"
crank_speed = "20 rad/s"
[contact]
law = "paper"
[friction]
[integrator]
rtol = 1e-10
[study]
members = 16
duration = "30 ms"
samples = 4
quantities = ["energy_residual", "drive_work", "friction_loss", "damping_loss", "energy_change", "contact_onsets"]
verify = 0
[study.vary]
"mechanism.stall_torque" = { dist = "unif", low = 0.4, high = 0.6 }
)");
    // Where switches of the published law make no energy: springs.
    std::vector<std::string> const springs{"--set", "contact.law=kelvin_voigt"};
    ASSERT_EQ(run_scene(springs, "whole.nc").code, 0);
    expect_refusal(2, "the contacts of a motor_yoke give way); use another law, or mechanism.kind = slider_crank or ", {"check", "s.toml", "--set", "contact.law=rigid", "--set", "contact.restitution=0.5"});
    auto const file = results("whole.nc");
    auto const residual = file.values("energy_residual"), work = file.values("drive_work"), torque = file.values("mechanism_stall_torque");
    auto const speed = file.values("final_crank_angular_velocity");
    for (std::size_t i = 0; i < residual.size(); ++i) {
        EXPECT_LT(std::abs(residual[i]), 1e-9) << i;
        EXPECT_GT(work[i], 0.1) << i;
        EXPECT_GT(speed[i], 20 + 20 * (torque[i] - 0.3)) << "the motor turns it";
    }
    for (char const* const part : {"1/2", "2/2"}) {
        auto options = springs;
        options.insert(options.end(), {"--shard", part});
        ASSERT_EQ(run_scene(options).code, 0);
    }
    ASSERT_EQ(run({"merge", "s.nc.shards", "-o", "s.nc"}).code, 0);
    EXPECT_EQ(hash_of("s.nc"), hash_of("whole.nc"));
    // The published law rattles: neighbours part, in y and z and in the angle of the crank.
    std::string orbits = text_of("s.toml");
    orbits.erase(orbits.find("samples = 4"), orbits.find("verify = 0") - orbits.find("samples = 4"));
    write("orbits.toml", orbits);
    Outcome const chaos = run({"run", "orbits.toml", "-o", "chaos.nc", "--no-progress", "--set", "study.kind=lyapunov", "study.Ttr=0.1 s", "study.duration=0.2 s",
                               "study.dt=1 ms", "study.members=8", "integrator.rtol=1e-6"});
    EXPECT_EQ(chaos.code, 0) << chaos.err;
    EXPECT_NE(chaos.out.find("largest: 8 members above zero"), std::string::npos) << chaos.out;
    Outcome const probed = run({"probe", "s.toml"});
    EXPECT_EQ(probed.code, 0) << probed.err;
}

TEST_F(OwnModules, ThatASignalEndsLeaveNothing) {
    fs::create_directories(path("tmp"));
    setenv("TMPDIR", path("tmp").c_str(), 1);
    write("twin.hpp", twin);
    pid_t const child = start({"compile", "twin.hpp", "-o", "own"});
    EXPECT_TRUE(comes_true([&] { return !fs::is_empty(path("tmp")); }));
    kill(child, SIGINT);
    Outcome const ended = wait(child);
    unsetenv("TMPDIR");
    EXPECT_TRUE(ended.code == 0 || ended.code == 5) << ended.code << ended.err;
    EXPECT_TRUE(fs::is_empty(path("tmp")));
}

/// As the keys of the tree's laws are.
TEST_F(OwnModules, HaveKeysThatHaveNoEffectWithAnotherLaw) {
    std::string text(twin);
    for (std::string const part : {"auto info = KelvinVoigt::info;", "struct Twin : KelvinVoigt {"}) ASSERT_NE(text.find(part), text.npos);
    text.replace(text.find("auto info = KelvinVoigt::info;"), 30, "auto info = KelvinVoigt::info; info.keys = own;");
    text.insert(text.find("struct Twin : KelvinVoigt {") + 27, R"(static constexpr Key own[] = {{"contact.twin_stiffness", &Inputs::law_a, "N/m", Rule::positive, KeyGroup::law, "stiffness", 1e7}};)");
    compile(text);
    write("s.toml", "schema = 1\n[modules]\nsearch = [\"own\"]\n[contact]\nlaw = \"twin\"\ntwin_stiffness = 2e7\n[study]\nduration = \"5 ms\"\n");
    EXPECT_EQ(run_scene({}).code, 0);
    Outcome const other = run_scene({"--force", "--set", "contact.law=conservative"});
    EXPECT_EQ(other.code, 0) << other.err;
    EXPECT_NE(other.err.find("contact.twin_stiffness has no effect"), std::string::npos) << other.err;
}

TEST_F(OwnModules, OfOneFolderAreFoundByEveryScene) {
    compile(twin, {"--isa", "scalar"});
    ASSERT_EQ(run_scene({"--set", "modules.search=[]"}).code, 0);
    Outcome const list = run({"list"});
    EXPECT_NE(list.out.find(fmt::format("(module in {}", path("cache/slideway/modules").string())), std::string::npos) << list.out;
    EXPECT_NE(run({"list", "--json"}).out.find("\"name\": \"twin\""), std::string::npos);
    EXPECT_NE(run({"check", "s.toml", "--resolved"}).out.find("law = \"twin\"  # source "), std::string::npos);
    EXPECT_EQ(run({"list", "--markdown"}).out.find("twin"), std::string::npos);
    // Nothing is compiled twice.
    EXPECT_NE(run({"compile", "twin.hpp", "--isa", "scalar"}).out.find("was there already"), std::string::npos);
}

TEST_F(OwnModules, ThatCannotBeUsedAreOneLine) {
    compile(twin);
    std::string const whole = text_of(file("scalar"));
    std::string other = whole;
    auto const at = whole.find(SLIDEWAY_KERNEL_BORDER);
    ASSERT_NE(at, whole.npos);
    other[at] = other[at] == '0' ? '1' : '0';
    Dl_info mathematics{};
    ASSERT_NE(dladdr(reinterpret_cast<void const*>(&lgamma_r), &mathematics), 0);
    std::ifstream foreign(mathematics.dli_fname, std::ios::binary);
    std::string const of_others{std::istreambuf_iterator<char>(foreign), {}};
    for (auto const& [text, part] : {std::pair{other, "of another version of slideway's kernels"}, std::pair{whole.substr(0, whole.size() / 2), "cannot be opened"},
                                     std::pair{of_others, "is no module of slideway"}, std::pair{std::string("no module\n"), "cannot be opened"}}) {
        fs::remove_all(path("own"));
        fs::create_directories(path("own"));
        write(file("scalar"), text);
        expect_refusal(2, part, {"run", "s.toml", "-o", "s.nc"});
    }
    // Of an instruction set, under the name of another.
    if (best_isa() != Isa::scalar) {
        fs::remove_all(path("own"));
        fs::create_directories(path("own"));
        write(file(best()), whole);
        expect_refusal(2, fmt::format("slideway_law_twin_{}.so is compiled for scalar", best()), {"run", "s.toml", "-o", "s.nc"});
        fs::remove(path(file(best())));
        write(file("scalar"), whole);
    }
    // Of instructions that this program does not have.
    fs::remove(path(file("scalar")));
    write("own/slideway_law_twin_neon.so", whole);
    if (!is_built(Isa::neon)) expect_refusal(2, "compiled for neon alone", {"run", "s.toml", "-o", "s.nc"});
    fs::remove_all(path("own"));
    expect_refusal(2, fmt::format("there is no such contact law); use one of paper, conservative, kelvin_voigt, foundation, rigid, or compile your header that has it (slideway compile); no module of this version has it in {}", path("own").string()),
                   {"run", "s.toml", "-o", "s.nc"});
    expect_refusal(2, "there is no such contact law); did you mean \"paper\"?", {"run", "s.toml", "-o", "s.nc", "--set", "contact.law=papre"});
    EXPECT_FALSE(fs::exists(path("s.nc")) || fs::exists(path("s.nc.shards")));
}

TEST_F(OwnModules, WithoutKernelsOfAnInstructionSetAreOneLine) {
    if (built_isas().size() < 2) GTEST_SKIP() << "this build has one instruction set";
    write("twin.hpp", twin);
    ASSERT_EQ(run({"compile", "twin.hpp", "-o", "own", "--isa", best()}).code, 0);
    for (Isa const isa : built_isas()) {
        if (isa != best_isa() && is_supported(isa))
            expect_refusal(4, fmt::format("slideway compile --isa {}", name_of(isa)), {"run", "s.toml", "-o", "s.nc", "--no-progress", "--quiet", "--isa", std::string(name_of(isa))});
    }
    // What there is is used.
    fs::remove_all(path("own"));
    ASSERT_EQ(run({"compile", "twin.hpp", "-o", "own", "--isa", "scalar"}).code, 0);
    for (std::string const isa : {"auto", "scalar"}) EXPECT_EQ(run_scene({"--force", "--isa", isa}).code, 0) << isa;
}

/// Of what is objected to (objections_test.cpp) one stands for all.
TEST_F(OwnModules, AreRefusedWithTheCompilersWordsOrOneLine) {
    std::string const text(twin);
    auto const with = [&](std::string const& from, std::string const& to) {
        auto const at = text.find(from);
        EXPECT_NE(at, text.npos);
        return text.substr(0, at) + to + text.substr(at + from.size());
    };
    EXPECT_EQ(std::ranges::count(refused("#pragma once\n", "offers nothing").err, '\n'), 1);
    EXPECT_EQ(std::ranges::count(refused(with("\"twin\"", "\"Twin law\""), "small letters").err, '\n'), 1);
    refused(with("KelvinVoigt::info", "Missing::info"), "bad.hpp:6:");  // the line at fault
    refused("#include \"not_there.hpp\"\n", "not_there.hpp");
    refused("struct Law {};\n#define SLIDEWAY_LAW Law\n", "static assertion failed: the law has no `static constexpr LawInfo info`");
    refused("struct Mechanism {};\n#define SLIDEWAY_MECHANISM Mechanism\n", "static assertion failed: the mechanism has no `static constexpr MechanismInfo info`");
    refused("#include \"kernels/mechanisms/mechanism_info.hpp\"\nstruct Nameless { static constexpr slideway::MechanismInfo info{}; };\n#define SLIDEWAY_MECHANISM Nameless\n", "static assertion failed: the mechanism's info says no name");
    refused(with("struct Twin : KelvinVoigt {", "struct Twin {"), "static assertion failed: the law has no `forces<Damping>(motion, face, contact)`");
    std::string const empty = "#include \"kernels/mechanisms/spatial_slider.hpp\"\nusing namespace slideway;\nstruct OwnBase : SliderBase {};\nstruct Empty { static constexpr MechanismInfo "
                              "info = [] { auto info = spatial_slider_info(); info.name = info.meaning = \"empty\"; return info; }(); };\n#define SLIDEWAY_MECHANISM Empty\n";
    refused(empty, "static assertion failed: the mechanism has no `derivative<Full, Real, Law>(");
    refused(empty + "#define SLIDEWAY_BASE OwnBase\n", "static assertion failed: nothing says how lanes treat SLIDEWAY_BASE");
    expect_refusal(2, "there is no such file", {"compile", "nowhere.hpp"});
    setenv("CXX", "/no/compiler", 1);
    write("twin.hpp", twin);
    write("file", "");
    expect_refusal(4, "/file is no folder); give another folder with -o", {"compile", "twin.hpp", "-o", "file/own"});  // before anything is compiled
    expect_refusal(4, "/no/compiler does not start", {"compile", "twin.hpp", "-o", "own"});
    unsetenv("CXX");
}

}  // namespace
}  // namespace slideway::testing::own_modules_test
