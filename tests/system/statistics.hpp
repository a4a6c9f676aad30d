// Runs that keep statistics in place of members.
#pragma once

#include <filesystem>

#include "host/store/netcdf_file.hpp"
#include "host/store/result_view.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing {

// Members that touch and members that do not, some 0.1 ms of work each.
inline constexpr char const* cheap_scene = R"(
schema = 1
title = "Cheap members"
[contact]
law = "conservative"
[friction]
[study]
kind = "tolerance"
members = 400
duration = "0.1 ms"
quantities = ["peak_normal_force", "energy_change", "mode_time"]
store = "statistics"
[study.vary]
"initial.y" = { dist = "unif", low = "-0.099 mm", high = "0.099 mm" }
"initial.vy" = { dist = "norm", mean = 0, sd = 0.3 }
[study.limits]
"peak_normal_force" = { max = "10 N" }
"mode_time[free]" = { min = "0.099 ms" }
)";

inline std::vector<std::string> const stored{"--set", "study.store=members"};
/// Some members break off: a few dozen steps are enough for those that fly free.
inline std::vector<std::string> const failing{"--set", "integrator.max_steps=60", "--max-failures", "100%"};

class StatisticsRun : public ProgramWithResults {
protected:
    StatisticsRun() { write("s.toml", cheap_scene); }
    Outcome run_scene(std::string const& output, std::vector<std::string> const& more = {},
                      std::vector<std::string> const& and_more = {}) const {
        std::vector<std::string> arguments{"run", "s.toml", "--no-progress", "-o", output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        arguments.insert(arguments.end(), and_more.begin(), and_more.end());
        return run(std::move(arguments));
    }
    std::string hash_of(std::string const& name) const {
        EXPECT_EQ(results(name).attribute("completeness"), "complete");
        return ProgramWithResults::hash_of(name);
    }
    /// A variable of the group `statistics`.
    std::vector<double> statistic(std::string const& file, std::string const& name,
                                  std::string const& group = "statistics") const {
        NetcdfFile const results = NetcdfFile::open(path(file).string());
        auto const held_from = results.group(group);
        DataFile const& from = *held_from;
        for (DataFile::Variable const& variable : from.variables()) {
            if (variable.name != name) continue;
            std::vector<std::size_t> const start(variable.shape.size() + 1, 0);
            std::vector<std::size_t> shape = variable.shape;
            shape.push_back(0);
            std::size_t const rank = variable.shape.size();
            std::vector<double> values(variable.size());
            std::vector<int> counts(variable.size());
            bool const whole = variable.type == DataFile::Type::int32;
            from.read(variable.id, {start.data(), rank}, {shape.data(), rank},
                      whole ? static_cast<void*>(counts.data()) : values.data());
            if (whole) values.assign(counts.begin(), counts.end());
            return values;
        }
        ADD_FAILURE() << name;
        return {};
    }
    std::size_t files_in(std::string const& folder) const {
        std::size_t count = 0;
        for (auto const& entry : std::filesystem::directory_iterator(path(folder))) {
            count += entry.path().filename().string().starts_with("statistics-");
        }
        return count;
    }
};

}  // namespace slideway::testing
