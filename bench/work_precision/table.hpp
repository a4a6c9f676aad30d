// The figures as files: CSV for programs, markdown for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/work_precision/sweep.hpp"

namespace slideway::bench {

/// Machine, compiler, flags, commit and date, a line each: "key: value".
std::vector<std::string> provenance();

struct Result {
    Problem problem;
    std::vector<Row> rows;
};

/// All rows of all problems, provenance as comments above.
void write_csv(std::filesystem::path const& file, std::vector<Result> const& results);
/// What is promised, rates beside the best of others at equal p95 error, and the plots.
void write_markdown(std::filesystem::path const& file, std::vector<Result> const& results);

}  // namespace slideway::bench
