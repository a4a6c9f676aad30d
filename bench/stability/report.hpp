// The sweep's rows as files: CSV for programs, Markdown for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/stability/measure.hpp"

namespace slideway::bench {

struct Row {
    Law law;
    Axis const* axis;
    Point const* point;
    Method method;
    double step = 0;          // of rk4 [s]
    double limit = 0;         // 2√2/Ω [s]
    double largest_step = 0;  // rk4's largest usable one; NaN where none is, 0 where it was not searched
    Outcome outcome;
};

void write_csv(std::filesystem::path const& file, std::vector<Row> const& rows);
void write_markdown(std::filesystem::path const& file, std::vector<Row> const& rows);

}  // namespace slideway::bench
