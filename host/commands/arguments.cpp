#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "host/base/suggest.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/description.hpp"
#include "host/commands/text.hpp"
#include "host/store/provenance.hpp"

namespace slideway::cli {
namespace {

/// What --members of info is without a value.
constexpr std::string_view all_members = "all";

/// Texts of the options as CLI11 fills them in; checked and turned into arguments afterwards.
struct Words {
    std::string scene, output, isa = "auto", backend = "auto", table, file;
    std::vector<std::string> overrides;
    std::string max_failures, max_hours, member, members, threads, shard, block_members;
    std::string variable, column, spacing, skip_time, skip_samples, max_points, delay, dimension, theiler, fit;
    std::string command, shell;
    bool man = false, quiet = false, no_progress = false;
    bool scene_too = false, intact = false, resolved = false, resume = false, force = false, verify = false, json = false, schema = false, markdown = false;
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
    command.add_option("--backend", words.backend, "auto (a card where it pays), cpu or cuda")->type_name("BACKEND");
}

void add_force(CLI::App& command, Words& words) {
    command.add_flag("--force", words.force, "Replace a file of slideway that is there already; inputs and other files never");
}

CLI::Option* add_json(CLI::App& command, Words& words) {
    return command.add_flag("--json", words.json, "One object in JSON in place of text (docs/json.md)");
}

void add_threads(CLI::App& command, Words& words) {
    command.add_option("--threads", words.threads, "Threads (default: all that this process may use)")->type_name("N");
}

/// An option with a word for its value.
void add_word(CLI::App& command, char const* name, std::string& word, char const* meaning, char const* value) {
    command.add_option(name, word, meaning)->type_name(value);
}

void add_run_options(CLI::App& run, Words& words) {
    add_scene_options(run, words);
    add_word(run, "-o,--output", words.output, "Result file (default: in this folder, the scene's name and what --set changes)", "OUT.nc");
    add_threads(run, words);
    add_backend(run, words);
    run.add_flag("--resume", words.resume, "Go on with what an earlier run has left in OUT.nc.shards");
    add_force(run, words);
    add_word(run, "--max-hours", words.max_hours, "Stop after this time and keep what is finished in OUT.nc.shards (exit code 5)", "H");
    add_word(run, "--max-failures", words.max_failures, "Members that may fail before the exit code is 3 (default 1%)", "N|P%");
    add_word(run, "--member", words.member, "Run this member alone, counted from 0, with the inputs it has in the ensemble", "N");
    add_word(run, "--members", words.members, "Run these members alone, both ends included", "A..B");
    add_word(run, "--shard", words.shard, "Run the I-th of N parts, as a job of an array; the jobs share OUT.nc.shards, and merge makes OUT.nc", "I/N");
    add_word(run, "--block-members", words.block_members,
             "Members that a thread takes at once (default: by their cost); a crash loses those under way", "N");
    run.add_flag("--verify", words.verify, "Run 16 members again to check the study, whatever it costs (study.verify = 16)");
    run.add_flag("--no-progress", words.no_progress, "No lines of progress on stderr");
    run.add_flag("--quiet", words.quiet, "No progress and no summary: warnings and errors alone");
    add_json(run, words);
}

void add_check_options(CLI::App& check, Words& words) {
    add_scene_options(check, words);
    add_threads(check, words);
    add_backend(check, words);
    CLI::Option* const json = add_json(check, words);
    check.add_flag("--resolved", words.resolved, "Print the resolved scene alone, as a scene file")->excludes(json);
    check.add_flag("--force", words.force, "Accept starts inside the way");
}

void add_probe_options(CLI::App& probe, Words& words) {
    add_scene_options(probe, words);
    add_word(probe, "--csv", words.table, "Table of states (default: the scene's start)", "STATES.csv");
    add_word(probe, "-o,--output", words.output, "Write CSV to this file", "OUT.csv");
    add_force(probe, words);
    add_json(probe, words);
}

void add_info_options(CLI::App& info, Words& words) {
    info.add_option("FILE", words.file, "Result file")->type_name("");
    CLI::Option* const json = add_json(info, words);
    info.add_flag("--scene", words.scene_too, "Show its scene, too")->excludes(json);
    info.add_flag("--check", words.intact, "Only say whether the file is what was written (exit code 4 if not)")->excludes(json);
    info.add_option("--members", words.members, "Show its members, or these of them, too: number, status, end time, steps")
        ->type_name("A..B")->expected(0, 1)->default_str(std::string(all_members));
}

void add_stats_options(CLI::App& stats, Words& words) {
    stats.add_option("FILE", words.file, "Result file, or a table in CSV")->required()->type_name("");
    add_word(stats, "--variable", words.variable, "Variable of a result (default y)", "NAME");
    add_word(stats, "--member", words.member, "Member of a result (default: its first)", "K");
    add_word(stats, "--column", words.column, "Column of a table, by name or number from 1 (default: the last)", "NAME|N");
    add_word(stats, "--dt", words.spacing, "Spacing of a table's samples (default: from its column time or t)", "SECONDS");
    add_word(stats, "--skip", words.skip_time, "Leave out a transient", "SECONDS");
    add_word(stats, "--skip-samples", words.skip_samples, "Leave out a transient", "N");
    add_word(stats, "--max-points", words.max_points, "Use at most so many samples", "N");
    add_word(stats, "--delay", words.delay, "Delay of the embedding in samples (default: C-C method)", "N");
    add_word(stats, "--dimension", words.dimension, "Dimension of the embedding (default: C-C method)", "M");
    add_word(stats, "--theiler", words.theiler, "Neighbours are farther apart in time, samples (default: the average period)", "N");
    add_word(stats, "--fit", words.fit, "Fit the exponent over these samples of the divergence curve (default: found)", "A..B");
    add_word(stats, "-o,--output", words.output, "Write the C-C curves and the divergence curve to this file", "OUT.csv");
    add_force(stats, words);
    add_json(stats, words);
}

void add_merge_options(CLI::App& merge, Words& words) {
    merge.add_option("DIR", words.file, "Folder of shards, OUT.nc.shards")->required()->type_name("");
    merge.add_option("-o,--output", words.output, "Result file")->required()->type_name("OUT.nc");
    add_force(merge, words);
    add_json(merge, words);
}

void add_report_options(CLI::App& report, Words& words) {
    report.add_option("FILE", words.file, "Result file")->required()->type_name("");
    add_word(report, "-o,--output", words.output, "Page (default: FILE with .html)", "OUT.html");
    add_force(report, words);
    report.footer("The companion is the package slideway of the interpreter that SLIDEWAY_PYTHON names, else of python3; "
                  "pip install ./python in the source tree installs it.");
}

void add_list_options(CLI::App& list, Words& words) {
    CLI::Option* const json = list.add_flag("--json", words.json, "The keys of a scene as JSON");
    CLI::Option* const schema = list.add_flag("--schema", words.schema, "A JSON Schema of scenes, for editors of TOML")->excludes(json);
    list.add_flag("--markdown", words.markdown, "The keys of a scene as a page in Markdown")->excludes(json)->excludes(schema);
}

void add_help_options(CLI::App& help, Words& words) {
    CLI::Option* const command = help.add_option("COMMAND", words.command, "Command to explain (default: a list of all)")->type_name("")->default_str("all");
    CLI::Option* const man = help.add_flag("--man", words.man, "Write slideway.1, the page for man")->excludes(command);
    help.add_option("--completion", words.shell, "Write the script that completes command lines in a shell: bash, zsh or fish")
        ->type_name("SHELL")->excludes(command)->excludes(man);
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

InfoArguments info_arguments(Words const& words) {
    InfoArguments info{words.file, words.scene_too, words.json, words.intact, {}};
    std::string members = words.members;
    // --members takes the word behind it, the file too.
    if (info.path.empty() && members != all_members) info.path = std::exchange(members, all_members);
    if (info.path.empty()) throw SceneError("slideway: FILE is missing; give a result file, see slideway help info");
    if (members == all_members)
        info.members = MemberRange{0, std::numeric_limits<std::uint64_t>::max()};
    else if (!members.empty())
        info.members = parse_member_range(members);
    return info;
}

ListArguments list_arguments(Words const& words) {
    using Form = ListArguments::Form;
    return {words.json ? Form::json : words.schema ? Form::schema : words.markdown ? Form::markdown : Form::text};
}

Arguments help_arguments(Words const& words);

struct CommandRow {
    char const *name, *summary;
    void (*add_options)(CLI::App&, Words&);
    Arguments (*arguments)(Words const&);
    std::vector<Example> examples;
};

std::vector<CommandRow> const& command_rows() {
    static std::vector<CommandRow> const rows = {
        {"run", "Integrate the members of a scene to a NetCDF file", add_run_options,
         [](Words const& words) -> Arguments { return run_arguments(words); },
         {{"slideway run scenes/tolerance_0.1mm.toml -o result.nc", "The members of a scene, on all cores; its summary goes to stdout."},
          {"slideway run scenes/slider_crank_0.1mm.toml --set joint.clearance=\"0.2 mm\" study.revolutions=4", "The same scene with other numbers."},
          {"slideway run scenes/tolerance_0.1mm.toml -o result.nc --resume", "What an earlier run that was stopped has left to do."},
          {"slideway run scenes/tolerance_0.1mm.toml -o result.nc --shard 3/8", "The third of eight jobs of an array, which share result.nc.shards."}}},
        {"check", "Validate a scene; print it resolved, and what a run will take", add_check_options,
         [](Words const& words) -> Arguments { return CheckArguments{scene_arguments(words), threads(words), words.force, words.json, words.resolved}; },
         {{"slideway check scenes/tolerance_0.1mm.toml", "The scene in SI units, parts of the kernels, memory and cost."},
          {"slideway check scenes/tolerance_0.1mm.toml --resolved >resolved.toml", "A scene file with every key."}}},
        {"probe", "Forces, contact mode and derivative of single states", add_probe_options,
         [](Words const& words) -> Arguments { return ProbeArguments{scene_arguments(words), words.table, words.output, words.force, words.json}; },
         {{"slideway probe scenes/slider_crank_0.1mm.toml --set initial.z=\"0.1 mm\"", "The start of a scene, a tenth of a millimetre higher."},
          {"slideway probe scenes/slider_crank_0.1mm.toml --csv states.csv -o forces.csv", "A table of states to a table of forces."}}},
        {"info", "Provenance, statuses and statistics of a result file", add_info_options,
         [](Words const& words) -> Arguments { return info_arguments(words); },
         {{"slideway info result.nc", "Where a result comes from, how its members ended, their statistics."},
          {"slideway info result.nc --members 0..9", "The same with a row for each of its first ten members."}}},
        {"stats", "Chaos statistics of a stored series (NetCDF result or CSV)", add_stats_options,
         [](Words const& words) -> Arguments { return stats_arguments(words); },
         {{"slideway stats result.nc --variable y --member 3 --skip 2", "The series y of member 3, without its first two seconds."},
          {"slideway stats measured.csv --column 2 --dt 1e-4", "The second column of a measured table."}}},
        {"merge", "Shards of a run or of a job array to one result file", add_merge_options,
         [](Words const& words) -> Arguments { return MergeArguments{words.file, words.output, words.force, words.json}; },
         {{"slideway merge result.nc.shards -o result.nc", "Whatever is finished, to one result file."}}},
        {"report", "A page to look at, without a network, of a result file (uses the Python companion)", add_report_options,
         [](Words const& words) -> Arguments { return ReportArguments{words.file, words.output, words.force}; },
         {{"slideway report result.nc -o result.html", "A page for a browser."}}},
        {"list", "Mechanisms, laws, quantities, keys: what a scene may ask for", add_list_options,
         [](Words const& words) -> Arguments { return list_arguments(words); },
         {{"slideway list", "All that a scene may ask for, with units, domains and defaults."},
          {"slideway list --schema >scene.schema.json", "For completion and hover in editors of TOML."}}},
        {"help", "What a command does, and its options", add_help_options, help_arguments,
         {{"slideway help run", "What run does, its options and examples."},
          {"slideway help --man >slideway.1", "The page for man, which an installation has already."},
          {"source <(slideway help --completion bash)", "Completion in this shell."}}},
    };
    return rows;
}

std::vector<std::string_view> command_names() {
    std::vector<std::string_view> names;
    for (CommandRow const& row : command_rows()) names.emplace_back(row.name);
    return names;
}

/// CLI11's own message for an unknown command names all words behind it, but not what was meant.
void require_known_command(std::string_view word) {
    std::vector<std::string_view> names = command_names();
    if (std::ranges::find(names, word) != names.end()) return;
    std::string_view const meant = nearest_name(word, names);
    std::string_view const last = names.back();
    names.pop_back();
    std::string const known = fmt::format("use {} or {}", fmt::join(names, ", "), last);
    if (word.empty()) throw SceneError(fmt::format("slideway: a command is missing; {} (see slideway --help)", known));
    throw SceneError(fmt::format("slideway: there is no command '{}'; {}", word, meant.empty() ? known : fmt::format("did you mean {}?", meant)));
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

OptionDescription described(CLI::Option const& option) {
    OptionDescription description{.names = {}, .value = option.get_type_size() == 0 ? "" : option.get_type_name(), .meaning = option.get_description()};
    description.positional = option.get_positional();
    description.optional = !option.get_default_str().empty();
    description.repeats = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
    if (description.positional) description.names = {description.value = option.get_name(true, false)};
    for (std::string const& name : option.get_snames()) description.names.push_back("-" + name);
    for (std::string const& name : option.get_lnames()) description.names.push_back("--" + name);
    return description;
}

/// The parser of all commands; what it reads goes to `words`.
std::unique_ptr<CLI::App> make_parser(Words& words) {
    auto app = std::make_unique<CLI::App>("", "slideway");
    app->set_version_flag("--version", fmt::format("slideway {} ({})", build_info().version, build_info().commit));
    app->require_subcommand(1);
    for (CommandRow const& row : command_rows()) row.add_options(*app->add_subcommand(row.name, row.summary), words);
    return app;
}

std::size_t help_width() { return line_width() > 0 ? line_width() : usual_width; }

std::string help_of(std::string_view command) {
    std::vector<CommandDescription> const all = command_descriptions();
    if (command.empty()) return help_text(all, help_width());
    return help_text(*std::ranges::find(all, command, &CommandDescription::name), help_width());
}

Arguments help_arguments(Words const& words) {
    if (words.man) return TextOnly{man_page(command_descriptions())};
    if (!words.shell.empty()) return TextOnly{completion(words.shell)};
    if (!words.command.empty()) require_known_command(words.command);
    return TextOnly{help_of(words.command)};
}

}  // namespace

std::vector<CommandDescription> command_descriptions() {
    Words words;
    auto const parser = make_parser(words);
    std::vector<CommandDescription> all;
    for (CommandRow const& row : command_rows()) {
        CLI::App const& app = *parser->get_subcommand(row.name);
        CommandDescription command{.name = row.name, .summary = row.summary, .note = app.get_footer(), .options = {}, .examples = row.examples};
        for (CLI::Option const* const option : app.get_options()) command.options.push_back(described(*option));
        all.push_back(std::move(command));
    }
    return all;
}

Arguments parse_arguments(int argc, char const* const* argv) {
    std::string_view const first = argc > 1 ? argv[1] : "";
    std::vector<std::string> given(argv + 1, argv + argc);
    if (first == "__complete") return TextOnly{candidates(command_descriptions(), std::span(given).subspan(std::min<std::size_t>(2, given.size())))};
    if (first != "--help" && first != "-h" && first != "--version") require_known_command(first);
    Words words;
    auto const parser = make_parser(words);
    auto const command = [&]() -> CLI::App const* { return parser->get_subcommands().empty() ? nullptr : parser->get_subcommands().front(); };
    std::reverse(given.begin(), given.end());  // as CLI11 wants them
    try {
        parser->parse(given);
    } catch (CLI::CallForHelp const&) {
        return TextOnly{help_of(command() == nullptr ? "" : command()->get_name())};
    } catch (CLI::CallForVersion const& version) {
        return TextOnly{std::string(version.what()) + "\n"};
    } catch (CLI::ExtrasError const& error) {
        throw SceneError("slideway: " + one_line(error.what()) + (command() == nullptr ? "" : option_advice(*command())));
    } catch (CLI::ParseError const& error) {
        throw SceneError("slideway: " + one_line(error.what()));
    }
    refuse_empty_words(*command());
    auto const row = std::ranges::find(command_rows(), command()->get_name(), &CommandRow::name);
    return row->arguments(words);
}

}  // namespace slideway::cli
