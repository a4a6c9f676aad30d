// Stability report: every method and each law with every damping over stiffness, clearance, speed, damping, tolerance and step, out to the limits.
// Writes stability.csv and stability.md.  Results are errors, not times: they do not mind other work on the machine.
#include <fmt/format.h>
#include <omp.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <list>

#include "bench/command_line.hpp"
#include "bench/stability/report.hpp"

namespace slideway::bench {
namespace {

/// Methods that have a say on an axis: a tolerance means nothing to rk4, a fixed step to the others.
std::vector<Method> methods_of(Axis const& axis) {
    if (axis.name.starts_with("step")) return {Method::rk4};
    std::vector<Method> methods{Method::automatic, Method::dopri5, Method::bs32, Method::ros34pw2};
    // Restitution wants steps that end at touches.
    if (!axis.of_the_method && axis.name != "restitution") methods.push_back(Method::rk4);
    return methods;
}

std::vector<Row> all_rows(Law law, std::vector<Axis> const& axes) {
    std::vector<Row> rows;
    for (auto const& axis : axes) {
        for (auto const& point : axis.points) {
            double const limit = linear_limit(point.members);
            for (Method const method : methods_of(axis)) {
                double const step = method == Method::rk4 ? point.step_fraction * limit : 0;
                rows.push_back({law, &axis, &point, method, step, limit, 0, {}});
            }
        }
    }
    return rows;
}

void fill(Row& row) {
    row.outcome = measure(*row.point, row.method, row.step);
    if (row.method != Method::rk4 || row.axis->of_the_method) return;
    auto const reference = measure(*row.point, Method::automatic, 0);
    row.largest_step = largest_usable_step(*row.point, reference);
}

}  // namespace
}  // namespace slideway::bench

int main(int argc, char** argv) {
    using namespace slideway;
    using namespace slideway::bench;
    CommandLine words("How far each method goes, and how it tells when it has gone too far");
    bool quick = false;
    std::string folder = ".";
    int threads = 2;
    words.flag("--quick", quick, "fewer members and points: half a minute instead of two");
    words.folder("-o,--output", folder, "folder for the tables");
    words.count("--threads", threads, "runs at a time (2)");
    if (auto const code = words.parse(argc, argv)) return *code;
    try {
        auto const start = std::chrono::steady_clock::now();
        std::vector<Row> rows;
        std::list<std::vector<Axis>> axes_of_laws;  // rows point to them
        for (Law const law : swept_laws()) {
            auto const more = all_rows(law, axes_of_laws.emplace_back(axes(law, quick)));
            rows.insert(rows.end(), more.begin(), more.end());
        }
        auto const count = static_cast<int>(rows.size());
        // The searches of rk4's step, at the end of each point, are the longest: begin with the last.
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
        for (int i = 0; i < count; ++i) fill(rows[static_cast<std::size_t>(count - 1 - i)]);
        write_csv(std::filesystem::path(folder) / "stability.csv", rows);
        write_markdown(std::filesystem::path(folder) / "stability.md", rows);
        fmt::print("{} runs in {:.0f} s\n", count,
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    } catch (std::exception const& error) {
        fmt::print(stderr, "stability: {}\n", error.what());
        return 1;
    }
}
