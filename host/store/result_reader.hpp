// Reads a result file back.
#pragma once

#include <string>

#include "host/store/netcdf_file.hpp"
#include "host/store/result_seal.hpp"
#include "host/store/result_view.hpp"

namespace slideway {

/// A file that a reader keeps open; a base, so that it is there before the view of it.
struct OpenResult {
    NetcdfFile file;
};

/// A finished result file; usable wherever a view is.  Of files that were not just written `check_result` comes first.
class ResultReader : private OpenResult, public ResultView {
public:
    /// @throws FileError if the file is missing, not netCDF, not a result of slideway, of a newer format, or unfinished.
    explicit ResultReader(std::string const& path);
    ResultReader(ResultReader const&) = delete;  // the view goes by the file's place
    ResultReader& operator=(ResultReader const&) = delete;

    std::string stored_hash() const { return attribute("payload_hash"); }
    std::string computed_hash() const { return payload_hash(file); }  // reads all data
    /// Of a file that was just written and looked at.
    SealCheck seal() const { return {format_of(file), stored_hash(), attribute("metadata_hash"), stored_hash(), attribute("metadata_hash")}; }
    SealCheck check() const { return check_seal(file); }  // reads all data
};

}  // namespace slideway
