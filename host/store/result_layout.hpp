// Which variables a result file has, in which order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/descriptors.hpp"
#include "host/config/outputs.hpp"
#include "host/run/member_set.hpp"
#include "host/sampling/design.hpp"
#include "host/store/provenance.hpp"
#include "kernels/block.hpp"

namespace slideway {

// What a study concludes of its members.

/// A dimension of its own with the values along it.
struct StudyAxis {
    std::string name;
    std::string unit;
    std::string long_name;
    std::vector<double> values;
};

/// One value, or a row of values along axes, per member.
struct StudyColumn {
    std::string name;
    std::string unit;
    std::string long_name;
    std::vector<std::string> axes;  // names of StudyAxis, slowest first
};

struct StudyTable {
    std::vector<StudyAxis> axes;
    std::vector<StudyColumn> columns;

    /// Values of a column per member.
    std::size_t width(StudyColumn const& column) const;
};

/// Values of a table's columns for the members of one block: [column][members × width].
using StudyValues = std::vector<std::vector<double>>;

/// What a member's run cost, as numbers of a result.
struct WorkCounter {
    char const* name;  // of the member variable
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

/// Adds one for each number of a quantity.
void add_columns(std::vector<QuantityColumn>& columns, OutputQuantity const& quantity);
/// A column for each number of the quantities, in the order of the mechanism's outputs.
std::vector<QuantityColumn> columns_of(Mechanism mechanism, Selection quantities);
/// The one that a limit is of; nullptr without it.
QuantityColumn const* column_of(std::vector<QuantityColumn> const& columns, Limit const& limit);

/// A varied input: its dotted key with underscores for dots.
struct ParameterColumn {
    std::string name;
    std::string unit;
    std::string long_name;
    double Inputs::*member;
};

/// A dotted key as the name of a variable: underscores for dots.
std::string variable_name(std::string_view key);

struct ResultLayout {
    MemberSet members;
    Mechanism mechanism{};  // whose states are stored
    std::vector<double> sample_times;               // empty: no time series
    Selection quantities = 0;
    Selection series = 0;
    std::vector<ParameterColumn> parameters;
    std::size_t sections = 0;        // of a member, at most; 0: none are stored
    std::uint64_t section_rows = 0;  // of all members
    bool crossings = false;          // of a surface, not of a crank angle
    std::string sweep;               // name of the parameter column that a sweep goes by; "": no sweep
    StudyTable study;                // what the study concludes of each member
    std::shared_ptr<MemberTable const> labelled;  // the table whose columns of text name the members; none: nothing does

    /// Bytes of the longest label; 0 without labels.
    std::size_t label_width() const { return labelled == nullptr ? 0 : labelled->label_width; }
    std::size_t states() const { return static_cast<std::size_t>(info(mechanism).states); }
};

/// Bytes of data in the file.
std::uint64_t payload_bytes(ResultLayout const& layout);
/// Bytes beside the data, at most: descriptions of the variables, and the scene as text.  A shard has them too.
std::uint64_t header_bytes(ResultLayout const& layout, Provenance const& provenance);

}  // namespace slideway
