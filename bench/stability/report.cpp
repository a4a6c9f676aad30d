#include "bench/stability/report.hpp"

#include <cmath>
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

/// "3.1e-05 / 2e-04; 2 unstable, 1 geometry": median, 95th percentile, and who did not finish.
std::string cell(Outcome const& outcome) {
    std::string text = std::isnan(outcome.median_relative)
                           ? "—"
                           : fmt::format("{:.0e} / {:.0e}", outcome.median_relative, outcome.p95_relative);
    char const* separator = "; ";
    for (int status = 1; status < status_count; ++status) {
        int const count = outcome.ended[static_cast<std::size_t>(status)];
        if (count == 0) continue;
        text += fmt::format("{}{} {}", separator, count, status_names[status]);
        separator = ", ";
    }
    return text;
}

std::string step_cell(Row const& row) {
    return std::isnan(row.largest_step)
               ? "none"
               : fmt::format("{:.1e} s, {:.2f}", row.largest_step, row.largest_step / row.limit);
}

void write_axis(fmt::ostream& out, std::vector<Row const*> const& rows) {
    auto const& axis = *rows.front()->axis;
    std::vector<Method> methods;
    for (Row const* row : rows) {
        if (row->point == rows.front()->point) methods.push_back(row->method);
    }
    bool const steps = rows.back()->largest_step != 0;
    out.print("\n### {}\n\n| {} |", axis.title, axis.unit.empty() ? "value" : axis.unit);
    for (Method const method : methods) out.print(" {} |", slideway::name_of(method));
    if (steps) out.print(" linear limit | largest usable step, over the limit |");
    out.print("\n|---|");
    for (std::size_t i = 0; i < methods.size() + (steps ? 2 : 0); ++i) out.print("---|");
    for (Row const* row : rows) {
        if (row->method == methods.front()) out.print("\n| {:.3g} |", row->point->value);
        out.print(" {} |", cell(row->outcome));
        if (steps && row->method == Method::rk4) out.print(" {:.1e} s | {} |", row->limit, step_cell(*row));
    }
    out.print("\n");
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
    out.print("# Stability of the methods\n\n{}", provenance());
    out.print(
        "\nHow to read it, and what follows: `docs/stability.md`.  Each cell: energy residual |ε| over what friction "
        "and "
        "damping burnt (D_f + |D_d|), median / 95th percentile of the members that reached the end at {} s; after it "
        "those that did not finish, by status.  Where nothing else is said: 0.1 mm, π rad/s, steel, η = 0.01, χ = 10 "
        "s/m "
        "(conservative) or 0 (paper), friction on, falling starts; tolerance 1e-5; rk4 with half of the linear limit.  "
        "Largest usable step of rk4: all members finish, and the 95th percentile is at most 0.01 (conservative) or the "
        "median at most 0.2 above that of auto (paper).\n",
        end_time);
    for (Law const law : swept_laws()) {
        out.print("\n## Law: {}\n", info(law).name);
        std::vector<Row const*> of_axis;
        auto const flush = [&] {
            if (!of_axis.empty()) write_axis(out, of_axis);
            of_axis.clear();
        };
        for (auto const& row : rows) {
            if (row.law != law) continue;
            if (!of_axis.empty() && of_axis.front()->axis != row.axis) flush();
            of_axis.push_back(&row);
        }
        flush();
    }
}

}  // namespace slideway::bench
