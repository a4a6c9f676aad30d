#include "bench/work_precision/table.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "host/backend/backend.hpp"
#include "host/store/provenance.hpp"

namespace slideway::bench {
namespace {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

char const* unit(Problem const& problem) { return problem.measure == Measure::energy ? "J" : "1"; }

/// "12.3", or a dash where the target is out of reach.
std::string number_or_dash(double value, char const* format = "{:.3g}") {
    return std::isnan(value) ? "—" : fmt::format(fmt::runtime(format), value);
}

/// Decades of p95 error that at least one method reaches, coarsest first.
std::vector<double> targets(std::vector<Row> const& rows) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (auto const& row : rows) {
        if (!std::isfinite(row.p95_error) || row.p95_error <= 0) continue;
        low = std::min(low, row.p95_error);
        high = std::max(high, row.p95_error);
    }
    std::vector<double> found;
    for (int i = static_cast<int>(std::floor(std::log10(high))); std::pow(10.0, i) >= low && found.size() < 9; --i) {
        found.push_back(std::pow(10.0, i));
    }
    return found;
}

void write_rates(fmt::ostream& out, std::vector<Row> const& rows) {
    auto const levels = targets(rows);
    out.print(
        "\nMembers per second and core at equal p95 error (interpolated between tolerances; — where not reached):\n\n");
    out.print("| method | code |");
    for (double const level : levels) out.print(" {:.0e} |", level);
    out.print("\n|---|---|{}\n", [&] {
        std::string dashes;
        for (std::size_t i = 0; i < levels.size(); ++i) dashes += "---|";
        return dashes;
    }());
    Row const* before = nullptr;
    for (auto const& row : rows) {
        if (before && before->method == row.method && before->code == row.code) continue;
        before = &row;
        out.print("| {} | {} |", row.method, row.code);
        for (double const level : levels) {
            double const time = time_to_reach(level, rows, row.method, row.code);
            out.print(" {} |", number_or_dash(1 / time));
        }
        out.print("\n");
    }
}

/// What slideway's auto stands for at the errors that it reaches, against others at the same p95 error.
void write_ratios(fmt::ostream& out, std::vector<Row> const& rows) {
    bool const has_auto = std::ranges::any_of(rows, [](Row const& r) { return r.method == "slideway auto"; });
    if (!has_auto) return;
    auto const best = std::string(name_of(best_isa()));
    out.print(
        "\nslideway auto, {}, against others at its own p95 error: members per second and core, times theirs.\n\n",
        best);
    out.print(
        "| tolerance | error, p95 | members/s | slideway, best scalar | CVODE, best | Odeint, best | evaluations | "
        "fewer than slideway "
        "dopri5 |\n|---|---|---|---|---|---|---|---|\n");
    for (auto const& row : rows) {
        if (row.method != "slideway auto" || row.code != best || !std::isfinite(row.p95_error)) continue;
        auto const ratio = [&](std::string_view family, std::string_view code) {
            return number_or_dash(least_cost(row.p95_error, rows, family, code, &Row::seconds) / row.seconds);
        };
        double const evaluations = least_cost(row.p95_error, rows, "slideway dopri5", best, &Row::evaluations);
        out.print("| {:.0e} | {:.1e} | {:.3g} | {} | {} | {} | {:.0f} | {} |\n", row.tolerance, row.p95_error,
                  1 / row.seconds, ratio("slideway", "scalar"), ratio("CVODE", "scalar"), ratio("Odeint", "scalar"),
                  row.evaluations, number_or_dash(evaluations / row.evaluations));
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
        fmt::format("processor: {}, one core", processor()), fmt::format("compiler: {}", build_info().compiler),
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
                      r.method, r.code, r.tolerance, r.ensemble, r.members, r.failures, r.median_error, r.p95_error,
                      unit(problem), r.seconds, r.evaluations, r.friction_loss, r.damping_loss,
                      problem.reference_difference);
        }
    }
}

void write_markdown(std::filesystem::path const& file, std::vector<Result> const& results) {
    auto out = fmt::output_file(file.string());
    out.print("# Work and precision\n\n");
    for (auto const& line : provenance()) out.print("- {}\n", line);
    out.print(
        "\nError: states, root mean square over the components of |y − reference|/(scale + |reference|) at the end "
        "time, when no "
        "member touches the way; energies, |ε| in joules (`docs/model.md` 8).  Percentiles over members; a member that "
        "failed counts "
        "as infinite.  Time: of the processor, in the run whose error is shown, the energy audit included where "
        "energies are "
        "measured, divided by "
        "the members of the ensemble; slideway runs it as one block, the peers one member after the other.  "
        "Evaluations: of "
        "the right-hand side; an analytic Jacobian counts as one.\n");
    write_promises(out, results);
    for (auto const& [problem, rows] : results) {
        bool const energy = problem.measure == Measure::energy;
        out.print("\n## {}\n\n{} members, of which errors and evaluations of the first {} count.", problem.title,
                  problem.size(), problem.shared);
        if (problem.measure == Measure::state)
            out.print("  Two references differ by {:.1e} at most.", problem.reference_difference);
        out.print("\n");
        write_ratios(out, rows);
        write_rates(out, rows);
        out.print(
            "\n| method | code | tolerance | ensemble | members | failed | error, median | error, p95 | ms per member "
            "| "
            "evaluations |{}\n",
            energy ? " D_f, median [J] | D_d, median [J] |" : "");
        out.print("|---|---|---|---|---|---|---|---|---|---|{}\n", energy ? "---|---|" : "");
        for (auto const& r : rows) {
            out.print("| {} | {} | {:.0e} | {} | {} | {} | {:.1e} | {:.1e} | {:.4g} | {:.0f} |", r.method, r.code,
                      r.tolerance, r.ensemble, r.members, r.failures, r.median_error, r.p95_error, 1e3 * r.seconds,
                      r.evaluations);
            if (energy) out.print(" {:.3e} | {:.3e} |", r.friction_loss, r.damping_loss);
            out.print("\n");
        }
    }
}

}  // namespace slideway::bench
