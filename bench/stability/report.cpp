#include "bench/stability/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <fmt/os.h>

#include "bench/machine.hpp"
#include "host/backend/backend.hpp"
#include "host/config/descriptors.hpp"

namespace slideway::bench {
namespace {

std::string provenance() {
    return machine_and_build() +
           fmt::format("- kernels: {}, {}\n", slideway::name_of(best_isa()), flags_of(best_isa()));
}

constexpr Method columns[] = {Method::automatic, Method::dopri5, Method::bs32, Method::ros34pw2, Method::rk4};

/// Of one method over an axis: "2e-04; 3 lost", the largest 95th percentile of the residual and how many members did not finish; of a law that makes
/// energy the second alone.
std::string cell(std::vector<Row const*> const& rows, Method method, bool conserving) {
    double worst = 0;
    int lost = 0;
    bool any = false;
    for (Row const* row : rows) {
        if (row->method != method) continue;
        any = true;
        worst = std::fmax(worst, row->outcome.p95_relative);  // ignores NaN
        lost += row->outcome.members - row->outcome.finished();
    }
    if (!any) return "—";
    if (!conserving) return fmt::format("{}", lost);
    return fmt::format("{:.0e}", worst) + (lost == 0 ? "" : fmt::format("; {} lost", lost));
}

/// "0.08 … 0.42": rk4's largest usable step over the linear limit, least and most on the axis.
std::string step_cell(std::vector<Row const*> const& rows) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (Row const* row : rows) {
        if (row->largest_step == 0) continue;  // not searched
        double const share = std::isnan(row->largest_step) ? 0 : row->largest_step / row->limit;
        least = std::min(least, share);
        most = std::max(most, share);
    }
    return most == 0 ? "—" : fmt::format("{:.2g} … {:.2g}", least, most);
}

/// A line for each axis.
void write_law(fmt::ostream& out, Law law, std::vector<Row> const& rows) {
    bool const conserving = !info(law).switches;
    out.print("\n## Law: {}\n\n{}\n\n| axis | from … to | members |", info(law).name,
              conserving ? "Largest 95th percentile of the residual, and members that did not finish:"
                         : "Members that did not finish (the residual is the law's):");
    for (Method const method : columns) out.print(" {} |", slideway::name_of(method));
    out.print(" rk4, usable step |\n|---|---|---|---|---|---|---|---|---|\n");
    std::vector<Axis const*> axes;
    for (Row const& row : rows) {
        if (row.law == law && std::ranges::find(axes, row.axis) == axes.end()) axes.push_back(row.axis);
    }
    for (Axis const* axis : axes) {
        std::vector<Row const*> own;
        for (Row const& row : rows) {
            if (row.axis == axis) own.push_back(&row);
        }
        int members = 0;  // of one method
        for (Row const* row : own) members += row->method == own.front()->method ? row->outcome.members : 0;
        auto const unit = axis->unit.empty() ? std::string() : fmt::format(" [{}]", axis->unit);
        out.print("| {}{} | {:.3g} … {:.3g} | {} |", axis->title, unit, axis->points.front().value, axis->points.back().value, members);
        for (Method const method : columns) out.print(" {} |", cell(own, method, conserving));
        out.print(" {} |\n", step_cell(own));
    }
}

}  // namespace

void write_csv(std::filesystem::path const& file, std::vector<Row> const& rows) {
    auto out = fmt::output_file(file.string());
    std::istringstream lines(provenance());
    for (std::string line; std::getline(lines, line);) out.print("# {}\n", line.substr(2));
    out.print("law,axis,value,method,tolerance,step_s,linear_limit_s,largest_usable_step_s,members");
    for (char const* name : status_names) out.print(",{}", name);
    out.print(",median_residual_J,median_relative_residual,p95_relative_residual,median_steps\n");
    for (auto const& row : rows) {
        auto const& o = row.outcome;
        bool const fixed = row.method == Method::rk4;
        auto const or_nothing = [](bool given, double value) {
            return given ? fmt::format("{:.3e}", value) : std::string();
        };
        out.print("{},{},{:g},{},{},{},{:.3e},{},{}", info(row.law).name, row.axis->name, row.point->value,
                  slideway::name_of(row.method), or_nothing(!fixed, row.point->tolerance), or_nothing(fixed, row.step),
                  row.limit, or_nothing(row.largest_step != 0, row.largest_step), o.members);
        for (int const count : o.ended) out.print(",{}", count);
        out.print(",{:.3e},{:.3e},{:.3e},{:.0f}\n", o.median_residual, o.median_relative, o.p95_relative,
                  o.median_steps);
    }
}

void write_markdown(std::filesystem::path const& file, std::vector<Row> const& rows) {
    auto out = fmt::output_file(file.string());
    out.print("# Stability of the methods\n\n{}- kernels: {}\n", machine_and_build(), slideway::name_of(best_isa()));
    out.print(
        "\nWhat follows from it: [docs/evidence/stability.md](../../docs/evidence/stability.md). Every point, with medians, statuses and steps: "
        "[stability.csv](stability.csv). Residual: |ε| over what friction and damping took (D_f + |D_d|), of the members that reached the end at {} s. "
        "Where the axis says nothing else: 0.1 mm, π rad/s, steel, η = 0.01, χ = 10 s/m (paper: 0), friction on, falling starts, tolerance 1e-5, "
        "rk4 with half of the linear limit 2√2/Ω. Usable step of rk4, over that limit: the largest with which all members finish and the 95th "
        "percentile is at most 0.01 (paper: the median at most 0.2 above that of auto); 0: none.\n",
        end_time);
    for (Law const law : swept_laws()) write_law(out, law, rows);
}

}  // namespace slideway::bench
