// Small studies of orbits, run through the program, and their files read back.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "host/store/result_reader.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::orbits {

inline constexpr double speed = 100, turn = 2 * std::numbers::pi / speed;
inline constexpr std::size_t member_total = 11;  // a pack of eight, and a rest

std::string scene(std::string const& study, std::string const& law = "conservative");

extern std::string const ensemble;
extern std::string const lyapunov;
extern std::string const by_phase;
extern std::string const by_state;
extern std::string const by_gap;
extern std::string const sweep;
extern std::string const plain_sweep;

extern std::string const continued_key;

extern std::vector<std::string> const state_names;
using State = std::array<double, 10>;
struct Section {
    double time;
    State state;
    friend bool operator==(Section const&, Section const&) = default;
};

/// By member, in the order of the file.
std::vector<std::vector<Section>> sections_of(ResultReader const& file);

std::vector<State> final_states(ResultReader const& file);

/// The bits of member i's row, for numbers that may be NaN.
std::vector<double> row(ResultReader const& file, std::string const& name, std::size_t i);

/// All that a file holds of member i, but for its sections.
std::map<std::string, std::vector<double>> member_of(ResultReader const& file, std::size_t i);

class OrbitProgram : public Program {
protected:
    Outcome run_scene(std::string const& text, std::vector<std::string> options = {}) const;
    /// Runs to the end without complaint.
    ResultReader results_of(std::string const& text, std::vector<std::string> options = {}) const;
    ResultReader results(std::string const& name = "r.nc") const { return ResultReader(path(name).string()); }
};

/// Steps that half of the members need more than.
std::uint64_t steps_of_half(ResultReader const& file);

}  // namespace slideway::testing::orbits
