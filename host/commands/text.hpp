// What commands print of scenes and results, and how text is laid out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/commands/commands.hpp"
#include "host/config/linkages.hpp"
#include "host/run/ensemble.hpp"
#include "host/store/output_target.hpp"
#include "host/store/result_view.hpp"
#include "host/study/prediction.hpp"
#include "host/study/probe.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/series_analysis.hpp"
#include "host/study/state_table.hpp"
#include "host/study/study_run.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway::cli {

/// Reads the scene of a command line.  @throws SceneError, also when the file is missing.
Scene load_scene(SceneArguments const& arguments);

/// The same of a scene whose members are to run: refused where they cannot (host/study/admission); its warnings go to stderr.
Scene admitted_scene(SceneArguments const& arguments, bool any_start);

/// To stdout, as `shown_lines`: what files, titles and paths hold never moves a cursor.  A stream that fails ends no command, whose work is
/// worth more than its words; `output_failure` tells of it when all is done.
void write_out(std::string_view text);
template <class... Values> void print_out(fmt::format_string<Values...> format, Values&&... values) {
    write_out(fmt::format(format, std::forward<Values>(values)...));
}
/// Writes what is still to be written to stdout.  @return errno of the first failure since the start; 0: none
int output_failure();

/// A line to stderr, as `shown`.  Where that cannot be written, nobody is there to read it, and the command goes on: never an exception.
void tell_text(std::string_view text) noexcept;
template <class... Values> void tell(fmt::format_string<Values...> format, Values&&... values) {
    tell_text(fmt::format(format, std::forward<Values>(values)...));
}

/// To stderr: @param file of a run's identity that was damaged and is whole again; "" for none.
void warn_of_mending(std::string const& file);

std::string bytes_text(std::uint64_t bytes);  // "1.5 MB"
std::string duration_text(double seconds);  // "8.2 s", "3 min 20 s", "2.4 h"

/// ", 3.1 GB on the card"; "" without one.
std::string card_memory_text(Prediction const& prediction);
/// "as much again", or a bound for those of statistics.
std::string shards_text(Scene const& scene, Prediction const& prediction);

/// The contacts that χ damps.
char const* rate_damped(LawInfo const& law);
/// What damps the contacts; a mechanism with corners has the point law's.
std::string damping_text(Parts const& parts);

/// Lines `  finished  1000`.
void print_statuses(std::vector<StatusCount> const& statuses);

/// Headed table of mean, standard deviation, minimum, median and maximum, one row per column of a quantity.
void print_quantities(std::vector<QuantitySummary> const& quantities);

/// Distribution and mean of the exponents and how the largest converged; nothing where there are none.
void print_exponents(ResultReader const& results);
/// How many sections there are, and a warning where members have none.
void print_sections(ResultReader const& results);
/// Tables of moments and quantiles, yields, and what matters most for each quantity; lines of at most 120 columns.
void print_tolerance(ToleranceReport const& report);
/// All members of the file: how they ended, statistics, and what to do about those that failed.
/// @param arguments those of the command that replays a member
/// @param report of a scene that `asks_for_report`
void print_results(RunArguments const& arguments, Scene const& scene, ResultReader const& results, std::optional<ToleranceReport> const& report);
/// What this run computed, and how fast.
void print_throughput(Scene const& scene, StudyOptions const& options, EnsembleTotals const& totals, int ranks);

/// Members that ended otherwise than finished.
std::uint64_t failed_count(ResultReader const& results);
/// To stderr: that numbers are not resolved.
void warn_of_results(ResultReader const& results);

/// "1 member", "3 members".
std::string counted(std::uint64_t count, std::string_view noun);

/// "Title (scene.toml)"
std::string scene_text(Scene const& scene, std::string const& path);

/// Where lines of help end that go to no terminal.
inline constexpr std::size_t usual_width = 80;
/// Columns of the terminal that stdout is; 0 where it is none: then lines are as long as they are.
std::size_t line_width();
/// The text broken at blanks into lines that end before column `width` (0: anywhere); all but the first begin with `indent` blanks, or with fewer
/// where a word needs their room.
/// @param first column at which the text begins; npos: at `indent`
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width, std::size_t first = std::string_view::npos);

/// Writes "label      text", labels in a column; the text `shown`, on one line, but for a terminal.
void print_field(std::string_view label, std::string_view text, std::size_t label_width = 12);

/// Writes lines as they are, but for a terminal: there a long one goes on `indent` blanks from the left.
void print_lines(std::size_t indent, std::string_view text);
template <class... Values> void print_text(std::size_t indent, fmt::format_string<Values...> format, Values&&... values) {
    print_lines(indent, fmt::format(format, std::forward<Values>(values)...));
}

using TextRows = std::vector<std::vector<std::string>>;
/// Writes rows of cells in columns, the first `left` of them flush left, all others at least `least` wide where there is no terminal.
/// @param rows makes the rows with so many significant digits: `digits`, or fewer where lines would be longer than a terminal's
void print_table(std::function<TextRows(int)> const& rows, int digits, std::size_t left, std::size_t least);
/// A number for such a table; "-" for NaN.
std::string cell(double value, int digits);

// What commands say with --json: one object on stdout, as docs/reference/json.md describes it.

inline constexpr int json_version = 1;

/// Provenance, dimensions, statuses, statistics over the members that finished, exponents, sections and what the check of the resolution found; of a damaged
/// file provenance and dimensions alone.
/// @param report of a scene that `asks_for_report`  @param totals of the run that has just made it, or nullptr  @param left members that have not run
/// @param members to list one by one  @param scene of the run, which has labels of members
std::string result_json(char const* command, ResultReader const& results, SealCheck const& seal, std::optional<ToleranceReport> const& report,
                        EnsembleTotals const* totals = nullptr, std::uint64_t left = 0, std::optional<MemberRange> const& members = {},
                        Scene const* scene = nullptr);
/// A run that ended before its result.
std::string stopped_json(std::string const& folder, std::uint64_t left);
/// What the Python package draws a scene of: resolved, with the state in which it starts.  @param open where it does not go together
std::string drawing_json(Scene const& scene, OpenLinkage const* open = nullptr);
/// Where `check --draw` draws.  @throws FileError, SceneError
OutputTarget drawing_target(CheckArguments const& arguments);
/// Becomes the Python package, which draws.  @param drawing of drawing_json
[[noreturn]] void draw(OutputTarget const& target, std::string const& drawing);
/// @param trial nothing where no member was tried
std::string check_json(Scene const& scene, Prediction const& prediction, std::optional<Trial> const& trial, Backend const& backend);
/// @param path of the scene or the result  @param stored where the state is from
std::string probe_json(std::string const& path, StateTable const& table, std::vector<ProbeResult> const& results, std::optional<StoredState> const& stored,
                       bool explained);
std::string stats_json(StatsArguments const& arguments, std::string const& series, SeriesAnalysis const& analysis,
                       std::vector<std::pair<std::string, std::string>> const& rows);

}  // namespace slideway::cli
