// What reports of stored members and of statistics have in common: whom the numbers are of, and what they are named.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/study/tolerance_report.hpp"

namespace slideway {

/// Whether members are random draws, so that intervals mean something.
bool is_random(DesignKind design);
std::string policy_of(DesignKind design);
/// @param complete whether every member ran: the slow ones are missing otherwise, and what is left is no fair sample.
std::string intervals_of(DesignKind design, bool complete);

/// A column for each number of the quantities, in the order of their table, with its units and names.
std::vector<QuantityColumn> report_columns(Selection quantities);

/// Without an interval where members are no random draws.
Proportion yield_of(std::uint64_t met, std::uint64_t trials, bool random);

/// A limit is of what the result lacks.  @throws FileError always.
[[noreturn]] void refuse_limit(Limit const& limit, std::string const& path);

}  // namespace slideway
