// Which columns a result file has, in which order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/descriptors.hpp"
#include "host/config/outputs.hpp"
#include "host/sampling/design.hpp"
#include "host/store/column.hpp"
#include "host/store/run_identity.hpp"

namespace slideway {

class ResultView;

/// What a member's run cost, as numbers of a result.
struct WorkCounter {
    char const* name;  // of the column
    char const* meaning;
    std::uint64_t MemberRecord::*of;
};

inline constexpr std::array<WorkCounter, 5> work_table{{
    {"steps_accepted", "accepted steps", &MemberRecord::steps_accepted},
    {"steps_rejected", "rejected steps", &MemberRecord::steps_rejected},
    {"rhs_evaluations", "evaluations of the right-hand side", &MemberRecord::rhs_evaluations},
    {"jacobian_evaluations", "evaluations of the Jacobian", &MemberRecord::jacobian_evaluations},
    {"stiff_steps", "accepted steps of the stiff method", &MemberRecord::stiff_steps},
}};

/// One number per member: a quantity, or one of its columns.
struct QuantityColumn {
    std::string quantity;   // name of the variable: "mode_time"
    std::string dimension;  // of the labels: "mode_class"; "" for a quantity of one column
    std::string label;      // "free"; "" likewise
    std::size_t index = 0;  // along the dimension
    std::size_t place = 0;  // in a member's row of all quantities
    std::string unit;
    std::string long_name;
    std::string name() const { return label.empty() ? quantity : quantity + "[" + label + "]"; }
};

/// Adds one for each number of a quantity.  @param first without its label and index
void add_columns(std::vector<QuantityColumn>& columns, QuantityColumn first);
/// A column for each number of the quantities, in the order of the mechanism's outputs.
std::vector<QuantityColumn> columns_of(Mechanism mechanism, Selection quantities);
/// Those that a result names itself, in the order of the file: a mechanism's own are known without its module.  Places count from the first of each.
std::vector<QuantityColumn> stored_columns(ResultView const& results);
/// The one that a limit is of; nullptr without it.
QuantityColumn const* column_of(std::vector<QuantityColumn> const& columns, Limit const& limit);

/// A dotted key as the name of a variable: underscores for dots.
std::string variable_name(std::string_view key);
/// The column of a varied input, with its key as the attribute `key`.
ResultColumn parameter_column(std::string_view key, std::string_view unit, std::string_view meaning, double Inputs::*input);

struct ResultLayout {
    MemberSet members;
    Mechanism mechanism{};             // whose states are stored
    std::vector<double> sample_times;  // empty: no time series
    bool by_turns = false;             // they are angles that the crank has turned
    Selection quantities = 0;
    Selection series = 0;
    std::vector<ResultColumn> parameters;  // what varies
    std::size_t sections = 0;        // of a member, at most; 0: none are stored
    std::uint64_t section_rows = 0;  // of all members
    bool crossings = false;          // of a surface, not of a crank angle
    std::string sweep;               // name of the parameter column that a sweep goes by; "": no sweep
    /// What the study concludes of each member; a column with values along a dimension of its own name is an axis of others.
    std::vector<ResultColumn> study;
    std::function<std::vector<double>(BlockResult const& block, std::size_t place)> study_row;  // the numbers that these take theirs from
    std::shared_ptr<MemberTable const> labelled;                                                // whose columns of text name the members
};

/// Also names, for readers that do not know the mechanism, the columns that are summed up (`quantities`).
ResultColumns result_columns(ResultLayout const& layout);

/// One that holds statuses, with `flag_values` and `flag_meanings`.
ResultColumn status_column(std::string name, std::string meaning, std::string dimension);

/// Bytes of data in the file.
std::uint64_t payload_bytes(ResultLayout const& layout);
/// Bytes beside the data, at most: descriptions of the variables, and the scene as text.  A shard has them too.
std::uint64_t header_bytes(ResultLayout const& layout, Provenance const& provenance);

/// The sections that a member of a block reached: [sections][section_columns].
std::span<double const> sections_of(BlockResult const& block, std::size_t place);

}  // namespace slideway
