// Whether a result file is what was written, found out in a process apart: HDF5 crashes on some files of which a single byte has changed.
// In a job of several ranks it is found out by the rank itself: MPI does not outlive a fork.
#pragma once

#include <string>

#include "host/store/result_seal.hpp"

namespace slideway {

/// Opens a result, reads all of it and computes both hashes, before this process opens it.
/// @throws FileError with one line: it is missing, no finished result of slideway, of a newer format, or so damaged that it cannot be read;
/// hashes that do not match are told by what is returned
SealCheck check_result(std::string const& path);

/// @throws FileError also if a hash does not match; the line says which part is damaged
void require_intact(std::string const& path);

/// Whether a file is a finished result, as far as its header tells: damaged data are no matter.
bool is_result_file(std::string const& path);

}  // namespace slideway
