// A study of one member, checked: its orbit beside those that tighter tolerances and another method make of the same start.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/verification.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

constexpr std::size_t looks = 1001;   // at the orbits, evenly over their time
constexpr double parted_from = 1e-2;  // of the joint's scales
constexpr double infinity = std::numeric_limits<double>::infinity();

/// States of an orbit along its time, and at its sections.
struct Orbit {
    std::size_t states = 0;
    std::vector<double> course;    // [looks][states]
    std::vector<double> times;     // [looks]
    std::vector<double> sections;  // [sections][1 + states]: time and state

    std::size_t section_count() const { return sections.size() / (1 + states); }
};

/// The same scene, with the states of its members along their time.
Scene looked_at(Scene scene) {
    MechanismInfo const& has = info(scene.parts.mechanism);
    OrbitSchedule const schedule = orbit_schedule(scene);
    double const end = schedule.by_turns ? schedule.turns * turn_length(scene) : schedule.end;
    scene.sample_times.clear();
    for (std::size_t i = 0; i < looks; ++i)
        scene.sample_times.push_back(std::min(end, end * static_cast<double>(i) / (looks - 1)));
    scene.series = 0;
    for (int k = 0; k < has.states; ++k) scene.series |= selection_of(has.state[k]);
    return scene;
}

Orbit orbit_of(Scene const& scene, FreshRun const& run) {
    Scene const looked = looked_at(scene);
    MechanismInfo const& has = info(scene.parts.mechanism);
    Orbit orbit;
    orbit.states = static_cast<std::size_t>(has.states);
    // Series lie in the order of their table, states in the mechanism's.
    std::vector<std::size_t> place(orbit.states);
    for (std::size_t k = 0; k < orbit.states; ++k) {
        for (std::size_t j = 0; j < orbit.states; ++j) place[k] += has.state[j] < has.state[k];
    }
    auto const take = [&](BlockResult const& block) {
        orbit.course.resize(looks * orbit.states);
        for (std::size_t i = 0; i < looks; ++i) {
            for (std::size_t k = 0; k < orbit.states; ++k)
                orbit.course[i * orbit.states + k] = block.series[place[k] * looks + i];
        }
        orbit.sections.assign(block.sections.begin(), block.sections.end());
        orbit.times.assign(block.clock.begin(), block.clock.end());
        if (orbit.times.empty()) orbit.times = looked.sample_times;
    };
    run_members(looked, {0}, run, take);
    auto const end = std::ranges::find_if(orbit.sections, [](double x) { return std::isnan(x); });
    auto const width = static_cast<std::ptrdiff_t>(1 + orbit.states);
    orbit.sections.resize(static_cast<std::size_t>((end - orbit.sections.begin()) / width * width));
    return orbit;
}

/// On which scale components of the state tell that orbits part: the clearance, and what tilts the slider by it; of speeds nothing, for at an impact
/// they differ whenever its time does.
std::vector<double> parting_scales(Scene const& scene) {
    Inputs const in = member_inputs(scene, 0);
    MechanismInfo const& has = info(scene.parts.mechanism);
    MemberSize const size = size_of(scene.parts.mechanism, in);
    double const clearance = size.least_play, tilt = clearance / size.lever;
    std::vector<double> scales;
    for (int k = 0; k < has.states; ++k) {
        std::string_view const unit = state_info(has, k).unit;
        // What a drive prescribes is no matter of the orbit.
        bool const is_free = !is_prescribed(scene.parts, k);
        scales.push_back(is_free && unit == "m" ? clearance : is_free && unit == "rad" ? tilt : infinity);
    }
    return scales;
}

/// How far two states are apart, on those scales; NaN where one of them is none.
double distance(double const* a, double const* b, std::vector<double> const& scales) {
    double largest = 0;
    for (std::size_t k = 0; k < scales.size(); ++k) {
        double const here = std::abs(a[k] - b[k]) / scales[k];
        if (!(here <= largest)) largest = here;
    }
    return largest;
}

/// First time from which one is off the other; infinite if none is.
double parting_of(Orbit const& one, Orbit const& other, std::vector<double> const& scales) {
    for (std::size_t i = 0; i < looks; ++i) {
        if (!(distance(&one.course[i * one.states], &other.course[i * one.states], scales) < parted_from))
            return one.times[i];
    }
    return infinity;
}

/// Sections that both have, from the first one on.
std::size_t sections_alike(Orbit const& one, Orbit const& other, std::vector<double> const& scales, double end) {
    std::size_t const width = 1 + one.states;
    for (std::size_t i = 0; i < one.section_count(); ++i) {
        if (i >= other.section_count()) return i;
        double const *a = &one.sections[i * width], *b = &other.sections[i * width];
        // At one phase the states tell; crossings and impacts come at times of their own, while all else moves on.
        bool const alike = a[0] == b[0] ? distance(a + 1, b + 1, scales) < parted_from : std::abs(a[0] - b[0]) < 1e-4 * end;
        if (!alike) return i;
    }
    return one.section_count();
}

/// One orbit has no interval and no spread: the checks differ from it by what it is wrong, as far as they agree with each other.
void judge(CheckedNumber& n, std::vector<double> const& differences, std::size_t checks, bool parts) {
    auto const [least, largest] = std::ranges::minmax(differences);
    double const farthest = std::max(std::abs(least), std::abs(largest));
    n.error.pairs = differences.size();
    n.error.difference = std::abs(largest) > std::abs(least) ? largest : least;
    n.error.half_width = largest - least;
    n.error.bound = differences.size() < checks ? nan : farthest;
    n.cut = checks - differences.size();
    if (std::isnan(n.error.bound)) return;
    // Beyond doubt: the checks say the same, and the study something else.
    bool const agree = largest - least <= 0.1 * farthest;
    n.verdict = farthest <= n.margin               ? Verdict::resolved
                : parts                            ? Verdict::undecided
                : agree && farthest > n.least_felt ? Verdict::not_resolved
                                                   : Verdict::bounded;
}

/// Each number by what the checks that are of it say.
void judge_numbers(Verification& v) {
    for (CheckedNumber& n : v.numbers) {
        auto const& column = v.study.columns[n.column];
        std::vector<double> differences;
        std::size_t checks = 0;
        for (CheckPair const& pair : v.pairs) {
            if (v.methods[pair.method].of_exponents && column.kind != MemberNumbers::Kind::exponent) continue;
            ++checks;
            double const difference = v.again[n.column][pair.method] - column.values[0];
            if (!std::isnan(difference)) differences.push_back(difference);
        }
        n.verdict = column.kind == MemberNumbers::Kind::contacts ? Verdict::resolved : Verdict::undecided;
        n.refutes_sign = false;
        if (n.verdict == Verdict::undecided && !differences.empty())
            judge(n, differences, checks, v.orbit->parting <= v.orbit->end);
    }
}

}  // namespace

Verification verify_orbit(Scene const& scene, Backend const& backend, VerificationRequest const& request) {
    Verification v;
    v.settings = words_of(scene.integrator);
    // Each runs for its numbers and once more for its orbit.
    v.methods = check_methods(scene);
    ProgressTask task{1};
    task.is_check = true;
    task.work = 2;
    for (CheckMethod const& method : v.methods) task.work += (method.of_exponents ? 1 : 2) * method.cost;
    Progress progress(task, request.progress, stderr, request.stop);
    FreshRun run{backend, request.threads, request.stop, &progress};
    std::vector<double> const scales = parting_scales(scene);
    Scene const bare = without_series(scene);
    v.study = fresh_numbers(bare, {0}, run);
    auto const stopped = [&] { return request.stop.reason() != StopReason::none; };
    if (!v.study.finished.front()) {
        v.summary = stopped() ? check_was_stopped : "not checked against tighter tolerances: no member finished";
        return v;
    }
    v.members = {0}, v.draws = {1}, v.all = 1;
    v.groups = {{"", {v.study.finished.front()}}};
    Orbit const own = orbit_of(bare, run);
    double const end = own.times.back();
    v.orbit = OrbitCheck{end, infinity, own.section_count(), own.section_count()};
    v.again.resize(v.study.columns.size());
    double spent = 2 * v.study.total_work();
    for (CheckMethod const& method : v.methods) {
        if (stopped()) break;
        run.weight = method.cost;
        MemberNumbers const numbers = fresh_numbers(method.scene, {0}, run);
        v.cut.push_back(numbers.finished[0] ? 0 : 1);
        v.pairs.push_back({0, v.pairs.size(), numbers.finished[0] != 0});
        for (std::size_t column = 0; column < numbers.columns.size(); ++column)
            v.again[column].push_back(numbers.columns[column].values[0]);
        if (method.audits_energy) v.energy = audit_energy(numbers.energy_residual, scene);
        spent += (method.of_exponents ? 1 : 2) * numbers.total_work();
        if (method.of_exponents) continue;
        Orbit const other = orbit_of(method.scene, run);
        if (stopped()) break;
        v.orbit->parting = std::min(v.orbit->parting, parting_of(own, other, scales));
        v.orbit->sections_before = std::min(v.orbit->sections_before, sections_alike(own, other, scales, end));
    }
    if (stopped()) {
        v.summary = check_was_stopped;
        return v;
    }
    v.share = spent / v.study.total_work();
    v.numbers = check_numbers(v, scene);
    judge_numbers(v);
    conclude(v, scene, request);
    return v;
}

}  // namespace slideway
