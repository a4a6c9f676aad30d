#include "host/study/member_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "host/base/numbers.hpp"
#include "host/sampling/random.hpp"
#include "host/store/result_layout.hpp"
#include "host/study/member_numbers.hpp"
#include "host/study/orbit_schedule.hpp"

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

}  // namespace

MemberCheck::MemberCheck(Verification& v, Scene const& scene, Backend const& backend, VerificationRequest const& request)
    : v_(v), scene_(scene), backend_(backend), request_(request), methods_(check_methods(scene)) {
    given_up_.resize(methods_.size());
    left_over_.resize(methods_.size());
    v_.cut.resize(methods_.size());
}

void MemberCheck::look_at(ToleranceMembers const& stored) {
    stored_ = &stored;
    all_ = stored.size();
    v_.study = stored_numbers(stored, scene_);
    v_.groups = member_groups(stored, scene_);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < stored.size(); ++row) {
        v_.members.push_back(stored.number(row));
        draws_.push_back(stored.is_draw(row));
        if (stored.finished(row)) rows.push_back(row);
    }
    total_ = v_.study.total_work();
    take_samples(rows);
    left_ = nearly * of_the_study * total_;
}

void MemberCheck::run_some_anew() {
    all_ = member_count(scene_);
    double const of_a_member = 1 + 0.5 * at_hand * methods_.front().cost;
    auto const affordable = static_cast<std::uint64_t>(of_the_study * static_cast<double>(all_) / of_a_member);
    auto const most = static_cast<std::size_t>(std::min(all_, request_.members.value_or(affordable)));
    // At random: every n-th of a design may be one slice of it.
    Permutation const order(all_, {scene_.seed, name_hash("verification")});
    for (std::size_t i = 0; i < most; ++i) v_.members.push_back(order(i));
    std::ranges::sort(v_.members);
    v_.study = run_again(without_series(scene_), v_.members, {}, 1);
    std::vector<std::size_t> rows;
    std::vector<char> finished = v_.study.finished;
    for (std::size_t row = 0; row < finished.size(); ++row) {
        if (finished[row]) rows.push_back(row);
    }
    draws_.assign(finished.size(), 1);
    double const spent = v_.study.total_work();
    total_ = spent * static_cast<double>(all_) / static_cast<double>(std::max<std::size_t>(most, 1));
    spent_ = spent;
    v_.groups = {{"", std::move(finished)}};
    take_samples(rows);
    left_ = nearly * of_the_study * total_ - spent;
}

bool MemberCheck::compares() const {
    return std::ranges::any_of(v_.study.columns, [](auto const& one) { return one.kind != MemberNumbers::Kind::contacts; });
}

void MemberCheck::run() {
    for (std::size_t wanted = first_members; !stopped();) {
        std::size_t const before = v_.pairs.size();
        for (std::size_t method = 0; method < methods_.size() && !stopped(); ++method)
            add(method, samples_[method]->next(affordable(method, wanted)), false);
        for (std::size_t method = 0; method < methods_.size() && !stopped(); ++method)
            add(method, std::exchange(left_over_[method], {}), true);
        if (v_.pairs.size() == before) break;
        compare();
        if (is_decided() || samples_.front()->left() == 0) break;
        // Twice as many as there are: few members alone leave lanes empty.
        wanted = std::max(first_members, 2 * v_.pairs.size() / methods_.size());
    }
    if (!residuals_.empty()) v_.energy = audit_energy(residuals_, scene_);
    for (CheckMethod const& method : methods_) v_.methods.push_back(method.words);
    v_.share = spent_ / total_;
}

void MemberCheck::take_samples(std::vector<std::size_t> const& rows) {
    for (std::size_t const row : rows) typical_work_ += v_.study.work[row] / static_cast<double>(rows.size());
    auto const both = std::make_shared<CheckSample>(rows, v_.groups, v_.study.work, scene_.seed);
    for (CheckMethod const& method : methods_)
        samples_.push_back(method.of_exponents
                               ? std::make_shared<CheckSample>(rows, v_.groups, v_.study.work, scene_.seed)
                               : both);
}

std::size_t MemberCheck::affordable(std::size_t method, std::size_t wanted) const {
    std::size_t const methods_left =
        request_.members ? 2 - std::min<std::size_t>(method, 1) : methods_.size() - method;
    if (given_up_[method]) return 0;
    if (request_.members) {
        std::uint64_t const asked = std::max<std::uint64_t>(*request_.members, v_.pairs.size()) - v_.pairs.size();
        std::uint64_t const room = std::min<std::uint64_t>(asked, samples_[method]->left());
        if (methods_[method].of_exponents) return static_cast<std::size_t>(std::min<std::uint64_t>(wanted, room));
        return static_cast<std::size_t>(std::min<std::uint64_t>(wanted, (room + methods_left - 1) / methods_left));
    }
    // Methods that come later have their share, for one alone may err as the study does.
    bool const is_first =
        std::ranges::none_of(v_.pairs, [&](CheckPair const& pair) { return pair.method == method; });
    double const of_a_member = (is_first ? 0.5 : 1) * at_hand * methods_[method].cost * typical_work_;
    double const least = is_first ? least_members : 1, room = left_ / of_a_member,
                 share = room / static_cast<double>(methods_left);
    if (room < least) return 0;
    return std::min(wanted, static_cast<std::size_t>(std::clamp(share, least, 1e9)));
}

void MemberCheck::add(std::size_t method, std::vector<std::size_t> const& rows, bool again) {
    if (rows.empty()) return;
    std::vector<std::uint64_t> members;
    std::vector<double> own;
    for (std::size_t const row : rows) {
        members.push_back(v_.members[row]);
        own.push_back(v_.study.work[row]);
    }
    // Of a fixed step nobody takes more than was foreseen; whom another method left to it, only as far as that is there.
    bool const fixed = has_fixed_step(methods_[method].scene.integrator.method), bounded = !request_.members && !fixed;
    if (again && fixed && !request_.members && methods_[method].cost * sum(own) > left_) return give_up(method, rows);
    std::vector<std::uint64_t> const most = bounded ? most_steps(method, own) : std::vector<std::uint64_t>{};
    MemberNumbers const numbers = run_again(methods_[method].scene, members, most, methods_[method].cost);
    if (stored_ != nullptr) add_end_contacts(v_.study, *stored_, scene_, rows);
    keep(method, rows, numbers, again);
    double const spent = sum(numbers.work);
    left_ -= spent;
    spent_ += spent;
    // What it costs is known from now on.
    if (again) return;
    methods_[method].cost = spent / sum(own);
    double const steps = std::accumulate(numbers.steps.begin(), numbers.steps.end(), 0.0);
    methods_[method].work_of_a_step = more_than_average * spent / (steps * (1 + shadow_plan(scene_).count));
}

std::vector<std::uint64_t> MemberCheck::most_steps(std::size_t method, std::vector<double> const& own) const {
    std::vector<double> const bounds = shared_bounds(own);
    CheckMethod const& by = methods_[method];
    double const per_own = std::max(0.0, std::min(left_ / sum(bounds), beyond_foreseen * by.cost));
    double const of_a_step = by.work_of_a_step * (1 + shadow_plan(scene_).count);
    std::vector<std::uint64_t> most;
    for (double const bound : bounds) most.push_back(static_cast<std::uint64_t>(std::clamp(per_own * bound / of_a_step, 1.0, 1e18)));
    return most;
}

void MemberCheck::give_up(std::size_t method, std::vector<std::size_t> const& rows) {
    v_.again.resize(v_.study.columns.size());
    for (std::size_t const row : rows) {
        v_.pairs.push_back({row, method, false});
        for (auto& column : v_.again) column.push_back(nan);
    }
}

void MemberCheck::keep(std::size_t method, std::vector<std::size_t> const& rows, MemberNumbers const& numbers, bool again) {
    v_.again.resize(numbers.columns.size());
    std::size_t cut = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        bool const finished = numbers.finished[i] != 0;
        cut += !finished;
        if (!finished && !again) {
            // The other of the two that run for all numbers.
            if (!methods_[method].of_exponents) left_over_[1 - method].push_back(rows[i]);
            continue;
        }
        v_.pairs.push_back({rows[i], method, finished});
        for (std::size_t column = 0; column < numbers.columns.size(); ++column)
            v_.again[column].push_back(numbers.columns[column].values[i]);
    }
    v_.cut[method] += cut;
    given_up_[method] = given_up_[method] || (method > 0 && !again && 2 * cut >= rows.size());
    if (methods_[method].audits_energy)
        residuals_.insert(residuals_.end(), numbers.energy_residual.begin(), numbers.energy_residual.end());
}

MemberNumbers MemberCheck::run_again(Scene const& scene, std::vector<std::uint64_t> const& members,
                        std::vector<std::uint64_t> const& most, double weight) {
    ProgressTask task{members.size()};
    task.work =
        std::max(foreseen_check(scene_, request_.members, all_), static_cast<double>(members.size()) * weight);
    task.is_check = true;
    if (!progress_)
        progress_.emplace(task, request_.progress, stderr, request_.stop != nullptr ? *request_.stop : nobody_);
    return fresh_numbers(scene, members, {backend_, request_.threads, request_.stop, &*progress_, weight},
                         most);
}

void MemberCheck::compare() {
    v_.numbers = check_numbers({v_.study, v_.groups, v_.pairs, v_.again, methods_, draws_, all_}, scene_);
}

bool MemberCheck::is_decided() const {
    return std::ranges::all_of(v_.numbers, [&](CheckedNumber const& n) {
        return n.verdict == Verdict::resolved || n.verdict == Verdict::not_resolved || n.is_unseen() ||
               v_.study.columns[n.column].kind == MemberNumbers::Kind::contacts;
    });
}

namespace {

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

SobolAxis scrambled_axis(std::uint64_t seed) {
    return {sobol_directions(1).front(), {seed, name_hash("verification")}, Stream::scramble};
}

}  // namespace

std::size_t MemberGroup::size() const { return static_cast<std::size_t>(std::ranges::count(has, 1)); }

std::vector<MemberGroup> member_groups(ToleranceMembers const& members, Scene const& scene) {
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
