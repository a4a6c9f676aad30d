// Reads a result file back.
#pragma once

#include <string>

#include "host/store/netcdf_file.hpp"
#include "host/store/result_view.hpp"

namespace slideway {

/// A file that a reader keeps open; a base, so that it is there before the view of it.
struct OpenResult {
    NetcdfFile file;
};

/// A finished result file; usable wherever a view is.
class ResultReader : private OpenResult, public ResultView {
public:
    /// @throws FileError if the file is missing, not netCDF, not a result of slideway, or unfinished.
    explicit ResultReader(std::string const& path);
    ResultReader(ResultReader const&) = delete;  // the view goes by the file's place
    ResultReader& operator=(ResultReader const&) = delete;

    std::string stored_hash() const { return attribute("payload_hash"); }
    std::string computed_hash() const;  // reads all data
};

/// Reads all data of a result.  @throws FileError if they do not match their hash, or the file is no finished result
void require_intact(std::string const& path);

}  // namespace slideway
