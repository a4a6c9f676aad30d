#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/store/output_target.hpp"
#include "host/store/result_view.hpp"
#include "host/study/series_analysis.hpp"
#include "host/study/series_file.hpp"

namespace slideway::cli {
namespace {

/// What is printed: labels and texts; a row without a label goes on with the one before.
struct Rows : std::vector<std::pair<std::string, std::string>> {
    void operator()(std::string_view label, std::string text) { emplace_back(label, std::move(text)); }
};

StoredSeries read_series(StatsArguments const& arguments) {
    auto const in = input_stream(arguments.path);
    if (is_netcdf(*in, arguments.path)) {
        if (arguments.column) throw SceneError("--column is for tables; use --variable for a result file");
        if (arguments.spacing) throw SceneError("--dt is for tables; a result file has its own times");
        require_intact(arguments.path);
        return read_result_series(arguments.path, arguments.variable.value_or("y"), arguments.member);
    }
    if (arguments.variable) throw SceneError("--variable is for result files; use --column for a table");
    if (arguments.member) throw SceneError("--member is for result files; use --column for a table");
    return read_csv_series(*in, arguments.path, arguments.column.value_or(""), arguments.spacing);
}

/// Without the transient, and not longer than asked for.
void cut(StoredSeries& series, StatsArguments const& arguments) {
    std::size_t const count = series.values.size();
    std::size_t skipped = arguments.skip_samples.value_or(0);
    // A step that is a hair short of the skipped time belongs to it only by rounding.
    if (arguments.skip_time) {
        double const samples = std::ceil(*arguments.skip_time / series.spacing - 1e-6);
        skipped = static_cast<std::size_t>(std::min(samples, static_cast<double>(count)));
    }
    if (skipped >= count) throw SceneError(fmt::format("nothing is left: {} samples, all of them skipped", count));
    series.values.erase(series.values.begin(), series.values.begin() + static_cast<std::ptrdiff_t>(skipped));
    if (arguments.max_points && *arguments.max_points < series.values.size()) {
        series.values.resize(*arguments.max_points);
    }
}

std::string samples_text(std::size_t samples, double spacing) {
    return fmt::format("{} ({:.4g} s)", counted(samples, "sample"), static_cast<double>(samples) * spacing);
}

std::string found_text(std::optional<std::size_t> samples) {
    return samples ? fmt::format("{}", *samples) : std::string("none");
}

void add_embedding(Rows& row, SeriesAnalysis const& a, SeriesOptions const& given) {
    row("C-C method",
        fmt::format("first minimum of ΔS {}, first zero of S {}, minimum of S_cor {} samples",
                    found_text(a.choice.first_minimum), found_text(a.choice.first_zero), found_text(a.choice.window)));
    char const* const by = given.delay ? ", as given" : a.from_map ? ", as for iterates of a map" : "";
    row("delay", samples_text(a.delay, a.spacing) + by);
    bool const is_cut = !given.dimension && a.dimension < a.wanted_dimension;
    row("dimension",
        fmt::format("{}{}", a.dimension,
                    given.dimension ? ", as given"
                    : is_cut ? fmt::format(", the window asks for {}, too many for these points", a.wanted_dimension)
                             : ""));
    row("window", samples_text(a.window, a.spacing));
    row("Theiler window", samples_text(a.theiler, a.spacing) + (given.theiler ? ", as given" : ""));
}

void add_growth(Rows& row, SeriesAnalysis const& a, SeriesOptions const& given) {
    if (!a.growth) return row("exponent", "none");
    Growth const& g = *a.growth;
    row("exponent", fmt::format("{:.4g} ± {:.2g} 1/s, {:.3g} ± {:.2g} per average period", g.exponent, g.half_width(),
                                g.exponent * a.average_period, g.half_width() * a.average_period));
    row("",
        fmt::format(
            "95 % interval: ± {:.2g} (statistical), ± {:.2g} (systematic: choice of the fitted window and dimension{})",
            g.chance(), g.systematic, a.from_map ? "" : ", curvature"));
    row("fit window", fmt::format("samples {} to {}{}, R² = {:.4f}, distances grow by e^{:.2f}, {} pairs",
                                  g.window.first, g.window.last, given.fit ? ", as given" : "", g.line.r_squared,
                                  g.rise, a.divergence.pairs[g.window.first]));
}

constexpr std::string_view curves_header = "sample,time,S,delta_S,S_cor,mean_log_distance,pairs";

OutputTarget curves_target(StatsArguments const& arguments) {
    std::string const inputs[] = {arguments.path};
    auto const is_ours = [](std::string const& path) {
        return begins_with(path, [](std::string_view line) { return line == curves_header; });
    };
    return {arguments.output, {inputs, arguments.force, is_ours}};
}

/// One row per sample: t of C–C and k of the divergence; cells beyond a curve's end are empty.
std::string curves_text(SeriesAnalysis const& a) {
    std::ostringstream out;
    out << curves_header << '\n';
    std::size_t const rows = std::max(a.curves.mean.size() + 1, a.divergence.mean_log.size());
    for (std::size_t i = 0; i < rows; ++i) {
        out << fmt::format("{},{:.17g}", i, static_cast<double>(i) * a.spacing);
        if (i >= 1 && i <= a.curves.mean.size()) {
            out << fmt::format(",{:.17g},{:.17g},{:.17g}", a.curves.mean[i - 1], a.curves.spread[i - 1],
                               a.curves.correlation[i - 1]);
        } else {
            out << ",,,";
        }
        if (i < a.divergence.mean_log.size()) {
            out << fmt::format(",{:.17g},{}\n", a.divergence.mean_log[i], a.divergence.pairs[i]);
        } else {
            out << ",,\n";
        }
    }
    return out.str();
}

SeriesAnalysis analyse(StoredSeries const& series, StatsArguments const& arguments) {
    try {
        return analyse_series(series.values, series.spacing, arguments.options);
    } catch (SceneError const& error) {
        throw SceneError(fmt::format("{}: {}: {}", arguments.path, series.name, error.what()));
    }
}

Rows rows_of(StatsArguments const& arguments, std::string const& series, SeriesAnalysis const& a) {
    Rows row;
    row("series", fmt::format("{} of {}", series, arguments.path));
    row("points", fmt::format("{}, every {:.6g} s", a.points, a.spacing));
    row("average period", fmt::format("{:.4g} s ({:.4g} samples)", a.average_period, a.average_period / a.spacing));
    add_embedding(row, a, arguments.options);
    add_growth(row, a, arguments.options);
    std::string const k = std::isnan(a.zero_one.k) ? "none" : fmt::format("K = {:.3f}", a.zero_one.k);
    row("0-1 test", fmt::format("{} from {} samples, one of every {}", k, a.zero_one.points, a.stride));
    row("verdict", verdict(a));
    for (std::string const& line : reservations(a)) row("", "- " + line);
    return row;
}

}  // namespace

int execute(StatsArguments const& arguments) {
    std::optional<OutputTarget> const target = arguments.output.empty() ? std::nullopt : std::optional(curves_target(arguments));
    StoredSeries series = read_series(arguments);
    cut(series, arguments);
    SeriesAnalysis const a = analyse(series, arguments);
    if (target) target->write(curves_text(a));

    Rows const rows = rows_of(arguments, series.name, a);
    if (arguments.json) {
        print_out("{}", stats_json(arguments, series.name, a, rows));
        return exit_code::done;
    }
    for (auto const& [label, text] : rows) print_field(label, text, 16);
    if (target) print_field("curves", target->name(), 16);
    return exit_code::done;
}

}  // namespace slideway::cli
