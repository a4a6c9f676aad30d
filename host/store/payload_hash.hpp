// A fingerprint of a result file's numbers, to compare runs and to notice damage.
#pragma once

#include <string>

#include "host/store/netcdf_file.hpp"

namespace slideway {

/// The hash over all variables of a file by name (a file made in memory forgets their order): name, number of
/// dimensions, their lengths, then the data in C order, little-endian, each number in its own width.  Every NaN counts
/// as the same one, as its bits differ between instruction sets.  Groups follow what they lie in, in the order of their
/// definition: name, then their variables and groups in the same way, but for the group `verification`, which says how far the
/// numbers can be trusted and is none of them.  Attributes do not count: the same numbers
/// computed on another day, with other threads or another compiler keep their hash.  @return 16 hexadecimal digits.
std::string payload_hash(NetcdfFile const& file);

inline constexpr char const* verification_group = "verification";

}  // namespace slideway
