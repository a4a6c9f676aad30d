#include "host/study/verification.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "host/study/continued_sweep.hpp"
#include "host/study/orbit_schedule.hpp"

namespace slideway {
namespace {

constexpr double of_the_study = 0.1;  // that a check may cost unasked
constexpr double first_share = 0.8;   // of what is left
constexpr std::size_t most_members = 16;
constexpr double steps_beyond = 2;    // how much more than foreseen a check may take

std::string remedy(Scene const& scene, Verification const& v) {
    if (scene.integrator.method == Method::rk4) return "use a smaller integrator.step, or method = \"auto\"";
    bool tolerance = false;
    for (CheckedColumn const& found : v.findings) tolerance = tolerance || (found.differs && v.methods[found.method].starts_with(name_of(scene.integrator.method)));
    std::string const tighter = fmt::format("integrator.rtol = {:.0e} and atol likewise", check_tightening * scene.integrator.rtol);
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
                            found.pairs.interval.half_width(), column.unit, found.p,
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
    std::optional<ToleranceMembers> stored;
    if (results.stores_members()) stored.emplace(results, 0, member_count(scene));
    std::uint64_t const all = stored ? stored->size() : member_count(scene);
    auto const asked = [&] { return std::min<std::uint64_t>(request.members.value_or(most_members), all); };
    auto const choose = [&](std::uint64_t count) {
        std::vector<std::uint64_t> const rows = spread_over(all, count);
        for (std::uint64_t const row : rows) v.members.push_back(stored ? stored->number(row) : row);
        return rows;
    };
    auto const run_again = [&](Scene const& check) { return fresh_numbers(check, v.members, backend, request.threads, request.stop); };
    std::vector<double> work;
    std::vector<WholeColumn> whole;
    double total = 0;
    if (stored) {
        work = stored_work(*stored);
        total = std::accumulate(work.begin(), work.end(), 0.0);
    } else if (request.members || all * of_the_study > 2 * most_members) {
        // What members came to is not there: those that are compared run as in the study, too.
        choose(asked());
        v.numbers.push_back(run_again(without_series(scene)));
        total = v.numbers.front().total_work() * static_cast<double>(all) / static_cast<double>(v.members.size());
    }
    if (!(total > 0)) return not_checked(std::move(v), stored ? "no member ran" : "members are not stored; run --verify does it");
    std::vector<CheckMethod> methods = check_methods(scene);

    // Each check may have what is left of the whole, shared with those after it.
    double left = of_the_study * total, dearest = 0;
    double const mean_work = total / static_cast<double>(all);
    for (std::size_t i = 0; i < methods.size(); ++i) {
        CheckMethod& method = methods[i];
        // The first ones may take most of it: one check is better than several halves.
        double const share = i + 1 < methods.size() ? first_share * left : left, of_a_member = method.cost * mean_work;
        dearest += method.cost * static_cast<double>(std::min<std::uint64_t>(most_members, all));
        if (v.members.empty()) {
            std::uint64_t count = asked();
            if (!request.members) count = std::min(count, static_cast<std::uint64_t>(share / of_a_member));
            if (!request.members && count < least_members) continue;
            v.numbers.push_back(stored_numbers(*stored, scene, choose(count), work, whole));
        }
        if (!request.members) {
            auto const count = static_cast<double>(v.members.size());
            if (share < count * of_a_member) continue;
            limit_steps(method.scene, std::min(share / count, steps_beyond * of_a_member));
        }
        v.numbers.push_back(run_again(method.scene));
        if (request.stop != nullptr && request.stop->reason() != StopReason::none) return not_checked(std::move(v), "the run was stopped");
        v.methods.push_back(method.words);
        v.finished.push_back(v.numbers.back().finished());
        double const spent = v.numbers.back().total_work();
        left -= spent;
        v.share += spent / total;
    }
    if (v.methods.empty()) {
        return not_checked(std::move(v), fmt::format("it would take some {:.2g} times the study's work; run --verify does it",
                                                     dearest / static_cast<double>(all)));
    }
    v.findings = compare(v.numbers, scene, whole, all);
    bool const enough = std::any_of(v.findings.begin(), v.findings.end(), [&](CheckedColumn const& found) {
        return found.pairs.pairs >= least_members && 2 * found.pairs.pairs > v.members.size();
    });
    bool const differs = std::any_of(v.findings.begin(), v.findings.end(), [](CheckedColumn const& found) { return found.differs; });
    if (!enough && !differs) {
        if (v.numbers.front().finished() < least_members) return not_checked(std::move(v), "too few of its members came to their end");
        std::string ends;
        for (std::size_t i = 0; i < v.methods.size(); ++i)
            ends += fmt::format("{}{} of {} by {}", i > 0 ? ", " : "", v.finished[i], v.members.size(), v.methods[i]);
        return not_checked(std::move(v), fmt::format("too few members came to their end again ({}){}", ends,
                                                     request.members ? "" : "; run --verify gives them more time"));
    }
    v.resolution = differs ? Resolution::not_resolved : Resolution::resolved;
    v.summary = describe(v, scene);
    return v;
}

}  // namespace slideway
