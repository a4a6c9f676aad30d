// The commands: what the user gave, and what runs.  Each returns the process's exit code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/base/process.hpp"
#include "host/chaos/divergence.hpp"
#include "host/config/scene.hpp"
#include "host/study/backend_choice.hpp"
#include "host/study/series_analysis.hpp"
#include "host/study/study_run.hpp"

namespace slideway::cli {

namespace exit_code {
inline constexpr int done = 0;
inline constexpr int internal_error = 1;  // a defect of slideway itself
inline constexpr int bad_usage = 2;       // also a bad scene
inline constexpr int too_many_failures = 3;
inline constexpr int file_trouble = 4;  // also a lack of memory, and a card that fails
inline constexpr int stopped_early = 5;
}  // namespace exit_code

/// For the man page.
struct ExitCode {
    int number;
    char const* meaning;
};
inline constexpr ExitCode exit_codes[] = {
    {exit_code::done, "done"},
    {exit_code::internal_error, "a defect of slideway itself"},
    {exit_code::bad_usage, "bad usage, or a scene that cannot be used"},
    {exit_code::too_many_failures, "more members failed than --max-failures allows; the result is there, with all members"},
    {exit_code::file_trouble, "a file could not be read or written, memory was short, or a card failed"},
    {exit_code::stopped_early, "stopped early, by a signal or --max-hours; what is finished can be resumed"},
};

inline constexpr char const* out_of_memory = "slideway: out of memory; ask for fewer members or samples, or allow the process more (ulimit -v)";

/// [B] that a command takes which computes with so many threads, beside what its members do; one thread writes, another tells of progress.
inline std::uint64_t memory_of_work(int threads) { return (std::uint64_t{64} << 20) + bytes_of_threads(threads + 2); }

/// What a failure says in one line, and the program's exit code.
struct Complaint {
    int code;
    std::string line;
};
Complaint complaint_of(std::exception_ptr const& error);

/// How many members may fail before the exit code says so.
struct FailureLimit {
    double value = 1;
    bool percent = true;
    bool exceeded(std::uint64_t failed, std::uint64_t members) const;
    std::string text() const;
};

// Of an option's name and its word.  Each throws SceneError with one line for a word that cannot be used.

double parse_hours(std::string_view option, std::string_view word);
double parse_seconds(std::string_view option, std::string_view word);            // finite, > 0
double parse_time(std::string_view option, std::string_view word);               // finite
std::uint64_t parse_member(std::string_view option, std::string_view word);      // from 0
MemberRange parse_member_range(std::string_view option, std::string_view word);  // "A..B", both included, from 0
RunPart parse_part(std::string_view option, std::string_view word);              // "I/N", 1 <= I <= N
FailureLimit parse_failure_limit(std::string_view option, std::string_view word);  // "3", "0.5%"
FitWindow parse_fit(std::string_view option, std::string_view word);               // "A..B", both included, A < B, from 0
/// What parses a whole number from least to most.
std::function<std::uint32_t(std::string_view option, std::string_view word)> whole_number(std::uint32_t least, std::uint32_t most = ~0u);

std::pair<std::string, std::string> parse_override(std::string_view text);  // "key=value"
Isa parse_isa(std::string_view text);                                       // also "auto"; supported by this machine
/// What --backend takes, in the order of `BackendRequest::Kind`.
inline constexpr std::string_view backend_words[] = {"auto", "cpu", "cuda"};
/// Of --backend and --isa.
BackendRequest parse_backend(std::string_view backend, std::string_view isa);

/// 'a b' for a shell; words without special characters stay as they are, and what a terminal would obey becomes $'\302\233'.
std::string shell_quoted(std::string_view word);

struct SceneArguments {
    std::string path;
    Overrides overrides;
    std::string isa = "auto";
    BackendRequest backend;
};

struct RunArguments {
    SceneArguments scene;
    StudyOptions study;  // but for range, backend and progress, which follow; output is empty: by the scene's name
    std::optional<double> max_hours;
    FailureLimit max_failures;
    std::optional<MemberRange> members;  // empty: all
    bool any_start = false;  // also one that no mechanism has
    bool no_progress = false;
    bool quiet = false;  // no progress, no summary
    bool json = false;   // an object in place of the summary
    bool shows_progress() const { return !quiet && !no_progress; }
};
int execute(RunArguments const& arguments);

struct CheckArguments {
    SceneArguments scene;
    int threads = default_threads();
    bool any_start = false;  // also one that no mechanism has
    bool json = false;
    bool resolved = false;  // the resolved scene alone, which runs as it is
    std::string drawing;    // file of the mechanism at its start; empty: none
    bool force = false;
};
int execute(CheckArguments const& arguments);

struct ProbeArguments {
    SceneArguments scene;  // or a result, whose states are probed
    std::string table;     // empty: the scene's start
    std::optional<std::uint64_t> member;  // of a result; empty: its first
    std::optional<double> time;           // of a stored state [s]; empty: the member's end
    bool explain = false;                 // how forces come about, too
    std::string output;  // empty: stdout
    bool force = false, json = false;
};
int execute(ProbeArguments const& arguments);

struct InfoArguments {
    std::string path;
    bool scene = false;  // the scene too
    bool json = false;
    bool check = false;  // nothing but whether it is intact
    std::optional<MemberRange> members;  // a table of these, too
};
int execute(InfoArguments const& arguments);

struct StatsArguments {
    std::string path;
    std::optional<std::string> variable, column;  // of a result, of a table
    std::optional<std::uint64_t> member;          // of a result; empty: its first
    std::optional<double> spacing;                // of a table [s]
    std::optional<double> skip_time;              // transient [s]
    std::optional<std::size_t> skip_samples;
    std::optional<std::size_t> max_points;  // behind the transient
    SeriesOptions options;
    std::string output;  // empty: no curves
    bool force = false, json = false;
};
int execute(StatsArguments const& arguments);

struct MergeArguments {
    std::string folder, output;
    bool force = false, json = false;
};
int execute(MergeArguments const& arguments);

struct ReportArguments {
    std::string path;
    std::string output;  // empty: the path with .html
    bool force = false;
};
/// Becomes the Python package, which writes the page; returns only by an exception.
int execute(ReportArguments const& arguments);

struct ExportArguments {
    std::string path, output;
    std::optional<std::vector<std::string>> series;  // these of the time series; none of them: all
    bool sections = false, force = false;
};
int execute(ExportArguments const& arguments);

struct CompileArguments {
    std::string source;       // a header, or a scene with a linkage
    std::string folder;       // empty: the user's own
    std::vector<Isa> isas;    // none: all of this program that this machine runs
    int threads = default_threads();
    bool json = false;
};
int execute(CompileArguments const& arguments);

struct ListArguments {
    bool keys = false, json = false, schema = false, markdown = false;  // one of them, or the first two: of the keys of a scene
};
int execute(ListArguments const& arguments);

/// Text for stdout and nothing to run: --help, --version.
struct TextOnly {
    std::string text;
};
int execute(TextOnly const& only);

using Arguments = std::variant<RunArguments, CheckArguments, ProbeArguments, InfoArguments, StatsArguments,
                               MergeArguments, ReportArguments, ExportArguments, CompileArguments, ListArguments, TextOnly>;

/// @throws SceneError with one line for a command line that cannot be used.
Arguments parse_arguments(int argc, char const* const* argv);

}  // namespace slideway::cli
