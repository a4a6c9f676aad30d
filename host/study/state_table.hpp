// States to probe: the scene's start, the rows of a CSV table in the format of tests/golden/rhs_*.csv, or what a result has stored.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/scene.hpp"
#include "host/store/result_view.hpp"

namespace slideway {

struct StateTable {
    Mechanism mechanism{};          // of all rows
    bool has_loads = false;         // the scene
    std::vector<std::string> parameter_names;               // dotted keys, in the order of the input
    std::vector<std::vector<std::string>> parameter_texts;  // [row][parameter], as they are to be printed
    std::vector<Inputs> inputs;                             // [rows], complete; the initial state is the one to probe
    std::vector<Parts> parts;                               // [rows]
    std::vector<double> times;                              // [rows], s
    std::vector<std::string> warnings = {};                 // of unusual numbers, the first of each column

    std::size_t rows() const { return inputs.size(); }
};

/// The scene's start at t = 0.  @throws SceneError if the scene's inputs cannot be used.
StateTable start_state(Scene const& scene);

/// States of the scene's nominal mechanism.  @param states rows of the mechanism's state  @param times [s], one a row; none: 0
/// @throws SceneError if they are no rows, or one cannot be used
StateTable state_table(Scene const& scene, std::span<double const> states, std::span<double const> times);

/// Reads columns in any order: t and the mechanism's states (needed), `contact.law` and numeric keys of the scene (override
/// it), each with a unit in brackets or in SI; a column without a dot in its name that is none of these is ignored.  A row has the kernel parts that its
/// parameters need: the rates where a χ is not zero, the way's pose where one of its entries is not zero, friction if
/// the scene has it or the table has a friction.* column.
/// @param name of the table, for messages.  @throws SceneError `name:line: column …`.
StateTable read_state_table(std::istream& in, std::string const& name, Scene const& scene);

/// A state that a result has stored, to be probed.
struct StoredState {
    std::uint64_t member;
    double time;                  // [s]
    std::string_view of;          // "sample", "section" or "end"
    std::vector<double> numbers;  // of the mechanism's state
};

/// The one that is nearest in time.  @param mechanism of the result  @param member nothing: the first of the file  @param time [s]; nothing: the end
/// @throws SceneError if there is no such member, or no state of it
StoredState stored_state(ResultView const& results, Mechanism mechanism, std::optional<std::uint64_t> member, std::optional<double> time);

/// The scene of a result, whose members have the inputs that it stores, whatever has become of the file of their table.  @throws SceneError
Scene stored_scene(ResultView const& results, Overrides overrides = {});

/// Gives the inputs of the result's scene the numbers with which a member ran.
void take_member(Scene& scene, ResultView const& results, std::uint64_t member);

}  // namespace slideway
