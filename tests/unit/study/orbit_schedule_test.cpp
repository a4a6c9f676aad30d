// When members stop: times of crank angles, numbers of stops and records, and where shadows start.
#include "host/study/ensemble_plan.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/config/descriptors.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::orbit_schedule_test {
namespace {

using testing::scene_of;
constexpr double pi = std::numbers::pi;

/// A crank of 2 rad/s: a turn lasts π seconds.
Scene study(std::string const& kind, std::string const& lines) {
    return scene_of(fmt::format("schema = 1\n[mechanism]\ncrank_speed = 2\n[study]\nkind = \"{}\"\n{}", kind, lines));
}
Scene sweep(std::string const& lines) {
    return study("sweep", "parameter = \"joint.clearance\"\nvalues = [1e-4, 2e-4]\n" + lines);
}

Inputs crank(double speed, double start_angle = 0) {
    Inputs inputs;
    inputs.crank_speed = speed;
    inputs.start_angle = start_angle;
    return inputs;
}

// ---- times of crank angles ----

TEST(OrbitSchedule, OfACarriageGoesByItsPeriod) {
    // T = 2 (0.1/0.5 + 0.3) = 1 s; another speed, another T of the same number of sections.
    Scene const scene = scene_of(
        "schema = 1\n[mechanism]\nkind = \"carriage\"\ncarriage_speed = 0.5\nstroke = 0.1\nreversal_time = "
        "0.3\n[study]\n"
        "kind = \"poincare\"\ntransient_revolutions = 2\nrevolutions = 3\nphase = \"90 deg\"\n");
    OrbitSchedule const schedule = orbit_schedule(scene);
    EXPECT_EQ(schedule.stops.transient, 2u);
    EXPECT_EQ(schedule.stops.sections(), 3u);
    EXPECT_DOUBLE_EQ(schedule.timing(scene.inputs).first_stop, 0.25);
    EXPECT_DOUBLE_EQ(schedule.timing(scene.inputs).end, 4.25);
    Inputs slower = scene.inputs;
    slower.carriage_speed = 0.125;  // T = 2.2 s
    EXPECT_DOUBLE_EQ(schedule.timing(slower).first_stop, 0.55);
    EXPECT_DOUBLE_EQ(schedule.timing(slower).period, 2.2);
}

TEST(FirstTimeAt, IsThatOfTheNextPassage) {
    EXPECT_DOUBLE_EQ(first_time_at(1, Parts{}, crank(2)), 0.5);
    EXPECT_DOUBLE_EQ(first_time_at(1, Parts{}, crank(2, 0.5)), 0.25);
    EXPECT_DOUBLE_EQ(first_time_at(1, Parts{}, crank(2, 1.5)), (2 * pi - 0.5) / 2);
    EXPECT_DOUBLE_EQ(first_time_at(-1, Parts{}, crank(2)), (2 * pi - 1) / 2);
}

TEST(FirstTimeAt, GoesTheOtherWayRoundWithANegativeSpeed) {
    EXPECT_DOUBLE_EQ(first_time_at(1, Parts{}, crank(-2)), (2 * pi - 1) / 2);
    EXPECT_DOUBLE_EQ(first_time_at(-1, Parts{}, crank(-2)), 0.5);
    EXPECT_DOUBLE_EQ(first_time_at(0.5, Parts{}, crank(-2, 1)), 0.25);
}

TEST(FirstTimeAt, IsAWholeTurnWhereTheCrankStarts) {
    for (double const speed : {2.0, -2.0, pi, 0.1}) {
        double const turn = 2 * pi / std::abs(speed);
        for (double const start : {0.0, 1.0, -2.5, 40.0}) {
            EXPECT_DOUBLE_EQ(first_time_at(start, Parts{}, crank(speed, start)), turn) << speed << ' ' << start;
            // Another turn of the same angle differs by rounding alone, and may not give a stop at the start.
            for (int const turns : {1, 2, 3, 7, -1, -5}) {
                EXPECT_NEAR(first_time_at(start + 2 * pi * turns, Parts{}, crank(speed, start)), turn, 2e-9 * turn)
                    << speed << ' ' << start << ' ' << turns;
            }
        }
    }
}

TEST(FirstTimeAt, FindsEveryAngleWithinATurn) {
    for (double const speed : {3.0, -3.0, 0.7}) {
        for (double const start : {0.0, 2.0, -9.0}) {
            for (double phase = -13; phase < 13; phase += 0.37) {
                double const time = first_time_at(phase, Parts{}, crank(speed, start));
                EXPECT_GT(time, 0);
                EXPECT_LE(time, 2 * pi / std::abs(speed) * (1 + 1e-9));
                EXPECT_NEAR(std::remainder(start + speed * time - phase, 2 * pi), 0, 1e-13);
            }
        }
    }
}

// ---- numbers of stops ----

TEST(OrbitSchedule, OfAnEnsembleHasNoStops) {
    OrbitSchedule const schedule = orbit_schedule(scene_of("schema = 1\n[study]\nkind = \"ensemble\"\nmembers = 2\nduration = \"20 ms\""));
    EXPECT_FALSE(schedule.timing);
    EXPECT_EQ(schedule.stops.count, 0u);
    EXPECT_EQ(schedule.section_rows(), 0u);
    EXPECT_EQ(schedule.end, 0.02);
}

TEST(OrbitSchedule, OfAPoincareSectionStopsOnceATurn) {
    OrbitSchedule const schedule =
        orbit_schedule(study("poincare", "phase = 1.0\ntransient_revolutions = 4\nrevolutions = 7\n"));
    // Passages 0 … 3 are the transient, 4 … 10 are kept.
    EXPECT_EQ(schedule.stops.count, 11u);
    EXPECT_EQ(schedule.stops.transient, 4u);
    EXPECT_EQ(schedule.stops.sections(), 7u);
    EXPECT_TRUE(schedule.sections);
    EXPECT_EQ(schedule.section_rows(), 7u);
    MemberClock const clock = schedule.timing(crank(2));
    EXPECT_DOUBLE_EQ(clock.first_stop, 0.5);
    EXPECT_DOUBLE_EQ(clock.period, pi);
    EXPECT_DOUBLE_EQ(clock.end, 0.5 + 10 * pi);
    EXPECT_EQ(schedule.end, clock.end);
}

TEST(OrbitSchedule, HasTheSectionsOfTheRecordAndOneAtLeast) {
    using Counts = std::pair<std::size_t, std::size_t>;  // left out, and recorded
    auto const counts = [](std::string const& drive, std::string const& lines) {
        StopPlan const stops = orbit_schedule(scene_of("schema = 1\n[mechanism]\nstart_angle = 1.7\n" + drive + "[study]\nkind = \"poincare\"\n" + lines)).stops;
        return Counts{stops.transient / stops.section_every, stops.sections()};
    };
    // Of 30 rad/s, T = 0.2094 s: sections at 0.1528, 0.3622, 0.5717 and 0.7811 s, or after 0.729, 1.729 … turns.
    std::string const clock = "crank_speed = 30\n", turns = clock + "[drive]\nkind = \"torque\"\ntorque = 1.0\n", limit = "time_limit = 9\n";
    EXPECT_EQ(counts(clock, "Ttr = 0.1\nduration = 0.5\n"), Counts(0, 3));
    EXPECT_EQ(counts(clock, "Ttr = 0.1\nduration = 0.56\n"), Counts(0, 3));
    EXPECT_EQ(counts(clock, "Ttr = 0.2\nduration = 0.6\n"), Counts(1, 3));
    EXPECT_EQ(counts(clock, "Ttr = 0.16\nduration = 0.1\n"), Counts(1, 1)) << "none in the record: the next";
    for (auto const& [drive, more] : {std::pair(clock, std::string()), std::pair(turns, limit)}) {
        EXPECT_EQ(counts(drive, more + "transient_revolutions = 0.5\nrevolutions = 2.4\n"), Counts(0, 3));
        EXPECT_EQ(counts(drive, more + "transient_revolutions = 0.75\nrevolutions = 2.4\n"), Counts(1, 2));
        EXPECT_EQ(counts(drive, more + "transient_revolutions = 0.75\nrevolutions = 3\n"), Counts(1, 3));
        // Of whole turns rounding makes none more, wherever the first section is: here, at the start, and a hair from either.
        for (std::string const phase : {"0", "1.7", "1.7000001", "1.6999999"}) {
            for (std::size_t n = 0; n < 400; ++n) {
                std::string const lines = fmt::format("{}phase = {}\ntransient_revolutions = {}\nrevolutions = {}\n", more, phase, n, 401 - n);
                EXPECT_EQ(counts(drive, lines), Counts(n, 401 - n)) << phase;
            }
        }
    }
}

TEST(OrbitSchedule, OfExponentsRescalesFromTheStart) {
    OrbitSchedule const schedule = orbit_schedule(study("lyapunov", "dt = 0.01\nTtr = 0.05\nduration = 1\n"));
    EXPECT_FALSE(schedule.sections);
    EXPECT_EQ(schedule.section_rows(), 0u);
    // The fifth stop, number 4, ends the transient at 0.05 s; a hundred records follow.
    EXPECT_EQ(schedule.stops.transient, 4u);
    EXPECT_EQ(schedule.stops.growth_every, 1u);
    EXPECT_EQ(schedule.stops.growths(), 100u);
    EXPECT_EQ(schedule.stops.count, 105u);
    MemberClock const clock = schedule.timing(crank(2));
    EXPECT_EQ(clock.first_stop, 0.01);
    EXPECT_EQ(clock.period, 0.01);
    EXPECT_DOUBLE_EQ(clock.end, 1.05);
}

TEST(OrbitSchedule, WithoutATransientBeginsItsRecordsAtTheFirstStop) {
    StopPlan const stops = orbit_schedule(study("lyapunov", "dt = 0.01\nTtr = 0\nduration = 1\n")).stops;
    EXPECT_EQ(stops.transient, 0u);
    EXPECT_EQ(stops.growths(), 100u);
    EXPECT_EQ(stops.count, 101u);
}

TEST(OrbitSchedule, GathersManyRescalingsIntoWholeRecords) {
    for (int const rescalings : {255, 256, 511, 512, 1000, 20000, 20001}) {
        StopPlan const stops =
            orbit_schedule(study("lyapunov", fmt::format("dt = 0.001\nTtr = 0.1\nduration = {}e-3\n", rescalings)))
                .stops;
        auto const asked = static_cast<std::size_t>(rescalings);
        EXPECT_GE(stops.growths(), std::min<std::size_t>(asked, 256)) << rescalings;
        EXPECT_LE(stops.growths(), 4096u) << rescalings;
        // Every rescaling asked for is in a record, and the last stop ends the last record.
        EXPECT_GE(stops.growths() * stops.growth_every, asked);
        EXPECT_LT(stops.growths() * stops.growth_every, asked + stops.growth_every);
        EXPECT_EQ(stops.count, stops.transient + stops.growths() * stops.growth_every + 1);
        EXPECT_EQ(stops.transient, 99u);
    }
}

TEST(OrbitSchedule, RecordsNoMoreThanAskedForWhereTheNumberDivides) {
    for (int const rescalings : {1000, 3000, 20000, 400000}) {
        StopPlan const stops =
            orbit_schedule(study("lyapunov", fmt::format("dt = 0.001\nTtr = 0\nduration = {}e-3\n", rescalings))).stops;
        EXPECT_EQ(stops.growths() * stops.growth_every, static_cast<std::size_t>(rescalings));
    }
}

TEST(OrbitSchedule, OfASweepWithoutExponentsIsThatOfItsSections) {
    StopPlan const stops = orbit_schedule(sweep("exponents = 0\ntransient_revolutions = 2\nrevolutions = 5\n")).stops;
    EXPECT_EQ(stops.count, 7u);
    EXPECT_EQ(stops.sections(), 5u);
}

TEST(OrbitSchedule, OfASweepWithExponentsRescalesBetweenItsSections) {
    Scene const scene = sweep(
        "phase = 3.0\nexponents = 1\nrescalings_per_revolution = 50\ntransient_revolutions = 2\nrevolutions = 5\n");
    OrbitSchedule const schedule = orbit_schedule(scene);
    EXPECT_EQ(schedule.stops.transient, 100u);
    EXPECT_EQ(schedule.stops.count, 301u);  // two turns of transient, four between five sections, and the last stop
    EXPECT_EQ(schedule.stops.sections(), 5u);
    // Growth over as many turns as there are sections: the turn before the first counts too.
    EXPECT_EQ(schedule.stops.growths() * schedule.stops.growth_every, 250u);
    EXPECT_EQ(schedule.stops.growth_from(), 50u);
    EXPECT_EQ(50u % schedule.stops.growth_every, 0u);
    MemberClock const clock = schedule.timing(crank(2));
    EXPECT_DOUBLE_EQ(clock.first_stop, 1.5);
    EXPECT_DOUBLE_EQ(clock.period, pi / 50);
    // Its sections are those of the sweep without exponents.
    MemberClock const plain = orbit_schedule(sweep("phase = 3.0\nexponents = 0\ntransient_revolutions = 2\n"
                                                   "revolutions = 5\n"))
                                  .timing(crank(2));
    EXPECT_EQ(clock.first_stop, plain.first_stop);
    EXPECT_NEAR(clock.end, plain.end, 1e-14 * plain.end);
}

TEST(OrbitSchedule, OfASweepWithExponentsHasTheSectionsOfTheRecordAndGrowth) {
    auto const stops = [](std::string const& lines) { return orbit_schedule(sweep("phase = 5.0\nexponents = 1\nrescalings_per_revolution = 50\n" + lines)).stops; };
    // Sections after 0.796, 1.796 … turns.
    StopPlan const some = stops("transient_revolutions = 0.5\nrevolutions = 3\n"), few = stops("transient_revolutions = 0.5\nrevolutions = 1\n");
    EXPECT_EQ(some.transient, 0u);
    EXPECT_EQ(some.sections(), 3u);
    EXPECT_EQ(some.growths() * some.growth_every, 100u);
    EXPECT_EQ(few.sections(), 2u) << "one has no growth from section to section";
    EXPECT_EQ(few.growths() * few.growth_every, 50u);
    EXPECT_EQ(stops("transient_revolutions = 0.9\nrevolutions = 1\n").sections(), 1u);
}

TEST(OrbitSchedule, OfCrossingsHasASpanAndNoStops) {
    OrbitSchedule const schedule =
        orbit_schedule(study("poincare",
                             "Ttr = 3\nduration = 4\nmax_crossings = 17\n"
                             "section = { on = \"gap_z[P3]\", value = \"2 um\", direction = \"both\" }\n"));
    EXPECT_EQ(schedule.stops.count, 0u);
    EXPECT_TRUE(schedule.sections);
    EXPECT_EQ(schedule.section_rows(), 17u);
    EXPECT_EQ(schedule.crossings.on, CrossingPlan::On::gap_z);
    EXPECT_EQ(schedule.crossings.index, 2);
    EXPECT_EQ(schedule.crossings.direction, CrossingPlan::Direction::both);
    EXPECT_DOUBLE_EQ(schedule.crossings.level, 2e-6);
    MemberClock const clock = schedule.timing(crank(2));
    EXPECT_EQ(clock.first_stop, 3);
    EXPECT_EQ(clock.end, 7);
}

TEST(OrbitSchedule, OfCrossingsKnowsStatesAndDirections) {
    auto const plan = [](std::string const& section) {
        return orbit_schedule(study("poincare", fmt::format("section = {{ {} }}\n", section))).crossings;
    };
    CrossingPlan const vz = plan("on = \"vz\", value = 0.25");
    EXPECT_EQ(vz.on, CrossingPlan::On::state);
    EXPECT_EQ(vz.index, 3);
    EXPECT_EQ(vz.level, 0.25);
    EXPECT_EQ(vz.direction, CrossingPlan::Direction::rising);
    EXPECT_EQ(plan("on = \"wz\", direction = \"falling\"").direction, CrossingPlan::Direction::falling);
    EXPECT_EQ(plan("on = \"gap_y[P8]\"").on, CrossingPlan::On::gap_y);
    EXPECT_EQ(plan("on = \"gap_y[P8]\"").index, 7);
}

TEST(OrbitSchedule, OfRigidContactsTakesTheImpactsThatCloseAGap) {
    auto const on = [](std::string const& section, std::string const& more = "") {
        return orbit_schedule(study("poincare", fmt::format("section = {{ {} }}\n[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n{}", section, more)))
            .crossings.on;
    };
    using enum CrossingPlan::On;
    EXPECT_EQ(on("on = \"impacts\""), impacts);
    EXPECT_EQ(on("on = \"gap_y[P3]\""), impacts_y);
    EXPECT_EQ(on("on = \"gap_z[P3]\", value = 0"), impacts_z);
    EXPECT_EQ(on("on = \"gap_z[P3]\", value = 1e-9"), gap_z);
    EXPECT_EQ(on("on = \"y\""), state);
    EXPECT_EQ(on("on = \"gap_y[P3]\"", "[integrator]\nmethod = \"moreau_jean\"\nstep = 1e-5"), gap_y) << "time stepping knows no impacts";
}

// The kernels land on fma(i, period, first): an end one bit beyond the last stop would ask for a step of no length.
TEST(OrbitSchedule, EndsAtItsLastStopToTheLastBit) {
    for (Scene const& scene :
         {study("poincare", "phase = 0.1\ntransient_revolutions = 3\nrevolutions = 11\n"),
          study("lyapunov", "rescalings_per_revolution = 77\ntransient_revolutions = 1\nrevolutions = 3\n"),
          study("lyapunov", "dt = 0.0013\nTtr = 0.3\nduration = 1.7\n"),
          sweep("phase = 2.2\nrescalings_per_revolution = 33\ntransient_revolutions = 1\nrevolutions = 4\n")}) {
        OrbitSchedule const schedule = orbit_schedule(scene);
        for (double const speed : {2.0, pi, -0.3, 17.1}) {
            MemberClock const clock = schedule.timing(crank(speed, 0.4));
            EXPECT_EQ(clock.end,
                      std::fma(static_cast<double>(schedule.stops.count - 1), clock.period, clock.first_stop));
            EXPECT_GT(clock.first_stop, 0);
        }
    }
}

TEST(OrbitSchedule, GivesMembersOfOtherSpeedsAsManyStopsAtTimesOfTheirOwn) {
    for (std::string const& lines : {std::string("kind = \"poincare\"\nphase = 1.0\n"),
                                     std::string("kind = \"lyapunov\"\nrescalings_per_revolution = 40\n")}) {
        Scene const scene = scene_of("schema = 1\n[mechanism]\ncrank_speed = 2\n[study]\nmembers = 20\n" + lines +
                                     "transient_revolutions = 2\nrevolutions = 6\n[study.vary]\n"
                                     "\"mechanism.crank_speed\" = { dist = \"unif\", low = 1, high = 5 }\n");
        OrbitSchedule const schedule = orbit_schedule(scene);
        double const per_turn = scene.study == StudyKind::lyapunov ? 40 : 1;
        EXPECT_DOUBLE_EQ(schedule.timing(scene.inputs).period, pi / per_turn);
        std::set<double> ends;
        for (std::uint64_t member = 0; member < 20; ++member) {
            Inputs const inputs = member_inputs(scene, member);
            MemberClock const clock = schedule.timing(inputs);
            EXPECT_DOUBLE_EQ(clock.period, 2 * pi / inputs.crank_speed / per_turn);
            EXPECT_DOUBLE_EQ((clock.end - clock.first_stop) / clock.period,
                             static_cast<double>(schedule.stops.count - 1));
            double const first_angle = scene.study == StudyKind::lyapunov ? 2 * pi / 40 : 1;
            EXPECT_DOUBLE_EQ(clock.first_stop * inputs.crank_speed, first_angle);
            ends.insert(clock.end);
        }
        EXPECT_EQ(ends.size(), 20u);
    }
}

// ---- shadows ----

TEST(ShadowPlan, IsForStudiesThatAskForExponents) {
    EXPECT_EQ(shadow_plan(scene_of("schema = 1")).count, 0);
    EXPECT_EQ(shadow_plan(study("poincare", "")).count, 0);
    EXPECT_EQ(shadow_plan(sweep("exponents = 0\n")).count, 0);
    ShadowPlan const plan =
        shadow_plan(study("lyapunov", "exponents = 1\nd0 = 1e-5\nd0_lower = 1e-7\nd0_upper = 1e-4\n"));
    EXPECT_EQ(plan.count, 1);
    EXPECT_EQ(plan.d0, 1e-5);
    EXPECT_EQ(plan.lower, 1e-7);
    EXPECT_EQ(plan.upper, 1e-4);
    EXPECT_EQ(shadow_plan(sweep("exponents = 4\n")).count, 4);
}

std::vector<double> directions(std::uint64_t seed, std::uint64_t member, int shadows) {
    std::vector<double> values(static_cast<std::size_t>(shadows) * state_size);
    draw_directions(seed, member, shadows, Parts{}, values.data());
    return values;
}

TEST(ShadowDirections, HaveUnitLength) {
    for (std::uint64_t member = 0; member < 50; ++member) {
        auto const w = directions(7, member, most_shadows);
        for (std::size_t shadow = 0; shadow < most_shadows; ++shadow) {
            double squares = 0;
            for (std::size_t i = 0; i < state_size; ++i)
                squares += w[shadow * state_size + i] * w[shadow * state_size + i];
            EXPECT_NEAR(squares, 1, 1e-14);
        }
    }
}

TEST(ShadowDirections, DifferBetweenSeedsMembersAndShadows) {
    std::set<std::vector<double>> seen;
    for (std::uint64_t const seed : {1u, 2u, 3u}) {
        for (std::uint64_t member = 0; member < 20; ++member) {
            auto const w = directions(seed, member, 4);
            for (auto from = w.begin(); from != w.end(); from += state_size) seen.emplace(from, from + state_size);
        }
    }
    EXPECT_EQ(seen.size(), 3u * 20u * 4u);
}

TEST(ShadowDirections, DependOnTheirAddressAlone) {
    auto const many = directions(5, 1234567890123u, 6), few = directions(5, 1234567890123u, 2);
    EXPECT_EQ(many, directions(5, 1234567890123u, 6));
    EXPECT_EQ(few, std::vector<double>(many.begin(), many.begin() + 2 * state_size));
}

TEST(ShadowDirections, OfFewerStatesHaveTheSameNumbersInAnotherOrder) {
    // Each is the ratio of draws, whose addresses are counted through: six states of two shadows are the first twelve draws.
    std::vector<double> six(12), twelve(12);
    Parts planar, free;
    planar.mechanism = Mechanism::planar_slider_crank;
    planar.drive.by = slideway::DriveBy::nothing;
    free.mechanism = Mechanism::free_slider;
    draw_directions(3, 8, 2, planar, six.data());
    draw_directions(3, 8, 1, free, twelve.data());
    for (int i = 1; i < 6; ++i) EXPECT_NEAR(six[i] / six[0], twelve[i] / twelve[0], 1e-12 * std::abs(six[i] / six[0]));
    for (int i = 7; i < 12; ++i) EXPECT_NEAR(six[i] / six[6], twelve[i] / twelve[6], 1e-12 * std::abs(six[i] / six[6]));
}

TEST(ShadowDirections, LeaveOutWhatADrivePrescribes) {
    Parts driven;
    driven.mechanism = Mechanism::planar_slider_crank;
    std::vector<double> w(12);
    draw_directions(3, 8, 2, driven, w.data());
    for (int shadow = 0; shadow < 12; shadow += 6) {
        EXPECT_EQ(w[shadow], 0) << "crank angle";
        EXPECT_EQ(w[shadow + 3], 0) << "crank speed";
        double squares = 0;
        for (int i = 0; i < 6; ++i) squares += w[shadow + i] * w[shadow + i];
        EXPECT_NEAR(squares, 1, 1e-14);
    }
    EXPECT_EQ(free_states(driven), 4);
    driven.drive.by = slideway::DriveBy::nothing;
    EXPECT_EQ(free_states(driven), 6);
    EXPECT_EQ(free_states(Parts{}), 10);
}

TEST(ShadowDirections, FavourNoSide) {
    constexpr int members = 4000;
    double sum[state_size] = {}, squares[state_size] = {};
    for (std::uint64_t member = 0; member < members; ++member) {
        auto const w = directions(1, member, 1);
        for (std::size_t i = 0; i < state_size; ++i) sum[i] += w[i], squares[i] += w[i] * w[i];
    }
    // Mean 0 and mean square 1/10 by symmetry; five standard errors of each.
    for (std::size_t i = 0; i < state_size; ++i) {
        EXPECT_NEAR(sum[i] / members, 0, 5 * std::sqrt(0.1 / members));
        EXPECT_NEAR(squares[i] / members, 0.1, 5 * 0.1 / std::sqrt(members));
    }
}

}  // namespace
}  // namespace slideway::orbit_schedule_test
