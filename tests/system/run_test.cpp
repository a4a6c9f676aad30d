#include "tests/system/small_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernels/status.hpp"

namespace slideway::testing::run_test {
namespace {

class Run : public SmallRun {};

TEST_F(Run, WritesItsResultsAndSaysWhere) {
    Outcome const outcome = run_scene({});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(outcome.out.ends_with("results      s.nc\n")) << outcome.out;
    for (char const* const word : {"A small ensemble", "members/s", "finished", "accepted", "lanes in use",
                                   "drive_work", "mode_time[surface]", "Mode switching of the paper law made"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
    }
    ResultReader const file = results("s.nc");
    EXPECT_EQ(file.values("status"), std::vector<double>(37, 0));
    EXPECT_EQ(file.values("time").back(), 0.005);
    EXPECT_EQ(file.shape("y"), (std::vector<std::size_t>{37, 6}));
    EXPECT_EQ(file.attribute("title"), "A small ensemble");
    // The series starts where the member was drawn.
    auto const y = file.values("y"), start = file.values("initial_y");
    for (std::size_t i = 0; i < 37; ++i) EXPECT_EQ(y[6 * i], start[i]);
    EXPECT_NE(run_scene({"--force"}).out.find("replaced a former file"), std::string::npos);
}

// The slower of two edges that touch lets go where the faster one has parted, and pushes again a moment later for some microseconds: a step that has seen
// nothing of it may not go beyond.  Methods of order 5 once came to 89.9944 m/s2 at most tolerances.
TEST_F(Run, GoesOverNoEdgeThatPushesAgain) {
    write("e.toml", R"(
schema = 1
[mechanism]
crank_speed = 10.68174098171199
[joint]
clearance = 0.00011720494481114722
[contact]
law = "foundation"
restitution = 0.6
[friction]
kinetic = 0.09536422161259077
[study]
duration = "0.1 s"
verify = 0
quantities = ["rms_acceleration", "mode_time"]
)");
    for (char const* const method : {"auto", "dopri5", "bs32", "verner65"}) {
        for (char const* const rtol : {"1e-7", "1e-8", "1e-9"}) {
            Outcome const outcome = run({"run", "e.toml", "--no-progress", "--json", "--force", "-o", "e.nc", "--set", fmt::format("integrator.method={}", method), "--set",
                                         fmt::format("integrator.rtol={}", rtol)});
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            for (auto const& one : nlohmann::json::parse(outcome.out)["quantities"]) {
                double const mean = one["mean"].is_null() ? 1e9 : one["mean"].get<double>();
                if (one["name"] == "rms_acceleration[y]") { EXPECT_NEAR(mean, 89.8540, 1e-2) << method << ' ' << rtol; }
                if (one["name"] == "mode_time[free]") { EXPECT_NEAR(mean, 0.013917, 2e-6) << method << ' ' << rtol; }
                // Of next to nothing stages with negative weights once made less than nothing.
                if (one["name"] == "rms_acceleration[z]") { EXPECT_LT(mean, 1e-9) << method << ' ' << rtol; }
            }
        }
    }
}

TEST_F(Run, SaysNothingOfMadeEnergyUnderTheConservativeLaw) {
    Outcome const outcome = run_scene({"--set", "contact.law=conservative"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("Mode switching"), std::string::npos);
}

TEST_F(Run, SaysThatAFixedStepIsTooLong) {
    // The slider meets its way within 5 ms only where it starts close to it; the linear limit is 7e-6 s.
    std::vector<std::string> options{"--max-failures", "100%",
                                     "--set",          "contact.law=conservative",
                                     "--set",          "study.duration=0.1 s",
                                     "--set",          "study.quantities=[]",
                                     "--set",          "integrator.method=rk4",
                                     "--set",          "integrator.step=20 us"};
    Outcome const outcome = run_scene(options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    auto const from = outcome.out.find("rk4 with a step of 2e-05 s failed in ");
    ASSERT_NE(from, std::string::npos) << outcome.out;
    std::string const line = outcome.out.substr(from, outcome.out.find('\n', from) - from);
    EXPECT_NE(line.find("unstable by the energy audit"), std::string::npos) << line;
    EXPECT_NE(line.find("use a smaller integrator.step"), std::string::npos) << line;
    ResultReader const file = results("s.nc");
    auto const status = file.values("status"), residual = file.values("energy_residual");
    EXPECT_GT(std::count(status.begin(), status.end(), static_cast<double>(Status::unstable)), 18);
    // Their results are kept.
    for (std::size_t i = 0; i < status.size(); ++i) {
        if (status[i] != static_cast<double>(Status::unstable)) continue;
        EXPECT_TRUE(std::isfinite(residual[i]));
        EXPECT_EQ(file.values("end_time")[i], 0.1);
    }
    EXPECT_EQ(run_scene({}).out.find("failed in"), std::string::npos);
}

TEST_F(Run, ShowsTheResidualOfAMethodThatDoesNotSeeItsLosses) {
    std::vector<std::string> options{"--max-failures",           "100%",  "--set",
                                     "contact.law=conservative", "--set", "study.quantities=[]"};
    EXPECT_EQ(run_scene(options).out.find("energy_residual"), std::string::npos);
    options.insert(options.end(), {"--set", "integrator.method=ros34pw2"});
    Outcome const outcome = run_scene(options);
    EXPECT_NE(outcome.out.find("energy_residual"), std::string::npos) << outcome.err;
}

TEST_F(Run, BlamesTheLawOnlyWhereTheMethodIsSound) {
    std::string const alone = "Mode switching of the paper law made";
    EXPECT_NE(run_scene({}).out.find(alone), std::string::npos);
    Outcome const fixed = run_scene({"--set", "integrator.method=rk4", "--set", "integrator.step=2 us"});
    EXPECT_EQ(fixed.out.find(alone), std::string::npos);
    EXPECT_NE(fixed.out.find("The paper law's mode switching and the errors of rk4 together made"), std::string::npos)
        << fixed.out << fixed.err;
}

TEST_F(Run, SaysWhatToDoWhenStepsAreSpent) {
    std::vector<std::string> const options{"--max-failures", "100%", "--set", "integrator.max_steps=3"};
    Outcome const outcome = run_scene(options);
    EXPECT_NE(outcome.out.find("37 members spent integrator.max_steps = 3: try a larger one, looser rtol and atol, "
                               "or look at one with --member K.\n"),
              std::string::npos)
        << outcome.out;
    EXPECT_EQ(run_scene({}).out.find("spent"), std::string::npos);
}

TEST_F(Run, WarnsOfAKeyWithoutEffect) {
    Outcome const outcome = run_scene({"--set", "integrator.method=dopri5", "--set", "integrator.step=1 us"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "warning: integrator.step has no effect with method dopri5\n");
}

TEST_F(Run, GivesTheSameNumbersWithAnyThreads) {
    std::vector<std::string> hashes;
    for (char const* const threads : {"1", "2", "4"}) {
        std::string const name = std::string(threads) + ".nc";
        ASSERT_EQ(run_scene({"--threads", threads, "-o", name}).code, 0);
        hashes.push_back(results(name).computed_hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_F(Run, ReplaysOneMemberBitForBit) {
    ASSERT_EQ(run_scene({}).code, 0);
    ASSERT_EQ(run_scene({"--member", "29"}).code, 0);
    ASSERT_EQ(run_scene({"--members", "28..30", "-o", "three.nc"}).code, 0);
    ResultReader const all = results("s.nc"), one = results("s_member_29.nc"), three = results("three.nc");
    EXPECT_EQ(one.values("member"), std::vector<double>{29});
    EXPECT_EQ(three.values("member"), (std::vector<double>{28, 29, 30}));
    for (char const* const name : {"initial_y", "steps_accepted", "rhs_evaluations", "final_y", "final_vy", "final_wx",
                                   "drive_work", "energy_residual"}) {
        EXPECT_EQ(one.values(name)[0], all.values(name)[29]) << name;
        EXPECT_EQ(three.values(name)[1], all.values(name)[29]) << name;
    }
}

TEST_F(Run, CountsAndReplaysMembersWithUnusableInputs) {
    // About one in six of these masses is negative.
    std::vector<std::string> const vary{"--set", R"(study.vary."mechanism.slider_mass"={dist="norm",mean=0.2,sd=0.2})", "--set",
                                        R"(study.duration="1 ms")", "--any-start"};
    auto const with = [&](std::vector<std::string> options) {
        options.insert(options.end(), vary.begin(), vary.end());
        return run_scene(options);
    };
    Outcome const outcome = with({});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.err.find("more than --max-failures 1%"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("invalid_inputs: mechanism.slider_mass is -"), std::string::npos) << outcome.out;

    ResultReader const file = results("s.nc");
    auto const status = file.values("status"), mass = file.values("mechanism_slider_mass"), y = file.values("final_y");
    std::uint64_t failed = 0;
    for (std::size_t i = 0; i < status.size(); ++i) {
        bool const usable = mass[i] > 0;
        EXPECT_EQ(status[i] == static_cast<double>(Status::invalid_inputs), !usable) << i;
        EXPECT_EQ(std::isnan(y[i]), !usable) << i;
        failed += !usable;
    }
    ASSERT_GT(failed, 0u);
    EXPECT_EQ(with({"--max-failures", std::to_string(failed)}).code, 0);
    EXPECT_EQ(with({"--max-failures", std::to_string(failed - 1)}).code, 3);
    EXPECT_EQ(with({"--max-failures", "100%"}).code, 0);
    EXPECT_EQ(with({"--max-failures", "0%"}).code, 3);

    // The printed command, followed by a shell, ends as that member did.
    std::istringstream lines(outcome.out);
    std::string line, command;
    while (std::getline(lines, line)) {
        if (command.empty() && line.starts_with("    slideway ")) command = line.substr(13);
    }
    ASSERT_NE(command, "");
    std::string const shell =
        "cd '" + path("").string() + "' && '" SLIDEWAY_BINARY "' " + command + " -o one.nc >/dev/null 2>&1";
    EXPECT_EQ(WEXITSTATUS(std::system(shell.c_str())), 3);
    EXPECT_EQ(results("one.nc").values("status"), std::vector<double>{static_cast<double>(Status::invalid_inputs)});
}

TEST_F(Run, PrintsTheCommandThatRepeatsAPoisonedMember) {
    // A few members start where the rod does not reach, others so deep in the way that they spend their steps.
    std::vector<std::string> const poison{"--set", R"(study.vary."initial.y"={dist="norm",mean="0 mm",sd="70 mm"})",
                                          "--set", "integrator.max_steps=2000"};
    std::vector<std::string> options{"--any-start", "--max-failures", "100%"};
    options.insert(options.end(), poison.begin(), poison.end());
    Outcome const outcome = run_scene(options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const file = results("s.nc");
    auto const status = file.values("status");
    for (Status const kind : {Status::geometry, Status::max_steps}) {
        EXPECT_GT(std::count(status.begin(), status.end(), static_cast<double>(kind)), 0) << static_cast<int>(kind);
    }
    auto const bad = std::find_if(status.begin(), status.end(), [](double s) { return s != 0; });
    ASSERT_NE(bad, status.end());
    auto const member = static_cast<std::size_t>(bad - status.begin());
    auto const named =
        outcome.out.find(fmt::format("  member {}: {}", member, status_names[static_cast<std::size_t>(*bad)]));
    ASSERT_NE(named, std::string::npos) << outcome.out;
    auto const at = outcome.out.find("    slideway ", named);
    ASSERT_NE(at, std::string::npos);
    std::string const command = outcome.out.substr(at + 13, outcome.out.find('\n', at) - at - 13);
    EXPECT_TRUE(command.ends_with(fmt::format("--member {}", member))) << command;

    std::string const shell =
        "cd '" + path("").string() + "' && '" SLIDEWAY_BINARY "' " + command + " -o one.nc >/dev/null 2>&1";
    EXPECT_EQ(WEXITSTATUS(std::system(shell.c_str())), 3);
    ResultReader const one = results("one.nc");
    EXPECT_EQ(one.values("status"), std::vector<double>{*bad});
    for (char const* const name : {"end_time", "steps_accepted", "steps_rejected", "rhs_evaluations", "initial_y"}) {
        EXPECT_EQ(one.values(name)[0], file.values(name)[member]) << name;
    }
}

TEST_F(Run, OfOneMemberHasNoStandardDeviation) {
    Outcome const outcome = run_scene({"--member", "3"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("value\n"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("median"), std::string::npos) << outcome.out;
}

TEST_F(Run, ToAClosedOutputIsNoSuccess) {
    std::string const shell = "cd '" + path("").string() + "' && '" SLIDEWAY_BINARY "' list >/dev/full 2>err";
    EXPECT_EQ(WEXITSTATUS(std::system(shell.c_str())), 4);
    EXPECT_NE(file_text(path("err")), "");
}

TEST_F(Run, GoesOnWhereNobodyCanReadWhatItSays) {
    std::string const here = "cd '" + path("").string() + "' && '" SLIDEWAY_BINARY "' ";
    int of_lost_lines = 0;
    for (std::string const closed : {" 2>/dev/full", " 2>&-"}) {
        auto const code = [&](std::string const& words) { return WEXITSTATUS(std::system((here + words + " >/dev/null" + closed).c_str())); };
        EXPECT_EQ(code("check nope.toml"), 2) << closed;
        EXPECT_EQ(code("info nope.nc"), 4) << closed;
        EXPECT_EQ(code("nonsense"), 2) << closed;
        EXPECT_EQ(code("run s.toml -o lost" + std::to_string(of_lost_lines) + ".nc"), 0) << closed;
        EXPECT_EQ(results("lost" + std::to_string(of_lost_lines++) + ".nc").values("status").size(), 37u);
    }
}

TEST_F(Run, SendsNoControlCharactersToATerminal) {
    std::string scene = small_scene;
    scene.replace(scene.find("A small ensemble"), 16, "A \\u001b[2Jsmall\\u0007 ensemble");
    write("s.toml", scene);
    Outcome const outcome = run_scene({});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (std::string const& text : {outcome.out, run({"info", "s.nc"}).out}) {
        EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](char c) { return c == '\x1b' || c == '\a'; }));
        EXPECT_NE(text.find("small"), std::string::npos);
    }
}

TEST_F(Run, InfoTellsOfItsResults) {
    ASSERT_EQ(run_scene({}).code, 0);
    Outcome const outcome = run({"info", "s.nc", "--scene"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    for (char const* const word : {"A small ensemble", "matches the data", "member           37", "sample           6",
                                   "finished         37", "drive_work", "[study.vary]"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word << "\n" << outcome.out;
    }
}

TEST_F(Run, InfoNoticesAChangedNumber) {
    ASSERT_EQ(run_scene({}).code, 0);
    double const victim = results("s.nc").values("final_vy")[5];
    std::string bytes = file_text(path("s.nc"));
    std::string pattern(sizeof victim, '\0');
    std::memcpy(pattern.data(), &victim, sizeof victim);
    auto const at = bytes.find(pattern);
    ASSERT_NE(at, std::string::npos);
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    std::ofstream(path("s.nc"), std::ios::binary) << bytes;
    Outcome const outcome = run({"info", "s.nc"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.out.find("DOES NOT MATCH"), std::string::npos);
    EXPECT_NE(outcome.err.find("s.nc"), std::string::npos);
}

}  // namespace
}  // namespace slideway::testing::run_test
