#include "host/study/verification.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/study/continued_sweep.hpp"
#include "host/study/orbit_schedule.hpp"

namespace slideway {
namespace {

constexpr double of_the_study = 0.1;  // that a check may cost unasked
constexpr double first_share = 0.8;   // of what is left
constexpr double steps_beyond = 2;    // how much more than foreseen a check may take

std::string remedy(Scene const& scene, Verification const& v) {
    if (has_fixed_step(scene.integrator.method)) return "use a smaller integrator.step, or method = \"auto\"";
    bool const tolerance = std::ranges::any_of(
        v.findings, [&](CheckedColumn const& found) { return found.differs && v.methods[found.method].starts_with(name_of(scene.integrator.method)); });
    std::string const tighter = fmt::format("integrator.rtol = {:.0e} and atol likewise", check_tightening * scene.integrator.rtol);
    if (scene.integrator.method == Method::automatic || tolerance) return "use " + tighter;
    return fmt::format("use {}, or method = \"auto\"", tighter);
}

std::string describe(Verification const& v, Scene const& scene) {
    std::string by = v.methods.front();
    for (std::size_t i = 1; i < v.methods.size(); ++i) by += (i + 1 == v.methods.size() ? " and by " : ", by ") + v.methods[i];
    std::string const again = fmt::format("{} members again by {} ({:.2g} % of the study's work)", v.members.size(), by, 100 * v.share);
    std::string unfinished;
    for (std::size_t i = 0; i < v.methods.size(); ++i) {
        if (v.finished[i] < v.members.size())
            unfinished += fmt::format("\n  by {} {} of {} finished", v.methods[i], v.finished[i], v.members.size());
    }
    std::string const energy =
        v.energy ? fmt::format("energy audit: the integration makes {:.2g} % of the energy of the slider's fall through its clearance in a period of the drive{}",
                               100 * v.energy->share, v.energy->is_too_much ? ": too much for exponents" : "")
                 : "";
    if (v.resolution == Resolution::resolved)
        return fmt::format("resolved: {}: no mean and no distribution differs beyond chance{}{}", again, v.energy ? "; " : "", energy) + unfinished;
    std::string text = fmt::format("NOT RESOLVED by {}: {}", v.settings, again) + unfinished;
    for (CheckedColumn const& found : v.findings) {
        if (!found.differs) continue;
        auto const& column = v.numbers.front().columns[found.column];
        text += fmt::format("\n  {}: {:.4g} of these members, {:.4g} by {} (difference {:.3g} ± {:.2g} {}, p = {:.1g}){}", column.name,
                            found.pairs.first, found.pairs.second, v.methods[found.method], found.pairs.difference,
                            found.pairs.interval.half_width(), column.unit, found.p,
                            found.refutes_sign ? ": the sign of the study's is refuted" : "");
    }
    if (v.energy && v.energy->is_too_much) text += "\n  " + energy;
    return text + "\n  " + remedy(scene, v);
}

Verification not_checked(Verification v, std::string const& why) {
    v.resolution = Resolution::not_checked;
    v.summary = "not checked against tighter tolerances: " + why;
    return v;
}

/// Which checks there is work for.  Each may have what is left of the whole, shared with those after it: the first ones may take most
/// of it, for one check is better than several halves.
class Budget {
public:
    /// @param asked as in VerificationRequest  @param all members of the study  @param total their work
    /// @param members that are chosen already, or 0
    Budget(std::optional<std::uint64_t> asked, std::uint64_t all, double total, std::uint64_t members)
        : is_asked_(asked.has_value()), most_(std::min<std::uint64_t>(asked.value_or(most_checked), all)), mean_work_(total / static_cast<double>(all)),
          left_(of_the_study * total), members_(members) {}

    /// Members that the next check may run again, each taking `cost` times what a member of the study takes; 0: none.
    std::uint64_t next(double cost, bool is_last) {
        share_ = is_last ? left_ : first_share * left_;
        of_a_member_ = cost * mean_work_;
        auto const affordable = static_cast<std::uint64_t>(share_ / of_a_member_);
        if (members_ == 0) {
            std::uint64_t const count = is_asked_ ? most_ : std::min(most_, affordable);
            if (!is_asked_ && count < least_members) return 0;
            members_ = count;
        }
        return is_asked_ || share_ >= static_cast<double>(members_) * of_a_member_ ? members_ : 0;
    }
    /// What one of them may take.
    double most_of_a_member() const { return std::min(share_ / static_cast<double>(members_), steps_beyond * of_a_member_); }
    void spend(double work) { left_ -= work; }

private:
    bool const is_asked_;
    std::uint64_t const most_;
    double const mean_work_;
    double left_, share_ = 0, of_a_member_ = 0;
    std::uint64_t members_;
};

/// What checks are foreseen to take, in the work of members of the study.
double foreseen_work(std::vector<CheckMethod> const& methods, Budget budget, double mean_work) {
    double work = 0;
    for (std::size_t i = 0; i < methods.size(); ++i) {
        double const of_check = static_cast<double>(budget.next(methods[i].cost, i + 1 == methods.size())) * methods[i].cost;
        budget.spend(of_check * mean_work);
        work += of_check;
    }
    return work;
}

/// Of a study that keeps no members: whether some run again to be compared.
bool runs_members_anew(std::optional<std::uint64_t> asked, std::uint64_t all) { return asked || all * of_the_study > 2 * most_checked; }

/// Bounds what a check may take, in steps.
void limit_steps(Scene& check, double work_of_a_member) {
    constexpr double of_a_step = 4;  // right-hand sides, of the cheapest method
    double const steps = work_of_a_member / (of_a_step * (1 + shadow_plan(check).count));
    check.integrator.max_steps = std::min(check.integrator.max_steps, static_cast<std::uint64_t>(std::max(1.0, steps)));
}

/// What follows from the findings.  @param was_asked for so many members, whatever they cost
Verification concluded(Verification v, Scene const& scene, bool was_asked) {
    bool const enough = std::ranges::any_of(v.findings, [&](CheckedColumn const& found) {
        return found.pairs.pairs >= least_members && 2 * found.pairs.pairs > v.members.size();
    });
    bool const differs = (v.energy && v.energy->is_too_much) || std::ranges::any_of(v.findings, &CheckedColumn::differs);
    if (!enough && !differs) {
        if (v.numbers.front().finished() < least_members) return not_checked(std::move(v), "too few of its members finished");
        std::vector<std::string> ends;
        for (std::size_t i = 0; i < v.methods.size(); ++i) ends.push_back(fmt::format("{} of {} by {}", v.finished[i], v.members.size(), v.methods[i]));
        return not_checked(std::move(v), fmt::format("too few members finished again ({}){}", fmt::join(ends, ", "),
                                                     was_asked ? "" : "; run --verify gives them more time"));
    }
    v.resolution = differs ? Resolution::not_resolved : Resolution::resolved;
    v.summary = describe(v, scene);
    return v;
}

}  // namespace

double foreseen_check(Scene const& scene, std::optional<std::uint64_t> asked, std::uint64_t all) {
    if (asked == 0u || is_continued(scene)) return 0;
    std::uint64_t const most = std::min<std::uint64_t>(asked.value_or(most_checked), all);
    bool const stored = scene.stores_members();
    if (!stored && !runs_members_anew(asked, all)) return 0;
    Budget const budget(asked, all, static_cast<double>(all), stored ? 0 : most);
    return foreseen_work(check_methods(scene), budget, 1) + (stored ? 0.0 : static_cast<double>(most));
}

Verification verify(ResultView const& results, Scene const& scene, Backend const& backend, VerificationRequest const& request) {
    Verification v;
    v.settings = words_of(scene.integrator);
    if (request.members == 0u) return not_checked(std::move(v), "study.verify is 0");
    if (is_continued(scene)) return not_checked(std::move(v), "columns of this sweep go on from one another");
    std::optional<ToleranceMembers> stored;
    if (results.stores_members()) stored.emplace(results, 0, member_count(scene));
    std::uint64_t const all = stored ? stored->size() : member_count(scene);
    auto const choose = [&](std::uint64_t count) {
        std::vector<std::uint64_t> rows = spread_over(all, count);
        for (std::uint64_t const row : rows) v.members.push_back(stored ? stored->number(row) : row);
        return rows;
    };
    StopRequest const nobody;
    std::optional<Progress> progress;
    auto const run_again = [&](Scene const& check, double weight) {
        ProgressTask task{v.members.size()};
        task.work = foreseen_check(scene, request.members, all);
        task.is_check = true;
        if (!progress) progress.emplace(task, request.progress, stderr, request.stop != nullptr ? *request.stop : nobody);
        return fresh_numbers(check, v.members, backend, request.threads, request.stop, &*progress, weight);
    };
    std::vector<double> work;
    std::vector<WholeColumn> whole;
    double total = 0, dearest = 0;
    if (stored) {
        work = stored_work(*stored);
        total = std::accumulate(work.begin(), work.end(), 0.0);
    } else if (runs_members_anew(request.members, all)) {
        // What members came to is not there: those that are compared run as in the study, too.
        choose(std::min<std::uint64_t>(request.members.value_or(most_checked), all));
        v.numbers.push_back(run_again(without_series(scene), 1));
        total = v.numbers.front().total_work() * static_cast<double>(all) / static_cast<double>(v.members.size());
    }
    if (!(total > 0)) return not_checked(std::move(v), stored ? "no member ran" : "members are not stored; run --verify does it");
    std::vector<CheckMethod> methods = check_methods(scene);

    Budget budget(request.members, all, total, v.members.size());
    for (std::size_t i = 0; i < methods.size(); ++i) {
        CheckMethod& method = methods[i];
        dearest += method.cost * static_cast<double>(std::min<std::uint64_t>(most_checked, all));
        std::uint64_t const count = budget.next(method.cost, i + 1 == methods.size());
        if (count == 0) continue;
        if (v.members.empty()) v.numbers.push_back(stored_numbers(*stored, scene, choose(count), work, whole));
        if (!request.members) limit_steps(method.scene, budget.most_of_a_member());
        v.numbers.push_back(run_again(method.scene, method.cost));
        if (method.audits_energy) v.energy = audit_energy(v.numbers.back(), method.scene);
        if (request.stop != nullptr && request.stop->reason() != StopReason::none) return not_checked(std::move(v), "the run was stopped");
        v.methods.push_back(method.words);
        v.finished.push_back(v.numbers.back().finished());
        budget.spend(v.numbers.back().total_work());
        v.share += v.numbers.back().total_work() / total;
    }
    if (v.methods.empty()) {
        return not_checked(std::move(v), fmt::format("it would take some {:.2g} times the study's work; run --verify does it",
                                                     dearest / static_cast<double>(all)));
    }
    v.findings = compare(v.numbers, scene, whole, all);
    return concluded(std::move(v), scene, request.members.has_value());
}

}  // namespace slideway
