#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/outputs.hpp"
#include "host/config/reader.hpp"
#include "host/config/settings.hpp"

namespace slideway {
namespace {

/// Of one member: they stay in memory while it runs.
std::uint64_t most_samples() { return setting("study.samples").most; }

struct EndTime {
    double seconds;
    double revolutions;  // NaN where there are none
};

EndTime read_end_time(Node const& root, Scene const& scene) {
    double const turn = drive_period(scene.parts, scene.inputs);
    bool const turns = std::isfinite(turn);
    if (auto const seconds = given_number(root, "study.duration")) return {*seconds, turns ? *seconds / turn : NAN};
    Node const* const node = root.find_path("study.revolutions");
    if (!turns) {
        if (node != nullptr) refuse_at_rest(*node, scene.parts, "study.duration");
        return {1, NAN};
    }
    double const revolutions = given_number(root, "study.revolutions").value_or(1), seconds = revolutions * turn;
    if (!(seconds > 0 && seconds <= longest_time)) {
        std::string const reason = fmt::format("it lasts {} s, with {} s for each", seconds, turn);
        std::string const advice = fmt::format("stay below {} s", longest_time);
        if (node != nullptr) refuse(*node, {reason, advice});
        throw SceneError(fmt::format("{}: study.revolutions is 1 ({}); {}", root.where, reason, advice));
    }
    return {seconds, revolutions};
}

void check_drive_is_resolved(Node const& root, Scene const& scene, double seconds) {
    auto const problem = unresolved_drive(scene.parts, scene.inputs, seconds);
    if (!problem) return;
    for (char const* const key : {"study.revolutions", "study.duration"}) {
        if (Node const* const node = root.find_path(key)) refuse(*node, *problem);
    }
    throw SceneError(fmt::format("{}: the study is too long: {}; {}", root.where, problem->reason, problem->advice));
}

/// The node that asks for a time series, and how many times it has.
struct Sampling {
    Node const* node = nullptr;
    std::size_t count = 0;
};

Sampling read_sampling(Node const& root, Scene const& scene, EndTime const& end) {
    if (Node const* const node = root.find_path("study.samples")) {
        std::uint64_t const count = read_count(*node, setting("study.samples"));
        if (count == 1) refuse(*node, {"the first and the last time are both stored", "use 0 or at least 2"});
        if (count > 1 && end.seconds / static_cast<double>(count) < std::numeric_limits<double>::min()) {
            refuse(*node, {fmt::format("no numbers tell the times of {} s apart", end.seconds), "use a longer study.duration"});
        }
        return {node, count};
    }
    Node const* const node = root.find_path("study.samples_per_revolution");
    if (node == nullptr) return {};
    std::uint64_t const per_turn = read_count(*node, setting("study.samples_per_revolution"));
    if (per_turn == 0) return {node, 0};
    if (std::isnan(end.revolutions)) refuse_at_rest(*node, scene.parts, "study.samples");
    double const intervals = std::max(1.0, std::round(static_cast<double>(per_turn) * end.revolutions));
    if (intervals >= static_cast<double>(most_samples())) {
        refuse(*node, {fmt::format("that makes {} samples of each member", intervals + 1),
                       fmt::format("ask for at most {}", most_samples())});
    }
    return {node, static_cast<std::size_t>(intervals) + 1};
}

void read_series(Node const& node, std::size_t place, Scene& scene) {
    if (scene.sample_times.empty()) {
        refuse(node, {"it is a time series and the study stores none",
                      scene.study == StudyKind::ensemble ? "set study.samples_per_revolution or study.samples"
                                                         : "remove it, or use kind = \"ensemble\""});
    }
    if (auto const why = why_unknown(static_cast<Series>(place), scene)) refuse(node, *why);
    scene.series |= Selection{1} << place;
}

void read_quantities(Node const& list, Scene& scene) {
    if (list.type != Node::Type::array) {
        refuse(list, {"not a list of names", "write for example [\"mean_normal_force\", \"energy_residual\"]"});
    }
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    std::vector<std::string_view> names;
    for (QuantityInfo const& quantity : outputs.quantities) names.emplace_back(quantity.name);
    for (SeriesInfo const& series : outputs.series) names.emplace_back(series.name);
    for (Node const& node : list.children) {
        std::size_t const index = read_choice(node, "quantity", names);
        bool const is_series = index >= outputs.quantities.size();
        std::size_t const place = is_series ? index - outputs.quantities.size() : index;
        if (((is_series ? outputs.has_series : outputs.has_quantities) >> place & 1u) == 0) refuse_foreign_quantity(node, names[index], scene.parts.mechanism);
        if (is_series) {
            read_series(node, place, scene);
            continue;
        }
        if (auto const why = why_unknown(static_cast<Quantity>(place), scene)) refuse(node, *why);
        scene.quantities |= Selection{1} << place;
    }
}

void check_size(Sampling const& sampling, Scene const& scene) {
    double const values = static_cast<double>(scene.members) * static_cast<double>(scene.sample_times.size()) *
                          std::popcount(scene.series);
    if (values > most_values) {
        refuse(*sampling.node,
               {fmt::format("the time series of {} members would hold {:.3g} numbers", scene.members, values),
                fmt::format("ask for fewer samples, members or series, at most {:g} numbers", most_values)});
    }
}

/// Why a study has no such key, where there is more to say than that.
Problem foreign_key(Setting const& key, StudyKind kind) {
    bool const sweep = kind == StudyKind::sweep;
    if (key.name.starts_with("study.samples")) {
        return {fmt::format("kind = \"{}\" stores no time series", name_of(kind)),
                "remove it, or use kind = \"ensemble\""};
    }
    if (sweep && key.name == "study.duration") return {"a sweep records whole revolutions", "use study.revolutions"};
    if (sweep && key.name == "study.section") return {"a sweep takes its sections at a crank angle", "use study.phase"};
    if (sweep && key.name == "study.dt") {
        return {"rescalings of a sweep fall on its sections", "use study.rescalings_per_revolution"};
    }
    std::vector<std::string> owners;
    for (int i = 0; i < static_cast<int>(std::size(study_kind_names)); ++i) {
        if ((key.studies & set_of(static_cast<StudyKind>(i))) != 0) owners.push_back(fmt::format("\"{}\"", study_kind_names[i]));
    }
    return {fmt::format("it has no effect with kind = \"{}\"", name_of(kind)), fmt::format("remove it, or use kind = {}", fmt::join(owners, " or "))};
}

/// Refuses what the study does not read, and the later one of two keys that say the same.
void check_keys(Node const& root, StudyKind kind) {
    for (Setting const& key : settings()) {
        Node const* const node = root.find_path(key.name);
        if (node == nullptr) continue;
        if ((key.studies & set_of(kind)) == 0) refuse(*node, foreign_key(key, kind));
        for (std::string_view const rival : key.rivals) {
            // study.members may say what a design comes to.
            Node const* const other = rival.empty() || rival == "study.members" ? nullptr : root.find_path(rival);
            if (other == nullptr) continue;
            bool const is_later = std::pair(node->order, node->line) > std::pair(other->order, other->line);
            refuse(is_later ? *node : *other, {fmt::format("{} says it too", is_later ? rival : key.name), "remove one of the two"});
        }
    }
}

}  // namespace

std::optional<Problem> unresolved_drive(Parts const& parts, Inputs const& inputs, double seconds) {
    double const turn = drive_period(parts, inputs);
    if (!std::isfinite(turn)) return {};
    bool const cranks = info(parts.mechanism).drive == DriveKind::crank;
    double const radius = cranks ? inputs.crank_length : inputs.stroke / 2;
    constexpr double of_clearance = 1e-6;
    double const per_turn = 2 * std::numbers::pi * std::numeric_limits<double>::epsilon() * radius;
    double const most = of_clearance * inputs.clearance_y / per_turn, turns = seconds / turn;
    if (!(turns > most)) return {};
    return Problem{fmt::format("after {:.3g} {} the last bit of a number of double precision moves the drive by {:.2g} of the clearance", turns,
                               cranks ? "revolutions" : "cycles", of_clearance * turns / most),
                   fmt::format("stay below {:.2g} s, or run several members", most * turn)};
}

std::vector<double> uniform_times(double end_time, std::size_t count) {
    std::vector<double> times(count);
    for (std::size_t i = 0; i < count; ++i) {
        times[i] = end_time * static_cast<double>(i) / static_cast<double>(count - 1);
    }
    if (count > 0) times.back() = end_time;
    return times;
}

void read_study(Node const& root, Scene& scene) {
    read_given(root, "study.kind", scene.study);
    check_keys(root, scene.study);
    read_bound(root, "study", scene);
    read_design(root, scene);
    if (scene.study == StudyKind::sweep) read_sweep(root, scene);
    if (!runs_to_end(scene.study)) read_chaos(root, scene);
}

void read_recording(Node const& root, Scene& scene) {
    bool const samples = runs_to_end(scene.study);
    EndTime const end = samples ? read_end_time(root, scene) : EndTime{run_length(scene).seconds, NAN};
    RunLength const length = samples ? RunLength{end.seconds, end.seconds, 0} : run_length(scene);
    scene.integrator.end_time = end.seconds;
    if (samples) scene.chaos.span = {end.seconds, false};
    read_steps(root, scene, length);
    check_drive_is_resolved(root, scene, length.longest);
    Sampling const sampling = samples ? read_sampling(root, scene, end) : Sampling{};
    scene.sample_times = uniform_times(end.seconds, sampling.count);
    if (!scene.sample_times.empty()) scene.series = info(scene.parts.mechanism).always;
    if (Node const* const list = root.find_path("study.quantities")) read_quantities(*list, scene);
    read_limits(root, scene);
    if (scene.study == StudyKind::tolerance && scene.quantities == 0) {
        Node const* const list = root.find_path("study.quantities");
        refuse_missing(list != nullptr ? *list : *root.find_path("study.kind"), "a quantity",
                       "a tolerance study tells how quantities scatter",
                       "add quantities = [\"mean_normal_force\", \"friction_loss\"], or see `slideway list`");
    }
    // The audit runs anyway, and whoever takes such a method should see what it says.
    if (is_always_audited(scene.integrator.method)) scene.quantities |= selection_of(Quantity::energy_residual);
    check_size(sampling, scene);
    read_store(root, scene);
}

void read_store(Node const& root, Scene& scene) {
    if (scene.stores_members()) return;
    Node const* const node = root.find_path("study.store");
    if (scene.design.kind == DesignKind::saltelli) {
        refuse(*node, {"sensitivity indices need every member's values", "use store = \"members\""});
    }
    if (!scene.sample_times.empty()) {
        refuse(*node, {"time series are of single members", "remove the samples, or use store = \"members\""});
    }
    if (scene.quantities == 0) {
        refuse(*node, {"there is no quantity to make statistics of",
                       "add quantities = [\"mean_normal_force\"], or see `slideway list`"});
    }
}

}  // namespace slideway
