#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "host/base/suggest.hpp"
#include "host/commands/commands.hpp"
#include "host/store/provenance.hpp"

namespace slideway::cli {
namespace {

constexpr std::string_view command_names[] = {"run", "check", "probe", "info", "stats", "merge", "report", "list", "help"};

/// Texts of the options as CLI11 fills them in; checked and turned into arguments afterwards.
struct Words {
    std::string scene, output, isa = "auto", backend = "auto", table, file;
    std::vector<std::string> overrides;
    std::string max_failures, max_hours, member, members, threads, shard, block_members;
    std::string variable, column, spacing, skip_time, skip_samples, max_points, delay, dimension, theiler, fit;
    bool quiet = false, no_progress = false, scene_too = false, intact = false, resolved = false, resume = false, force = false, verify = false, json = false, schema = false, markdown = false;
};

std::string isa_help() {
    std::string text = "Instruction set: auto (the widest)";
    for (Isa const isa : built_isas())
        text += fmt::format("{}{}", isa == built_isas().back() ? " or " : ", ", name_of(isa));
    return text;
}

void add_scene_options(CLI::App& command, Words& words) {
    command.add_option("SCENE", words.scene, "Scene file (TOML)")->type_name("");
    command.add_option("--set", words.overrides, "Override keys of the scene, as in contact.law=conservative")
        ->type_name("KEY=VALUE");
    command.add_option("--isa", words.isa, isa_help())->type_name("ISA");
}

void add_backend(CLI::App& command, Words& words) {
    command.add_option("--backend", words.backend, "auto (a card where it pays), cpu or cuda")->type_name("NAME");
}

void add_force(CLI::App& command, Words& words) {
    command.add_flag("--force", words.force, "Replace a file of slideway that is there already; inputs and other files never");
}

void add_json(CLI::App& command, Words& words) {
    command.add_flag("--json", words.json, "One object in JSON in place of text (docs/json.md)");
}

void add_threads(CLI::App& command, Words& words) {
    command.add_option("--threads", words.threads, "Threads (default: all that this process may use)")->type_name("N");
}

void add_stats_options(CLI::App& command, Words& words) {
    auto const add = [&](char const* name, std::string& word, char const* help, char const* type) {
        command.add_option(name, word, help)->type_name(type);
    };
    command.add_option("FILE", words.file, "Result file, or a table in CSV")->required()->type_name("");
    add("--variable", words.variable, "Variable of a result (default y)", "NAME");
    add("--member", words.member, "Member of a result (default: its first)", "K");
    add("--column", words.column, "Column of a table, by name or number from 1 (default: the last)", "NAME|N");
    add("--dt", words.spacing, "Spacing of a table's samples (default: from its column time or t)", "SECONDS");
    add("--skip", words.skip_time, "Leave out a transient", "SECONDS");
    add("--skip-samples", words.skip_samples, "Leave out a transient", "N");
    add("--max-points", words.max_points, "Use at most so many samples", "N");
    add("--delay", words.delay, "Delay of the embedding in samples (default: C-C method)", "N");
    add("--dimension", words.dimension, "Dimension of the embedding (default: C-C method)", "M");
    add("--theiler", words.theiler, "Neighbours are farther apart in time, samples (default: the average period)", "N");
    add("--fit", words.fit, "Fit the exponent over these samples of the divergence curve (default: found)", "A..B");
    add("-o,--output", words.output, "Write the C-C curves and the divergence curve to this file", "OUT.csv");
    add_force(command, words);
    add_json(command, words);
}

/// `--set` takes all words up to the next option, the scene too where it stands behind: only that has no `=`.
SceneArguments scene_arguments(Words const& words) {
    SceneArguments scene;
    scene.path = words.scene;
    scene.isa = words.isa;
    scene.backend = parse_backend(words.backend, words.isa);
    for (std::string const& word : words.overrides) {
        if (scene.path.empty() && word.find('=') == word.npos)
            scene.path = word;
        else
            scene.overrides.push_back(parse_override(word));
    }
    if (scene.path.empty()) throw SceneError("slideway: SCENE is missing; give a scene file, see slideway --help");
    return scene;
}

std::optional<int> threads(Words const& words) {
    if (words.threads.empty()) return std::nullopt;
    return parse_threads(words.threads);
}

RunArguments run_arguments(Words const& words) {
    RunArguments run;
    run.scene = scene_arguments(words);
    if (words.verify) run.scene.overrides.emplace_back("study.verify", "16");
    run.output = words.output;
    run.threads = threads(words);
    run.quiet = words.quiet;
    run.progress = !words.quiet && !words.no_progress;
    run.json = words.json;
    run.resume = words.resume;
    run.force = words.force;
    if (!words.max_failures.empty()) run.max_failures = parse_failure_limit(words.max_failures);
    if (!words.max_hours.empty()) run.max_hours = parse_hours(words.max_hours);
    if (!words.member.empty() && !words.members.empty()) {
        throw SceneError("--member and --members exclude each other; use one");
    }
    if (!words.shard.empty()) run.part = parse_part(words.shard);
    if (!words.block_members.empty()) run.block_members = parse_block_members(words.block_members);
    if (!words.member.empty()) run.members = parse_member(words.member);
    if (!words.members.empty()) run.members = parse_member_range(words.members);
    return run;
}

StatsArguments stats_arguments(Words const& words) {
    StatsArguments stats;
    stats.path = words.file;
    stats.output = words.output;
    stats.force = words.force;
    stats.json = words.json;
    if (!words.variable.empty()) stats.variable = words.variable;
    if (!words.column.empty()) stats.column = words.column;
    if (!words.member.empty()) stats.member = parse_member(words.member).first;
    if (!words.spacing.empty()) stats.spacing = parse_seconds("--dt", words.spacing);
    if (!words.skip_time.empty()) stats.skip_time = parse_seconds("--skip", words.skip_time);
    auto const count = [](std::string_view option, std::string const& word, std::size_t least) {
        return word.empty() ? std::nullopt : std::optional(parse_count(option, word, least));
    };
    stats.skip_samples = count("--skip-samples", words.skip_samples, 0);
    stats.max_points = count("--max-points", words.max_points, 1);
    stats.options.delay = count("--delay", words.delay, 1);
    stats.options.dimension = count("--dimension", words.dimension, 1);
    stats.options.theiler = count("--theiler", words.theiler, 0);
    if (!words.fit.empty()) stats.options.fit = parse_fit(words.fit);
    if (stats.skip_time && stats.skip_samples) {
        throw SceneError("--skip and --skip-samples exclude each other; use one");
    }
    return stats;
}

/// "use run, check, …, list or help"
std::string known_commands() {
    return fmt::format("use {} or {}", fmt::join(std::begin(command_names), std::end(command_names) - 1, ", "), *(std::end(command_names) - 1));
}

/// CLI11's own message for an unknown command names all words behind it, but not what was meant.
void require_known_command(int argc, char const* const* argv) {
    if (argc < 2)
        throw SceneError(
            fmt::format("slideway: a command is missing; {} (see slideway --help)", known_commands()));
    std::string_view const word = argv[1];
    if (word == "--help" || word == "-h" || word == "--version") return;
    if (std::find(std::begin(command_names), std::end(command_names), word) != std::end(command_names)) return;
    std::string_view const meant = nearest_name(word, command_names);
    throw SceneError(fmt::format("slideway: there is no command '{}'; {}", word,
                                 meant.empty() ? known_commands()
                                               : fmt::format("did you mean {}?", meant)));
}

/// "; did you mean --resume?" where an option of the command is near enough to one that it does not have.
std::string option_advice(CLI::App const& command) {
    std::vector<std::string> names;
    for (CLI::Option const* const option : command.get_options()) {
        for (std::string const& name : option->get_lnames()) names.push_back("--" + name);
    }
    std::vector<std::string_view> const known(names.begin(), names.end());
    for (std::string const& word : command.remaining()) {
        std::string_view const near = word.starts_with("--") ? nearest_name(word.substr(0, word.find('=')), known) : std::string_view();
        if (!near.empty()) return fmt::format("; did you mean {}?", near);
    }
    return fmt::format("; see slideway help {}", command.get_name());
}

/// A shell's variable that is unset must not become the whole study, or a default.
void refuse_empty_words(CLI::App const& command) {
    for (CLI::Option const* const option : command.get_options()) {
        for (std::string const& word : option->results()) {
            if (!word.empty()) continue;
            throw SceneError(fmt::format("{}: is empty; give a value, or leave it out", option->get_name()));
        }
    }
}

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

Arguments parse_arguments(int argc, char const* const* argv) {
    require_known_command(argc, argv);
    Words words;
    CLI::App app{"Clearance joints of slider mechanisms: ensembles of simulations from a scene file.", "slideway"};
    app.set_version_flag("--version", fmt::format("slideway {} ({})", build_info().version, build_info().commit));
    app.require_subcommand(1);

    CLI::App* const run = app.add_subcommand("run", "Integrate the members of a scene to a NetCDF file");
    add_scene_options(*run, words);
    run->add_option("-o,--output", words.output, "Result file (default: in this folder, the scene's name and what --set changes)")
        ->type_name("OUT.nc");
    add_threads(*run, words);
    add_backend(*run, words);
    run->add_flag("--resume", words.resume, "Go on with what an earlier run has left in OUT.nc.shards");
    add_force(*run, words);
    run->add_option("--max-hours", words.max_hours,
                    "Stop after this time and keep what is finished in OUT.nc.shards (exit code 5)")
        ->type_name("H");
    run->add_option("--max-failures", words.max_failures,
                    "Members that may fail before the exit code is 3 (default 1%)")
        ->type_name("N|P%");
    run->add_option("--member", words.member,
                    "Run this member alone, counted from 0, with the inputs it has in the ensemble")
        ->type_name("N");
    run->add_option("--members", words.members, "Run these members alone, both ends included")->type_name("A..B");
    run->add_option(
           "--shard", words.shard,
           "Run the I-th of N parts, as a job of an array; the jobs share OUT.nc.shards, and merge makes OUT.nc")
        ->type_name("I/N");
    run->add_option("--block-members", words.block_members,
                    "Members that a thread takes at once (default: by their cost); a crash loses those under way")
        ->type_name("N");
    run->add_flag("--verify", words.verify, "Run 16 members again to check the study, whatever it costs (study.verify = 16)");
    run->add_flag("--no-progress", words.no_progress, "No lines of progress on stderr");
    run->add_flag("--quiet", words.quiet, "No progress and no summary: warnings and errors alone");
    add_json(*run, words);

    CLI::App* const check =
        app.add_subcommand("check", "Validate a scene; print it resolved, and what a run will take");
    add_scene_options(*check, words);
    add_threads(*check, words);
    add_backend(*check, words);
    add_json(*check, words);
    check->add_flag("--resolved", words.resolved, "Print the resolved scene alone, as a scene file");
    check->add_flag("--force", words.force, "Accept starts inside the way");

    CLI::App* const probe = app.add_subcommand("probe", "Forces, contact mode and derivative of single states");
    add_scene_options(*probe, words);
    probe->add_option("--csv", words.table, "Table of states (default: the scene's start)")->type_name("STATES.csv");
    probe->add_option("-o,--output", words.output, "Write CSV to this file")->type_name("OUT.csv");
    add_force(*probe, words);
    add_json(*probe, words);

    CLI::App* const info = app.add_subcommand("info", "Provenance, statuses and statistics of a result file");
    info->add_option("FILE", words.file, "Result file")->required()->type_name("");
    info->add_flag("--scene", words.scene_too, "Show its scene, too");
    add_json(*info, words);
    info->add_flag("--check", words.intact, "Only say whether the file is what was written (exit code 4 if not)");

    CLI::App* const stats = app.add_subcommand("stats", "Chaos statistics of a stored series (NetCDF result or CSV)");
    add_stats_options(*stats, words);

    CLI::App* const merge = app.add_subcommand("merge", "Shards of a run or of a job array to one result file");
    merge->add_option("DIR", words.file, "Folder of shards, OUT.nc.shards")->required()->type_name("");
    merge->add_option("-o,--output", words.output, "Result file")->required()->type_name("OUT.nc");
    add_force(*merge, words);
    add_json(*merge, words);

    CLI::App* const report = app.add_subcommand(
        "report", "A page to look at, without a network, of a result file (uses the Python companion)");
    report->add_option("FILE", words.file, "Result file")->required()->type_name("");
    report->add_option("-o,--output", words.output, "Page (default: FILE with .html)")->type_name("OUT.html");
    add_force(*report, words);
    report->footer(
        "The companion is the package slideway of the interpreter that SLIDEWAY_PYTHON names, else of python3;\n"
        "pip install ./python in the source tree installs it.");

    app.add_subcommand("help", "What a command does, and its options: help [COMMAND]");
    CLI::App* const list = app.add_subcommand("list", "Mechanisms, laws, quantities, keys: what a scene may ask for");
    CLI::Option* const json = list->add_flag("--json", words.json, "The keys of a scene as JSON");
    CLI::Option* const schema = list->add_flag("--schema", words.schema, "A JSON Schema of scenes, for editors of TOML")->excludes(json);
    list->add_flag("--markdown", words.markdown, "The keys of a scene as a page in Markdown")->excludes(json)->excludes(schema);

    // `help run` is `run --help`, and `help` alone `--help`.
    std::vector<std::string> given(argv + 1, argv + argc);
    if (!given.empty() && given.front() == "help") {
        given.erase(given.begin());
        if (!given.empty()) require_known_command(static_cast<int>(given.size()) + 1, argv + 1);
        given.resize(std::min<std::size_t>(given.size(), 1));
        given.emplace_back("--help");
    }
    std::reverse(given.begin(), given.end());  // as CLI11 wants them
    try {
        app.parse(given);
    } catch (CLI::CallForHelp const&) {
        return TextOnly{app.help()};
    } catch (CLI::CallForAllHelp const&) {
        return TextOnly{app.help("", CLI::AppFormatMode::All)};
    } catch (CLI::CallForVersion const& version) {
        return TextOnly{std::string(version.what()) + "\n"};
    } catch (CLI::ExtrasError const& error) {
        auto const commands = app.get_subcommands();
        throw SceneError("slideway: " + one_line(error.what()) + (commands.empty() ? "" : option_advice(*commands.front())));
    } catch (CLI::ParseError const& error) {
        throw SceneError("slideway: " + one_line(error.what()));
    }

    for (CLI::App const* const command : app.get_subcommands()) refuse_empty_words(*command);
    if (run->parsed()) return run_arguments(words);
    if (check->parsed()) return CheckArguments{scene_arguments(words), threads(words), words.force, words.json, words.resolved};
    if (probe->parsed()) return ProbeArguments{scene_arguments(words), words.table, words.output, words.force, words.json};
    if (info->parsed()) return InfoArguments{words.file, words.scene_too, words.json, words.intact};
    if (stats->parsed()) return stats_arguments(words);
    if (merge->parsed()) return MergeArguments{words.file, words.output, words.force, words.json};
    if (report->parsed()) return ReportArguments{words.file, words.output, words.force};
    if (list->parsed()) {
        using Form = ListArguments::Form;
        return ListArguments{words.json ? Form::json : words.schema ? Form::schema : words.markdown ? Form::markdown : Form::text};
    }
    throw SceneError("slideway: a command is missing; see slideway --help");
}

}  // namespace slideway::cli
