#include "tests/system/process.hpp"

#include <sys/stat.h>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/config/descriptors.hpp"
#include "host/sampling/design.hpp"
#include "host/sampling/distribution.hpp"

namespace slideway::testing::usage_test {
namespace {

class Usage : public Program {
protected:
    Usage() { write("s.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nmembers = 10\nduration = \"1 ms\"\n"); }
};

TEST_F(Usage, OfCommands) {
    expect_refusal(2, "a command is missing", {});
    expect_refusal(2, "did you mean check?", {"chek", "s.toml"});
    expect_refusal(2, "there is no command 'frobnicate'", {"frobnicate"});
    expect_refusal(2, "SCENE is missing", {"run"});
    expect_refusal(2, "--bogus", {"run", "s.toml", "--bogus"});
    expect_refusal(2, "did you mean --resume?", {"run", "s.toml", "--resum"});
    expect_refusal(2, "did you mean --threads?", {"check", "s.toml", "--thread=2"});
    expect_refusal(2, "see slideway help info", {"info", "s.nc", "--frobnicate"});
    for (char const* const command : {"run", "check", "probe", "info", "stats", "merge", "report", "export", "list"}) {
        Outcome const help = run({"help", command});
        EXPECT_EQ(help.code, 0) << command;
        EXPECT_EQ(help.out, run({command, "--help"}).out);
    }
    EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
    expect_refusal(2, "did you mean check?", {"help", "chek"});
    expect_refusal(2, "there is no command '--quiet'", {"--quiet", "run", "s.toml"});
    expect_refusal(2, "second", {"run", "s.toml", "second"});
    expect_refusal(2, "FILE", {"info"});
}

TEST_F(Usage, OfCardsForOtherMechanisms) {
    write("c.toml", "schema = 1\n[mechanism]\nkind = \"carriage\"\n[contact]\nlaw = \"paper\"\n");
    for (char const* const command : {"run", "check"}) {
        expect_refusal(2,
                       "c.toml: mechanism.kind is \"carriage\" (the kernels for cards are of slider_crank alone); use "
                       "--backend cpu",
                       {command, "c.toml", "--backend", "cuda"});
    }
    EXPECT_NE(run({"check", "c.toml"}).out.find("the kernels for cards are of slider_crank alone"), std::string::npos);
    EXPECT_EQ(run({"check", "s.toml"}).out.find("of slider_crank alone"), std::string::npos);
}

TEST_F(Usage, OfCardsForLoads) {
    write("l.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[load.push]\nforce_x = 1\n");
    for (char const* const command : {"run", "check"})
        expect_refusal(2, "l.toml: load.push is given (the kernels for cards have no loads, no film, and a straight way without ends); use --backend cpu", {command, "l.toml", "--backend", "cuda"});
}

TEST_F(Usage, OfCardsForForces) {
    for (std::string const name : {"peak_rod_force", "face_force_y_plus"}) {
        write("f.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nsamples = 3\nquantities = [\"" + name + "\"]\n");
        expect_refusal(2, "f.toml: study.quantities asks for forces of faces or pins (the kernels for cards do not tell them); use --backend cpu",
                       {"check", "f.toml", "--backend", "cuda"});
    }
}

TEST_F(Usage, OfCardsForRigidContacts) {
    write("r.toml", "schema = 1\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n");
    for (char const* const command : {"run", "check"}) {
        expect_refusal(2, "r.toml: contact.law is \"rigid\" (the kernels for cards have no rigid contacts); use --backend cpu",
                       {command, "r.toml", "--backend", "cuda"});
    }
    EXPECT_NE(run({"check", "r.toml"}).out.find("the kernels for cards have no rigid contacts"), std::string::npos);
}

TEST_F(Usage, CheckShowsThePartsOfEachMechanism) {
    auto const parts = [&](std::string const& lines) {
        write("m.toml", "schema = 1\n[mechanism]\n" + lines + "\n[study]\nduration = \"1 ms\"\n");
        std::string const out = run({"check", "m.toml"}).out;
        auto const from = out.find("parts in");
        return out.substr(from, out.find("\nasked for") - from);
    };
    EXPECT_EQ(parts("kind = \"carriage\""),
              "parts in     carriage mechanism; foundation law; no damping\n"
              "parts out    paper law; conservative law; kelvin_voigt law; rigid contact; damping of surface contacts; restitution; friction; "
              "pose of a misaligned way; offset of mass centre and pin; time series");
    EXPECT_EQ(parts("kind = \"planar_slider_crank\"\n[drive]\nkind = \"free\"\n[contact]\nrestitution = 0.5"),
              "parts in     planar_slider_crank mechanism; contact of corners; no drive; restitution\n"
              "parts out    friction; time series");
    // One that has them all.
    EXPECT_NE(run({"check", std::string(SLIDEWAY_SCENES) + "/planar_rigid.toml"}).out.find("\nparts out    none\n"), std::string::npos);
}

TEST_F(Usage, CheckShowsThePartsOfEachLaw) {
    for (LawInfo const& law : laws()) {
        write("l.toml", fmt::format("schema = 1\n[contact]\nlaw = \"{}\"\n[study]\nduration = \"1 ms\"\n", law.name));
        std::string const out = run({"check", "l.toml"}).out;
        auto const from = out.find("parts in");
        std::string const in = out.substr(from, out.find('\n', from) - from);
        auto const after = out.find("parts out");
        std::string const left = out.substr(after, out.find('\n', after) - after);
        EXPECT_EQ(in, fmt::format("parts in     slider_crank mechanism; {} law; {}", law.name,
                                  has_group(law.groups, KeyGroup::point_damping) ? std::string("damping of point contacts")
                                  : law.keys.empty() || law.has(Damping::rate)   ? "no damping"
                                                                                 : fmt::format("damping of the {} law", law.name)));
        for (LawInfo const& other : laws()) {
            EXPECT_EQ(left.find(fmt::format(" {} law;", other.name)) != left.npos, other.name != law.name) << left;
        }
        EXPECT_EQ(left.find("restitution") != left.npos, law.has(Damping::restitution)) << left;
        EXPECT_EQ(left.find("surface contacts") != left.npos, law.has(Damping::rate)) << left;
        EXPECT_EQ(left.find("line and surface") != left.npos, has_group(law.groups, KeyGroup::edges)) << left;
        for (Key const& key : law.keys) EXPECT_NE(out.find(key.name.substr(8)), out.npos) << key.name;
    }
}

TEST_F(Usage, ListShowsWhatEachLawHas) {
    std::string const list = run({"list"}).out;
    for (LawInfo const& law : laws()) {
        EXPECT_NE(list.find(fmt::format("\n  {:<30} {}\n", law.name, law.words)), list.npos) << law.name;
        for (Key const& key : law.keys) EXPECT_NE(list.find(fmt::format("{} [{}]: {}", key.name, key.unit, key.meaning)), list.npos);
    }
    for (char const* const lines : {
             "one mode per face: surface, lines or points (makes energy where it switches)\n"
             "                                 damping: point, rate, restitution\n  conservative ",
             "a linear spring and damper at each apex, no modes\n"
             "                                 damping: its own alone\n"
             "                                 contact.apex_stiffness [N/m]: stiffness of an apex\n"
             "                                 contact.apex_damping [N s/m]: damping of an apex\n",
             "an elastic bed over each face, no modes\n"
             "                                 damping: rate, restitution\n"
             "                                 contact.bed_stiffness [N/m3]: stiffness of the bed: pressure over depth\n",
         }) {
        EXPECT_NE(list.find(lines), list.npos) << lines;
    }
}

TEST_F(Usage, ListShowsWhatEachMechanismHas) {
    std::string const list = run({"list"}).out;
    for (char const* const line : {
             "  planar_slider_crank            block between two walls",
             "crank_angle, rod_angle, pitch, crank_angular_velocity, rod_angular_velocity, wz; series have y, vy too\n",
             "  peak_crank_torque              N m      largest magnitude of the drive torque, crank weight included "
             "(slider_crank, planar_slider_crank)\n",
             "  crank_angle                    rad      angle of the crank (planar_slider_crank)\n",
             "  mechanism.stroke               m        distance that the carriage travels at constant speed: > 0; default 0.15 (carriage)\n",
             "  mechanism.gravity              m/s2     gravity; default 9.81\n",
             "  mechanism.slider_mass          kg       mass of the slider: > 0; default derived: density x slider_length x way_width x way_depth, or "
             "density x slider_length x 2 wall x (way_width + way_depth + 2 wall), or density x slider_length x slider_height x slider_depth\n",
             "  mechanism.crank_length         m        crank length: > 0; default 0.05 (slider_crank, scotch_yoke, "
             "planar_slider_crank)\n",
             "  contact.eta                    1        damping ratio of point contacts: ≥ 0; default 0.01 (law paper, conservative)\n",
             "  contact.slider_young_modulus   Pa       modulus of the slider: > 0; default 2.07e+11 "
             "(law paper, conservative, kelvin_voigt, foundation)\n",
             "  contact.apex_damping           N s/m    damping of an apex: ≥ 0; default 0 (slider_crank, carriage, scotch_yoke, "
             "free_slider; law kelvin_voigt)\n",
         }) {
        EXPECT_NE(list.find(line), std::string::npos) << line;
    }
}

TEST_F(Usage, OfOptionsOfRun) {
    expect_refusal(2, "--threads 0", {"run", "s.toml", "--threads", "0"});
    expect_refusal(2, "--threads", {"run", "s.toml", "--threads", "many"});
    expect_refusal(2, "--isa mmx", {"run", "s.toml", "--isa", "mmx"});
    expect_refusal(2, "leave one of them out", {"run", "s.toml", "--backend", "cuda", "--isa", "avx2"});
    expect_refusal(2, "--backend abacus", {"run", "s.toml", "--backend", "abacus"});
    expect_refusal(2, "--max-hours", {"run", "s.toml", "--max-hours=-1"});
    expect_refusal(2, "--max-hours", {"run", "s.toml", "--max-hours", "nan"});
    for (char const* const limit : {"-1", "1.5", "101%", "x", "%", "nan%"}) {
        expect_refusal(2, "--max-failures", {"run", "s.toml", std::string("--max-failures=") + limit});
    }
    for (char const* const range : {"3", "5..2", "a..b", "1..", "..2", "0..10"}) {
        expect_refusal(2, "--members", {"run", "s.toml", "--members", range});
    }
    expect_refusal(2, "--member 10: s.toml has members 0 to 9", {"run", "s.toml", "--member", "10"});
    expect_refusal(2, "--member -1: ", {"run", "s.toml", "--member", "-1"});
    expect_refusal(2, "--member two: ", {"run", "s.toml", "--member", "two"});
    expect_refusal(2, "exclude each other", {"run", "s.toml", "--member", "1", "--members", "1..2"});
    expect_refusal(2, "--set contact.law", {"run", "s.toml", "--set", "contact.law"});
    EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
}

TEST_F(Usage, OfEmptyWordsIsRefused) {
    for (char const* const option : {"-o", "--threads", "--max-hours", "--max-failures", "--member", "--members", "--shard", "--block-members",
                                     "--isa", "--backend", "--set"}) {
        expect_refusal(2, "empty", {"run", "s.toml", option, ""});
        if (option[1] == '-') expect_refusal(2, option, {"run", "s.toml", std::string(option) + "="});
    }
    for (char const* const option : {"--csv", "-o"}) expect_refusal(2, "empty", {"probe", "s.toml", option, ""});
    for (char const* const option : {"--variable", "--member", "--dt", "--skip", "--max-points", "--fit", "-o"})
        expect_refusal(2, "empty", {"stats", "s.nc", option, ""});
    for (char const* const command : {"run", "check", "probe", "info", "stats", "report"}) expect_refusal(2, "empty", {command, ""});
    EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
}

TEST_F(Usage, OfAnInstructionSetThatThisMachineOrBuildLacks) {
    std::string const list = run({"list"}).out;
    int lacking = 0;
    for (Isa const isa : all_isas()) {
        std::string const name(name_of(isa));
        auto const row = list.find("\n  " + name + ' ');
        ASSERT_NE(row, std::string::npos) << name;
        std::string const told = list.substr(row + 1, list.find('\n', row + 1) - row - 1);
        EXPECT_EQ(told.ends_with(", not in this build"), !is_built(isa)) << told;
        if (is_supported(isa)) {
            EXPECT_EQ(run({"probe", "s.toml", "--isa", name}).code, 0);
            continue;
        }
        char const* const why =
            is_built(isa) ? ": this machine does not have it" : ": is not in this build, which has ";
        for (char const* const command : {"probe", "run"})
            expect_refusal(2, "--isa " + name + why, {command, "s.toml", "--isa", name});
        ++lacking;
    }
    EXPECT_GT(lacking, 0) << "no build is for two kinds of processors";
}

TEST_F(Usage, OfScenes) {
    for (char const* const command : {"run", "check", "probe"}) {
        expect_refusal(2, "missing.toml", {command, "missing.toml"});
        expect_refusal(2, "joint.clearance", {command, "s.toml", "--set", "joint.clearance=-1"});
    }
    write("bad.toml", "schema = 1\n[joint]\nclearence = 1e-4\n");
    expect_refusal(2, "bad.toml:3: ", {"check", "bad.toml"});
}

TEST_F(Usage, OfPlacesForResults) {
    expect_refusal(4, "no folder", {"run", "s.toml", "-o", "nowhere/s.nc"});
    expect_refusal(4, "is a folder", {"run", "s.toml", "-o", "."});
    expect_refusal(4, "states.csv", {"probe", "s.toml", "--csv", "states.csv"});
    expect_refusal(4, "there is no folder", {"probe", "s.toml", "-o", "nowhere/p.csv"});
}

TEST_F(Usage, NeverReplacesWhatIsNoResult) {
    std::string const scene = file_text(path("s.toml"));
    for (char const* const name : {"s.toml", "./s.toml"}) {
        expect_refusal(4, "is what this command reads", {"run", "s.toml", "--force", "-o", name});
        EXPECT_EQ(file_text(path("s.toml")), scene);
    }
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    expect_refusal(4, "pipe: is a device or a pipe", {"run", "s.toml", "-o", "pipe"});
    EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
}

TEST_F(Usage, OfFilesThatAreNoResults) {
    expect_refusal(4, "missing.nc", {"info", "missing.nc"});
    expect_refusal(4, "s.toml: is no netCDF file", {"info", "s.toml"});
    expect_refusal(4, ".", {"info", "."});
}

TEST_F(Usage, AllowsTheSceneBehindItsOverrides) {
    Outcome const outcome = run({"check", "--set", "study.members=7", "contact.law=conservative", "s.toml"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("members = 7"), std::string::npos);
    EXPECT_NE(outcome.out.find("law = \"conservative\""), std::string::npos);
}

TEST_F(Usage, AnswersQuestions) {
    for (auto const& question : {std::vector<std::string>{"--help"}, {"run", "--help"}, {"--version"}, {"list"}}) {
        Outcome const outcome = run(question);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.out, "");
        EXPECT_EQ(outcome.err, "");
    }
    EXPECT_TRUE(run({"--version"}).out.starts_with("slideway 0."));
    std::string const list = run({"list"}).out;
    for (char const* const name : {"slider_crank", "conservative", "dopri5", "mode_time", "truncnorm",
                                   "joint.clearance_y", "contact.young_modulus", "avx512", "ensemble",
                                   "rod_angular_velocity", "tolerance", "limits", "correlation"}) {
        EXPECT_NE(list.find(name), std::string::npos) << name;
    }
    for (std::string_view const design : design_names) {
        EXPECT_NE(list.find(fmt::format("\n  {:<30} ", design)), std::string::npos) << design;
    }
    for (DistributionForm const& form : distribution_forms()) {
        EXPECT_NE(list.find(fmt::format("\n  {:<10} {}", form.name, listed_arguments(form))), std::string::npos)
            << form.name;
    }
}

TEST_F(Usage, OfCheckTellsHowMembersAreSpread) {
    auto const design = [&](std::string const& lines) {
        write("d.toml", "schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nkind = \"tolerance\"\n" + lines +
                            "\n[study.limits]\nfriction_loss = {max=1}\n\"mode_time[free]\" = {min=0}\n[study.vary]\n"
                            "\"initial.y\" = {dist=\"unif\", low=0, high=1e-5}\n"
                            "\"initial.z\" = {dist=\"triang\", low=0, mode=0, high=1e-5}\n");
        return run({"check", "d.toml"}).out;
    };
    auto const has = [](std::string const& text, std::string const& line) {
        return text.find("\n" + line + "\n") != text.npos;
    };
    EXPECT_TRUE(has(design("design = \"saltelli\"\nbase = 512"), "design       saltelli, 512 rows of 4 members"));
    EXPECT_TRUE(has(design("design = \"lhs\"\nmembers = 30"), "design       lhs, 30 points of 2 keys"));
    std::string const grid = design("design = \"grid\"\nlevels = 3");
    EXPECT_TRUE(has(grid, "design       grid, 3 x 3 levels"));
    EXPECT_TRUE(has(grid, "limits       of friction_loss, mode_time[free]"));
}

TEST_F(Usage, OfCheckTellsWhatIsInTheKernels) {
    std::string const bare = run({"check", "s.toml"}).out;
    auto const line = [](std::string const& text, std::string const& label) {
        auto const at = text.find("\n" + label);
        return at == text.npos ? std::string() : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    };
    EXPECT_NE(line(bare, "parts in").find("paper law"), std::string::npos);
    EXPECT_NE(line(bare, "parts out").find("; friction"), std::string::npos);
    EXPECT_NE(line(bare, "parts out").find("misaligned way"), std::string::npos);
    write("full.toml",
          "schema = 1\n[friction]\n[way]\nroll = 1e-4\n[contact]\nlaw = \"conservative\"\nchi_line = 0.1\n"
          "[study]\nquantities = [\"drive_work\"]\n");
    std::string const full = run({"check", "full.toml"}).out;
    EXPECT_NE(line(full, "parts in").find("conservative law"), std::string::npos);
    EXPECT_NE(line(full, "parts in").find("; friction"), std::string::npos);
    EXPECT_NE(line(full, "parts in").find("misaligned way"), std::string::npos);
    EXPECT_NE(line(full, "parts out").find("paper law"), std::string::npos);
    EXPECT_EQ(line(full, "asked for"), "asked for    drive_work");
    for (char const* const label : {"kernels", "memory", "disk", "cost"}) EXPECT_NE(line(full, label), "") << label;
    // A status each; with a quantity of one column that column, its finished members and them sorted as
    // well; and a quarter more.
    EXPECT_NE(line(bare, "memory").find(" 100 B for the statistics"), std::string::npos) << line(bare, "memory");
    EXPECT_NE(line(full, "memory").find(" 40 B for the statistics"), std::string::npos) << line(full, "memory");
}

TEST_F(Usage, OfCheckKnowsTheNumberOfFixedSteps) {
    Outcome const outcome = run({"check", "s.toml", "--set", "study.members=1", "--set", "integrator.method=rk4",
                                 "--set", "integrator.step=1e-9", "--set", "integrator.rtol=1e-3", "--threads", "4"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "warning: integrator.rtol has no effect with method rk4\n");
    EXPECT_NE(outcome.out.find("cost         1000000 steps, all fixed; "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" on 1 thread\n"), std::string::npos) << "one member keeps one thread busy";
    EXPECT_EQ(outcome.out.find("rtol"), std::string::npos);
}

}  // namespace
}  // namespace slideway::testing::usage_test
