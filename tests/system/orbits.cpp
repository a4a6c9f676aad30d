#include "tests/system/orbits.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace slideway::testing::orbits {

std::string scene(std::string const& study, std::string const& law) {
    return fmt::format(
        "schema = 1\ntitle = \"Orbits\"\n[mechanism]\ncrank_speed = {}\n[contact]\nlaw = \"{}\"\n[friction]\n"
        "[initial]\nz = \"0.005 mm\"\nroll = 1e-4\nyaw = 2e-4\npitch = -1e-4\n[study]\n{}\n"
        "[study.vary]\n\"initial.y\" = {{ dist = \"unif\", low = \"-0.03 mm\", high = \"0.03 mm\" }}\n",
        speed, law, study);
}

std::vector<std::string> const state_names{"y", "z", "vy", "vz", "roll", "yaw", "pitch", "wx", "wy", "wz"};

std::vector<std::vector<Section>> sections_of(ResultReader const& file) {
    std::vector<std::vector<double>> columns;
    for (std::string const& name : state_names) columns.push_back(file.values("section_" + name));
    auto const times = file.values("section_time");
    std::vector<std::vector<Section>> sections;
    std::size_t row = 0;
    for (double const count : file.values("section_count")) {
        auto& of_member = sections.emplace_back();
        for (double i = 0; i < count; ++i, ++row) {
            of_member.push_back({times.at(row), {}});
            for (std::size_t j = 0; j < columns.size(); ++j) of_member.back().state[j] = columns[j].at(row);
        }
    }
    EXPECT_EQ(row, times.size());
    return sections;
}

std::vector<State> final_states(ResultReader const& file) {
    std::vector<State> states(file.values("status").size());
    for (std::size_t j = 0; j < state_names.size(); ++j) {
        auto const column = file.values("final_" + state_names[j]);
        for (std::size_t i = 0; i < states.size(); ++i) states[i][j] = column[i];
    }
    return states;
}

std::vector<double> row(ResultReader const& file, std::string const& name, std::size_t i) {
    auto const values = file.values(name);
    std::size_t const width = values.size() / file.values("status").size();
    std::vector<double> found(values.begin() + static_cast<std::ptrdiff_t>(i * width),
                              values.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
    for (double& x : found) {
        if (std::isnan(x)) x = 1e300;
    }
    return found;
}

std::map<std::string, std::vector<double>> member_of(ResultReader const& file, std::size_t i) {
    std::map<std::string, std::vector<double>> values;
    for (std::string const& name : file.variable_names()) {
        bool const along_members =
            !name.starts_with("section_") && name != "exponent" && name != "history" && name != "member";
        if (along_members) values[name] = row(file, name, i);
    }
    return values;
}

std::uint64_t steps_of_half(ResultReader const& file) {
    auto steps = file.values("steps_accepted");
    auto const rejected = file.values("steps_rejected");
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += rejected[i];
    std::sort(steps.begin(), steps.end());
    EXPECT_LT(steps.front(), steps.back());
    return static_cast<std::uint64_t>(steps[steps.size() / 2 - 1]);
}

Outcome OrbitProgram::run_scene(std::string const& text, std::vector<std::string> options) const {
    write("s.toml", text);
    options = to_result(std::move(options));
    options.insert(options.begin(), {"run", "s.toml", "--no-progress"});
    return run(std::move(options));
}

ResultReader OrbitProgram::results_of(std::string const& text, std::vector<std::string> options) const {
    options.insert(options.end(), {"-o", "r.nc"});
    Outcome const outcome = run_scene(text, std::move(options));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return results();
}

}  // namespace slideway::testing::orbits
