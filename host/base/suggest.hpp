// The name that a mistyped one was meant to be.
#pragma once

#include <span>
#include <string_view>

namespace slideway {

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `names` if it is near enough to be meant, else an empty string.  An abbreviation is near (norm and
/// normal).  Where names are dotted, the part behind the last dot alone may match too: a key in the wrong table.
std::string_view nearest_name(std::string_view name, std::span<std::string_view const> names);

}  // namespace slideway
