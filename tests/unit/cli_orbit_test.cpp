// Studies of orbits as a user runs them: sections, exponents and sweeps, and that their numbers depend on nothing but the scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "cli_process.hpp"
#include "host/backend/backend.hpp"
#include "host/output/result_reader.hpp"
#include "kernels/status.hpp"
#include "tests/oracle/oracle.hpp"

namespace slideway::testing {
namespace {

constexpr double speed = 100, turn = 2 * std::numbers::pi / speed;
constexpr std::size_t member_total = 11;  // a pack of eight, and a rest

std::string scene(std::string const& study, std::string const& law = "conservative") {
    return fmt::format(
        "schema = 1\ntitle = \"Orbits\"\n[mechanism]\ncrank_speed = {}\n[contact]\nlaw = \"{}\"\n[friction]\n"
        "[initial]\nz = \"0.005 mm\"\nroll = 1e-4\nyaw = 2e-4\npitch = -1e-4\n[study]\n{}\n"
        "[study.vary]\n\"initial.y\" = {{ dist = \"unif\", low = \"-0.03 mm\", high = \"0.03 mm\" }}\n",
        speed, law, study);
}

std::string const ensemble = scene("kind = \"ensemble\"\nmembers = 11");
std::string const lyapunov =
    scene("kind = \"lyapunov\"\nmembers = 11\nTtr = \"10 ms\"\nduration = \"50 ms\"\ndt = \"0.5 ms\"\nexponents = 2",
          "paper");
std::string const by_phase =
    scene("kind = \"poincare\"\nmembers = 11\ntransient_revolutions = 0\nrevolutions = 2\nphase = \"90 deg\"");
std::string const by_state = scene(
    "kind = \"poincare\"\nmembers = 11\nTtr = \"10 ms\"\nduration = \"50 ms\"\n"
    "section = { on = \"y\", value = \"0.03 mm\", direction = \"falling\" }");
std::string const by_gap = scene(
    "kind = \"poincare\"\nmembers = 11\nTtr = \"10 ms\"\nduration = \"50 ms\"\n"
    "section = { on = \"gap_y[P2]\", value = \"0.02 mm\" }");
std::string const sweep = scene(
    "kind = \"sweep\"\nmembers = 3\nparameter = \"joint.clearance\"\nvalues = [\"0.2 mm\", \"0.1 mm\"]\n"
    "transient_revolutions = 0\nrevolutions = 2\nphase = \"90 deg\"\nexponents = 1\nrescalings_per_revolution = 20");
std::string const plain_sweep = scene(
    "kind = \"sweep\"\nmembers = 3\nparameter = \"joint.clearance\"\nvalues = [\"0.2 mm\", \"0.1 mm\"]\n"
    "transient_revolutions = 0\nrevolutions = 2\nphase = \"90 deg\"\nexponents = 0");

std::string const continued_key = "study.start=continue";

std::vector<std::string> const state_names{"y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz"};
using State = std::array<double, 10>;
struct Section {
    double time;
    State state;
    friend bool operator==(Section const&, Section const&) = default;
};

/// By member, in the order of the file.
std::vector<std::vector<Section>> sections_of(ResultReader const& file) {
    std::vector<std::vector<double>> columns;
    for (std::string const& name : state_names) columns.push_back(file.values("section_" + name));
    auto const times = file.values("section_time");
    std::vector<std::vector<Section>> sections;
    std::size_t row = 0;
    for (double const count : file.values("section_count")) {
        auto& of_member = sections.emplace_back();
        for (double i = 0; i < count; ++i, ++row) {
            of_member.push_back({times.at(row), {}});
            for (std::size_t j = 0; j < columns.size(); ++j) of_member.back().state[j] = columns[j].at(row);
        }
    }
    EXPECT_EQ(row, times.size());
    return sections;
}

std::vector<State> final_states(ResultReader const& file) {
    std::vector<State> states(file.values("status").size());
    for (std::size_t j = 0; j < state_names.size(); ++j) {
        auto const column = file.values("final_" + state_names[j]);
        for (std::size_t i = 0; i < states.size(); ++i) states[i][j] = column[i];
    }
    return states;
}

/// The bits of member i's row, for numbers that may be NaN.
std::vector<double> row(ResultReader const& file, std::string const& name, std::size_t i) {
    auto const values = file.values(name);
    std::size_t const width = values.size() / file.values("status").size();
    std::vector<double> found(values.begin() + static_cast<std::ptrdiff_t>(i * width),
                              values.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
    for (double& x : found) {
        if (std::isnan(x)) x = 1e300;
    }
    return found;
}

/// All that a file holds of member i, but for its sections.
std::map<std::string, std::vector<double>> member_of(ResultReader const& file, std::size_t i) {
    std::map<std::string, std::vector<double>> values;
    for (std::string const& name : file.variable_names()) {
        bool const along_members =
            !name.starts_with("section_") && name != "exponent" && name != "history" && name != "member";
        if (along_members) values[name] = row(file, name, i);
    }
    return values;
}

class OrbitProgram : public Program {
protected:
    Outcome run_scene(std::string const& text, std::vector<std::string> options = {}) const {
        write("s.toml", text);
        options.insert(options.begin(), {"run", "s.toml", "--quiet"});
        return run(std::move(options));
    }
    /// Runs to the end without complaint.
    ResultReader results_of(std::string const& text, std::vector<std::string> options = {}) const {
        options.insert(options.end(), {"-o", "r.nc"});
        Outcome const outcome = run_scene(text, std::move(options));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return results();
    }
    ResultReader results(std::string const& name = "r.nc") const { return ResultReader(path(name).string()); }
};

// ---- what holds of every study ----

struct Study {
    char const* name;
    std::string scene;
    std::vector<std::string> options;
};
void PrintTo(Study const& study, std::ostream* out) { *out << study.name; }

std::vector<Study> const studies{
    {"Lyapunov", lyapunov, {}},        {"SectionsByPhase", by_phase, {}},
    {"SectionsByState", by_state, {}}, {"SectionsByGap", by_gap, {}},
    {"FreshSweep", sweep, {}},         {"ContinuedSweep", sweep, {"--set", continued_key}}};

class EveryOrbitStudy : public OrbitProgram, public ::testing::WithParamInterface<Study> {
protected:
    ResultReader with(std::vector<std::string> options) const {
        options.insert(options.end(), GetParam().options.begin(), GetParam().options.end());
        return results_of(GetParam().scene, options);
    }
    std::string hash(std::vector<std::string> options) const {
        ResultReader const file = with(std::move(options));
        EXPECT_EQ(file.stored_hash(), file.computed_hash());
        return file.stored_hash();
    }
};

TEST_P(EveryOrbitStudy, GivesTheSameNumbersWithAnyThreads) {
    std::string const one = hash({"--threads", "1"});
    EXPECT_EQ(hash({"--threads", "2"}), one);
    EXPECT_EQ(hash({"--threads", "4"}), one);
}

TEST_P(EveryOrbitStudy, DependsOnItsSeed) {
    std::string const first = hash({"--set", "study.seed=5"});
    EXPECT_EQ(hash({"--set", "study.seed=5"}), first);
    EXPECT_NE(hash({"--set", "study.seed=6"}), first);
}

TEST_P(EveryOrbitStudy, ReplaysMembersBitForBit) {
    ResultReader const all = with({});
    std::size_t const members = all.values("status").size();
    std::vector<std::map<std::string, std::vector<double>>> expected;
    for (std::size_t i = 0; i < members; ++i) expected.push_back(member_of(all, i));
    bool const has_sections = all.has("section_count");
    auto const sections = has_sections ? sections_of(all) : std::vector<std::vector<Section>>(members);
    for (auto const& [first, last] : {std::pair<std::size_t, std::size_t>{0, 0}, {members - 2, members - 1}, {1, 4}}) {
        ResultReader const part = with({"--members", fmt::format("{}..{}", first, last)});
        ASSERT_EQ(part.values("status").size(), last - first + 1);
        for (std::size_t i = first; i <= last; ++i) {
            EXPECT_EQ(part.values("member")[i - first], static_cast<double>(i));
            for (auto const& [name, values] : member_of(part, i - first)) {
                EXPECT_EQ(values, expected[i].at(name))
                    << name << " of member " << i << " in " << first << ".." << last;
            }
            if (has_sections) {
                EXPECT_EQ(sections_of(part)[i - first], sections[i]) << i;
            }
        }
    }
}

TEST_P(EveryOrbitStudy, IsToldByInfo) {
    ResultReader const file = with({});
    Outcome const outcome = run({"info", "r.nc"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("matches the data"), std::string::npos);
    EXPECT_EQ(outcome.out.find("Lyapunov exponents [1/s]") != std::string::npos, file.has("lyapunov_exponent"));
    if (file.has("section_count")) {
        std::string const line = fmt::format("{} of all members", file.values("section_time").size());
        EXPECT_NE(outcome.out.find(line), std::string::npos) << outcome.out;
    }
    if (!file.has("lyapunov_exponent")) return;
    auto const exponents = file.values("lyapunov_exponent");
    std::size_t const members = file.values("status").size(), width = exponents.size() / members;
    for (std::size_t j = 0; j < width; ++j) {
        double sum = 0;
        for (std::size_t i = 0; i < members; ++i) sum += exponents[i * width + j];
        std::string const mean = fmt::format("{:.4g} ± ", sum / static_cast<double>(members));
        EXPECT_NE(outcome.out.find(mean), std::string::npos) << mean << outcome.out;
    }
}

auto const name_of_study = [](auto const& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Studies, EveryOrbitStudy, ::testing::ValuesIn(studies), name_of_study);

class OrbitsOverInstructions : public OrbitProgram, public ::testing::WithParamInterface<std::tuple<Study, Isa>> {};

TEST_P(OrbitsOverInstructions, HaveTheBitsOfTheScalarRun) {
    auto const& [study, isa] = GetParam();
    if (!is_supported(isa)) GTEST_SKIP() << "this machine has no " << name_of(isa);
    auto const hash = [&, &study = study](std::string const& name) {
        std::vector<std::string> options{"--isa", name, "--threads", "2"};
        options.insert(options.end(), study.options.begin(), study.options.end());
        return results_of(study.scene, options).computed_hash();
    };
    EXPECT_EQ(hash(std::string(name_of(isa))), hash("scalar"));
}

INSTANTIATE_TEST_SUITE_P(Studies, OrbitsOverInstructions,
                         ::testing::Combine(::testing::ValuesIn(studies), ::testing::Values(Isa::avx2, Isa::avx512)),
                         [](auto const& info) {
                             return fmt::format("{}_{}", std::get<0>(info.param).name,
                                                name_of(std::get<1>(info.param)));
                         });

// ---- exponents ----

class Exponents : public OrbitProgram {};

TEST_F(Exponents, HaveTheirVariables) {
    ResultReader const file = results_of(lyapunov, {"--set", "study.history=10"});
    EXPECT_EQ(file.values("status"), std::vector<double>(member_total, 0));
    using Shape = std::vector<std::size_t>;
    EXPECT_EQ(file.shape("lyapunov_exponent"), (Shape{member_total, 2}));
    EXPECT_EQ(file.shape("lyapunov_exponent_error"), (Shape{member_total, 2}));
    EXPECT_EQ(file.shape("lyapunov_history"), (Shape{member_total, 10, 2}));
    EXPECT_EQ(file.shape("kaplan_yorke_dimension"), (Shape{member_total}));
    EXPECT_EQ(file.shape("lost_offsets"), (Shape{member_total}));
    EXPECT_EQ(file.values("exponent"), (std::vector<double>{1, 2}));
    EXPECT_EQ(file.values("history"), (std::vector<double>{10, 20, 30, 40, 50, 60, 70, 80, 90, 100}));
    EXPECT_FALSE(file.has("section_count"));
    auto const end = file.values("end_time"), time = file.values("lyapunov_time"),
               resolution = file.values("lyapunov_resolution"), exponents = file.values("lyapunov_exponent");
    for (std::size_t i = 0; i < member_total; ++i) {
        EXPECT_DOUBLE_EQ(end[i], 0.06);
        EXPECT_DOUBLE_EQ(time[i], 0.05);
        EXPECT_DOUBLE_EQ(resolution[i], 1e-15 / (1e-6 * 5e-4));  // rounding over d0 and dt
        EXPECT_GE(exponents[2 * i], exponents[2 * i + 1]);
        EXPECT_TRUE(std::isfinite(exponents[2 * i + 1]));
    }
}

TEST_F(Exponents, AreTheEndOfTheirHistory) {
    // Of so short a run QR leaves some of ten out of order: each history must go with its own exponent.
    for (std::size_t const count : {1u, 10u}) {
        ResultReader const file =
            results_of(lyapunov, {"--set", fmt::format("study.exponents={}", count), "--set", "study.history=7"});
        auto const exponents = file.values("lyapunov_exponent"), history = file.values("lyapunov_history");
        EXPECT_EQ(file.values("history").back(), 100);
        for (std::size_t i = 0; i < member_total; ++i) {
            for (std::size_t j = 0; j < count; ++j) {
                double const value = exponents[count * i + j];
                EXPECT_NEAR(history[(7 * i + 6) * count + j], value, 1e-11 * (1 + std::abs(value))) << i << ' ' << j;
            }
        }
        EXPECT_EQ(file.has("kaplan_yorke_dimension"), count > 1);
    }
    EXPECT_FALSE(results_of(lyapunov, {"--set", "study.history=0"}).has("lyapunov_history"));
}

TEST_F(Exponents, ShowEachPointOfAShortHistoryOnce) {
    for (int const points : {1, 2, 5, 6}) {
        Outcome const outcome = run_scene(lyapunov, {"--set", fmt::format("study.history={}", points)});
        std::size_t shown = 0;
        for (auto at = outcome.out.find(" after "); at != std::string::npos; at = outcome.out.find(" after ", at + 1))
            ++shown;
        EXPECT_EQ(shown, std::min<std::size_t>(5, static_cast<std::size_t>(points))) << outcome.out;
        EXPECT_NE(outcome.out.find("after 100 rescalings"), std::string::npos) << outcome.out;
    }
}

/// Steps that half of the members need more than.
std::uint64_t steps_of_half(ResultReader const& file) {
    auto steps = file.values("steps_accepted");
    auto const rejected = file.values("steps_rejected");
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += rejected[i];
    std::sort(steps.begin(), steps.end());
    EXPECT_LT(steps.front(), steps.back());
    return static_cast<std::uint64_t>(steps[steps.size() / 2 - 1]);
}

TEST_F(Exponents, OfAFailedMemberDisturbNobody) {
    ResultReader const whole = results_of(lyapunov);
    std::uint64_t const limit = steps_of_half(whole);
    auto const accepted = whole.values("steps_accepted"), rejected = whole.values("steps_rejected");
    std::vector<std::map<std::string, std::vector<double>>> expected;
    for (std::size_t i = 0; i < member_total; ++i) expected.push_back(member_of(whole, i));
    std::vector<std::string> const options{"--set", fmt::format("integrator.max_steps={}", limit), "-o", "r.nc"};
    Outcome const outcome = run_scene(lyapunov, options);
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("Lyapunov exponents [1/s]"), std::string::npos) << outcome.out;
    ResultReader const file = results();
    auto const status = file.values("status"), time = file.values("lyapunov_time"),
               history = file.values("lyapunov_history");
    for (std::size_t i = 0; i < member_total; ++i) {
        bool const fails = accepted[i] + rejected[i] > static_cast<double>(limit);
        EXPECT_EQ(status[i], static_cast<double>(fails ? Status::max_steps : Status::finished)) << i;
        if (!fails) {
            EXPECT_EQ(member_of(file, i), expected[i]) << i;
            continue;
        }
        EXPECT_LT(time[i], 0.05);
        EXPECT_TRUE(std::isnan(history[i * (history.size() / member_total)])) << i;
    }
    EXPECT_EQ(run({"info", "r.nc"}).code, 0);
}

TEST_F(Exponents, OfMembersThatFailAtOnceAreNone) {
    Outcome const outcome =
        run_scene(lyapunov, {"--max-failures", "100%", "--set", "integrator.max_steps=3", "-o", "r.nc"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("No member finished: there are no exponents."), std::string::npos) << outcome.out;
    ResultReader const file = results();
    for (char const* const name :
         {"lyapunov_exponent", "lyapunov_exponent_error", "lyapunov_history", "kaplan_yorke_dimension"}) {
        for (double const x : file.values(name)) EXPECT_TRUE(std::isnan(x)) << name;
    }
    EXPECT_EQ(file.values("lyapunov_time"), std::vector<double>(member_total, 0));
}

// ---- sections at a crank angle ----

class SectionsByPhase : public OrbitProgram {};

TEST_F(SectionsByPhase, ComeOnceATurn) {
    ResultReader const file = results_of(by_phase, {"--set", "study.transient_revolutions=1"});
    EXPECT_EQ(file.values("section_count"), std::vector<double>(member_total, 2));
    auto const sections = sections_of(file);
    auto const states = final_states(file);
    for (std::size_t i = 0; i < member_total; ++i) {
        EXPECT_DOUBLE_EQ(sections[i][0].time, 1.25 * turn);  // the passage at a quarter turn is transient
        EXPECT_DOUBLE_EQ(sections[i][1].time, 2.25 * turn);
        EXPECT_EQ(sections[i][1].state, states[i]);  // the last section ends the run
        EXPECT_EQ(file.values("end_time")[i], sections[i][1].time);
    }
}

// Both runs end a step at that time, to the last bit: up to there neither knows what comes later.
TEST_F(SectionsByPhase, AreTheFinalStatesOfAnEnsembleOfThatDuration) {
    auto const sections = sections_of(results_of(by_phase));
    auto const ends =
        final_states(results_of(ensemble, {"--set", fmt::format("study.duration={:.17g}", sections[0][0].time)}));
    for (std::size_t i = 0; i < member_total; ++i) {
        EXPECT_EQ(sections[i][0].time, sections[0][0].time);
        EXPECT_EQ(sections[i][0].state, ends[i]) << i;
    }
    EXPECT_NE(ends[0], ends[1]);
}

TEST_F(SectionsByPhase, OfATransientAreThoseOfARunWithout) {
    auto const whole = sections_of(results_of(by_phase, {"--set", "study.revolutions=3"}));
    auto const later =
        sections_of(results_of(by_phase, {"--set", "study.revolutions=2", "--set", "study.transient_revolutions=1"}));
    for (std::size_t i = 0; i < member_total; ++i) {
        EXPECT_EQ(later[i], (std::vector<Section>{whole[i][1], whole[i][2]})) << i;
    }
}

TEST_F(SectionsByPhase, OfAFailedMemberAreKept) {
    ResultReader const whole = results_of(by_phase);
    std::uint64_t const limit = steps_of_half(whole);
    auto const expected = sections_of(whole);
    Outcome const outcome = run_scene(
        by_phase, {"--set", fmt::format("integrator.max_steps={}", limit), "--max-failures", "100%", "-o", "r.nc"});
    EXPECT_EQ(outcome.code, 0);
    ResultReader const file = results();
    auto const status = file.values("status"), end = file.values("end_time");
    auto const sections = sections_of(file);
    std::size_t failed = 0, partial = 0;
    for (std::size_t i = 0; i < member_total; ++i) {
        failed += status[i] != 0;
        partial += status[i] != 0 && !sections[i].empty();
        // Those it came to, and no more.
        std::vector<Section> reached;
        for (Section const& section : expected[i]) {
            if (section.time <= end[i]) reached.push_back(section);
        }
        EXPECT_EQ(sections[i], reached) << i;
        EXPECT_EQ(reached.size() == 2, status[i] == 0);
    }
    EXPECT_GT(failed, 0u);
    EXPECT_LT(failed, member_total);
    EXPECT_GT(partial, 0u);
}

TEST_F(SectionsByPhase, OfUnusableMembersAreNone) {
    // About one in six of these clearances is negative.
    std::string const vary = R"(study.vary."joint.clearance"={dist="norm",mean=1e-4,sd=1e-4})";
    Outcome const outcome = run_scene(by_phase, {"--max-failures", "100%", "--set", "study.members=40", "--set",
                                                 "study.revolutions=1", "--set", vary, "-o", "r.nc"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const file = results();
    auto const clearance = file.values("joint_clearance"), counts = file.values("section_count"),
               status = file.values("status");
    EXPECT_LT(*std::min_element(clearance.begin(), clearance.end()), 0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (clearance[i] <= 0) {
            EXPECT_EQ(counts[i], 0) << i;
        } else if (status[i] == 0) {
            EXPECT_EQ(counts[i], 1) << i;
        }
    }
}

// ---- sections where a state or a gap crosses a level ----

class Crossings : public OrbitProgram {
protected:
    static constexpr double level = 3e-5, gap_level = 2e-5;
};

TEST_F(Crossings, OfAStateLieOnItsLevelAndFall) {
    auto const sections = sections_of(results_of(by_state));
    std::size_t count = 0;
    for (auto const& of_member : sections) {
        double before = 0.01;
        for (Section const& section : of_member) {
            ++count;
            EXPECT_NEAR(section.state[0], level, 1e-12 * 1e-4);
            EXPECT_LT(section.state[2], 0);
            EXPECT_GE(section.time, before);
            EXPECT_LE(section.time, 0.01 + 0.05);
            before = section.time;
        }
    }
    EXPECT_GT(count, member_total);
}

TEST_F(Crossings, OfAGapLieOnItsLevelAndOpen) {
    ResultReader const file = results_of(by_gap);
    auto const sections = sections_of(file);
    auto const y = file.values("initial_y");
    Parts parts;
    parts.law = Law::conservative;
    parts.friction = true;
    std::size_t count = 0;
    for (std::size_t i = 0; i < member_total; ++i) {
        Inputs inputs;
        inputs.crank_speed = speed;
        inputs.y = y[i];
        Inputs const completed = oracle::completed(inputs);
        for (Section const& section : sections[i]) {
            ++count;
            auto const there = oracle::evaluate(completed, parts, section.time, section.state);
            EXPECT_NEAR(-there.pen_y[1], gap_level, 1e-12 * 1e-4);
            EXPECT_LT(there.rate_y[1], 0);  // the depth falls where the gap rises
        }
    }
    EXPECT_GT(count, member_total);
}

TEST_F(Crossings, LeaveTheOrbitAsItIs) {
    constexpr double end = 0.01 + 0.05;  // of transient and duration, in binary numbers
    auto const ends = final_states(results_of(ensemble, {"--set", fmt::format("study.duration={:.17g}", end)}));
    for (std::string const& text : {by_state, by_gap}) {
        ResultReader const file = results_of(text);
        EXPECT_EQ(final_states(file), ends);
        EXPECT_EQ(file.values("end_time"), std::vector<double>(member_total, end));
    }
}

TEST_F(Crossings, OfBothDirectionsAreThoseOfEither) {
    for (char const* const on : {"on=\"y\",value=\"0.03 mm\"", "on=\"gap_y[P2]\",value=\"0.02 mm\""}) {
        auto const with = [&](char const* direction) {
            return sections_of(
                results_of(by_state, {"--set", fmt::format("study.section={{{},direction=\"{}\"}}", on, direction)}));
        };
        auto const rising = with("rising"), falling = with("falling"), both = with("both");
        for (std::size_t i = 0; i < member_total; ++i) {
            auto merged = rising[i];
            merged.insert(merged.end(), falling[i].begin(), falling[i].end());
            std::sort(merged.begin(), merged.end(), [](auto const& a, auto const& b) { return a.time < b.time; });
            EXPECT_EQ(both[i], merged) << i;
        }
    }
}

// Between two samples on either side of the level lies an odd number of crossings, else an even one.
TEST_F(Crossings, AreAllThatTheSampledOrbitShows) {
    std::vector<std::string> const method{"--set", "integrator.method=dopri5"};
    auto options = method;
    options.insert(options.end(), {"--set", "study.section={on=\"y\",value=\"0.03 mm\",direction=\"both\"}"});
    auto const sections = sections_of(results_of(by_state, options));
    options = method;
    options.insert(options.end(), {"--set", "study.duration=0.06", "--set", "study.samples=1201"});
    ResultReader const sampled = results_of(ensemble, options);
    auto const y = sampled.values("y"), time = sampled.values("time");
    std::size_t changes = 0;
    for (std::size_t i = 0; i < member_total; ++i) {
        for (std::size_t k = 200; k < 1200; ++k) {  // after the transient of 10 ms
            double const from = time[k], to = time[k + 1];
            auto const between = std::count_if(sections[i].begin(), sections[i].end(), [&](Section const& section) {
                return section.time > from && section.time <= to;
            });
            bool const changed = (y[1201 * i + k] > level) != (y[1201 * i + k + 1] > level);
            changes += changed;
            EXPECT_EQ(between % 2 == 1, changed) << i << " at " << from;
        }
    }
    EXPECT_GT(changes, 2 * member_total);
}

TEST_F(Crossings, BeyondTheirRoomAreCountedAlone) {
    ResultReader const whole = results_of(by_state);
    auto const all = sections_of(whole);
    EXPECT_EQ(whole.values("section_crossings"), whole.values("section_count"));
    Outcome const outcome = run_scene(by_state, {"--set", "study.max_crossings=2", "-o", "r.nc"});
    EXPECT_EQ(outcome.code, 0);
    ResultReader const file = results();
    auto const few = sections_of(file);
    auto const crossings = file.values("section_crossings");
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < member_total; ++i) {
        auto expected = all[i];
        EXPECT_EQ(crossings[i], static_cast<double>(expected.size()));
        if (expected.size() > 2) left_out += expected.size() - 2, expected.resize(2);
        EXPECT_EQ(few[i], expected) << i;
    }
    EXPECT_GT(left_out, 0u);
    EXPECT_EQ(outcome.err,
              fmt::format("warning: {} more crossings are not stored: raise study.max_crossings\n", left_out));
}

TEST_F(Crossings, OfALevelThatNobodyReachesAreWarnedOf) {
    Outcome const outcome = run_scene(by_state, {"--set", "study.section={on=\"y\",value=\"0.5 mm\"}", "-o", "r.nc"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "warning: 11 members never crossed the section: look at study.section, or at the orbit\n");
    ResultReader const file = results();
    EXPECT_EQ(file.values("section_count"), std::vector<double>(member_total, 0));
    EXPECT_EQ(file.shape("section_time"), std::vector<std::size_t>{0});
    EXPECT_EQ(file.shape("section_wz"), std::vector<std::size_t>{0});
    EXPECT_EQ(file.values("status"), std::vector<double>(member_total, 0));
    EXPECT_EQ(run({"info", "r.nc"}).code, 0);
}

// ---- sweeps ----

class Sweep : public OrbitProgram {};

TEST_F(Sweep, GivesEachColumnTheSameStarts) {
    ResultReader const file = results_of(sweep);
    EXPECT_EQ(file.values("joint_clearance"), (std::vector<double>{2e-4, 2e-4, 2e-4, 1e-4, 1e-4, 1e-4}));
    auto const y = file.values("initial_y");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(y[i], y[i + 3]);
    EXPECT_NE(y[0], y[1]);
    EXPECT_EQ(file.values("section_count"), std::vector<double>(6, 2));
    EXPECT_EQ(file.shape("lyapunov_exponent"), (std::vector<std::size_t>{6, 1}));
    for (double const x : file.values("lyapunov_exponent")) EXPECT_TRUE(std::isfinite(x));
    for (double const time : file.values("lyapunov_time")) EXPECT_DOUBLE_EQ(time, turn);
}

TEST_F(Sweep, HasAsColumnsTheSectionsOfItsValues) {
    auto const columns = sections_of(results_of(plain_sweep));
    for (std::size_t column = 0; column < 2; ++column) {
        auto const alone =
            sections_of(results_of(by_phase, {"--set", "study.members=3", "--set",
                                              fmt::format("joint.clearance=\"{} mm\"", column == 0 ? "0.2" : "0.1")}));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(columns[3 * column + i], alone[i]) << column << ' ' << i;
    }
}

TEST_F(Sweep, ContinuedIsFreshInItsFirstColumnAlone) {
    auto const fresh = sections_of(results_of(plain_sweep)),
               continued = sections_of(results_of(plain_sweep, {"--set", continued_key}));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(continued[i], fresh[i]);
        EXPECT_NE(continued[i + 3], fresh[i + 3]);
    }
}

TEST_F(Sweep, ContinuedStartsWhereTheColumnBeforeEnded) {
    ResultReader const file =
        results_of(plain_sweep, {"--set", continued_key, "--set", "study.values=[\"0.1 mm\",\"0.1 mm\"]"});
    auto const columns = sections_of(file);
    for (std::size_t i = 0; i < 3; ++i) {
        // The same, step by step, by hand: the last section as the initial state of a run that starts at its angle.
        State const& start = columns[i].back().state;
        std::vector<std::string> options{"--set", "study.members=1",
                                         "--set", "joint.clearance=\"0.1 mm\"",
                                         "--set", "mechanism.start_angle=\"90 deg\""};
        for (std::size_t j = 0; j < start.size(); ++j) {
            std::string const key = state_names[j] == "y" ? "study.vary.\"initial.y\"" : "initial." + state_names[j];
            std::string const value = state_names[j] == "y" ? "{{dist=\"const\",value={:.17g}}}" : "{:.17g}";
            options.insert(options.end(), {"--set", key + "=" + fmt::format(fmt::runtime(value), start[j])});
        }
        EXPECT_EQ(columns[i + 3], sections_of(results_of(by_phase, options))[0]) << i;
        EXPECT_DOUBLE_EQ(columns[i + 3][0].time, turn);
    }
}

TEST_F(Sweep, ContinuedGoesOnFromTheScenesStartAfterAFailure) {
    // The middle column's gap is a tenth of the others': it takes more steps than it may.
    std::string const values = "study.values=[\"0.5 mm\",\"0.05 mm\",\"0.5 mm\"]";
    ResultReader const whole = results_of(plain_sweep, {"--set", continued_key, "--set", values});
    auto const accepted = whole.values("steps_accepted"), rejected = whole.values("steps_rejected");
    double most = 0, least = 1e300;
    for (std::size_t i = 0; i < 9; ++i) {
        double const steps = accepted[i] + rejected[i];
        if (i / 3 == 1) least = std::min(least, steps);
        if (i / 3 == 0) most = std::max(most, steps);
    }
    ASSERT_LT(most, least);
    Outcome const outcome =
        run_scene(plain_sweep, {"--max-failures", "100%", "--set", continued_key, "--set", values, "--set",
                                fmt::format("integrator.max_steps={:.0f}", most), "-o", "r.nc"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const file = results();
    EXPECT_EQ(file.values("status"), (std::vector<double>{0, 0, 0, 2, 2, 2, 0, 0, 0}));
    auto const columns = sections_of(file);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(columns[i + 6], columns[i]) << i;
}

TEST_F(Sweep, OutOfTimeLeavesAWholeFile) {
    for (std::string const start : {"fresh", "continue"}) {
        Outcome const outcome = run_scene(sweep, {"--max-hours", "0", "--set", "study.start=" + start, "-o", "r.nc"});
        EXPECT_EQ(outcome.code, 5);
        EXPECT_NE(outcome.err.find("6 of 6 members were not run"), std::string::npos) << outcome.err;
        ResultReader const file = results();
        EXPECT_EQ(file.values("status"), std::vector<double>(6, -1));
        EXPECT_EQ(file.values("section_count"), std::vector<double>(6, 0));
        EXPECT_EQ(file.stored_hash(), file.computed_hash());
    }
}

}  // namespace
}  // namespace slideway::testing
