// Quantities and series of whole runs, held against the oracle and against quadrature of densely stored series.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "kernels/joint/contact_report.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::observer_quantities_test {
namespace {

constexpr std::size_t intervals = 4000;
constexpr double end_time = 0.02;

/// A soft joint, whose impacts last long enough for plain quadrature.  Every parameter that a quantity
/// may forget is not at its neutral value.
Inputs soft_member(std::size_t i) {
    double const sign = i % 2 == 0 ? 1 : -1;
    Inputs in;
    in.slider_young_modulus = in.way_young_modulus = 1e8;
    in.eta = 0.1;
    in.inclination = 0.3;
    in.crank_speed = 20;
    in.start_angle = 0.5 + 1.1 * static_cast<double>(i);
    in.clearance_y = 1e-4;
    in.clearance_z = 1.5e-4;
    in.vy = -0.08 * sign;
    in.vz = 0.05 + 0.004 * static_cast<double>(i);
    in.wx = 2.0 * sign;
    in.wy = -0.7 * sign;
    in.wz = 0.5;
    return complete_inputs(in);
}

std::vector<Inputs> soft_members() {
    std::vector<Inputs> members;
    for (std::size_t i = 0; i < 11; ++i) members.push_back(soft_member(i));  // more than lanes: some are refilled
    return members;
}

testing::RunOptions dense_options(Law law) {
    testing::RunOptions o;
    bool const damps = has_group(info(law).groups, KeyGroup::point_damping) || !info(law).has(Damping::rate);
    o.parts = {law, damps ? Damping::point : Damping::rate, true, false};
    o.settings.rtol = o.settings.atol = 1e-9;
    o.settings.end_time = end_time;
    o.settings.max_step = end_time / static_cast<double>(intervals);
    o.series = (Selection(1) << series_count) - 1;
    for (std::size_t i = 0; i <= intervals; ++i) {
        o.sample_times.push_back(end_time * static_cast<double>(i) / static_cast<double>(intervals));
    }
    return o;
}

/// One run with samples at every step or so, and what the oracle says of the samples.
class SampledRun : public ::testing::TestWithParam<Law> {
protected:
    void SetUp() override {
        members_ = soft_members();
        for (auto& in : members_) in = testing::with_own(in, GetParam(), 50);  // which no touch shorter than the samples' distance follows
        for (auto& in : members_) in.chi_surface = 5;
        options_ = dense_options(GetParam());
        result_ = testing::run(best_isa(), options_, members_);
        for (auto const& record : result_.records) ASSERT_EQ(record.status, Status::finished);
    }

    double at(Series s, std::size_t member, std::size_t sample) const {
        return result_.series[(static_cast<std::size_t>(s) * members_.size() + member) * (intervals + 1) + sample];
    }
    oracle::State state(std::size_t member, std::size_t sample) const {
        oracle::State s{};
        for (std::size_t i = 0; i < state_size; ++i) s[i] = at(static_cast<Series>(i), member, sample);
        return s;
    }
    oracle::Result oracle_at(std::size_t member, std::size_t sample) const {
        return oracle::evaluate(members_[member], options_.parts, options_.sample_times[sample], state(member, sample));
    }
    /// Time mean of a function of the sample, by Simpson's rule.
    double mean(std::function<double(std::size_t)> const& f) const {
        double sum = f(0) + f(intervals);
        for (std::size_t i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(i);
        return sum / (3.0 * static_cast<double>(intervals));
    }
    double largest(std::function<double(std::size_t)> const& f) const {
        double value = 0;
        for (std::size_t i = 0; i <= intervals; ++i) value = std::max(value, std::abs(f(i)));
        return value;
    }
    /// Whether the force jumps: where the law switches, or where a damper of its own meets the way.
    static bool jumps() { return info(GetParam()).switches || !info(GetParam()).has(Damping::rate); }
    int mode_class(std::size_t member, std::size_t sample) const {
        if (at(Series::surfaces, member, sample) > 0) return 3;
        if (at(Series::lines, member, sample) > 0) return 2;
        return at(Series::points, member, sample) > 0 ? 1 : 0;
    }

    std::vector<Inputs> members_;
    testing::RunOptions options_;
    testing::EnsembleResult result_;
};

TEST_P(SampledRun, SeriesAreTheOraclesOfTheStoredStates) {
    for (std::size_t m = 0; m < members_.size(); ++m) {
        for (std::size_t i = 0; i <= intervals; i += 37) {
            auto const r = oracle_at(m, i);
            double load = 0;
            for (std::size_t a = 0; a < 8; ++a) load += r.fn_y[a] + r.fn_z[a];
            EXPECT_NEAR(at(Series::x, m, i), r.x, 1e-14);
            EXPECT_NEAR(at(Series::vx, m, i), r.vx, 1e-13);
            EXPECT_NEAR(at(Series::normal_force, m, i), load, 2e-8 * load);
            EXPECT_NEAR(at(Series::crank_torque, m, i), r.crank_torque_with_weight,
                        2e-8 * (std::abs(r.crank_torque_with_weight) + 0.05 * load));
            EXPECT_NEAR(at(Series::rod_angular_velocity, m, i), r.rod_angular_velocity[2], 1e-12);
            EXPECT_EQ(at(Series::surfaces, m, i), r.surfaces);
            EXPECT_EQ(at(Series::lines, m, i), r.lines);
            EXPECT_EQ(at(Series::points, m, i), r.points);
        }
    }
}

TEST_P(SampledRun, BeginsAtTheStartAndEndsAtTheFinalState) {
    for (std::size_t m = 0; m < members_.size(); ++m) {
        auto const& in = members_[m];
        oracle::State const start{in.y, in.z, in.vy, in.vz, in.roll, in.yaw, in.pitch, in.wx, in.wy, in.wz};
        EXPECT_EQ(state(m, 0), start);
        for (std::size_t i = 0; i < state_size; ++i) {
            double const last = result_.states[m][i];
            EXPECT_NEAR(state(m, intervals)[i], last, 1e-14 * std::abs(last) + 1e-18);
        }
    }
}

TEST_P(SampledRun, MeansAndRootMeanSquaresAreThoseOfTheSeries) {
    for (std::size_t m = 0; m < members_.size(); ++m) {
        auto const series = [&](Series s) { return [this, m, s](std::size_t i) { return at(s, m, i); }; };
        auto const square = [&](Series s) { return [this, m, s](std::size_t i) { return at(s, m, i) * at(s, m, i); }; };
        double const force = mean(series(Series::normal_force));
        // At a jump Simpson's rule errs by a part of an interval.
        double const jump = jumps() ? 1e-2 : 1e-4;
        ASSERT_GT(force, 0) << m;
        EXPECT_NEAR(result_.value(m, Quantity::mean_normal_force), force, jump * force) << m;
        double const torque = std::sqrt(mean(square(Series::crank_torque)));
        EXPECT_NEAR(result_.value(m, Quantity::rms_crank_torque), torque, std::max(jump, 1e-3) * torque) << m;
    }
}

TEST_P(SampledRun, ApexForcesErrorsAndRodSpinAreTheOraclesOverTime) {
    for (std::size_t const m : {0u, 9u}) {
        std::array<std::vector<double>, 8> apex;
        std::vector<double> error, spin;
        for (std::size_t i = 0; i <= intervals; ++i) {
            auto const r = oracle_at(m, i);
            for (std::size_t a = 0; a < 8; ++a) apex[a].push_back(r.fn_y[a] + r.fn_z[a]);
            error.push_back(std::hypot(r.x - r.ideal_x, at(Series::y, m, i), at(Series::z, m, i)));
            auto const& w = r.rod_angular_velocity;
            spin.push_back(std::hypot(w[0], w[1], w[2]));
        }
        double const force = result_.value(m, Quantity::mean_normal_force);
        double const jump = jumps() ? 1e-2 : 1e-4;
        double const peak = result_.value(m, Quantity::peak_normal_force);
        double means = 0;
        for (std::size_t a = 0; a < 8; ++a) {
            int const column = static_cast<int>(a);
            double const got = result_.value(m, Quantity::mean_apex_force, column);
            EXPECT_NEAR(got, mean([&](std::size_t i) { return apex[a][i]; }), jump * force) << m << " apex " << a;
            EXPECT_NEAR(result_.value(m, Quantity::peak_apex_force, column),
                        *std::max_element(apex[a].begin(), apex[a].end()), std::max(jump, 1e-3) * peak)
                << m << " apex " << a;
            means += got;
        }
        EXPECT_NEAR(means, force, 1e-12 * force) << "the apices share the total force";
        auto const root_mean_square = [&](std::vector<double> const& v) {
            return std::sqrt(mean([&](std::size_t i) { return v[i] * v[i]; }));
        };
        double const e = root_mean_square(error), w = root_mean_square(spin);
        EXPECT_NEAR(result_.value(m, Quantity::rms_position_error), e, 1e-6 * e);
        EXPECT_NEAR(result_.value(m, Quantity::peak_position_error), *std::max_element(error.begin(), error.end()),
                    1e-4 * e);
        EXPECT_NEAR(result_.value(m, Quantity::rms_rod_angular_velocity), w, 1e-6 * w);
        EXPECT_NEAR(result_.value(m, Quantity::peak_rod_angular_velocity), *std::max_element(spin.begin(), spin.end()),
                    1e-4 * w);
    }
}

TEST_P(SampledRun, PeaksAreThoseOfTheSeries) {
    // Steps are no longer than the samples' distance, so that neither misses much of a peak.
    std::array<int, 4> negative{};
    for (std::size_t m = 0; m < members_.size(); ++m) {
        auto const compare = [&](Quantity q, int column, Series s, double slack) {
            double const peak = largest([&](std::size_t i) { return at(s, m, i); });
            EXPECT_NEAR(result_.value(m, q, column), peak, slack * peak)
                << m << " " << series_table[static_cast<int>(s)].name;
        };
        compare(Quantity::peak_normal_force, 0, Series::normal_force, 1e-2);
        compare(Quantity::peak_crank_torque, 0, Series::crank_torque, 1e-2);
        Series const tilts[] = {Series::roll, Series::yaw, Series::pitch};
        for (int axis = 0; axis < 3; ++axis) compare(Quantity::peak_tilt, axis, tilts[axis], 1e-3);
        Series const signed_peaks[] = {Series::roll, Series::yaw, Series::pitch, Series::crank_torque};
        for (std::size_t k = 0; k < 4; ++k) {
            double low = 0, high = 0;
            for (std::size_t i = 0; i <= intervals; ++i) {
                low = std::min(low, at(signed_peaks[k], m, i));
                high = std::max(high, at(signed_peaks[k], m, i));
            }
            negative[k] += -low > 1.1 * high ? 1 : 0;
        }
    }
    for (int const count : negative) EXPECT_GT(count, 0) << "some member must have its largest magnitude below zero";
}

TEST_P(SampledRun, ForcesOfFacesAndPinsAreThoseOfTheSeries) {
    double const jump = jumps() ? 1e-2 : 1e-3;
    for (std::size_t const m : {0u, 9u}) {
        auto const& in = members_[m];
        double const peak_force = result_.value(m, Quantity::peak_normal_force), area_y = in.slider_length * in.way_depth, area_z = in.slider_length * in.way_width;
        std::array<int, 4> onsets{}, touched{};
        for (std::size_t i = 0; i <= intervals; ++i) {
            auto const r = oracle_at(m, i);
            for (int face = 0; face < 4; ++face) {
                double deepest = -1;
                for (int k = 0; k < 4; ++k) deepest = std::max(deepest, (face < 2 ? r.pen_y : r.pen_z)[static_cast<std::size_t>(face_apex(face, k))]);
                auto const f = static_cast<std::size_t>(face);
                onsets[f] += i > 0 && deepest > 0 && touched[f] == 0 ? 1 : 0;
                touched[f] = deepest > 0 ? 1 : 0;
            }
        }
        double largest_pv = 0;
        for (int face = 0; face < 4; ++face) {
            auto const of = [&](Series first) { return [this, m, s = static_cast<Series>(static_cast<int>(first) + face)](std::size_t i) { return at(s, m, i); }; };
            double const force = largest(of(Series::face_force_y_plus)), pv = largest(of(Series::face_pv_y_plus));
            largest_pv = std::max(largest_pv, pv);
            EXPECT_NEAR(result_.value(m, Quantity::peak_face_force, face), force, std::max(jump, 1e-2) * peak_force) << m << " " << face_names[face];
            EXPECT_NEAR(result_.value(m, Quantity::peak_pressure, face), result_.value(m, Quantity::peak_face_force, face) / (face < 2 ? area_y : area_z),
                        1e-12 * peak_force / area_y);
            EXPECT_NEAR(result_.value(m, Quantity::peak_pv, face), pv, 1e-2 * std::max(pv, largest_pv)) << m << " " << face_names[face];
            EXPECT_NEAR(result_.value(m, Quantity::mean_pv, face), mean(of(Series::face_pv_y_plus)), jump * largest_pv) << m << " " << face_names[face];
            EXPECT_EQ(result_.value(m, Quantity::face_onsets, face), onsets[static_cast<std::size_t>(face)]) << m << " " << face_names[face];
            double counted = 0;
            for (int bin = 0; bin < impact_speed_count; ++bin) counted += result_.value(m, Quantity::impact_speeds, face * impact_speed_count + bin);
            EXPECT_EQ(counted, onsets[static_cast<std::size_t>(face)]);
        }
        EXPECT_GT(largest_pv, 0);
        auto const compare = [&](Quantity q, Series x) {
            auto const of = [&](int axis, std::size_t i) { return at(static_cast<Series>(static_cast<int>(x) + axis), m, i); };
            double const peak = largest([&](std::size_t i) { return std::hypot(of(0, i), of(1, i), of(2, i)); });
            EXPECT_NEAR(result_.value(m, q), peak, 1e-2 * peak) << m << " " << quantity_table[static_cast<int>(q)].name;
        };
        compare(Quantity::peak_friction_force, Series::friction_force_x);
        compare(Quantity::peak_rod_force, Series::rod_force_x);
        compare(Quantity::peak_crank_pin_force, Series::crank_pin_force_x);
    }
}

TEST_P(SampledRun, ModeTimesAndOnsetsAreThoseOfTheSampledModes) {
    double const interval = end_time / static_cast<double>(intervals);
    std::array<double, 4> over_all{};
    for (std::size_t m = 0; m < members_.size(); ++m) {
        std::array<double, 4> time{};
        int changes = 0, onsets = 0;
        for (std::size_t i = 0; i <= intervals; ++i) {
            int const now = mode_class(m, i);
            time[static_cast<std::size_t>(now)] += i == 0 || i == intervals ? 0.5 * interval : interval;
            if (i == 0) continue;
            int const before = mode_class(m, i - 1);
            changes += now != before ? 1 : 0;
            onsets += before == 0 && now > 0 ? 1 : 0;
        }
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            double const got = result_.value(m, Quantity::mode_time, static_cast<int>(k));
            EXPECT_NEAR(got, time[k], interval * changes) << m << " " << mode_class_names[k];
            sum += got;
            over_all[k] += got;
        }
        EXPECT_NEAR(sum, end_time, 1e-13) << m;
        EXPECT_EQ(result_.value(m, Quantity::contact_onsets), onsets) << m;
        EXPECT_GE(onsets, 1) << "the members must meet the way, " << m;
    }
    for (std::size_t const k : {0u, 1u, 2u}) EXPECT_GT(over_all[k], 100 * interval) << mode_class_names[k];
}

TEST_P(SampledRun, EnergyIsTheOraclesOfTheFirstAndLastState) {
    for (std::size_t m = 0; m < members_.size(); ++m) {
        oracle::State last{};
        std::copy(result_.states[m].begin(), result_.states[m].end(), last.begin());
        auto const first = oracle_at(m, 0);
        double const end = oracle::evaluate(members_[m], options_.parts, end_time, last).energy;
        double const change = end - first.energy;
        EXPECT_NEAR(result_.value(m, Quantity::energy_change), change, 1e-12 + 2e-8 * std::abs(change)) << m;
        EXPECT_NEAR(result_.value(m, Quantity::energy_residual),
                    change - result_.value(m, Quantity::drive_work) + result_.value(m, Quantity::friction_loss) +
                        result_.value(m, Quantity::damping_loss),
                    1e-12)
            << m;
    }
}

TEST_P(SampledRun, WorkAndLossesAreIntegralsOfTheOraclesPowers) {
    for (std::size_t const m : {1u, 10u}) {
        std::vector<oracle::Result> all;
        for (std::size_t i = 0; i <= intervals; ++i) all.push_back(oracle_at(m, i));
        auto const integral = [&](double oracle::Result::*power) {
            return end_time * mean([&](std::size_t i) { return all[i].*power; });
        };
        double const work = integral(&oracle::Result::power_crank),
                     friction = integral(&oracle::Result::power_friction);
        double const damping = integral(&oracle::Result::power_damping);
        double const jump = jumps() ? 2e-2 : 1e-3;
        double const scale = std::abs(work) + friction + damping;
        EXPECT_NEAR(result_.value(m, Quantity::drive_work), work, jump * scale) << m;
        EXPECT_NEAR(result_.value(m, Quantity::friction_loss), friction, jump * friction) << m;
        EXPECT_NEAR(result_.value(m, Quantity::damping_loss), damping, 5 * jump * damping) << m;
        EXPECT_GT(friction, 0);
        EXPECT_GT(damping, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, SampledRun, ::testing::ValuesIn(testing::every_law()),
                         [](auto const& p) { return std::string(slideway::info(p.param).name); });

}  // namespace
}  // namespace slideway::observer_quantities_test
