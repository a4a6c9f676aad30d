// Small studies of orbits, run through the program, and their files read back.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "host/store/result_view.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing::orbits {

inline constexpr double speed = 100, turn = 2 * std::numbers::pi / speed;
inline constexpr std::size_t member_total = 11;  // a pack of eight, and a rest

std::string scene(std::string const& study, std::string const& law = "conservative");

// Tests are instantiated with them before any other unit's constants are there.
inline std::string const ensemble = scene("kind = \"ensemble\"\nmembers = 11");
inline std::string const lyapunov =
    scene("kind = \"lyapunov\"\nmembers = 11\nTtr = \"10 ms\"\nduration = \"50 ms\"\ndt = \"0.5 ms\"\nexponents = 2",
          "paper");
inline std::string const by_phase =
    scene("kind = \"poincare\"\nmembers = 11\ntransient_revolutions = 0\nrevolutions = 2\nphase = \"90 deg\"");
inline std::string const by_state = scene(
    "kind = \"poincare\"\nmembers = 11\nTtr = \"10 ms\"\nduration = \"50 ms\"\n"
    "section = { on = \"y\", value = \"0.03 mm\", direction = \"falling\" }");
inline std::string const by_gap = scene(
    "kind = \"poincare\"\nmembers = 11\nTtr = \"10 ms\"\nduration = \"50 ms\"\n"
    "section = { on = \"gap_y[P2]\", value = \"0.02 mm\" }");
inline std::string const sweep = scene(
    "kind = \"sweep\"\nmembers = 3\nparameter = \"joint.clearance\"\nvalues = [\"0.2 mm\", \"0.1 mm\"]\n"
    "transient_revolutions = 0\nrevolutions = 2\nphase = \"90 deg\"\nexponents = 1\nrescalings_per_revolution = 100");
inline std::string const plain_sweep = scene(
    "kind = \"sweep\"\nmembers = 3\nparameter = \"joint.clearance\"\nvalues = [\"0.2 mm\", \"0.1 mm\"]\n"
    "transient_revolutions = 0\nrevolutions = 2\nphase = \"90 deg\"\nexponents = 0");
inline std::string const continued_key = "study.start=continue";

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
