// Work-precision diagrams: every method over its tolerances on fixed problems, slideway's beside those that users would
// take instead. Writes work_precision.csv, work_precision.md and one SVG per problem.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string_view>

#include "bench/command_line.hpp"
#include "bench/work_precision/members.hpp"
#include "bench/work_precision/plot.hpp"
#include "bench/work_precision/references.hpp"
#include "bench/work_precision/table.hpp"
#include "host/backend/backend.hpp"

namespace {

/// @param words separated by commas
bool contains_one(std::string_view name, std::string_view words) {
    for (std::size_t from = 0; from <= words.size();) {
        auto const to = std::min(words.find(',', from), words.size());
        if (name.find(words.substr(from, to - from)) != std::string_view::npos) return true;
        from = to + 1;
    }
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace slideway::bench;
    CommandLine words("Error against run time of slideway's methods and their peers, on one core");
    bool quick = false;
    std::string folder = ".", only, only_method;
    double budget = 0;
    bool members = false, no_scalar = false;
    words.flag("--quick", quick, "fewer members and tolerances: about half a minute");
    words.folder("-o,--output", folder, "folder for the table and the plots");
    words.option("--problem", only, "only problems whose name contains this");
    words.option("--method", only_method, "only methods whose name contains this, or one of these, separated by commas");
    words.option("--budget", budget, "seconds for one method at one tolerance (8, or 1 if quick)");
    words.flag("--no-scalar", no_scalar, "without slideway's scalar code");
    words.flag("--members", members, "write the members and the states that count as exact, too");
    if (auto const code = words.parse(argc, argv)) return *code;
    if (!slideway::is_supported(slideway::Isa::scalar) ||
        slideway::compiled_isa(slideway::Isa::scalar) != slideway::Isa::scalar) {
        fmt::print(stderr, "work_precision: this machine has no AVX2 and FMA, which the peers are built for\n");
        return 1;
    }
    try {
        SweepOptions options;
        options.budget = budget > 0 ? budget : quick ? 1 : 8;
        options.repeats = quick ? 2 : 3;
        std::vector<Method> methods;
        for (auto const& group : {our_methods(), peer_methods()}) {
            for (auto const& method : group) {
                bool const left_out = no_scalar && method.ours && method.code == slideway::name_of(slideway::Isa::scalar);
                if (!left_out && contains_one(method.name, only_method)) methods.push_back(method);
            }
        }
        std::vector<Result> results;
        for (auto& problem : all_problems(quick)) {
            if (problem.name.find(only) == std::string::npos) continue;
            auto const start = std::chrono::steady_clock::now();  // references take all cores
            find_references(problem);
            auto const begun = std::chrono::steady_clock::now();
            auto rows = sweep(problem, methods, options);
            fmt::print("{}: {} members, references {:.0f} s, methods {:.0f} s\n", problem.name, problem.size(),
                       seconds_between(start, begun), seconds_between(begun, std::chrono::steady_clock::now()));
            std::fflush(stdout);
            if (members) write_members(std::filesystem::path(folder) / (problem.name + "_members.csv"), problem);
            write_plot(std::filesystem::path(folder) / (problem.name + ".svg"), problem, rows, methods);
            results.push_back({problem, std::move(rows)});
        }
        write_csv(std::filesystem::path(folder) / "work_precision.csv", results);
        write_markdown(std::filesystem::path(folder) / "work_precision.md", results);
    } catch (std::exception const& error) {
        fmt::print(stderr, "work_precision: {}\n", error.what());
        return 1;
    }
}
