// What a run promises beside its physics: samples, counts, statuses, the say of the quantities in the steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::observer_run_test {
namespace {

/// Members on a soft way, which meet it a few times in 0.02 s with few steps.
std::vector<Inputs> soft_members(std::size_t count) {
    std::vector<Inputs> members;
    for (auto in : testing::scattered_starts(count, 1e-4, 20.0)) {
        in.slider_young_modulus = in.way_young_modulus = 1e8;
        in.eta = 0.1;
        in.vy = -0.06;
        in.vz = 0.03;
        members.push_back(in);
    }
    return members;
}

testing::RunOptions options_of(double tolerance, double end_time) {
    testing::RunOptions o;
    o.parts = {Law::conservative, Damping::point, true, false};
    o.settings.method = Method::dopri5;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = end_time;
    o.quantities = 0;
    return o;
}

constexpr Selection one(Quantity q) { return Selection(1) << static_cast<int>(q); }
constexpr Selection audit = one(Quantity::energy_residual) | one(Quantity::drive_work) | one(Quantity::friction_loss) |
                            one(Quantity::damping_loss) | one(Quantity::load_work) | one(Quantity::ground_work) |
                            one(Quantity::spring_loss) | one(Quantity::film_loss);

double series_value(testing::EnsembleResult const& r, std::size_t members, std::size_t samples, std::size_t row,
                    std::size_t member, std::size_t sample) {
    return r.series[(row * members + member) * samples + sample];
}

TEST(Samples, AreTheStatesOfRunsThatEndThere) {
    auto const members = soft_members(5);
    // Both runs take the same steps but the last, which the dense output replaces; in contact, where the force has kinks, it is
    // worse than a step, though seldom.
    double const tolerance = 1e-8, slack = 1000 * tolerance;
    std::vector<double> differences;
    auto o = options_of(tolerance, 0.02);
    o.series = testing::state_selection;
    o.sample_times = {0.0007, 0.00211, 0.0034, 0.0062, 0.0111, 0.01393, 0.0171, 0.0199};
    auto const sampled = testing::run(best_isa(), o, members);
    // c, c·ω, 2c/L_k, 2c/L_k·ω
    double const c = 1e-4, speed = 20, tilt = 5e-3;
    double const scale[] = {c, c, c * speed, c * speed, tilt, tilt, tilt, tilt * speed, tilt * speed, tilt * speed};
    for (std::size_t i = 0; i < o.sample_times.size(); ++i) {
        auto const ended = testing::run(best_isa(), options_of(tolerance, o.sample_times[i]), members);
        for (std::size_t m = 0; m < members.size(); ++m) {
            auto const& state = ended.states[m];
            double const speeds = std::max(std::abs(state[2]), std::abs(state[3]));
            double const spin = std::max({std::abs(state[7]), std::abs(state[8]), std::abs(state[9])});
            for (std::size_t k = 0; k < state_size; ++k) {
                double const got = series_value(sampled, members.size(), o.sample_times.size(), k, m, i);
                double const size = k < 2 ? 0 : k < 4 ? speeds : k < 7 ? 0 : spin;
                EXPECT_NEAR(got, state[k], slack * (scale[k] + size))
                    << "member " << m << " " << series_table[k].name << " at " << o.sample_times[i] << " s";
                differences.push_back(std::abs(got - state[k]) / (scale[k] + size));
            }
        }
    }
    std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2),
                     differences.end());
    EXPECT_LT(differences[differences.size() / 2], tolerance);
}

TEST(Samples, BeyondTheEndOfAMemberAreMissing) {
    auto const members = soft_members(11);
    auto o = options_of(1e-6, 0.02);
    o.series = info(o.parts.mechanism).series;
    for (int i = 0; i <= 400; ++i) o.sample_times.push_back(5e-5 * i);
    o.settings.max_steps = 60;
    auto const r = testing::run(best_isa(), o, members);
    for (std::size_t m = 0; m < members.size(); ++m) {
        EXPECT_EQ(r.records[m].status, Status::max_steps);
        std::size_t row = 0;
        for (int series = 0; series < series_count; ++series) {
            if (!selects(o.series, static_cast<Series>(series))) continue;
            for (std::size_t i = 0; i < o.sample_times.size(); ++i) {
                bool const reached = o.sample_times[i] <= r.records[m].time;
                EXPECT_EQ(std::isfinite(series_value(r, members.size(), o.sample_times.size(), row, m, i)), reached)
                    << "member " << m << " " << series_table[series].name << " sample " << i;
            }
            ++row;
        }
    }
}

TEST(Counts, EveryTriedStepCostsSixEvaluations) {
    // The seventh stage is the first of the next step; a sample beyond the state costs one more.
    auto const members = soft_members(11);
    for (bool const beyond_state : {false, true}) {
        auto o = options_of(1e-7, 0.01);
        o.series = beyond_state ? Selection(1) << static_cast<int>(Series::normal_force) : testing::state_selection;
        for (int i = 0; i < 50; ++i) o.sample_times.push_back(2e-4 * i);
        auto const r = testing::run(best_isa(), o, members);
        std::uint64_t tried = 0;
        for (auto const& record : r.records) {
            auto const steps = record.steps_accepted + record.steps_rejected;
            EXPECT_EQ(record.rhs_evaluations, 1 + 6 * steps + (beyond_state ? 50 : 0));
            EXPECT_EQ(record.time, 0.01);
            tried += steps;
        }
        EXPECT_EQ(r.lane_steps_useful, tried);
        EXPECT_GE(r.lane_steps_executed, tried);
        EXPECT_EQ(r.lane_steps_executed % static_cast<std::uint64_t>(lanes_of(best_isa())), 0u);
    }
}

TEST(Counts, ATouchCostsOneEvaluationMore) {
    // One flat impact: all apices of a face touch at once, and the derivative is evaluated anew with their speed.
    Inputs in;
    in.crank_speed = 0;
    in.gravity = 0;
    in.restitution = 0.5;
    in.clearance_y = in.clearance_z = 1e-3;
    in.y = -0.9e-3;
    in.vy = -0.1;
    auto o = options_of(1e-8, 3e-3);
    o.parts = {Law::conservative, Damping::restitution, false, false};
    auto const r = testing::run(best_isa(), o, {complete_inputs(in)});
    auto const& record = r.records[0];
    EXPECT_EQ(record.rhs_evaluations, 1 + 6 * (record.steps_accepted + record.steps_rejected) + 1);
}

TEST(Steps, AreNeverLongerThanAllowed) {
    auto const members = soft_members(3);
    auto o = options_of(1e-4, 0.01);
    o.settings.max_step = 1e-5;
    auto const r = testing::run(best_isa(), o, members);
    for (auto const& record : r.records) EXPECT_GE(record.steps_accepted, 999u);
}

TEST(Steps, MeetTheAbsoluteToleranceInTheScalesOfTheJoint) {
    // A relative tolerance of nothing leaves the control to atol, which means atol·c, not atol metres.
    auto const members = soft_members(4);
    auto tight = options_of(1e-11, 5e-3), loose = tight;
    loose.settings.rtol = 1e-14;
    loose.settings.atol = 1e-5;
    auto const reference = testing::run(best_isa(), tight, members), got = testing::run(best_isa(), loose, members);
    double const c = 1e-4;
    for (std::size_t m = 0; m < members.size(); ++m) {
        EXPECT_NEAR(got.states[m][0], reference.states[m][0], 0.01 * c);
        EXPECT_NEAR(got.states[m][1], reference.states[m][1], 0.01 * c);
        EXPECT_LT(got.records[m].steps_accepted, reference.records[m].steps_accepted / 2);
    }
}

TEST(Steps, BelowTheResolutionOfTimeEndTheMember) {
    // The paper's law jumps where its modes switch: at a tolerance of rounding no step across a jump is short enough.
    auto o = options_of(1e-16, 0.05);
    o.parts.law = Law::paper;
    o.settings.max_steps = 500'000;
    auto const r = testing::run(best_isa(), o, testing::scattered_starts(3));
    for (auto const& record : r.records) {
        EXPECT_EQ(record.status, Status::step_too_small) << "not " << status_names[static_cast<int>(record.status)];
        EXPECT_LT(record.time, 0.05);
    }
}

TEST(Faults, OfAContactAreNotSeenByLanesWithoutIt) {
    // An absurd edge radius leaves a line no domain at all; a member that flies free has no line, whatever its neighbours have.
    auto flying = testing::golden_start(1e-4, 20.0);
    flying.edge_radius = 1e6;
    auto lying = testing::golden_start(1e-4, 20.0);
    lying.roll = lying.yaw = 0;
    lying.pitch = 1e-4;
    lying.y = -1e-4;  // two apices of the bottom face inside: a line
    for (Law const law : testing::every_law()) {
        flying = with_presets(flying, law), lying = with_presets(lying, law);
        auto o = options_of(1e-6, 1e-4);
        o.parts.law = law;
        o.series = Selection(1) << static_cast<int>(Series::lines);
        o.sample_times = {0.0};
        auto const r = testing::run(best_isa(), o, {flying, lying, flying, lying});
        for (auto const& record : r.records) EXPECT_EQ(record.status, Status::finished);
        EXPECT_EQ(r.series[0], 0);
        EXPECT_GT(r.series[1], 0) << "the neighbour must begin with a line";
    }
}

TEST(Faults, InsideARunKeepTheirReason) {
    // A line contact leaves its domain in some stage of a step.  The NaN that follows runs through the later stages and must
    // not be taken for a rod that does not reach.
    auto o = options_of(1e-6, 0.03);
    o.parts.law = Law::paper;
    auto members = testing::scattered_starts(8);
    for (auto& in : members) in.edge_radius = 1e5;
    auto const r = testing::run(best_isa(), o, members);
    for (auto const& record : r.records) {
        EXPECT_EQ(record.status, Status::contact_domain) << "not " << status_names[static_cast<int>(record.status)];
        EXPECT_GT(record.time, 1e-3) << "the members must start in free flight";
    }
}

TEST(Quantities, OnlyTheAuditHasASayInTheSteps) {
    auto const members = soft_members(6);
    auto o = options_of(1e-6, 0.02);
    auto const without = testing::run(best_isa(), o, members);
    o.quantities = audit;
    auto const audited = testing::run(best_isa(), o, members);
    for (int q = 0; q < quantity_count; ++q) {
        o.quantities = Selection(1) << q;
        auto const got = testing::run(best_isa(), o, members);
        auto const& expected = (o.quantities & audit) != 0 ? audited : without;
        for (std::size_t m = 0; m < members.size(); ++m) {
            EXPECT_EQ(got.states[m], expected.states[m]) << quantity_table[q].name << " member " << m;
            EXPECT_EQ(got.records[m].steps_accepted, expected.records[m].steps_accepted) << quantity_table[q].name;
        }
    }
    EXPECT_NE(audited.records[0].steps_accepted, without.records[0].steps_accepted)
        << "the audit must have its say here";
}

TEST(Quantities, AskedForAloneAreWhatTheyAreTogether) {
    auto const members = soft_members(6);
    for (Selection const together : {audit, testing::all_quantities & ~audit}) {
        auto o = options_of(1e-6, 0.02);
        o.quantities = together;
        auto const all = testing::run(best_isa(), o, members);
        for (int q = 0; q < quantity_count; ++q) {
            if (((together >> q) & 1u) == 0) continue;
            o.quantities = Selection(1) << q;
            auto const alone = testing::run(best_isa(), o, members);
            for (std::size_t m = 0; m < members.size(); ++m) {
                for (int column = 0; column < quantity_table[q].columns; ++column) {
                    EXPECT_EQ(alone.value(m, static_cast<Quantity>(q), column),
                              all.value(m, static_cast<Quantity>(q), column))
                        << quantity_table[q].name << " member " << m;
                }
            }
        }
    }
}

/// Where nothing else is integrated, reports of stages tell the powers of the audit alone.
TEST(Quantities, OfTheAuditAreTheSameBesideAnyOther) {
    auto const starts = soft_members(11);
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::carriage, Mechanism::free_slider}) {
        for (Law const law : {Law::paper, Law::conservative, Law::kelvin_voigt}) {
            auto members = starts;
            for (auto& in : members) in = testing::with_own(in, law, 50);
            for (Method const method :
                 {Method::automatic, Method::dopri5, Method::bs32, Method::dop853, Method::verner65, Method::ros34pw2, Method::rk4}) {
                auto o = options_of(1e-5, 0.01);
                o.parts.law = law;
                o.parts.mechanism = mechanism;
                o.settings.method = method;
                o.settings.fixed_step = 5e-6;
                o.quantities = testing::all_quantities;
                auto const all = testing::run(best_isa(), o, members);
                o.quantities = audit;
                auto const alone = testing::run(best_isa(), o, members);
                for (std::size_t m = 0; m < members.size(); ++m) {
                    auto const what = std::string(info(mechanism).name) + ", " + std::string(info(law).name) + ", " + std::string(name_of(method)) +
                                      ", member " + std::to_string(m);
                    EXPECT_EQ(alone.states[m], all.states[m]) << what;
                    // Peaks are looked for inside of steps with step control: four reports each, of a method whose extension has three stages seven.
                    auto const &with = all.records[m], &without = alone.records[m];
                    EXPECT_EQ(with.steps_accepted, without.steps_accepted) << what;
                    EXPECT_EQ(with.steps_rejected, without.steps_rejected) << what;
                    EXPECT_EQ(with.jacobian_evaluations, without.jacobian_evaluations) << what;
                    std::uint64_t const search = method == Method::dop853 ? 7 : 4, more = with.rhs_evaluations - without.rhs_evaluations;
                    EXPECT_EQ(more % search, 0u) << what;
                    EXPECT_TRUE(more == 0 || (method != Method::ros34pw2 && method != Method::rk4)) << what;
                    for (Quantity const q : {Quantity::drive_work, Quantity::friction_loss, Quantity::damping_loss, Quantity::energy_residual}) {
                        EXPECT_EQ(alone.value(m, q), all.value(m, q)) << what << ", quantity " << static_cast<int>(q);
                    }
                }
            }
        }
    }
}

TEST(Peaks, AreThoseInsideOfSteps) {
    // By the ends of steps alone they are off by up to some per cent, the more the longer the steps are.
    auto const members = soft_members(32);
    auto o = options_of(1e-11, 0.02);
    o.quantities = one(Quantity::peak_normal_force) | one(Quantity::peak_apex_force) | one(Quantity::peak_acceleration);
    auto const want = testing::run(best_isa(), o, members);
    for (Method const method : {Method::automatic, Method::dopri5, Method::bs32, Method::dop853, Method::verner65}) {
        auto loose = o;
        loose.settings.method = method;
        loose.settings.rtol = loose.settings.atol = 1e-6;
        auto const found = testing::run(best_isa(), loose, members);
        std::vector<double> errors;
        for (std::size_t m = 0; m < members.size(); ++m) {
            for (Quantity const q : {Quantity::peak_normal_force, Quantity::peak_apex_force, Quantity::peak_acceleration}) {
                int const columns = q == Quantity::peak_apex_force ? 8 : q == Quantity::peak_acceleration ? 3 : 1;
                for (int i = 0; i < columns; ++i) {
                    double const exact = want.value(m, q, i);
                    if (exact > 0.2 * want.value(m, q, 0)) errors.push_back(std::abs(found.value(m, q, i) / exact - 1));
                }
            }
        }
        std::sort(errors.begin(), errors.end());
        EXPECT_LT(errors[errors.size() / 2], 2e-4) << name_of(method);
        EXPECT_LT(errors[errors.size() * 9 / 10], 1e-3) << name_of(method);
    }
}

/// Time in contact of one impact, flat and on a corner.  By halves of the steps in which it begins and ends it was 4 to 9 % off.
TEST(ModeTimes, OfOneImpactAreThoseOfItsContact) {
    std::vector<Inputs> drops;
    for (int i = 0; i < 24; ++i) {
        auto in = testing::scattered_starts(1)[0];
        in.y = -0.7e-4, in.z = in.vz = in.yaw = 0;
        in.roll = i % 2 == 0 ? 0 : 8e-4, in.pitch = i % 2 == 0 ? 0 : 6e-4;
        in.wx = in.wy = in.wz = 0;
        in.vy = -0.05 - 0.003 * i;
        drops.push_back(in);
    }
    for (Law const law : {Law::paper, Law::conservative, Law::kelvin_voigt, Law::foundation}) {
        auto members = drops;
        for (auto& in : members) in = testing::with_own(in, law, 0);
        auto o = options_of(1e-11, 1.5e-3);
        o.parts.law = law;
        o.parts.mechanism = Mechanism::free_slider;
        o.settings.method = Method::verner65;
        o.quantities = one(Quantity::mode_time) | one(Quantity::contact_onsets);
        auto const want = testing::run(best_isa(), o, members);
        std::size_t single = 0;
        for (std::size_t m = 0; m < members.size(); ++m) single += want.value(m, Quantity::contact_onsets, 0) == 1;
        EXPECT_GE(single, members.size() / 2) << info(law).name << ": members of one impact";
        for (Method const method : {Method::automatic, Method::dopri5, Method::bs32, Method::verner65}) {
            auto loose = o;
            loose.settings.method = method;
            loose.settings.rtol = 1e-6, loose.settings.atol = 1e-7;
            auto const found = testing::run(best_isa(), loose, members);
            for (std::size_t m = 0; m < members.size(); ++m) {
                if (want.value(m, Quantity::contact_onsets, 0) != 1) continue;
                double const contact = o.settings.end_time - want.value(m, Quantity::mode_time, 0);
                EXPECT_NEAR(o.settings.end_time - found.value(m, Quantity::mode_time, 0), contact, 5e-3 * contact) << info(law).name << " " << name_of(method) << " " << m;
            }
        }
    }
}

}  // namespace
}  // namespace slideway::observer_run_test
