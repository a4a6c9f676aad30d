// What a result file says of itself so that damage shows: its format, and fingerprints of its numbers and of all else.
#pragma once

#include <string>
#include <vector>

#include "host/store/netcdf_file.hpp"

namespace slideway {

inline constexpr char const* verification_group = "verification";

/// Attribute `format_version` of results and shards.  Files without it are of format 1, which had no metadata hash; up to 2 quantities had names
/// of then (host/config/outputs.hpp).  This program reads all of them.
inline constexpr int format_version = 3;

/// The hash over all variables of a file by name (a file made in memory forgets their order): name, number of
/// dimensions, their lengths, then the data in C order, little-endian, each number in its own width.  Every NaN counts
/// as the same one, as its bits differ between instruction sets.  Groups follow what they lie in, in the order of their
/// definition: name, then their variables and groups in the same way, but for the group `verification`, which says how far the
/// numbers can be trusted and is none of them.  Attributes do not count: the same numbers
/// computed on another day, with other threads or another compiler keep their hash.  @return 16 hexadecimal digits.
std::string payload_hash(DataFile const& file);

/// The hash over what the payload hash leaves out, everything by name: of the file and each group the dimensions with their lengths, the
/// attributes (type, count, values) but for the two hashes, of each variable the type, the dimensions and the attributes; and the
/// data of the group `verification`.  @return 16 hexadecimal digits.
std::string metadata_hash(NetcdfFile const& file);

/// The last that is written into a file: its format and both hashes.  Whatever changes afterwards is damage.
void seal(NetcdfFile& file);

/// What a file says of itself, and what it holds.
struct SealCheck {
    int version = format_version;
    std::string payload, metadata;                // as stored; without `metadata` format 1
    std::string payload_found, metadata_found;    // of what is there
    std::string foreign = {};                     // what neither hash covers and slideway does not write, in words; "" where there is nothing
    bool data_match() const { return payload == payload_found; }
    bool metadata_match() const { return version == 1 ? metadata.empty() : metadata == metadata_found; }
    bool has_what_was_written() const { return data_match() && metadata_match(); }
    bool intact() const { return has_what_was_written() && foreign.empty(); }
    bool is_only_added_to() const { return has_what_was_written() && !foreign.empty(); }
    /// Which part is damaged, in words: "the data do not match their hash"; "" of an intact file.
    std::string damage() const;
};

/// 1 without the attribute.  @throws FileError if this program does not read that format.
int format_of(DataFile const& file);
/// Reads everything.  @throws FileError also where that fails
SealCheck check_seal(NetcdfFile const& file);

// What a file holds that slideway does not write, so that no hash of a result covers it.

/// In words, by name: "variable extra of type float", "type mine", "attribute of y: weights", "object notes".  Of the data model of netCDF-4
/// variables of other types than `DataFile::Type`, types of a user's own and attributes of these; of a file on the disk also objects and
/// attributes of HDF5 that netCDF-4 does not see.  All else, of any name, is covered by one of the hashes.
std::vector<std::string> uncovered(NetcdfFile const& file);

}  // namespace slideway
