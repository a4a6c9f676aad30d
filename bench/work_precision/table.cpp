#include "bench/work_precision/table.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/backend/backend.hpp"
#include "host/store/run_identity.hpp"

namespace slideway::bench {
namespace {

/// A field of the CSV: "slideway dopri5, located" has a comma.
std::string field(std::string const& text) { return text.find(',') == std::string::npos ? text : fmt::format("\"{}\"", text); }

char const* unit(Problem const& problem) { return problem.measure == Measure::energy ? "J" : "1"; }

/// "12.3", or a dash where the target is out of reach.
std::string number_or_dash(double value, char const* format = "{:.3g}") {
    return std::isnan(value) ? "—" : fmt::format(fmt::runtime(format), value);
}

constexpr double largest_error = 0.1;  // beyond it nothing is compared

/// Coarsest, middle and finest tolerance of slideway's auto, or of dopri5 where there is no auto, whose error means something.
std::vector<Row const*> telling_rows(std::vector<Row> const& rows) {
    std::string_view const automatic = "slideway auto";
    bool const has_auto = std::ranges::any_of(rows, [&](Row const& r) { return r.method == automatic; });
    std::vector<Row const*> all;
    for (auto const& row : rows) {
        bool const ours = row.method == (has_auto ? automatic : "slideway dopri5") && row.code == name_of(best_isa());
        if (ours && row.p95_error <= largest_error) all.push_back(&row);
    }
    if (all.size() <= 3) return all;
    return {all.front(), all[all.size() / 2], all.back()};
}

/// Rates of these rows over those of others at the same p95 error.
void write_ratios(fmt::ostream& out, std::vector<Result> const& results) {
    out.print(
        "\n## Beside the best of others\n\nMembers per second and core of slideway's `auto`, {} (`dopri5` where a problem has no `auto`), and over those "
        "of the best scalar method of slideway, of CVODE and of Odeint at the same p95 error; — where none reaches it.\n\n"
        "| problem | tolerance | error, p95 | members/s | over scalar | CVODE | Odeint |\n|---|---|---|---|---|---|---|\n",
        name_of(best_isa()));
    for (auto const& [problem, rows] : results) {
        for (Row const* row : telling_rows(rows)) {
            auto const ratio = [&](std::string_view family) {
                return number_or_dash(least_cost(row->p95_error, rows, family, "scalar", &Row::seconds) / row->seconds);
            };
            out.print("| {} | {:.0e} | {:.1e} | {:.3g} | {} | {} | {} |\n", problem.name, row->tolerance, row->p95_error, 1 / row->seconds,
                      ratio("slideway"), ratio("CVODE"), ratio("Odeint"));
        }
    }
}

/// A figure that the engine is held to, on one problem.
struct Promise {
    std::string_view problem, against;  // a family of methods, by the beginning of the name
    std::string_view code;
    bool evaluations;  // else members per second
    double least;
};
constexpr Promise promises[] = {
    {"turn_energy", "slideway dopri5", "", true, 60},   {"turn_energy", "CVODE", "scalar", false, 150},
    {"turn_energy", "slideway", "scalar", false, 5},    {"rattling_energy", "CVODE", "scalar", false, 15},
    {"rattling_energy", "Odeint", "scalar", false, 15}, {"rattling_states", "CVODE", "scalar", false, 15},
    {"rattling_states", "Odeint", "scalar", false, 15},
};

/// Ratios to slideway auto at the errors that it reaches.
void write_promises(fmt::ostream& out, std::vector<Result> const& results) {
    auto const best = std::string(name_of(best_isa()));
    out.print(
        "\n## What is promised\n\nslideway auto, {}, at equal p95 error, over its tolerances.\n\n"
        "| problem | what | against the best of | promised | reached at most | at an error of | at least |\n"
        "|---|---|---|---|---|---|---|\n",
        best);
    for (auto const& promise : promises) {
        auto const result = std::ranges::find(results, promise.problem, [](Result const& r) { return r.problem.name; });
        if (result == results.end()) continue;
        auto const cost = promise.evaluations ? &Row::evaluations : &Row::seconds;
        double most = 0, least = std::numeric_limits<double>::infinity(), where = 0;
        for (auto const& row : result->rows) {
            if (row.method != "slideway auto" || row.code != best || !std::isfinite(row.p95_error)) continue;
            auto const code = promise.code.empty() ? std::string_view(best) : promise.code;
            double const ratio = least_cost(row.p95_error, result->rows, promise.against, code, cost) / row.*cost;
            if (std::isnan(ratio)) continue;
            if (ratio > most) where = row.p95_error;
            most = std::max(most, ratio);
            least = std::min(least, ratio);
        }
        if (most == 0) continue;
        out.print("| {} | {} | {}{} | {:.0f} × | {:.3g} × | {:.1e} | {:.3g} × |\n", promise.problem,
                  promise.evaluations ? "fewer evaluations" : "members/s", promise.against,
                  promise.against == "slideway" ? ", scalar" : "", promise.least, most, where, least);
    }
}

}  // namespace

std::vector<std::string> provenance() {
    std::vector<std::string> lines = {
        fmt::format("processor: {}, one core", machine_name()), fmt::format("compiler: {}", build_info().compiler),
        fmt::format("commit: {}", build_info().commit), fmt::format("date: {}", creation_time()),
        fmt::format("peers: {}; CVODE: {}", SLIDEWAY_PEER_FLAGS, SLIDEWAY_CVODE_BUILD)};
    for (Isa const isa : {Isa::scalar, best_isa()}) {
        lines.push_back(fmt::format("slideway {}: {}", name_of(isa), flags_of(isa)));
    }
    return lines;
}

void write_csv(std::filesystem::path const& file, std::vector<Result> const& results) {
    auto out = fmt::output_file(file.string());
    for (auto const& line : provenance()) out.print("# {}\n", line);
    out.print(
        "problem,method,code,tolerance,ensemble,members,failures,median_error,p95_error,error_unit,seconds_per_member,"
        "evaluations_per_member,median_friction_loss_J,median_damping_loss_J,reference_difference\n");
    for (auto const& [problem, rows] : results) {
        for (auto const& r : rows) {
            out.print("{},{},{},{:.0e},{},{},{},{:.3e},{:.3e},{},{:.4e},{:.1f},{:.4e},{:.4e},{:.1e}\n", problem.name,
                      field(r.method), r.code, r.tolerance, r.ensemble, r.members, r.failures, r.median_error, r.p95_error,
                      unit(problem), r.seconds, r.evaluations, r.friction_loss, r.damping_loss,
                      problem.reference_difference);
        }
    }
}

void write_markdown(std::filesystem::path const& file, std::vector<Result> const& results) {
    auto out = fmt::output_file(file.string());
    out.print(
        "# Work and precision\n\n"
        "Time of slideway's methods and their peers for an error, on one core ({}; commit {}). All rows, flags, compiler: "
        "[work_precision.csv](work_precision.csv). To repeat: `scripts/work_precision.sh`. Problems, references, settings: "
        "[bench/work_precision](../work_precision/README.md).\n\n"
        "Error of *states*: root mean square over the components of |y − reference|/(scale + |reference|) at the end time, when no member touches "
        "the way. Error of *energy*: |ε| in joules ([model](../../docs/explanation/model.md#8-energy-audit)). p95: 95 % of the members, of which a failed one "
        "counts as infinite. Time: of the processor, in the run whose error is shown, the energy audit included where energies are measured, "
        "divided by the members. slideway takes the ensemble as one block, the peers one member after the other. An analytic Jacobian counts as "
        "one evaluation.\n",
        machine_name(), build_info().commit);
    write_promises(out, results);
    write_ratios(out, results);
    out.print("\n## Error against time\n\nA line for each method; p95 solid, median dashed.\n");
    for (auto const& result : results) {
        out.print("\n![{}]({}.svg)\n", result.problem.title, result.problem.name);
    }
}

}  // namespace slideway::bench
