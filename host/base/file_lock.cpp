#include "host/base/file_lock.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"

namespace slideway {
namespace {

int flock_uninterrupted(int file, int operation) {
    int result;
    do {
        result = flock(file, operation);
    } while (result != 0 && errno == EINTR);
    return result;
}

/// Whether the name still leads to the open file: whoever held the lock before may have removed it.
bool is_named(int file, std::string const& path) {
    struct stat open_one {
    }, named_one{};
    return fstat(file, &open_one) == 0 && stat(path.c_str(), &named_one) == 0 && open_one.st_ino == named_one.st_ino &&
           open_one.st_dev == named_one.st_dev;
}

int operation_of(FileLock::Kind kind) { return kind == FileLock::Kind::alone ? LOCK_EX : LOCK_SH; }

}  // namespace

FileLock::FileLock(std::string path, Kind kind, Wait wait, std::string const& rival) : path_(std::move(path)) {
    for (;;) {
        file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file_ < 0) throw FileError(fmt::format("{}: cannot create: {}", path_, std::strerror(errno)));
        bool const held = flock_uninterrupted(file_, operation_of(kind) | (wait == Wait::no ? LOCK_NB : 0)) != 0 &&
                          errno == EWOULDBLOCK;
        if (held) {
            close(std::exchange(file_, -1));
            throw FileError(rival);
        }
        if (is_named(file_, path_)) return;
        close(std::exchange(file_, -1));
    }
}

FileLock::~FileLock() {
    if (file_ >= 0) close(file_);
}

void FileLock::change(Kind kind, std::string const& rival) {
    if (flock_uninterrupted(file_, operation_of(kind) | LOCK_NB) != 0 && errno == EWOULDBLOCK) throw FileError(rival);
}

void FileLock::remove() { remove_file(path_); }

}  // namespace slideway
