#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "host/base/text.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/description.hpp"
#include "host/commands/text.hpp"
#include "host/config/settings.hpp"
#include "host/store/run_identity.hpp"

namespace slideway::cli {
namespace {

/// What --members of info is without a value.
constexpr std::string_view all_members = "all";

/// The options of a command and where they go.  Words that are more than a text are read when the whole command line is known to be one.
class Options {
public:
    explicit Options(CLI::App& app) : app_(app) {}

    CLI::Option* positional(char const* name, std::string& to, char const* meaning) { return app_.add_option(name, to, meaning)->type_name(""); }
    CLI::Option* flag(char const* name, bool& to, char const* meaning) { return app_.add_flag(name, to, meaning); }
    /// @param value word for what it takes
    template <class Text> CLI::Option* text(char const* name, char const* value, Text& to, std::string const& meaning) {
        return app_.add_option(name, to, meaning)->type_name(value);
    }
    /// @param read makes of the option's name and its word what `to` is
    template <class Value, class Read> CLI::Option* value(char const* name, char const* value, Value& to, char const* meaning, Read read) {
        CLI::Option* const option = app_.add_option(name, [](CLI::results_t const&) { return true; }, meaning)->type_name(value);
        at_end([=, &to] {
            if (!option->empty()) to = read(option->get_name(), option->results().front());
        });
        return option;
    }

    void any_start(bool& to) { flag("--any-start", to, "Take starts that no mechanism has, such as inside the way"); }
    void force(bool& to) { flag("--force", to, "Replace an existing result of slideway; inputs and other files are never replaced"); }
    CLI::Option* json(bool& to) { return flag("--json", to, "One object in JSON in place of text (docs/reference/json.md)"); }
    void threads(int& to) {
        constexpr unsigned most = 4096;  // beyond it the OpenMP runtime ends the process instead of complaining
        value("--threads", "N", to, "Threads (default: all that this process may use)", whole_number(1, most));
    }
    void note(char const* sentences) { app_.footer(sentences); }

    void at_end(std::function<void()> action) { at_end_.push_back(std::move(action)); }
    void finish() const {
        for (auto const& action : at_end_) action();
    }

private:
    CLI::App& app_;
    std::vector<std::function<void()>> at_end_;
};

void add_scene(Options& options, SceneArguments& scene) {
    auto const words = std::make_shared<std::vector<std::string>>();
    options.positional("SCENE", scene.path, "Scene file (TOML)");
    options.text("--set", "KEY=VALUE", *words, "Override keys of the scene, as in contact.law=conservative");
    std::vector<std::string_view> isas;
    for (Isa const isa : built_isas()) isas.push_back(name_of(isa));
    std::string_view const last = isas.back();
    isas.pop_back();
    options.text("--isa", "ISA", scene.isa, fmt::format("Instruction set: auto (the widest){}{} or {}", isas.empty() ? "" : ", ", fmt::join(isas, ", "), last));
    options.at_end([&scene, words] {
        // --set takes all words up to the next option, the scene too where it stands behind: only that has no `=`.
        for (std::string const& word : *words) {
            if (scene.path.empty() && word.find('=') == word.npos)
                scene.path = word;
            else
                scene.overrides.push_back(parse_override(word));
        }
        if (scene.path.empty()) throw SceneError("slideway: SCENE is missing; give a scene file, see slideway --help");
    });
}

void add_backend(Options& options, SceneArguments& scene) {
    auto const word = std::make_shared<std::string>("auto");
    options.text("--backend", "BACKEND", *word, "auto (a GPU where it is faster), cpu or cuda");
    options.at_end([&scene, word] { scene.backend = parse_backend(*word, scene.isa); });
}

/// What the command line comes to, when all options are read.
using Finish = std::function<Arguments()>;

template <class Given, void (*declare)(Options&, Given&)> Finish add(Options& options) {
    auto const given = std::make_shared<Given>();
    declare(options, *given);
    return [given] { return *given; };
}

void add_run(Options& options, RunArguments& run) {
    auto const member = std::make_shared<std::optional<std::uint64_t>>();
    auto const verify = std::make_shared<bool>(false);
    constexpr unsigned most_block_members = 1'000'000;  // results of a block stay in memory while it runs
    run.study.threads = default_threads();
    add_scene(options, run.scene);
    options.text("-o,--output", "OUT.nc", run.study.output, "Result file (default: in this folder, the scene's name and what --set changes)");
    options.threads(run.study.threads);
    add_backend(options, run.scene);
    options.flag("--resume", run.study.resume, "Continue an interrupted run from what it left in OUT.nc.shards");
    options.force(run.study.force);
    options.value("--max-hours", "H", run.max_hours, "Stop after this time and keep what is finished in OUT.nc.shards (exit code 5)", parse_hours);
    options.value("--max-failures", "N|P%", run.max_failures, "Members that may fail before the exit code is 3 (default 1%)", parse_failure_limit);
    options.value("--member", "N", *member, "Run this member alone, counted from 0, with the inputs it has in the ensemble", parse_member);
    options.value("--members", "A..B", run.members, "Run these members alone, both ends included", parse_member_range);
    options.value("--shard", "I/N", run.study.part, "Run the I-th of N parts, as a job of an array; the jobs share OUT.nc.shards, and merge makes OUT.nc",
                  parse_part);
    options.value("--block-members", "N", run.study.block_members,
                  "Members that a thread takes at once (default: by their cost); a crash loses the unfinished ones", whole_number(1, most_block_members));
    options.any_start(run.any_start);
    options.flag("--verify", *verify, "Repeat members until the study's resolution is known, all of them if need be");
    options.flag("--no-progress", run.no_progress, "No lines of progress on stderr");
    options.flag("--quiet", run.quiet, "No progress and no summary: warnings and errors alone");
    options.json(run.json);
    options.at_end([&run, member, verify] {
        if (*member && run.members) throw SceneError("--member and --members exclude each other; use one");
        if (*member) run.members = MemberRange{**member, 1};
        if (*verify) run.scene.overrides.emplace_back("study.verify", std::to_string(most_verified));
    });
}

void add_check(Options& options, CheckArguments& check) {
    add_scene(options, check.scene);
    options.threads(check.threads);
    add_backend(options, check.scene);
    CLI::Option* const json = options.json(check.json);
    CLI::Option* const resolved = options.flag("--resolved", check.resolved, "Print the resolved scene alone, as a scene file")->excludes(json);
    options.text("--draw", "FILE.svg|FILE.png", check.drawing, "Draw the mechanism at its start, too (uses the Python package)")->excludes(json)->excludes(resolved);
    options.force(check.force);
    options.any_start(check.any_start);
}

void add_probe(Options& options, ProbeArguments& probe) {
    add_scene(options, probe.scene);
    CLI::Option* const table = options.text("--csv", "STATES.csv", probe.table, "Table of states (default: the scene's start, a result's last state)");
    options.value("--member", "K", probe.member, "With a result in the place of SCENE: the member (default: its first)", parse_member)->excludes(table);
    options.value("--time", "SECONDS", probe.time, "Likewise: its stored state that is nearest to this time (default: its end)", parse_time)->excludes(table);
    CLI::Option* const output = options.text("-o,--output", "OUT.csv", probe.output, "Write CSV to this file");
    options.flag("--explain", probe.explain, "Follow how the forces come about: apices or joints, depths, modes, normal forces, friction, what they come to")->excludes(output);
    options.force(probe.force);
    options.json(probe.json);
}

void add_info(Options& options, InfoArguments& info) {
    auto const members = std::make_shared<std::string>();
    options.positional("FILE", info.path, "Result file");
    CLI::Option* const json = options.json(info.json);
    options.flag("--scene", info.scene, "Show its scene, too")->excludes(json);
    options.flag("--check", info.check, "Only check the file against its stored hashes (exit code 4 if not)")->excludes(json);
    options.text("--members", "A..B", *members, "Show its members, or these of them, too: number, status, end time, steps")
        ->expected(0, 1)->default_str(std::string(all_members));
    options.at_end([&info, members] {
        // --members takes the word behind it, the file too.
        if (info.path.empty() && *members != all_members) info.path = std::exchange(*members, all_members);
        if (info.path.empty()) throw SceneError("slideway: FILE is missing; give a result file, see slideway help info");
        if (*members == all_members)
            info.members = MemberRange{0, std::numeric_limits<std::uint64_t>::max()};
        else if (!members->empty())
            info.members = parse_member_range("--members", *members);
    });
}

void add_stats(Options& options, StatsArguments& stats) {
    options.positional("FILE", stats.path, "Result file, or a table in CSV")->required();
    options.text("--variable", "NAME", stats.variable, "Variable of a result (default y)");
    options.value("--member", "K", stats.member, "Member of a result (default: its first)", parse_member);
    options.text("--column", "NAME|N", stats.column, "Column of a table, by name or number from 1 (default: the last)");
    options.value("--dt", "SECONDS", stats.spacing, "Spacing of a table's samples (default: from its column time or t)", parse_seconds);
    options.value("--skip", "SECONDS", stats.skip_time, "Leave out a transient", parse_seconds);
    options.value("--skip-samples", "N", stats.skip_samples, "Leave out a transient", whole_number(0));
    options.value("--max-points", "N", stats.max_points, "Use at most so many samples", whole_number(1));
    options.value("--delay", "N", stats.options.delay, "Delay of the embedding in samples (default: C-C method)", whole_number(1));
    options.value("--dimension", "M", stats.options.dimension, "Dimension of the embedding (default: C-C method)", whole_number(1));
    options.value("--theiler", "N", stats.options.theiler, "Neighbours are farther apart in time, samples (default: the average period)", whole_number(0));
    options.value("--fit", "A..B", stats.options.fit, "Fit the exponent over these samples of the divergence curve (default: found)", parse_fit);
    options.text("-o,--output", "OUT.csv", stats.output, "Write the C-C curves and the divergence curve to this file");
    options.force(stats.force);
    options.json(stats.json);
    options.at_end([&stats] {
        if (stats.skip_time && stats.skip_samples) throw SceneError("--skip and --skip-samples exclude each other; use one");
    });
}

void add_merge(Options& options, MergeArguments& merge) {
    options.positional("DIR", merge.folder, "Folder of shards, OUT.nc.shards")->required();
    options.text("-o,--output", "OUT.nc", merge.output, "Result file")->required();
    options.force(merge.force);
    options.json(merge.json);
}

void add_report(Options& options, ReportArguments& report) {
    options.positional("FILE", report.path, "Result file")->required();
    options.text("-o,--output", "OUT.html", report.output, "Page (default: FILE with .html)");
    options.force(report.force);
    options.note("The page is written by the Python package slideway, of the interpreter that SLIDEWAY_PYTHON names, else of python3; "
                 "pip install . in the source tree installs it.");
}

void add_export(Options& options, ExportArguments& given) {
    auto const series = std::make_shared<std::optional<std::string>>();
    options.positional("FILE", given.path, "Result file")->required();
    options.text("-o,--output", "OUT.csv|OUT.mat", given.output, "Table in CSV, or MAT file of MATLAB, Octave and scipy")->required();
    options.text("--series", "NAME,...", *series, "Write these time series, or all: a row for each sample of each member");
    options.flag("--sections", given.sections, "Write the sections of its orbits: a row each");
    options.force(given.force);
    options.note("A CSV file holds one table: of the members, unless --series or --sections is given.  A MAT file holds the members in any case.");
    options.at_end([&given, series] {
        if (!*series) return;
        given.series.emplace();
        if (**series == "all") return;
        for (std::string_view rest = **series; !rest.empty();) {
            auto const end = std::min(rest.find(','), rest.size());
            given.series->emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    });
}

void add_compile(Options& options, CompileArguments& compile) {
    options.positional("SOURCE", compile.source, "Header with a contact law or a mechanism (docs/how_to/extending.md), or a scene with a linkage")->required();
    options.text("-o,--output", "DIR", compile.folder, "Folder of the modules, which a scene names in [modules] search (default: one that every scene finds)");
    options.value("--isa", "ISA,...", compile.isas, "Instruction sets (default: all of this program that this machine has)", [](std::string_view, std::string_view word) {
        std::vector<Isa> isas;
        while (!word.empty()) {
            auto const end = std::min(word.find(','), word.size());
            Isa const isa = parse_isa(word.substr(0, end));
            if (std::ranges::find(isas, isa) == isas.end()) isas.push_back(isa);
            word.remove_prefix(std::min(end + 1, word.size()));
        }
        return isas;
    });
    options.threads(compile.threads);
    options.json(compile.json);
    options.note("Compilers run as CXX names them, else the one that compiled slideway, else g++.  What scenes then know by name runs as the tree's own laws and mechanisms do; linkages with the bodies and joints of a scene, whatever their numbers, run faster.");
}

void add_list(Options& options, ListArguments& list) {
    CLI::Option* const keys = options.flag("--keys", list.keys, "The keys of a scene alone");
    CLI::Option* const json = options.flag("--json", list.json, "The keys of a scene as JSON");
    CLI::Option* const schema = options.flag("--schema", list.schema, "A JSON Schema of scenes, for editors of TOML")->excludes(json)->excludes(keys);
    options.flag("--markdown", list.markdown, "The keys of a scene as a page in Markdown")->excludes(json)->excludes(keys)->excludes(schema);
}

std::string help_of(std::string const& command);

Finish add_help(Options& options) {
    struct Asked {
        std::string command, shell;
        bool man = false;
    };
    auto const asked = std::make_shared<Asked>();
    CLI::Option* const command = options.positional("COMMAND", asked->command, "Command to explain (default: a list of all)")->default_str("all");
    CLI::Option* const man = options.flag("--man", asked->man, "Write slideway.1, the page for man")->excludes(command);
    options.text("--completion", "SHELL", asked->shell, "Write the script that completes command lines in a shell: bash, zsh or fish")
        ->excludes(command)->excludes(man);
    return [=] {
        return TextOnly{asked->man              ? man_page(command_descriptions())
                        : !asked->shell.empty() ? completion(asked->shell)
                                                : help_of(asked->command)};
    };
}

struct CommandRow {
    char const *name, *summary;
    Finish (*add)(Options&);
    std::vector<Example> examples;
};

std::vector<CommandRow> const& command_rows() {
    static std::vector<CommandRow> const rows = {
        {"run", "Integrate the members of a scene to a NetCDF file", add<RunArguments, add_run>,
         {{"slideway run scenes/tolerance_0.1mm.toml -o result.nc", "The members of a scene, on all cores; its summary goes to stdout."},
          {"slideway run scenes/slider_crank_0.1mm.toml --set joint.clearance=\"0.2 mm\" study.revolutions=4", "The same scene with other numbers."},
          {"slideway run scenes/tolerance_0.1mm.toml -o result.nc --resume", "What an earlier run that was stopped has left to do."},
          {"slideway run scenes/tolerance_0.1mm.toml -o result.nc --shard 3/8", "The third of eight jobs of an array, which share result.nc.shards."}}},
        {"check", "Check a scene; print it with all keys, and the cost of a run", add<CheckArguments, add_check>,
         {{"slideway check scenes/tolerance_0.1mm.toml", "The scene in SI units, parts of the kernels, memory and cost."},
          {"slideway check scenes/tolerance_0.1mm.toml --resolved >resolved.toml", "A scene file with every key."},
          {"slideway check scenes/four_bar_journals.toml --draw four_bar.svg", "What the scene describes, as a picture."}}},
        {"probe", "Compute forces, contact mode and derivative of single states", add<ProbeArguments, add_probe>,
         {{"slideway probe scenes/slider_crank_0.1mm.toml --set initial.z=\"0.1 mm\"", "The start of a scene, a tenth of a millimetre higher."},
          {"slideway probe result.nc --member 3 --time 0.05 --explain", "A state that a result has stored, and how its forces come about."},
          {"slideway probe scenes/slider_crank_0.1mm.toml --csv states.csv -o forces.csv", "A table of states to a table of forces."}}},
        {"info", "Show provenance, statuses and statistics of a result file", add<InfoArguments, add_info>,
         {{"slideway info result.nc", "Where a result comes from, how its members ended, their statistics."},
          {"slideway info result.nc --members 0..9", "The same with a row for each of its first ten members."}}},
        {"stats", "Compute chaos statistics of a stored series (NetCDF result or CSV)", add<StatsArguments, add_stats>,
         {{"slideway stats result.nc --variable y --member 3 --skip 2", "The series y of member 3, without its first two seconds."},
          {"slideway stats measured.csv --column 2 --dt 1e-4", "The second column of a measured table."}}},
        {"merge", "Merge the shards of a run or of a job array into one result file", add<MergeArguments, add_merge>,
         {{"slideway merge result.nc.shards -o result.nc", "Whatever is finished, to one result file."}}},
        {"report", "Write an HTML page of a result file (uses the Python package)", add<ReportArguments, add_report>,
         {{"slideway report result.nc -o result.html", "A page for a browser."}}},
        {"export", "Write a result file's members, series or sections to CSV or MAT", add<ExportArguments, add_export>,
         {{"slideway export result.nc -o members.csv", "A row for each member: status, what varies, quantities."},
          {"slideway export result.nc -o result.mat --series y,vz", "Members and two time series for MATLAB and Octave."}}},
        {"compile", "Compile a law or mechanism of one's own for scenes", add<CompileArguments, add_compile>,
         {{"slideway compile hunt_crossley.hpp", "Scenes then know contact.law = \"hunt_crossley\"."},
          {"slideway compile own.hpp -o modules", "Into a folder, which scenes name: [modules] search = [\"modules\"]."}}},
        {"list", "List mechanisms, laws, quantities and keys", add<ListArguments, add_list>,
         {{"slideway list", "All that a scene may ask for, with units, domains and defaults."},
          {"slideway list --schema >scene.schema.json", "For completion and hover in editors of TOML."}}},
        {"help", "What a command does, and its options", add_help,
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

/// The parser of all commands, or of the one that a command line begins with, and of each what it finishes with.
struct Parser {
    CLI::App app{"", "slideway"};
    std::map<CLI::App const*, std::pair<Options, Finish>> commands;

    explicit Parser(std::optional<std::string_view> only = {}) {
        app.set_version_flag("--version", fmt::format("slideway {} ({})", build_info().version, build_info().commit));
        app.require_subcommand(1);
        for (CommandRow const& row : command_rows()) {
            if (only && *only != row.name) continue;
            CLI::App* const command = app.add_subcommand(row.name, row.summary);
            auto& [options, finish] = commands.try_emplace(command, Options(*command), nullptr).first->second;
            finish = row.add(options);
        }
    }
    /// The command that was named; nullptr if none.
    CLI::App const* command() const { return app.get_subcommands().empty() ? nullptr : app.get_subcommands().front(); }
};

std::string help_of(std::string const& command) {
    std::size_t const width = line_width() > 0 ? line_width() : usual_width;
    std::vector<CommandDescription> const& all = command_descriptions();
    if (command.empty()) return help_text(all, width);
    require_known_command(command);
    return help_text(*std::ranges::find(all, command, &CommandDescription::name), width);
}

}  // namespace

std::vector<CommandDescription> const& command_descriptions() {
    static std::vector<CommandDescription> const descriptions = [] {
        Parser const parser;
        std::vector<CommandDescription> all;
        for (CommandRow const& row : command_rows()) {
            CLI::App const& app = *parser.app.get_subcommand(row.name);
            CommandDescription command{.name = row.name, .summary = row.summary, .note = app.get_footer(), .options = {}, .examples = row.examples};
            for (CLI::Option const* const option : app.get_options()) command.options.push_back(described(*option));
            all.push_back(std::move(command));
        }
        return all;
    }();
    return descriptions;
}

Arguments parse_arguments(int argc, char const* const* argv) {
    std::string_view const first = argc > 1 ? argv[1] : "";
    std::vector<std::string> given(argv + 1, argv + argc);
    if (first == "__complete") return TextOnly{candidates(command_descriptions(), std::span(given).subspan(std::min<std::size_t>(2, given.size())))};
    bool const of_program = first == "--help" || first == "-h" || first == "--version";
    if (!of_program) require_known_command(first);
    Parser parser(of_program ? std::nullopt : std::optional(first));
    std::reverse(given.begin(), given.end());  // as CLI11 wants them
    try {
        parser.app.parse(given);
    } catch (CLI::CallForHelp const&) {
        return TextOnly{help_of(parser.command() == nullptr ? "" : parser.command()->get_name())};
    } catch (CLI::CallForVersion const& version) {
        return TextOnly{std::string(version.what()) + "\n"};
    } catch (CLI::ExtrasError const& error) {
        throw SceneError("slideway: " + one_line(error.what()) + (parser.command() == nullptr ? "" : option_advice(*parser.command())));
    } catch (CLI::ParseError const& error) {
        throw SceneError("slideway: " + one_line(error.what()));
    }
    refuse_empty_words(*parser.command());
    auto const& [options, finish] = parser.commands.at(parser.command());
    options.finish();
    return finish();
}

}  // namespace slideway::cli
