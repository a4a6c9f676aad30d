#include "host/store/result_reader.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/store/payload_hash.hpp"

namespace slideway {

ResultReader::ResultReader(std::string const& path) : OpenResult{NetcdfFile::open(path)}, ResultView(file) {
    if (stored_hash().empty()) {
        throw FileError(path + ": is unfinished: the run that wrote it did not come to its end");
    }
}

std::string ResultReader::computed_hash() const { return payload_hash(file); }

void require_intact(std::string const& path) {
    ResultReader const results(path);
    if (results.computed_hash() == results.stored_hash()) return;
    throw FileError(fmt::format("{}: the data do not match their hash; the file is damaged or was edited, see slideway info", path));
}

}  // namespace slideway
