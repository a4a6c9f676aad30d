// Sections as a user asks for them: at a crank angle, and where a state or a gap crosses a level.
#include <algorithm>

#include "kernels/laws/list.hpp"
#include "tests/system/orbits.hpp"

#include "tests/oracle/oracle.hpp"

namespace slideway::testing::orbits::sections_test {
namespace {

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
    // About one in six of these masses is negative.
    std::string const vary = R"(study.vary."mechanism.slider_mass"={dist="norm",mean=0.2,sd=0.2})";
    Outcome const outcome = run_scene(by_phase, {"--any-start", "--max-failures", "100%", "--set", "study.members=40", "--set",
                                                 "study.revolutions=1", "--set", vary, "-o", "r.nc"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ResultReader const file = results();
    auto const mass = file.values("mechanism_slider_mass"), counts = file.values("section_count"),
               status = file.values("status");
    EXPECT_LT(*std::min_element(mass.begin(), mass.end()), 0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (mass[i] <= 0) {
            EXPECT_EQ(counts[i], 0) << i;
        } else if (status[i] == 0) {
            EXPECT_EQ(counts[i], 1) << i;
        }
    }
}

// ---- sections where a state or a gap crosses a level ----

class SectionsByCrossing : public OrbitProgram {
protected:
    static constexpr double level = 3e-5, gap_level = 2e-5;
};

TEST_F(SectionsByCrossing, OfAStateLieOnItsLevelAndFall) {
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

TEST_F(SectionsByCrossing, OfAGapLieOnItsLevelAndOpen) {
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
            oracle::State state{};
            std::copy(section.state.begin(), section.state.end(), state.begin());
            auto const there = oracle::evaluate(completed, parts, section.time, state);
            EXPECT_NEAR(-there.pen_y[1], gap_level, 1e-12 * 1e-4);
            EXPECT_LT(there.rate_y[1], 0);  // the depth falls where the gap rises
        }
    }
    EXPECT_GT(count, member_total);
}

TEST_F(SectionsByCrossing, LeaveTheOrbitAsItIs) {
    constexpr double end = 0.01 + 0.05;  // of transient and duration, in binary numbers
    auto const ends = final_states(results_of(ensemble, {"--set", fmt::format("study.duration={:.17g}", end)}));
    for (std::string const& text : {by_state, by_gap}) {
        ResultReader const file = results_of(text);
        EXPECT_EQ(final_states(file), ends);
        EXPECT_EQ(file.values("end_time"), std::vector<double>(member_total, end));
    }
}

TEST_F(SectionsByCrossing, OfBothDirectionsAreThoseOfEither) {
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
TEST_F(SectionsByCrossing, AreAllThatTheSampledOrbitShows) {
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

TEST_F(SectionsByCrossing, BeyondTheirRoomAreCountedAlone) {
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

TEST_F(SectionsByCrossing, OfALevelThatNobodyReachesAreWarnedOf) {
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

}  // namespace
}  // namespace slideway::testing::orbits::sections_test
