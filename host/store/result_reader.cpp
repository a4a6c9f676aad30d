#include "host/store/result_reader.hpp"

#include "host/base/error.hpp"

namespace slideway {

ResultReader::ResultReader(std::string const& path) : OpenResult{NetcdfFile::open(path)}, ResultView(file) {
    format_of(file);
    if (stored_hash().empty()) {
        throw FileError(path + ": is unfinished: the run that wrote it did not come to its end");
    }
}

}  // namespace slideway
