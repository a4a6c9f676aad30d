// Time stepping of rigid contacts (model.md 13) against the same rule in 80-bit numbers, the event-driven methods, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/moreau_jean.hpp"
#include "tests/oracle/planar_runs.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::time_stepping_test {
namespace {

using testing::drifting_sliders;
using testing::rigid_joint_parts;
using testing::rigid_options;
using testing::rigid_planar_parts;
using testing::RunOptions;

constexpr double millisecond = 1e-3;
constexpr std::size_t milliseconds = 50;

RunOptions stepped(Parts const& parts, double step, double seconds) {
    auto o = rigid_options(parts, 1e-11, seconds);
    o.settings.method = Method::moreau_jean;
    o.settings.fixed_step = step;
    o.settings.max_steps = 100'000'000;
    return o;
}

Inputs flat_block() { return oracle::planar_check_inputs(); }

Inputs spinning_block() {
    auto in = oracle::planar_check_inputs();
    in.friction_static = in.friction_kinetic = 0.01;
    in.wz = -0.01;
    return in;
}

/// Heights of a planar slider at each millisecond [clearances].
std::vector<double> heights(RunOptions o, Inputs const& in) {
    o.series = selections::of({Series::y});
    for (std::size_t i = 0; i <= milliseconds; ++i) o.sample_times.push_back(std::min(millisecond * static_cast<double>(i), o.settings.end_time));
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    std::vector<double> found;
    for (double const y : r.series) found.push_back(y / in.clearance_y);
    return found;
}

double mean_distance(std::vector<double> const& a, std::vector<double> const& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum / static_cast<double>(a.size() - 1);
}

TEST(TimeStepping, OfTheBlockIsTheRuleOfTheReference) {
    double const step = millisecond / 64;
    struct Case {
        Inputs in;
        bool friction;
    } const cases[] = {{flat_block(), false}, {spinning_block(), true}};
    for (auto const& [in, friction] : cases) {
        auto const parts = rigid_planar_parts(friction, true);
        auto const found = heights(stepped(parts, step, 0.05), in);
        auto const expected =
            oracle::moreau_jean_run(in, parts, millisecond, static_cast<int>(milliseconds), step, oracle::MoreauJeanRates::of_middle);
        for (std::size_t i = 0; i <= milliseconds; ++i) {
            auto const& s = expected[i];
            long double const y = in.crank_length * std::sin(s[0]) + in.rod_length * std::sin(s[1]);
            EXPECT_NEAR(found[i], static_cast<double>(y / in.clearance_y), 1e-9) << friction << " " << i;
        }
    }
}

TEST(TimeStepping, OfTheBlockConvergesToItsEvents) {
    auto const flat = rigid_planar_parts(false, true);
    auto const exact = heights(rigid_options(flat, 1e-11, 0.05), flat_block());
    double const coarse = mean_distance(heights(stepped(flat, millisecond / 64, 0.05), flat_block()), exact),
                 fine = mean_distance(heights(stepped(flat, millisecond / 1024, 0.05), flat_block()), exact);
    EXPECT_GT(std::log2(coarse / fine), 0.9 * 4) << coarse << " " << fine;
    EXPECT_LT(fine, 1e-3);
}

/// Median over blocks that spin at the start of the distance of their heights after 20 ms from those of the event-driven run [clearances].
double median_of_spinning(double step) {
    auto const parts = rigid_planar_parts(true, true);
    std::vector<Inputs> members;
    for (int i = 0; i < 33; ++i) {
        members.push_back(spinning_block());
        members.back().wz = -0.005 - 3e-4 * i;
    }
    auto const a = testing::run(best_isa(), stepped(parts, step, 0.02), members), b = testing::run(best_isa(), rigid_options(parts, 1e-11, 0.02), members);
    auto const height = [&](testing::EnsembleResult const& r, std::size_t i) {
        return members[i].crank_length * std::sin(r.states[i][0]) + members[i].rod_length * std::sin(r.states[i][1]);
    };
    std::vector<double> all;
    for (std::size_t i = 0; i < members.size(); ++i) all.push_back(std::abs(height(a, i) - height(b, i)) / members[i].clearance_y);
    std::ranges::nth_element(all, all.begin() + 16);
    return all[16];
}

TEST(TimeStepping, OfSpinningBlocksConvergesToTheirEvents) {
    // Slower than of flat ones: impacts of two corners follow one another within a step (docs/how_to/rigid.md).
    double const coarse = median_of_spinning(millisecond / 64), fine = median_of_spinning(millisecond / 16384);
    EXPECT_LT(fine, 0.1 * coarse) << coarse;
    EXPECT_LT(fine, 5e-3);
}

/// Median over the members of the distance of the centre from that of the event-driven run, across the way [clearances].
double median_distance(testing::EnsembleResult const& a, testing::EnsembleResult const& b, std::vector<Inputs> const& members) {
    std::vector<double> all;
    for (std::size_t i = 0; i < members.size(); ++i) {
        EXPECT_EQ(a.records[i].status, Status::finished) << i;
        all.push_back(std::hypot(a.states[i][0] - b.states[i][0], a.states[i][1] - b.states[i][1]) / members[i].clearance_y);
    }
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
    return all[all.size() / 2];
}

TEST(TimeStepping, OfASliderConvergesToItsEvents) {
    for (auto const mechanism : {Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::slider_crank}) {
        auto const parts = rigid_joint_parts(true, mechanism == Mechanism::carriage, mechanism);
        auto const members = drifting_sliders(32, 3, 0.5, 0.2);
        double const seconds = 0.01;  // three impacts
        auto const exact = testing::run(best_isa(), rigid_options(parts, 1e-11, seconds), members);
        double const coarse = median_distance(testing::run(best_isa(), stepped(parts, 1.6e-5, seconds), members), exact, members),
                     fine = median_distance(testing::run(best_isa(), stepped(parts, 1e-6, seconds), members), exact, members);
        EXPECT_GT(std::log2(coarse / fine), 0.8 * 4) << info(mechanism).name << " " << coarse << " " << fine;
        EXPECT_LT(fine, 5e-4) << info(mechanism).name;
    }
}

TEST(TimeStepping, OfASettledSliderHasTheLossesOfItsEvents) {
    auto const parts = rigid_joint_parts(true, false, Mechanism::slider_crank);
    auto members = drifting_sliders(16, 5, 0.5, 0.2);
    double const seconds = 0.6;
    auto const exact = testing::run(best_isa(), rigid_options(parts, 1e-9, seconds), members);
    auto const found = testing::run(best_isa(), stepped(parts, 1e-5, seconds), members);
    for (std::size_t i = 0; i < members.size(); ++i) {
        ASSERT_EQ(found.records[i].status, Status::finished) << i;
        auto const near = [&](Quantity q, double share) {
            double const expected = exact.value(i, q);
            EXPECT_NEAR(found.value(i, q), expected, share * std::abs(expected)) << i << " " << quantity_table[static_cast<int>(q)].name;
        };
        near(Quantity::friction_loss, 2e-3);
        near(Quantity::drive_work, 2e-3);
        near(Quantity::mean_normal_force, 2e-3);
        near(Quantity::damping_loss, 0.2);  // of some ten impacts, each of which has the speed of another step
        EXPECT_NEAR(found.value(i, Quantity::mode_time, 0), exact.value(i, Quantity::mode_time, 0), 0.01 * seconds) << i;
        EXPECT_LT(std::abs(found.value(i, Quantity::energy_residual)), 1e-3 * exact.value(i, Quantity::friction_loss)) << i;
    }
}

/// A free slider in the middle of its way.
Inputs slider(double e, double friction = 0) {
    Inputs in;
    in.restitution = e;
    in.friction_static = in.friction_kinetic = friction;
    return complete_inputs(in);
}

TEST(TimeStepping, KeepsEnergyWithoutLoss) {
    auto in = slider(1);
    in.vz = 0.3;
    double const fall = in.slider_mass * in.gravity * in.clearance_y;
    auto const flat = testing::run(best_isa(), stepped(rigid_joint_parts(false), 2e-5, 1), {in});
    EXPECT_GT(flat.value(0, Quantity::contact_onsets), 1000);
    EXPECT_LT(std::abs(flat.value(0, Quantity::energy_change)), 1e-10 * fall);
    EXPECT_LT(std::abs(flat.value(0, Quantity::damping_loss)), 1e-10 * fall);
    EXPECT_LT(std::abs(flat.value(0, Quantity::energy_residual)), 1e-10 * fall);
}

TEST(TimeStepping, HoldsOnASlopeBelowTheAngleOfFrictionAndNotAbove) {
    for (double const slope : {0.05, 0.6}) {
        for (double const margin : {1e-6, -1e-6, -0.3}) {
            auto in = slider(0.5, std::tan(slope) * (1 + margin));
            in.inclination = slope;
            in.y = -in.clearance_y * (1 + 1e-9);
            auto const r = testing::run(best_isa(), stepped(rigid_joint_parts(true), 1e-4, 0.5), {in});
            ASSERT_EQ(r.records[0].status, Status::finished) << slope << margin;
            double const acceleration = std::max(0.0, in.gravity * (std::sin(slope) - in.friction_kinetic * std::cos(slope)));
            EXPECT_NEAR(-r.states[0][11], acceleration * 0.5, 1e-10) << slope << margin;
            EXPECT_NEAR(-r.states[0][10], acceleration * 0.125, 1e-10) << slope << margin;
            double const weight = in.slider_mass * in.gravity;
            EXPECT_NEAR(r.value(0, Quantity::mean_normal_force), weight * std::cos(slope), 1e-9 * weight) << slope << margin;
            double const rubbed = in.friction_kinetic * weight * std::cos(slope) * acceleration * 0.125;
            EXPECT_NEAR(r.value(0, Quantity::friction_loss), rubbed, 1e-9 * std::abs(weight)) << slope << margin;
            EXPECT_NEAR(r.value(0, Quantity::mode_time, 3), 0.5, 1e-4) << slope << margin;
            EXPECT_EQ(r.value(0, Quantity::contact_onsets), 1) << slope << margin;  // of its first step
        }
    }
}

TEST(TimeStepping, BouncesAreOnsetsAndRestIsRest) {
    double const e = 0.5, step = 1e-6;
    auto const in = slider(e);
    long double const first = std::sqrt(2 * in.clearance_y / in.gravity), end = first * (1 + 2 * e / (1 - e));
    auto const r = testing::run(best_isa(), stepped(rigid_joint_parts(false), step, 0.1), {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    // Bounces are seen down to those that last a few steps: speeds halve from 44 mm/s to some 10 µm/s.
    EXPECT_NEAR(r.value(0, Quantity::contact_onsets), 12, 3);
    EXPECT_NEAR(r.value(0, Quantity::mode_time, 0), static_cast<double>(end), 40 * step);
    EXPECT_NEAR(r.value(0, Quantity::mode_time, 3), 0.1 - static_cast<double>(end), 40 * step);
    EXPECT_NEAR(r.value(0, Quantity::damping_loss), in.slider_mass * in.gravity * in.clearance_y, 1e-3 * in.slider_mass * in.gravity * in.clearance_y);
}

TEST(TimeStepping, SamplesAreOfTheMotionWithinItsSteps) {
    auto const in = slider(0.5);
    double const step = 1e-4;
    auto o = stepped(rigid_joint_parts(false), step, 6 * step);
    o.series = selections::of({Series::y, Series::vy});
    for (int i = 0; i <= 60; ++i) o.sample_times.push_back(std::min(0.1 * step * i, 6 * step));
    auto const r = testing::run(best_isa(), o, {in});
    for (std::size_t i = 0; i < o.sample_times.size(); ++i) {
        double const t = o.sample_times[i];
        EXPECT_NEAR(r.series[i], -0.5 * in.gravity * t * t, 0.13 * in.gravity * step * step) << i;
        EXPECT_NEAR(r.series[o.sample_times.size() + i], -in.gravity * t, 1e-12) << i;
    }
}

/// Bits of all that members come to.
std::vector<std::vector<double>> outcomes(Isa isa, RunOptions const& options, std::vector<Inputs> const& members) {
    auto const r = testing::run(isa, options, members);
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < members.size(); ++i) {
        std::vector<double> row{static_cast<double>(r.records[i].status), r.records[i].time};
        row.insert(row.end(), r.states[i].begin(), r.states[i].end());
        row.insert(row.end(), r.quantities[i].begin(), r.quantities[i].end());
        all.push_back(row);
    }
    return all;
}

bool are_same(std::vector<double> const& a, std::vector<double> const& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(TimeStepping, HasTheBitsOfAMemberInAnyLane) {
    for (auto const mechanism : {Mechanism::planar_slider_crank, Mechanism::free_slider, Mechanism::slider_crank}) {
        bool const planar = mechanism == Mechanism::planar_slider_crank;
        auto const parts = planar ? rigid_planar_parts(true, false) : rigid_joint_parts(true, false, mechanism);
        auto members = planar ? testing::random_rigid_blocks(48, 11, 1) : testing::random_rigid_sliders(48, 11, 1);
        members[5].vz = members[5].wz = NAN;
        auto const o = stepped(parts, 2e-5, 0.02);
        auto const all = outcomes(best_isa(), o, members);
        for (Isa const isa : testing::supported_isas()) {
            if (isa == best_isa()) continue;
            auto const other = outcomes(isa, o, members);
            for (std::size_t i = 0; i < members.size(); ++i) EXPECT_TRUE(are_same(all[i], other[i])) << info(mechanism).name << name_of(isa) << i;
        }
        for (std::size_t i = 0; i < members.size(); i += 5) {
            EXPECT_TRUE(are_same(all[i], outcomes(best_isa(), o, {members[i]})[0])) << info(mechanism).name << i;
        }
    }
}

struct Ends {
    int of[status_count] = {};
    double slowest = 0, all = 0;  // block of 64 members [s]
};

Ends ends_of(Mechanism mechanism, double friction, double step, std::size_t count) {
    bool const planar = mechanism == Mechanism::planar_slider_crank;
    auto const parts = planar ? rigid_planar_parts(friction > 0, false) : rigid_joint_parts(friction > 0, false, mechanism);
    auto const members = planar ? testing::random_rigid_blocks(count, 7, friction) : testing::random_rigid_sliders(count, 7, friction);
    auto const o = stepped(parts, step, 0.02);
    Ends ends;
    for (std::size_t from = 0; from < count; from += 64) {
        auto const begin = std::chrono::steady_clock::now();
        auto const r = testing::run(best_isa(), o, {members.begin() + static_cast<std::ptrdiff_t>(from), members.begin() + static_cast<std::ptrdiff_t>(from + 64)});
        double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        ends.slowest = std::max(ends.slowest, seconds), ends.all += seconds;
        for (auto const& record : r.records) ++ends.of[static_cast<int>(record.status)];
    }
    return ends;
}

TEST(TimeStepping, EndsWithAStatusWhateverTheGeometry) {
    for (auto const mechanism :
         {Mechanism::planar_slider_crank, Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::slider_crank}) {
        for (double const friction : {0.0, 0.5, 3.0}) {
            constexpr std::size_t count = 256;
            auto const ends = ends_of(mechanism, friction, 1e-5, count);
            int sum = 0;
            for (int i = 0; i < status_count; ++i) sum += ends.of[i];
            EXPECT_EQ(sum, count);
            std::string const where = std::string(info(mechanism).name) + " " + std::to_string(friction);
            EXPECT_GT(ends.of[static_cast<int>(Status::finished)], friction > 1 ? 180 : 230) << where;  // of the others the step is too long, or they jam
            for (auto const never : {Status::step_too_small, Status::max_steps, Status::nonfinite}) EXPECT_EQ(ends.of[static_cast<int>(never)], 0) << where;
            EXPECT_LT(ends.slowest, 20 * ends.all / (count / 64)) << where;
        }
    }
}

TEST(TimeStepping, IsTooLongWhereItLeapsThroughAWall) {
    auto in = slider(0.5);
    in.vy = -10;
    auto const r = testing::run(best_isa(), stepped(rigid_joint_parts(false), 1e-3, 0.1), {in});
    EXPECT_EQ(r.records[0].status, Status::contact_domain);
}

}  // namespace
}  // namespace slideway::time_stepping_test
