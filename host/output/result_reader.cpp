#include "host/output/result_reader.hpp"

#include "host/output/payload_hash.hpp"
#include "host/scene/error.hpp"

namespace slideway {

ResultReader::ResultReader(std::string const& path) : OpenResult{NetcdfFile::open(path)}, ResultView(file) {
    if (stored_hash().empty()) {
        throw FileError(path + ": is unfinished: the run that wrote it did not come to its end");
    }
}

std::string ResultReader::computed_hash() const { return payload_hash(file); }

}  // namespace slideway
