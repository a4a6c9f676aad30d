#include "host/study/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "host/driver/ensemble.hpp"
#include "host/scene/descriptors.hpp"
#include "host/statistics/summary.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/exponent_table.hpp"
#include "host/study/orbit_schedule.hpp"
#include "host/study/state_numbers.hpp"
#include "host/study/tolerance_policy.hpp"

namespace slideway {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double level = 0.95;
constexpr double false_alarms = 0.02;    // of studies
constexpr double least_relative = 1e-3;  // differences of a mean that nobody prints
constexpr double least_share = 1e-4;     // of the run's time, and of what a fall through the clearance gives: differences that nobody feels
constexpr double of_the_study = 0.1;     // that a check may cost unasked
constexpr double first_share = 0.8;      // of what is left
constexpr std::size_t most_members = 16, least_members = 6;
/// Welch's test trusts means of few members to be normal: not of fewer, nor of numbers as skewed as rare events.
constexpr std::size_t least_of_welch = 12;
constexpr double most_skewed = 1.5;
constexpr double jacobian_work = 1.5;    // right-hand sides
constexpr double steps_beyond = 2;       // how much more than foreseen a check may take

/// When members end, about.
double plan_end(Scene const& scene) { return orbit_schedule(scene).longest; }

/// Column names of a scene's numbers.
MemberNumbers empty_numbers(Scene const& scene) {
    MemberNumbers numbers;
    LawInfo const& law = info(scene.parts.law);
    bool const residual_is_error = info(scene.parts.mechanism).spatial ? !law.switches : true;
    for (QuantityColumn const& column : report_columns(scene.quantities)) {
        if (residual_is_error && column.quantity == quantity_table[static_cast<int>(Quantity::energy_residual)].name) continue;
        numbers.columns.push_back({column.name(), column.unit, false, {}});
    }
    int const exponents = shadow_plan(scene).count;
    for (int j = 1; j <= exponents; ++j) numbers.columns.push_back({fmt::format("lyapunov_exponent[{}]", j), "1/s", true, {}});
    for (char const* kind : {"surfaces", "lines", "points"})
        numbers.columns.push_back({fmt::format("{} at the end", kind), "1", false, {}});
    return numbers;
}

/// Surfaces, lines and points that touch where members ended.
void put_end_contacts(Scene const& scene, std::span<Inputs const> inputs, std::span<double const> times,
                      std::span<double const> states, std::span<bool const> finished, MemberNumbers& numbers) {
    Mechanism const mechanism = scene.parts.mechanism;
    auto const width = static_cast<std::size_t>(info(mechanism).states);
    std::vector<Inputs> at(inputs.begin(), inputs.end());
    for (std::size_t i = 0; i < at.size(); ++i) {
        StateNumbers state{};
        std::copy_n(states.data() + i * width, width, state.begin());
        if (finished[i]) set_start(mechanism, state, at[i]);
    }
    std::vector<ProbeResult> results(at.size());
    find_instance(best_isa(), scene.parts).probe({at.data(), times.data(), at.size(), results.data()});
    auto const columns = std::span(numbers.columns).last(3);
    for (std::size_t i = 0; i < at.size(); ++i) {
        bool const known = finished[i] && results[i].status == Status::finished;
        columns[0].values.push_back(known ? results[i].surfaces : nan);
        columns[1].values.push_back(known ? results[i].lines : nan);
        columns[2].values.push_back(known ? results[i].points : nan);
    }
}

std::vector<std::uint64_t> numbers_of(ResultView const& results) {
    std::vector<std::uint64_t> members;
    for (double const member : results.values("member")) members.push_back(static_cast<std::uint64_t>(member));
    return members;
}

/// Where members stand in a result, by their number.
std::vector<std::size_t> rows_of(ResultView const& results, std::vector<std::uint64_t> const& members) {
    std::map<std::uint64_t, std::size_t> rows;
    std::vector<double> const numbers = results.values("member");
    for (std::size_t i = 0; i < numbers.size(); ++i) rows[static_cast<std::uint64_t>(numbers[i])] = i;
    std::vector<std::size_t> found;
    for (std::uint64_t const member : members) found.push_back(rows.at(member));
    return found;
}

/// A number over all members of a study.
struct Whole {
    Summary summary;
    double skewness;  // mean cube of what is off the mean, in standard deviations; NaN where all are alike
};

Whole whole_of(std::vector<double> const& values) {
    Summary const summary = summarise(values);
    double cubes = 0;
    for (double const x : values) {
        if (!std::isnan(x)) cubes += std::pow((x - summary.mean) / summary.sd, 3);
    }
    return {summary, cubes / static_cast<double>(summary.count)};
}

std::vector<double> work_of(ResultView const& results) {
    std::vector<double> work = results.values("rhs_evaluations");
    std::vector<double> const jacobians = results.values("jacobian_evaluations");
    for (std::size_t i = 0; i < work.size(); ++i) work[i] += jacobian_work * jacobians[i];
    return work;
}

/// What the study says of some of its members.  @param whole where each column's summary over all of its members goes, but those of how
/// they end
MemberNumbers stored_numbers(ResultView const& results, Scene const& scene, std::vector<std::uint64_t> const& members,
                             std::vector<Whole>& whole) {
    MemberNumbers numbers = empty_numbers(scene);
    std::vector<std::size_t> const rows = rows_of(results, members);
    std::vector<double> const statuses = results.values("status");
    std::unique_ptr<bool[]> const finished(new bool[rows.size()]);
    constexpr auto is_finished = static_cast<double>(static_cast<signed char>(Status::finished));
    for (std::size_t i = 0; i < rows.size(); ++i)
        finished[i] = statuses[rows[i]] == is_finished;

    std::vector<double> const work = work_of(results);
    for (std::size_t const row : rows) numbers.work.push_back(work[row]);
    std::size_t column = 0;
    auto const put = [&](std::vector<double> const& values, std::size_t width, std::size_t index) {
        std::vector<double>& to = numbers.columns[column++].values;
        for (std::size_t i = 0; i < rows.size(); ++i) to.push_back(finished[i] ? values[rows[i] * width + index] : nan);
        std::vector<double> all;
        for (std::size_t row = 0; row < statuses.size(); ++row) {
            if (statuses[row] == is_finished) all.push_back(values[row * width + index]);
        }
        whole.push_back(whole_of(all));
    };
    for (QuantityColumn const& of : report_columns(scene.quantities)) {
        if (numbers.columns[column].name != of.name()) continue;  // not compared
        std::vector<double> const values = results.values(of.quantity);
        put(values, values.size() / statuses.size(), of.index);
    }
    if (auto const exponents = static_cast<std::size_t>(shadow_plan(scene).count); exponents > 0) {
        std::vector<double> const values = results.values("lyapunov_exponent");
        for (std::size_t j = 0; j < exponents; ++j) put(values, exponents, j);
    }
    auto const width = static_cast<std::size_t>(info(scene.parts.mechanism).states);
    std::vector<Inputs> inputs;
    std::vector<double> times, states(rows.size() * width);
    std::vector<double> const ends = results.values("end_time");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        inputs.push_back(member_inputs(scene, members[i]));
        times.push_back(ends[rows[i]]);
    }
    for (std::size_t k = 0; k < width; ++k) {
        std::vector<double> const values =
            results.values(fmt::format("final_{}", state_info(info(scene.parts.mechanism), static_cast<int>(k)).name));
        for (std::size_t i = 0; i < rows.size(); ++i) states[i * width + k] = values[rows[i]];
    }
    put_end_contacts(scene, inputs, times, states, {finished.get(), rows.size()}, numbers);
    return numbers;
}

/// Of a column in a member's row of all quantities.
std::size_t place_of(QuantityColumn const& column) {
    int q = 0;
    while (column.quantity != quantity_table[q].name) ++q;
    return static_cast<std::size_t>(quantity_column(static_cast<Quantity>(q))) + column.index;
}

/// Runs members, and says what they came to in their order.
MemberNumbers fresh_numbers(Scene const& scene, std::vector<std::uint64_t> const& members, Backend const& backend,
                            VerificationRequest const& request) {
    MemberNumbers numbers = empty_numbers(scene);
    std::size_t const count = members.size();
    numbers.work.assign(count, nan);
    for (auto& column : numbers.columns) column.values.assign(count, nan);
    std::map<std::uint64_t, std::size_t> places;
    for (std::size_t i = 0; i < count; ++i) places[members[i]] = i;

    ExponentTable const exponents(scene);
    auto const offsets = static_cast<std::size_t>(shadow_plan(scene).count);
    std::vector<QuantityColumn> const asked = report_columns(scene.quantities);
    auto const take = [&](BlockResult const& block) {
        std::size_t const size = block.members.size();
        std::unique_ptr<bool[]> const finished(new bool[size]);
        std::vector<double> times;
        for (std::size_t i = 0; i < size; ++i) {
            finished[i] = block.records[i].status == Status::finished;
            times.push_back(block.records[i].time);
        }
        StudyValues const of_exponents = exponents.values(block);
        MemberNumbers ends = empty_numbers(scene);
        put_end_contacts(scene, block.inputs, times, block.final_states, {finished.get(), size}, ends);
        for (std::size_t i = 0; i < size; ++i) {
            std::size_t const place = places.at(block.members[i]);
            MemberRecord const& record = block.records[i];
            numbers.work[place] = static_cast<double>(record.rhs_evaluations) + jacobian_work * static_cast<double>(record.jacobian_evaluations);
            if (!finished[i]) continue;
            std::size_t column = 0;
            for (QuantityColumn const& of : asked) {
                if (numbers.columns[column].name != of.name()) continue;
                numbers.columns[column++].values[place] = block.quantities[i * quantity_columns + place_of(of)];
            }
            for (std::size_t j = 0; j < offsets; ++j) numbers.columns[column++].values[place] = of_exponents[0][i * offsets + j];
            for (std::size_t k = column; k < numbers.columns.size(); ++k) numbers.columns[k].values[place] = ends.columns[k].values[i];
        }
    };
    EnsemblePlan const plan = ensemble_plan(scene, MemberSet::of(members), backend, request.threads);
    StopRequest const nobody;
    run_ensemble(plan, backend.kernel(scene.parts, plan.request.shadows.count > 0), take,
                 request.stop != nullptr ? *request.stop : nobody);
    return numbers;
}

std::size_t finished_of(MemberNumbers const& numbers) {
    auto const& ends = numbers.columns.back().values;
    return static_cast<std::size_t>(std::count_if(ends.begin(), ends.end(), [](double x) { return !std::isnan(x); }));
}

/// Members, evenly over all of them.
std::vector<std::uint64_t> spread_members(std::uint64_t all, std::uint64_t count) {
    std::vector<std::uint64_t> members;
    for (std::uint64_t i = 0; i < count; ++i) members.push_back(static_cast<std::uint64_t>(static_cast<double>(i) * static_cast<double>(all) / static_cast<double>(count)));
    return members;
}

double half_width(Interval const& interval) { return 0.5 * (interval.high - interval.low); }

/// How far the mean of all members of the study may be off by chance, as some of them tell it.
double chance_of_mean(std::vector<double> const& values, std::uint64_t all) {
    Summary const summary = summarise(values);
    if (summary.count < 2) return 0;
    double const of_these = half_width(mean_interval(summary, level));
    return of_these * std::sqrt(static_cast<double>(summary.count) / static_cast<double>(all));
}

bool is_certain(Summary const& summary) {
    Interval const interval = mean_interval(summary, level);
    return interval.low > 0 || interval.high < 0;
}

/// A difference below which a number with this unit is the same.
double least_difference(std::string const& unit, Scene const& scene) {
    if (unit == "s") return least_share * plan_end(scene);
    if (unit != "J") return 0;
    Inputs const in = complete_inputs(scene.inputs);
    double const clearance = std::max(in.clearance_y, in.clearance_z), speed = clearance * std::max(1.0, std::abs(in.crank_speed));
    return least_share * in.slider_mass * (std::abs(in.gravity) * clearance + speed * speed);
}

/// Looks at every column of every check.
/// @param whole of the study's columns over all of its members, as far as they are known
void compare(Verification& v, Scene const& scene, std::vector<Whole> const& whole, std::uint64_t all) {
    MemberNumbers const& study = v.numbers.front();
    std::vector<double> p;
    for (std::size_t method = 0; method + 1 < v.numbers.size(); ++method) {
        for (std::size_t column = 0; column < study.columns.size(); ++column) {
            auto const& own = study.columns[column];
            double const relevant = std::max({chance_of_mean(own.values, all), least_relative * std::abs(summarise(own.values).mean),
                                              least_difference(own.unit, scene)});
            CheckedColumn found{column, method, relevant,
                                compare_pairs(own.values, v.numbers[method + 1].columns[column].values, relevant, level)};
            // Any of them may raise the alarm.
            p.push_back(found.pairs.pairs >= least_members ? found.pairs.p_mean : nan);
            p.push_back(found.pairs.pairs >= least_members ? found.pairs.p_distribution : nan);
            // Where the study's numbers scatter far more than they should, all of its members tell better than a few.
            Summary const again = summarise(v.numbers[method + 1].columns[column].values);
            bool const known = column < whole.size() && again.count >= least_of_welch && std::abs(whole[column].skewness) < most_skewed;
            found.welch = known ? again.mean - whole[column].summary.mean : 0;
            p.push_back(known ? welch_p(whole[column].summary, again) : nan);
            v.findings.push_back(found);
        }
    }
    std::vector<double> const adjusted = holm_adjusted(p);
    for (std::size_t i = 0; i < v.findings.size(); ++i) {
        CheckedColumn& found = v.findings[i];
        auto const& own = study.columns[found.column];
        auto const& other = v.numbers[found.method + 1].columns[found.column];
        double const least = std::fmin(adjusted[3 * i], std::fmin(adjusted[3 * i + 1], adjusted[3 * i + 2]));
        bool const mean_differs = (adjusted[3 * i] < false_alarms && std::abs(found.pairs.difference) > found.relevant) ||
                                  (adjusted[3 * i + 2] < false_alarms && std::abs(found.welch) > found.relevant);
        bool const distribution_differs = adjusted[3 * i + 1] < false_alarms;
        found.p = std::isnan(least) ? 1 : least;
        found.differs = mean_differs || distribution_differs;
        if (!own.is_exponent) continue;
        Summary const before = summarise(own.values), after = summarise(other.values);
        bool const other_sign = before.mean * after.mean < 0 || !is_certain(after);
        // A sign is what is said of an exponent first: it needs no adjustment for all the other numbers.
        found.refutes_sign = is_certain(before) && other_sign && found.pairs.p_mean < 1 - level;
        found.differs = found.differs || found.refutes_sign;
    }
}

std::string remedy(Scene const& scene, Verification const& v) {
    if (scene.integrator.method == Method::rk4) return "use a smaller integrator.step, or method = \"auto\"";
    bool tolerance = false;
    for (CheckedColumn const& found : v.findings) tolerance = tolerance || (found.differs && v.methods[found.method].starts_with(name_of(scene.integrator.method)));
    std::string const tighter = fmt::format("integrator.rtol = {:.0e} and atol likewise", 0.01 * scene.integrator.rtol);
    if (scene.integrator.method == Method::automatic || tolerance) return "use " + tighter;
    return fmt::format("use {}, or method = \"auto\"", tighter);
}

std::string joined(std::vector<std::string> const& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " and by " : ", by ") + words[i];
    return text;
}

std::string describe(Verification const& v, Scene const& scene) {
    std::string const again = fmt::format("{} members again by {} ({:.2g} % of the study's work)", v.members.size(), joined(v.methods), 100 * v.share);
    std::string unfinished;
    for (std::size_t i = 0; i < v.methods.size(); ++i) {
        if (v.finished[i] < v.members.size())
            unfinished += fmt::format("\n  by {} {} of {} came to their end", v.methods[i], v.finished[i], v.members.size());
    }
    if (v.resolution == Resolution::resolved)
        return fmt::format("resolved: {}: no mean and no distribution differs beyond chance", again) + unfinished;
    std::string text = fmt::format("NOT RESOLVED by {}: {}", v.settings, again) + unfinished;
    for (CheckedColumn const& found : v.findings) {
        if (!found.differs) continue;
        auto const& column = v.numbers.front().columns[found.column];
        text += fmt::format("\n  {}: {:.4g} of these members, {:.4g} by {} (difference {:.3g} ± {:.2g} {}, p = {:.1g}){}", column.name,
                            found.pairs.first, found.pairs.second, v.methods[found.method], found.pairs.difference,
                            half_width(found.pairs.interval), column.unit, found.p,
                            found.refutes_sign ? ": the sign of the study's is refuted" : "");
    }
    return text + "\n  " + remedy(scene, v);
}

Verification not_checked(Verification v, std::string const& why) {
    v.resolution = Resolution::not_checked;
    v.summary = "not checked against tighter tolerances: " + why;
    return v;
}

/// Bounds what a check may take, in steps.
void limit_steps(Scene& check, double work_of_a_member) {
    constexpr double of_a_step = 4;  // right-hand sides, of the cheapest method
    double const steps = work_of_a_member / (of_a_step * (1 + shadow_plan(check).count));
    check.integrator.max_steps = std::min(check.integrator.max_steps, static_cast<std::uint64_t>(std::max(1.0, steps)));
}

}  // namespace

Verification verify(ResultView const& results, Scene const& scene, Backend const& backend, VerificationRequest const& request) {
    Verification v;
    v.settings = words_of(scene.integrator);
    if (request.members == 0u) return not_checked(std::move(v), "study.verify is 0");
    if (is_continued(scene)) return not_checked(std::move(v), "columns of this sweep go on from one another");
    bool const stores = results.stores_members();
    std::vector<std::uint64_t> ran = stores ? numbers_of(results) : std::vector<std::uint64_t>();
    std::uint64_t const all = stores ? ran.size() : member_count(scene);
    auto const chosen = [&](std::uint64_t count) {
        std::vector<std::uint64_t> members = spread_members(all, count);
        if (stores) std::transform(members.begin(), members.end(), members.begin(), [&](std::uint64_t row) { return ran[row]; });
        return members;
    };
    std::vector<std::uint64_t> members;
    std::vector<Whole> whole;
    double total = 0;
    if (stores) {
        std::vector<double> const work = work_of(results);
        total = std::accumulate(work.begin(), work.end(), 0.0);
    } else if (request.members || all * of_the_study > 2 * most_members) {
        // What members came to is not there: those that are compared run as in the study, too.
        members = chosen(std::min<std::uint64_t>(request.members.value_or(most_members), all));
        v.numbers.push_back(fresh_numbers(without_series(scene), members, backend, request));
        auto const& work = v.numbers.front().work;
        total = std::accumulate(work.begin(), work.end(), 0.0) * static_cast<double>(all) / static_cast<double>(members.size());
        v.members = members;
    }
    if (!(total > 0)) return not_checked(std::move(v), stores ? "no member ran" : "members are not stored; run --verify does it");
    std::vector<CheckMethod> methods = check_methods(scene);

    // Each check may have what is left of the whole, shared with those after it.
    double left = of_the_study * total, dearest = 0;
    double const mean_work = total / static_cast<double>(all);
    for (std::size_t i = 0; i < methods.size(); ++i) {
        CheckMethod& method = methods[i];
        // The first ones may take most of it: one check is better than several halves.
        double const share = i + 1 < methods.size() ? first_share * left : left;
        dearest += method.cost * static_cast<double>(std::min<std::uint64_t>(most_members, all));
        if (members.empty()) {
            std::uint64_t count = std::min<std::uint64_t>(request.members.value_or(most_members), all);
            if (!request.members) count = std::min(count, static_cast<std::uint64_t>(share / (method.cost * mean_work)));
            if (!request.members && count < least_members) continue;
            v.members = members = chosen(count);
            v.numbers.push_back(stored_numbers(results, scene, members, whole));
        }
        auto const count = static_cast<double>(members.size());
        if (!request.members) {
            if (share < count * method.cost * mean_work) continue;
            limit_steps(method.scene, std::min(share / count, steps_beyond * method.cost * mean_work));
        }
        v.numbers.push_back(fresh_numbers(method.scene, members, backend, request));
        if (request.stop != nullptr && request.stop->reason() != StopReason::none) return not_checked(std::move(v), "the run was stopped");
        v.methods.push_back(method.words);
        v.finished.push_back(finished_of(v.numbers.back()));
        double const spent = std::accumulate(v.numbers.back().work.begin(), v.numbers.back().work.end(), 0.0);
        left -= spent;
        v.share += spent / total;
    }
    if (v.methods.empty()) {
        return not_checked(std::move(v), fmt::format("it would take some {:.2g} times the study's work; run --verify does it",
                                                     dearest / static_cast<double>(all)));
    }
    compare(v, scene, whole, all);
    bool const enough = std::any_of(v.findings.begin(), v.findings.end(), [&](CheckedColumn const& found) {
        return found.pairs.pairs >= least_members && 2 * found.pairs.pairs > v.members.size();
    });
    bool const differs = std::any_of(v.findings.begin(), v.findings.end(), [](CheckedColumn const& found) { return found.differs; });
    if (!enough && !differs) return not_checked(std::move(v), finished_of(v.numbers.front()) < least_members ? "too few of its members came to their end"
                                                                                      : "too few members came to their end in the time for it; run --verify gives them more");
    v.resolution = differs ? Resolution::not_resolved : Resolution::resolved;
    v.summary = describe(v, scene);
    return v;
}

}  // namespace slideway
