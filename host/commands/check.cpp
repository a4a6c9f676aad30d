#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/backend/linkage_modules.hpp"
#include "host/base/text.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/outputs.hpp"
#include "host/run/ensemble.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/prediction.hpp"

namespace slideway::cli {
namespace {

/// "load.plunger (indicator.csv over crank_angle), spring.return".
std::string loads_text(Scene const& scene) {
    SceneLoads const& loads = *scene.loads;
    std::string text, last;
    for (std::size_t i = 0; i < loads.rows().size(); ++i) {
        auto const& [name, table, words] = loads.rows()[i];
        if (name == last) continue;
        text += fmt::format("{}{}", i == 0 ? "" : ", ", name);
        last = name;
        if (table.function == nullptr) continue;
        TableFile const& file = *find_table(scene, name + ".table");
        text += fmt::format(" ({} over {})", std::filesystem::path(file.path).filename().string(), load_arguments[static_cast<int>(loads.load(i).over) - 1]);
    }
    return text;
}

void print_parts(Scene const& scene) {
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    std::vector<std::string> in{fmt::format("{} mechanism", kind_of(scene.parts.mechanism))}, out;
    auto const sort = [&](bool is_in, std::string name) { (is_in ? in : out).push_back(std::move(name)); };
    if (mechanism.spatial) {
        for (LawInfo const& law : laws()) sort(law.name == contact_info(scene.parts).name, fmt::format("{} law", law.name));
        if (may_be_rigid(scene.parts.mechanism)) sort(scene.parts.rigid, "rigid contact");
    } else if (!is_linkage(scene.parts.mechanism)) {
        sort(true, scene.parts.rigid ? "rigid contact of corners" : "contact of corners");
    }
    constexpr char const* drives[] = {"drive at constant speed", "drive on a profile", "motor", "no drive"};
    if (scene.parts.drive.by != DriveBy::speed) sort(true, drives[static_cast<int>(scene.parts.drive.by)]);
    sort(true, damping_text(scene.parts));
    // Which the scene might have had.
    auto const sort_out = [&](Damping damping, std::string name) {
        bool const may = scene.parts.rigid ? false : mechanism.spatial ? info(scene.parts.law).has(damping) : damping == Damping::restitution;
        if (may && scene.parts.damping != damping) sort(false, std::move(name));
    };
    sort_out(Damping::rate, fmt::format("damping of {} contacts", rate_damped(info(scene.parts.law))));
    sort_out(Damping::restitution, "restitution");
    sort(scene.parts.friction, "friction");
    if (mechanism.spatial) {
        sort(scene.parts.misaligned_way, "pose of a misaligned way");
        sort(scene.parts.offset_slider, "offset of mass centre and pin");
    }
    if (scene.loads != nullptr) sort(true, loads_text(scene));
    sort(!scene.sample_times.empty(), "time series");
    print_field("parts in", fmt::format("{}", fmt::join(in, "; ")));
    print_field("parts out", out.empty() ? "none" : fmt::format("{}", fmt::join(out, "; ")));

    std::vector<std::string_view> asked, left;
    Outputs const& outputs = outputs_of(scene.parts.mechanism);
    Selection const known = outputs.has_quantities & ~(scene.parts.rigid ? without_rigid_contact : of_rigid_contact);
    for (QuantityInfo const& quantity : selected(outputs.quantities, known & scene.quantities)) asked.emplace_back(quantity.name);
    for (QuantityInfo const& quantity : selected(outputs.quantities, known & ~scene.quantities)) left.emplace_back(quantity.name);
    auto const listed = [](auto const& names) { return names.empty() ? "no quantity" : fmt::format("{}", fmt::join(names, ", ")); };
    print_field("asked for", listed(asked));
    print_field("left out", listed(left));
}

/// Whether what bodies and joints there are is looked up.
std::string linkage_text(Scene const& scene, Backend const& backend) {
    bool const compiled = compiled_linkage(scene.parts, compiled_isa(parse_isa(backend.isa()))) != nullptr;
    return compiled ? "compiled for these bodies and joints" : "for any bodies and joints; slideway compile makes faster ones for these";
}

std::string range_text(std::string const& least, std::string const& most) {
    return least == most ? least : fmt::format("{} to {}", least, most);
}

std::string cost_text(Scene const& scene, Prediction const& prediction, std::optional<Trial> const& trial) {
    std::string const threads = counted(static_cast<std::uint64_t>(prediction.busy_threads), "thread");
    if (has_fixed_step(scene.integrator.method)) {
        return fmt::format("{:.0f} steps, all fixed; some {} on {}", prediction.most_steps,
                           duration_text(trial ? trial->seconds : prediction.most_seconds), threads);
    }
    if (trial) {
        return fmt::format("about {} on {}, some {:.2g} steps, estimated from {}", duration_text(trial->seconds), threads, trial->steps,
                           counted(trial->members, "member"));
    }
    return fmt::format(
        "{} steps, {} on {}; a rough range: all in free flight to all in contact that rings",
        range_text(fmt::format("{:.2g}", prediction.least_steps), fmt::format("{:.2g}", prediction.most_steps)),
        range_text(duration_text(prediction.least_seconds), duration_text(prediction.most_seconds)), threads);
}

/// What a study of orbits records of each member.
void print_orbits(Scene const& scene, OrbitSchedule const& schedule) {
    if (!schedule.timing) return;
    if (scene.study == StudyKind::sweep) {
        print_field("columns", fmt::format("{} of {}, {} each", counted(scene.chaos.values.size(), "value"), scene.chaos.parameter->name,
                                           counted(scene.members, "start")));
    }
    if (schedule.sections) {
        print_field("sections", fmt::format("{}{} of each member", schedule.crossings.room > 0 ? "at most " : "",
                                            schedule.section_rows()));
    }
    ShadowPlan const shadows = shadow_plan(scene);
    if (shadows.count == 0) return;
    double const period = schedule.timing(scene.inputs).period;
    print_field("exponents", fmt::format("{} by as many shadows, rescaled every {:.6g} {}", shadows.count,
                                         schedule.by_turns ? period * 180 / std::numbers::pi : period, schedule.by_turns ? "degrees" : "s"));
}

std::string design_text(Scene const& scene) {
    Design const& design = scene.design;
    std::string name(name_of(design.kind)), keys = counted(scene.variations.size(), "key");
    switch (design.kind) {
        case DesignKind::mc:
        case DesignKind::lhs:
        case DesignKind::sobol:
            return fmt::format("{}, {} of {}", name, counted(scene.members, "point"), keys);
        case DesignKind::saltelli:
            return fmt::format("{}, {} rows of {} members", name, design.base, scene.variations.size() + 2);
        case DesignKind::grid:
            return fmt::format("{}, {} levels", name, fmt::join(design.levels, " x "));
        case DesignKind::table:
            return fmt::format("{}, {} of the {} rows of {}", name, scene.members, design.table->rows(),
                               design.table->path);
    }
    return name;
}

/// A comment of the scene in lines that are comments too.
void print_comment(std::string_view words) {
    std::size_t const width = line_width();
    std::string const lines = wrapped(words, 4, width > 2 ? width - 2 : 0, 0);
    for (std::size_t at = 0, end = 0; end < lines.size(); at = end + 1) {
        end = std::min(lines.find('\n', at), lines.size());
        print_out("# {}\n", std::string_view(lines).substr(at, end - at));
    }
}

/// Lists may take several lines in TOML, other values not.
void print_resolved(std::string_view text) {
    while (!text.empty()) {
        auto const end = std::min(text.find('\n'), text.size());
        std::string_view const line = text.substr(0, end);
        if (line.starts_with("# ")) {
            print_comment(line.substr(2));
        } else {
            print_out("{}\n", wrapped(line, 4, line.find(" = [") == line.npos ? 0 : line_width(), 0));
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    print_out("\n");
}

/// What the scene does not give, with its values: "slider_mass 187.2 kg, slider_inertia_x 2.03 kg m2".
void print_derived(Scene const& scene) {
    std::vector<std::string> texts;
    for (DerivedNumber const& one : derived_numbers(scene)) {
        std::string_view const name = one.key->name.substr(one.key->name.find('.') + 1);
        texts.push_back(std::isnan(one.value) ? std::string(name)
                                              : fmt::format("{} {:.4g}{}{}", name, one.value, one.key->unit == "1" ? "" : " ",
                                                            one.key->unit == "1" ? "" : one.key->unit));
    }
    if (!texts.empty()) print_field("derived", fmt::format("{}", fmt::join(texts, ", ")));
}

/// How members are spread over what varies, and what they are to meet.
void print_design(Scene const& scene) {
    if (!scene.variations.empty()) print_field("design", design_text(scene));
    if (!scene.design.correlation.variations.empty()) {
        print_field("correlation", fmt::format("of {} keys", scene.design.correlation.variations.size()));
    }
    std::vector<std::string> limited;
    for (Limit const& limit : scene.limits) limited.push_back(limit.name());
    if (!limited.empty()) print_field("limits", fmt::format("of {}", fmt::join(limited, ", ")));
}

/// What is wrong is seen too: as far as the linkage goes together, with the joint that stays open.
Scene admitted_scene(CheckArguments const& arguments, std::optional<OutputTarget> const& target) {
    try {
        return admitted_scene(arguments.scene, arguments.any_start);
    } catch (OpenLinkage const& open) {
        if (!target) throw;
        pid_t const child = fork();
        if (child == 0) draw(*target, drawing_json(*open.scene, &open));
        if (child > 0) waitpid(child, nullptr, 0);
        throw;
    }
}

}  // namespace

int execute(CheckArguments const& arguments) {
    std::optional<OutputTarget> const target = arguments.drawing.empty() ? std::nullopt : std::optional(drawing_target(arguments));
    Scene const scene = admitted_scene(arguments, target);
    int const threads = arguments.threads;
    BackendRequest request = arguments.scene.backend;
    request.threads = threads;
    BackendChoice const choice =
        choose_backend(request, scene, place_count(scene, MemberSet(MemberRange{0, member_count(scene)})));
    Prediction const prediction = predict(scene, *choice.backend, threads);

    if (arguments.resolved) {
        print_out("{}", resolved_toml(scene));
        return exit_code::done;
    }
    bool const has_room = prediction.memory() + memory_of_work(threads) <= memory_room();
    if (!has_room) tell("warning: {}: a run takes more memory than this process may (ulimit -v)\n", scene.path);
    std::optional<Trial> const trial = has_room ? try_members(scene, *choice.backend, threads) : std::nullopt;
    if (arguments.json) {
        print_out("{}", check_json(scene, prediction, trial, *choice.backend));
        return exit_code::done;
    }

    print_text(2, "# {} is a valid scene.  Resolved, in SI units:\n", shown(scene.path));
    print_resolved(resolved_toml(scene));
    print_derived(scene);
    print_parts(scene);
    print_field("kernels", fmt::format("{}, {}, blocks of at most {}", backend_text(*choice.backend),
                                       counted(static_cast<std::uint64_t>(choice.backend->workers(threads)), "thread"),
                                       counted(prediction.largest_block, "member")));
    if (!choice.reason.empty()) print_field("", choice.reason);
    if (scene.parts.linkage != nullptr) print_field("", linkage_text(scene, *choice.backend));
    OrbitSchedule const schedule = orbit_schedule(scene);
    std::string const length = schedule.by_turns       ? fmt::format("{:.6g} revolutions, for at most {:.6g} s", schedule.turns, schedule.end)
                               : scene.has_own_ends() ? fmt::format("{:.6g} revolutions of its own, {:.6g} s at most", scene.chaos.span.value, scene.integrator.end_time)
                                                      : fmt::format("{:.6g} s", schedule.end);
    print_field("members", fmt::format("{}, each over {}", member_count(scene), length));
    print_design(scene);
    print_orbits(scene, schedule);
    std::string const design = prediction.design_bytes > 0 ? fmt::format(", {} for the order of the members", bytes_text(prediction.design_bytes)) : "";
    print_field("memory", fmt::format("{} for blocks in work, {} for shards on their way, {} for the statistics at the end{}{}",
                                      bytes_text(prediction.buffer_bytes), bytes_text(prediction.image_bytes), bytes_text(prediction.summary_bytes), design,
                                      card_memory_text(prediction)));
    print_field("disk", fmt::format("{} for the result, {} for its shards until it is whole", bytes_text(prediction.output_bytes),
                                    shards_text(scene, prediction)));
    print_field("cost", cost_text(scene, prediction, trial));
    if (target) draw(*target, drawing_json(scene));
    return exit_code::done;
}

}  // namespace slideway::cli
