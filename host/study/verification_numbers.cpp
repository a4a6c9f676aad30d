// What the study says of its members beside what they say when they run again.
#include <algorithm>
#include <array>
#include <cmath>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/tolerance_report.hpp"
#include "host/study/verification.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

using Kind = MemberNumbers::Kind;

constexpr double level = 0.95;
constexpr double false_alarms = 0.02;    // of studies
constexpr double least_relative = 1e-3;  // errors of a number that nobody prints
constexpr double most_skewed = 3;        // of numbers whose mean is made by many
constexpr double most_energy = 0.01;     // made a period of the drive, of what that fall gives
constexpr double felt = 1e-4;  // of what a fall through the clearance comes to: of smaller differences nobody is warned
constexpr double of_rounding = 1e-9; // of what a fall through the clearance comes to: numbers that are 0 but for that

bool is_certain(double mean, double half_width) { return std::abs(mean) > half_width; }

/// Values of a column in those rows of a group that are draws.
std::vector<double> group_values(Verification const& v, MemberGroup const& group, std::size_t column) {
    std::vector<double> values;
    for (std::size_t row = 0; row < group.has.size(); ++row) {
        if (group.has[row] && v.draws[row]) values.push_back(v.study.columns[column].values[row]);
    }
    return values;
}

/// Mean cube of what is off the mean, in standard deviations; 0 where all are alike.
double skewness(std::vector<double> const& values, Summary const& summary) {
    double cubes = 0;
    for (double const x : values) cubes += std::isnan(x) ? 0 : std::pow(x - summary.mean, 3);
    return summary.sd > 0 ? cubes / static_cast<double>(summary.count) / std::pow(summary.sd, 3) : 0;
}

/// What the study says of a number, how sure it is, and how far its members scatter.
void describe_study(CheckedNumber& n, Verification const& v, Scene const& scene) {
    auto const& column = v.study.columns[n.column];
    std::vector<double> const values = group_values(v, v.groups[n.group], n.column);
    Summary const summary = summarise(values);
    auto const known = static_cast<double>(summary.count);
    // Of a study whose members are not stored some stand for all.
    double const all = n.group == 0 && v.all > v.study.finished.size() ? static_cast<double>(v.all) : known;
    n.value = summary.count > 0 ? summary.mean : nan;
    n.half_width = summary.count > 1 ? mean_interval(summary, level).half_width() * std::sqrt(known / all) : 0;
    n.spread = summary.count > 1 ? summary.sd : 0;
    // Where forces jump, orbits do not follow their start; and where few members make the mean, their like may be missing.
    bool const jumps = makes_energy(scene.parts), by_few = std::abs(skewness(values, summary)) > most_skewed;
    n.unseen = (jumps || by_few) && summary.count > 1 ? summary.max - summary.min : n.spread;
    if (column.kind == Kind::limit && summary.count > 0) {
        // Where all meet it, or none, the next might not.
        auto const met = static_cast<std::uint64_t>(std::llround(summary.mean * known));
        n.half_width = proportion(met, summary.count, level).interval.half_width() * std::sqrt(known / all);
        double const share = (static_cast<double>(met) + 2) / (known + 4);
        n.spread = std::sqrt(share * (1 - share));
        n.unseen = jumps ? 1 : n.spread;
    }
    double const natural = natural_scale(column.unit, scene);
    n.margin = std::max({n.half_width, least_relative * std::abs(n.value), of_rounding * natural});
    n.least_felt = std::max(n.margin, felt * natural);
    // What scatters by rounding does not scatter.
    double const largest = std::max(std::abs(summary.min), std::abs(summary.max));
    if (n.spread <= of_rounding * std::max(natural, largest)) n.spread = n.unseen = 0;
}

/// Differences of a group's pairs, check less study; of one method, or of all that count for the column.
std::vector<double> differences(Verification const& v, CheckedNumber const& n, std::ptrdiff_t method = -1) {
    std::vector<double> found;
    bool const is_exponent = v.study.columns[n.column].kind == Kind::exponent;
    for (std::size_t i = 0; i < v.pairs.size(); ++i) {
        CheckPair const& pair = v.pairs[i];
        CheckMethod const& by = v.methods[pair.method];
        bool const counts = method < 0 ? !by.of_exponents : pair.method == static_cast<std::size_t>(method);
        if (!pair.finished || !v.groups[n.group].has[pair.row] || !counts || (by.of_exponents && !is_exponent)) continue;
        double const difference =
            by.error_per_difference * (v.again[n.column][i] - v.study.columns[n.column].values[pair.row]);
        if (!std::isnan(difference)) found.push_back(difference);
    }
    return found;
}

/// The bound by all pairs; where one method says more than that, by it: what it sees alone others would dilute.
/// @param p a test of all pairs, and of those of each method
void bound_error(CheckedNumber& n, Verification const& v, std::vector<double>& p) {
    std::size_t const members =
        n.group == 0 ? std::max<std::size_t>(v.groups[0].size(), v.all) : v.groups[n.group].size();
    double const grain = v.study.columns[n.column].unit == "1" ? 1 : 0;
    n.error = error_bound(differences(v, n), members, n.unseen, grain);
    p.push_back(n.error.p);
    double largest = std::abs(n.error.difference);
    for (std::size_t method = 0; method < v.methods.size(); ++method) {
        ErrorBound const of_method =
            error_bound(differences(v, n, static_cast<std::ptrdiff_t>(method)), members, n.unseen, grain);
        p.push_back(of_method.pairs >= least_members ? of_method.p : nan);
        // Offsets that collapse into rounding tell nothing but that they collapse.
        bool const collapse = v.methods[method].of_exponents && n.value < 0 && n.value + of_method.difference < 0;
        if (collapse) p.back() = nan;
        if (collapse || of_method.pairs < 2 || !(std::abs(of_method.difference) > largest)) continue;
        largest = std::abs(of_method.difference);
        n.error.difference = of_method.difference;
        n.error.bound = std::max(n.error.bound, largest);
    }
    std::array<std::size_t, 2> by{};  // the first two methods are of all numbers
    for (CheckPair const& pair : v.pairs) {
        if (!v.groups[n.group].has[pair.row]) continue;
        n.cut += !pair.finished;
        if (pair.finished && pair.method < by.size()) ++by[pair.method];
    }
    n.two_methods = 4 * std::min(by[0], by[1]) >= by[0] + by[1];
}

/// Whether those that ran again are not certain of the sign of the study's mean, by their own interval.
bool has_other_sign(CheckedNumber const& n, Verification const& v) {
    std::vector<double> again;
    for (std::size_t i = 0; i < v.pairs.size(); ++i) {
        if (v.groups[n.group].has[v.pairs[i].row]) again.push_back(v.again[n.column][i]);
    }
    Summary const summary = summarise(again);
    if (summary.count < least_members) return false;
    return n.value * summary.mean < 0 || !is_certain(summary.mean, mean_interval(summary, level).half_width());
}

Verdict verdict_of(CheckedNumber const& n) {
    bool const differs = n.refutes_sign || (n.p < false_alarms && std::abs(n.error.difference) > n.least_felt);
    if (differs) return Verdict::not_resolved;
    if (n.cut > 0 || std::isnan(n.error.bound)) return Verdict::undecided;
    if (n.error.bound <= n.margin && n.two_methods) return Verdict::resolved;
    return n.spread > 0 && n.error.bound > n.spread ? Verdict::undecided : Verdict::bounded;
}

/// A number in which all members are alike tells nothing by itself: those that would show it may be missing.  It is worth what the others are,
/// and nothing where it is 0: what nobody has seen was not compared.
void follow_others(std::vector<CheckedNumber>& numbers, Verification const& v) {
    auto const is_alike = [](CheckedNumber const& n) { return n.verdict == Verdict::resolved && n.agrees_as_all_do(); };
    std::vector<Verdict> worst(v.groups.size(), Verdict::resolved);
    for (CheckedNumber const& n : numbers) {
        if (v.study.columns[n.column].kind != Kind::contacts && !is_alike(n)) worst[n.group] = std::max(worst[n.group], n.verdict);
    }
    for (CheckedNumber& n : numbers) {
        if (is_alike(n)) n.verdict = n.is_unseen() ? Verdict::undecided : std::min(worst[n.group], Verdict::undecided);
    }
}

}  // namespace

double fall_energy(Scene const& scene) {
    Inputs const in = complete_inputs(scene.inputs, info(scene.parts.mechanism));
    MemberSize const size = size_of(scene.parts.mechanism, in);
    double const speed = size.most_play * std::max(1.0, std::abs(in.crank_speed));
    return size.mass * (std::abs(in.gravity) * size.most_play + speed * speed);
}

std::optional<EnergyCheck> audit_energy(std::vector<double> const& residuals, Scene const& scene) {
    std::vector<double> made;
    for (double const residual : residuals) made.push_back(std::abs(residual));
    Summary const summary = summarise(made);
    if (summary.count == 0) return {};
    double const share = summary.mean / std::max(1.0, orbit_schedule(scene).turns) / fall_energy(scene);
    return EnergyCheck{share, !(share < most_energy)};
}

std::vector<CheckedNumber> check_numbers(Verification const& v, Scene const& scene) {
    std::vector<CheckedNumber> numbers;
    std::vector<double> p;
    for (std::size_t group = 0; group < v.groups.size(); ++group) {
        for (std::size_t column = 0; column < v.study.columns.size(); ++column) {
            CheckedNumber& n = numbers.emplace_back();
            n.group = group;
            n.column = column;
            describe_study(n, v, scene);
            bound_error(n, v, p);
        }
    }
    std::vector<double> const adjusted = holm_adjusted(p);
    std::size_t const tests = 1 + v.methods.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        CheckedNumber& n = numbers[i];
        for (std::size_t test = 0; test < tests; ++test) n.p = std::fmin(n.p, adjusted[i * tests + test]);
        auto const& column = v.study.columns[n.column];
        n.refutes_sign = column.kind == Kind::exponent && is_certain(n.value, n.half_width) && n.p < 1 - level && has_other_sign(n, v);
        n.verdict = verdict_of(n);
    }
    follow_others(numbers, v);
    return numbers;
}

}  // namespace slideway
