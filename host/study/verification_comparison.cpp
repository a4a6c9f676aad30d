// What the study says of its members beside what they say when they run again.
#include <algorithm>
#include <cmath>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/study/orbit_schedule.hpp"
#include "host/study/verification.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

constexpr double level = 0.95;
constexpr double false_alarms = 0.02;    // of studies
constexpr double least_relative = 1e-3;  // differences of a mean that nobody prints
constexpr double most_energy = 0.01;     // made a period of the drive, of what that fall gives
constexpr double least_share = 1e-4;     // of the run's time, and of what a fall through the clearance gives: differences that nobody feels
/// Welch's test trusts means of few members to be normal: not of fewer, nor of numbers as skewed as rare events.
constexpr std::size_t least_of_welch = 12;
constexpr double most_skewed = 1.5;

/// How far the mean of all members of the study may be off by chance, as some of them tell it.
double chance_of_mean(Summary const& some, std::uint64_t all) {
    if (some.count < 2) return 0;
    return mean_interval(some, level).half_width() * std::sqrt(static_cast<double>(some.count) / static_cast<double>(all));
}

/// A difference below which a number with this unit is the same.
double least_difference(std::string const& unit, Scene const& scene) {
    if (unit == "s") return least_share * orbit_schedule(scene).end;
    return unit == "J" ? least_share * fall_energy(scene) : 0;
}

bool is_certain(Summary const& summary) {
    Interval const interval = mean_interval(summary, level);
    return interval.low > 0 || interval.high < 0;
}

}  // namespace

double fall_energy(Scene const& scene) {
    Inputs const in = complete_inputs(scene.inputs);
    double const clearance = std::max(in.clearance_y, in.clearance_z), speed = clearance * std::max(1.0, std::abs(in.crank_speed));
    return in.slider_mass * (std::abs(in.gravity) * clearance + speed * speed);
}

std::optional<EnergyCheck> audit_energy(MemberNumbers const& numbers, Scene const& scene) {
    std::vector<double> made;
    for (double const residual : numbers.energy_residual) made.push_back(std::abs(residual));
    Summary const summary = summarise(made);
    if (summary.count == 0) return {};
    double const end = orbit_schedule(scene).end, period = drive_period(scene.parts, scene.inputs);
    double const share = summary.mean / std::max(1.0, end / period) / fall_energy(scene);
    return EnergyCheck{share, !(share < most_energy)};
}

std::vector<CheckedColumn> compare(std::vector<MemberNumbers> const& numbers, Scene const& scene,
                                   std::vector<WholeColumn> const& whole, std::uint64_t all) {
    MemberNumbers const& study = numbers.front();
    std::vector<CheckedColumn> findings;
    std::vector<double> p;  // three tests of each finding, any of which may raise the alarm
    for (std::size_t method = 0; method + 1 < numbers.size(); ++method) {
        for (std::size_t column = 0; column < study.columns.size(); ++column) {
            auto const& own = study.columns[column];
            auto const& other = numbers[method + 1].columns[column].values;
            Summary const before = summarise(own.values), after = summarise(other);
            double const relevant =
                std::max({chance_of_mean(before, all), least_relative * std::abs(before.mean), least_difference(own.unit, scene)});
            CheckedColumn found{column, method, relevant, compare_pairs(own.values, other, relevant, level)};
            bool const paired = found.pairs.pairs >= least_members;
            p.push_back(paired ? found.pairs.p_mean : nan);
            p.push_back(paired ? found.pairs.p_distribution : nan);
            // Where the study's numbers scatter far more than they should, all of its members tell better than a few.
            bool const known = column < whole.size() && after.count >= least_of_welch && std::abs(whole[column].skewness) < most_skewed;
            found.welch = known ? after.mean - whole[column].summary.mean : 0;
            p.push_back(known ? welch_p(whole[column].summary, after) : nan);
            // A sign is what is said of an exponent first: it needs no adjustment for all the other numbers.
            bool const other_sign = before.mean * after.mean < 0 || !is_certain(after);
            found.refutes_sign = own.is_exponent && is_certain(before) && other_sign && found.pairs.p_mean < 1 - level;
            findings.push_back(found);
        }
    }
    std::vector<double> const adjusted = holm_adjusted(p);
    for (std::size_t i = 0; i < findings.size(); ++i) {
        CheckedColumn& found = findings[i];
        double const mean = adjusted[3 * i], distribution = adjusted[3 * i + 1], of_all = adjusted[3 * i + 2];
        double const least = std::fmin(mean, std::fmin(distribution, of_all));
        found.p = std::isnan(least) ? 1 : least;
        found.differs = found.refutes_sign || distribution < false_alarms ||
                        (mean < false_alarms && std::abs(found.pairs.difference) > found.relevant) ||
                        (of_all < false_alarms && std::abs(found.welch) > found.relevant);
    }
    return findings;
}

}  // namespace slideway
