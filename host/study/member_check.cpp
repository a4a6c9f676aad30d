// Members of a study again, by tighter methods, as many as a check needs or may cost.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/base/numbers.hpp"
#include "host/run/progress.hpp"
#include "host/sampling/random.hpp"
#include "host/store/result_layout.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/member_numbers.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

constexpr double nearly = 0.97;           // of that: a step may take more than foreseen
constexpr std::size_t first_members = 8;  // by each method, before it is known what they cost
constexpr double beyond_foreseen = 12;    // how much more than foreseen a member may take unasked
constexpr double more_than_average = 1.2;  // right-hand sides of a step that a member may take, beside those before it

double sum(std::vector<double> const& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), 0.0,
                           [](double so_far, double x) { return std::isnan(x) ? so_far : so_far + x; });
}

/// Of members that took so much: bounds alike for those that are alike, so that they fill lanes together.
std::vector<double> shared_bounds(std::vector<double> const& work) {
    constexpr double alike = 3;
    std::vector<std::size_t> order(work.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return work[a] > work[b]; });
    std::vector<double> bounds(work.size());
    double bound = 0;
    for (std::size_t const i : order) {
        if (!(work[i] * alike > bound)) bound = 0;
        if (bound == 0) bound = work[i];
        bounds[i] = bound;
    }
    return bounds;
}

/// A group for each value; none where there are too many of them.
std::vector<MemberGroup> by_value(std::string_view key, std::vector<double> const& values,
                                  ToleranceMembers const& members, std::size_t most) {
    std::map<double, MemberGroup> groups;
    for (std::size_t row = 0; row < values.size(); ++row) {
        if (!members.finished(row)) continue;
        auto& group = groups[values[row]];
        if (groups.size() > most) return {};  // before there are as many as members
        group.has.resize(values.size());
        group.has[row] = 1;
    }
    std::vector<MemberGroup> found;
    if (groups.size() < 2 || groups.size() > most) return found;
    for (auto& [value, group] : groups) {
        group.name = fmt::format("{} = {:.6g}", key, value);
        found.push_back(std::move(group));
    }
    return found;
}

/// All, and behind it one for each value of whatever takes few: the parameter of a sweep, lists and grids with at most `most_values` of them, that is
/// two members or more to each on average.
std::vector<MemberGroup> member_groups(ToleranceMembers const& members, Scene const& scene) {
    constexpr std::size_t most_values = 16;
    std::vector<MemberGroup> groups{{"", std::vector<char>(members.size())}};
    for (std::size_t row = 0; row < members.size(); ++row) groups.front().has[row] = members.finished(row);
    auto const add = [&](Key const& key, std::size_t most) {
        std::vector<MemberGroup> found = by_value(key.name, members.column(variable_name(key.name)), members, most);
        std::ranges::move(found, std::back_inserter(groups));
    };
    if (scene.study == StudyKind::sweep) add(*scene.chaos.parameter, members.size());
    // Starts of a sweep come again in each column, and rows of a table may: they are no values that the study is about.
    std::size_t const most = std::min(most_values, groups.front().size() / 2);
    for (Variation const& variation : scene.variations) {
        bool const is_list = variation.column == Variation::no_column && variation.distribution.kind == Distribution::Kind::values;
        if (is_list || scene.design.kind == DesignKind::grid) add(*variation.key, most);
    }
    return groups;
}

/// The members of a study, and which of them run again.
class MemberCheck {
public:
    static constexpr double of_the_study = 0.1;  // that a check may cost unasked
    static constexpr double at_hand = 3;  // times what members are foreseen to take must be left before they begin; of the first ones half of that

    MemberCheck(Verification& v, Scene const& scene, Backend const& backend, VerificationRequest const& request)
        : v_(v), scene_(scene), backend_(backend), request_(request) {
        v_.methods = check_methods(scene);
        given_up_.resize(v_.methods.size());
        left_over_.resize(v_.methods.size());
        v_.cut.resize(v_.methods.size());
    }

    /// Of a result that stores its members.
    void look_at(ToleranceMembers const& stored) {
        stored_ = &stored;
        v_.all = stored.size();
        v_.study = stored_numbers(stored, scene_);
        v_.groups = member_groups(stored, scene_);
        std::vector<std::size_t> rows;
        for (std::size_t row = 0; row < stored.size(); ++row) {
            v_.members.push_back(stored.number(row));
            v_.draws.push_back(stored.is_draw(row));
            if (stored.finished(row)) rows.push_back(row);
        }
        total_ = v_.study.total_work();
        take_samples(rows);
        left_ = nearly * of_the_study * total_;
    }

    /// Of a study that keeps no members: some run in the study's way, and stand for all.
    void run_some_anew() {
        v_.all = member_count(scene_);
        double const of_a_member = 1 + 0.5 * at_hand * v_.methods.front().cost;
        auto const affordable = static_cast<std::uint64_t>(of_the_study * static_cast<double>(v_.all) / of_a_member);
        auto const most = static_cast<std::size_t>(std::min(v_.all, request_.members.value_or(affordable)));
        // At random: every n-th of a design may be one slice of it.
        Permutation const order(v_.all, {scene_.seed, name_hash("verification")});
        for (std::size_t i = 0; i < most; ++i) v_.members.push_back(order(i));
        std::ranges::sort(v_.members);
        v_.study = run_again(without_series(scene_), v_.members, {}, 1);
        std::vector<std::size_t> rows;
        std::vector<char> finished = v_.study.finished;
        for (std::size_t row = 0; row < finished.size(); ++row) {
            if (finished[row]) rows.push_back(row);
        }
        v_.draws.assign(finished.size(), 1);
        double const spent = v_.study.total_work();
        total_ = spent * static_cast<double>(v_.all) / static_cast<double>(std::max<std::size_t>(most, 1));
        spent_ = spent;
        v_.groups = {{"", std::move(finished)}};
        take_samples(rows);
        left_ = nearly * of_the_study * total_ - spent;
    }

    double total() const { return total_; }
    bool compares() const {
        return std::ranges::any_of(v_.study.columns, [](auto const& one) { return one.kind != MemberNumbers::Kind::contacts; });
    }

    /// Adds members until every number is decided, or there is no more to be had.
    void run() {
        for (std::size_t wanted = first_members; !stopped();) {
            std::size_t const before = v_.pairs.size();
            for (std::size_t method = 0; method < v_.methods.size() && !stopped(); ++method)
                add(method, samples_[method]->next(affordable(method, wanted)), false);
            for (std::size_t method = 0; method < v_.methods.size() && !stopped(); ++method)
                add(method, std::exchange(left_over_[method], {}), true);
            if (v_.pairs.size() == before) break;
            v_.numbers = check_numbers(v_, scene_);
            if (is_decided() || samples_.front()->left() == 0) break;
            // Twice as many as there are: few members alone leave lanes empty.
            wanted = std::max(first_members, 2 * v_.pairs.size() / v_.methods.size());
        }
        if (!residuals_.empty()) v_.energy = audit_energy(residuals_, scene_);
        v_.share = spent_ / total_;
    }

    bool stopped() const { return request_.stop.reason() != StopReason::none; }

private:
    /// Each member runs by one method; those that only count for exponents have a sample of their own.
    void take_samples(std::vector<std::size_t> const& rows) {
        for (std::size_t const row : rows) typical_work_ += v_.study.work[row] / static_cast<double>(rows.size());
        auto const both = std::make_shared<CheckSample>(rows, v_.groups, v_.study.work, scene_.seed);
        for (CheckMethod const& method : v_.methods)
            samples_.push_back(method.of_exponents
                                   ? std::make_shared<CheckSample>(rows, v_.groups, v_.study.work, scene_.seed)
                                   : both);
    }

    /// How many members may run by a method now.
    std::size_t affordable(std::size_t method, std::size_t wanted) const {
        std::size_t const methods_left =
            request_.members ? 2 - std::min<std::size_t>(method, 1) : v_.methods.size() - method;
        if (given_up_[method]) return 0;
        if (request_.members) {
            std::uint64_t const asked = std::max<std::uint64_t>(*request_.members, v_.pairs.size()) - v_.pairs.size();
            std::uint64_t const room = std::min<std::uint64_t>(asked, samples_[method]->left());
            if (v_.methods[method].of_exponents) return static_cast<std::size_t>(std::min<std::uint64_t>(wanted, room));
            return static_cast<std::size_t>(std::min<std::uint64_t>(wanted, (room + methods_left - 1) / methods_left));
        }
        // Methods that come later have their share, for one alone may err as the study does.
        bool const is_first =
            std::ranges::none_of(v_.pairs, [&](CheckPair const& pair) { return pair.method == method; });
        double const of_a_member = (is_first ? 0.5 : 1) * at_hand * v_.methods[method].cost * typical_work_;
        double const least = is_first ? least_members : 1, room = left_ / of_a_member,
                     share = room / static_cast<double>(methods_left);
        if (room < least) return 0;
        return std::min(wanted, static_cast<std::size_t>(std::clamp(share, least, 1e9)));
    }

    /// Runs members by a method.  @param again those that another one has cut short
    void add(std::size_t method, std::vector<std::size_t> const& rows, bool again) {
        if (rows.empty()) return;
        std::vector<std::uint64_t> members;
        std::vector<double> own;
        for (std::size_t const row : rows) {
            members.push_back(v_.members[row]);
            own.push_back(v_.study.work[row]);
        }
        // Of a fixed step nobody takes more than was foreseen; whom another method left to it, only as far as that is there.
        bool const fixed = has_fixed_step(v_.methods[method].scene.integrator.method), bounded = !request_.members && !fixed;
        if (again && fixed && !request_.members && v_.methods[method].cost * sum(own) > left_) return give_up(method, rows);
        std::vector<std::uint64_t> const most = bounded ? most_steps(method, own) : std::vector<std::uint64_t>{};
        MemberNumbers const numbers = run_again(v_.methods[method].scene, members, most, v_.methods[method].cost);
        if (stored_ != nullptr) add_end_contacts(v_.study, *stored_, scene_, rows);
        keep(method, rows, numbers, again);
        double const spent = sum(numbers.work);
        left_ -= spent;
        spent_ += spent;
        // What it costs is known from now on.
        if (again) return;
        v_.methods[method].cost = spent / sum(own);
        double const steps = std::accumulate(numbers.steps.begin(), numbers.steps.end(), 0.0);
        v_.methods[method].work_of_a_step = more_than_average * spent / (steps * (1 + shadow_plan(scene_).count));
    }

    /// Steps after which members that took so much in the study are cut short: bounds alike for those that are alike, so that they fill lanes together.
    std::vector<std::uint64_t> most_steps(std::size_t method, std::vector<double> const& own) const {
        std::vector<double> const bounds = shared_bounds(own);
        CheckMethod const& by = v_.methods[method];
        double const per_own = std::max(0.0, std::min(left_ / sum(bounds), beyond_foreseen * by.cost));
        double const of_a_step = by.work_of_a_step * (1 + shadow_plan(scene_).count);
        std::vector<std::uint64_t> most;
        for (double const bound : bounds) most.push_back(static_cast<std::uint64_t>(std::clamp(per_own * bound / of_a_step, 1.0, 1e18)));
        return most;
    }

    /// Members that nobody brings to their end.
    void give_up(std::size_t method, std::vector<std::size_t> const& rows) {
        v_.again.resize(v_.study.columns.size());
        for (std::size_t const row : rows) {
            v_.pairs.push_back({row, method, false});
            for (auto& column : v_.again) column.push_back(nan);
        }
    }

    /// A pair for each member that came to its end, and for those that no method has brought there.
    void keep(std::size_t method, std::vector<std::size_t> const& rows, MemberNumbers const& numbers, bool again) {
        v_.again.resize(numbers.columns.size());
        std::size_t cut = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            bool const finished = numbers.finished[i] != 0;
            cut += !finished;
            if (!finished && !again) {
                // The other of the two that run for all numbers.
                if (!v_.methods[method].of_exponents) left_over_[1 - method].push_back(rows[i]);
                continue;
            }
            v_.pairs.push_back({rows[i], method, finished});
            for (std::size_t column = 0; column < numbers.columns.size(); ++column)
                v_.again[column].push_back(numbers.columns[column].values[i]);
        }
        v_.cut[method] += cut;
        given_up_[method] = given_up_[method] || (method > 0 && !again && 2 * cut >= rows.size());
        if (v_.methods[method].audits_energy)
            residuals_.insert(residuals_.end(), numbers.energy_residual.begin(), numbers.energy_residual.end());
    }

    MemberNumbers run_again(Scene const& scene, std::vector<std::uint64_t> const& members,
                            std::vector<std::uint64_t> const& most, double weight) {
        ProgressTask task{members.size()};
        task.work =
            std::max(foreseen_check(scene_, request_.members, v_.all), static_cast<double>(members.size()) * weight);
        task.is_check = true;
        if (!progress_)
            progress_.emplace(task, request_.progress, stderr, request_.stop);
        return fresh_numbers(scene, members, {backend_, request_.threads, request_.stop, &*progress_, weight},
                             most);
    }

    bool is_decided() const {
        return std::ranges::all_of(v_.numbers, [&](CheckedNumber const& n) {
            return n.verdict == Verdict::resolved || n.verdict == Verdict::not_resolved || n.is_unseen() ||
                   v_.study.columns[n.column].kind == MemberNumbers::Kind::contacts;
        });
    }

    Verification& v_;
    Scene const& scene_;
    Backend const& backend_;
    VerificationRequest const& request_;
    std::vector<char> given_up_;                       // [methods] that cut most of their members short
    std::vector<std::vector<std::size_t>> left_over_;  // [methods] rows that another one has cut short
    ToleranceMembers const* stored_ = nullptr;
    double total_ = 0, left_ = 0, spent_ = 0;
    double typical_work_ = 0;  // mean of the members that may run again: those that failed took less
    std::vector<std::shared_ptr<CheckSample>> samples_;  // [methods]
    std::vector<double> residuals_;
    std::optional<Progress> progress_;
};

/// Of a study that keeps no members: whether some run again to be compared.
bool runs_members_anew(std::optional<std::uint64_t> asked, std::uint64_t all) {
    return asked || all >= 100 * least_members;
}

/// Nothing varies: all members are one.
bool is_one_member(Scene const& scene) {
    bool const varies = std::ranges::any_of(scene.variations, [](Variation const& one) {
        return one.column != Variation::no_column || one.distribution.kind != Distribution::Kind::constant;
    });
    return member_count(scene) == 1 || (!varies && scene.study != StudyKind::sweep);
}

}  // namespace

double foreseen_check(Scene const& scene, std::optional<std::uint64_t> asked, std::uint64_t all) {
    if (asked == 0u || is_continued(scene)) return 0;
    std::vector<CheckMethod> const methods = check_methods(scene);
    double cost = 0;
    for (CheckMethod const& method : methods) cost += method.cost;
    double const of_a_member = cost / static_cast<double>(methods.size());
    if (is_one_member(scene)) return asked ? 1 + cost : 0;
    bool const stored = scene.stores_members();
    if (!stored && !runs_members_anew(asked, all)) return 0;
    auto const members = static_cast<double>(all);
    if (asked) return static_cast<double>(std::min(*asked, all)) * (of_a_member + (stored ? 0 : 1));
    double const room = MemberCheck::of_the_study * members;
    return room < 0.5 * MemberCheck::at_hand * methods.front().cost * least_members ? 0 : room;
}

Verification verify(ResultView const& results, Scene const& scene, Backend const& backend,
                    VerificationRequest const& request) {
    Verification v;
    v.settings = words_of(scene.integrator);
    auto const not_checked = [&](std::string const& why) {
        v.resolution = Resolution::not_checked;
        v.summary = "not checked against tighter tolerances: " + why;
        return v;
    };
    if (request.members == 0u) return not_checked("study.verify is 0");
    if (is_continued(scene)) return not_checked("columns of this sweep go on from one another");
    if (is_one_member(scene)) {
        if (!request.members) return not_checked("there is one member; run --verify compares its orbit");
        return verify_orbit(scene, backend, request);
    }
    std::optional<ToleranceMembers> stored;
    MemberCheck check(v, scene, backend, request);
    if (results.stores_members()) {
        stored.emplace(results, design_width(scene), member_count(scene));
        check.look_at(*stored);
    } else if (runs_members_anew(request.members, member_count(scene))) {
        check.run_some_anew();
    }
    if (!(check.total() > 0))
        return not_checked(stored ? "no member ran" : "members are not stored; run --verify does it");
    if (!check.compares()) return not_checked("the study has no number that is compared: ask for study.quantities");
    check.run();
    if (check.stopped()) return not_checked("the run was stopped");
    if (v.pairs.empty()) {
        bool const nobody = std::ranges::count(v.study.finished, 1) == 0;
        return not_checked(nobody ? "no member finished" : "a tenth of the study's work is not enough for six members; run --verify does it");
    }
    conclude(v, scene, request);
    return v;
}
namespace {

SobolAxis scrambled_axis(std::uint64_t seed) {
    return {sobol_directions(1).front(), {seed, name_hash("verification")}, Stream::scramble};
}

}  // namespace

CheckSample::CheckSample(std::vector<std::size_t> rows, std::vector<MemberGroup> const& groups,
                         std::vector<double> const& cost, std::uint64_t seed)
    : order_(std::move(rows)), axis_(scrambled_axis(seed)) {
    std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) {
        for (MemberGroup const& group : groups) {
            if (group.has[a] != group.has[b]) return group.has[a] > group.has[b];
        }
        return cost[a] < cost[b];
    });
}

std::vector<std::size_t> CheckSample::next(std::size_t count) {
    std::vector<std::size_t> rows;
    for (std::size_t const wanted = std::min(count, left()); rows.size() < wanted;) {
        auto place = static_cast<std::size_t>(axis_(point_++) * static_cast<double>(order_.size()));
        while (!drawn_.insert(place).second) place = (place + 1) % order_.size();
        rows.push_back(order_[place]);
    }
    return rows;
}

}  // namespace slideway
