// A small ensemble, run through the program.
#pragma once

#include <string>
#include <vector>

#include "tests/system/results.hpp"

namespace slideway::testing {

inline constexpr char const* small_scene = R"(
schema = 1
title = "A small ensemble"
[contact]
law = "paper"
[friction]
[study]
members = 37
duration = "5 ms"
samples = 6
quantities = ["energy_residual", "drive_work", "mode_time"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

class SmallRun : public ProgramWithResults {
protected:
    SmallRun() { write("s.toml", small_scene); }
    Outcome run_scene(std::vector<std::string> options) const {
        options = to_result(std::move(options));
        options.insert(options.begin(), {"run", "s.toml", "--no-progress"});
        return run(std::move(options));
    }
};

}  // namespace slideway::testing
