#include "host/base/file_lock.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
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

bool is_held_elsewhere(int file, int operation) { return flock_uninterrupted(file, operation) != 0 && errno == EWOULDBLOCK; }

/// Of a lock that the system lists with its process (proc(5), /proc/locks); on another machine, and on file systems that number their
/// files otherwise, nobody can tell.
std::string holder_of(int file) {
    struct stat found {};
    if (fstat(file, &found) != 0) return "another process";
    std::string const place = fmt::format("{:02x}:{:02x}:{}", major(found.st_dev), minor(found.st_dev), found.st_ino);
    std::ifstream locks("/proc/locks");
    for (std::string line; std::getline(locks, line);) {
        std::istringstream words(line);
        std::string number, kind, is_advisory, mode, process, where;
        words >> number >> kind >> is_advisory >> mode >> process >> where;
        if (kind == "FLOCK" && where == place) return "process " + process;
    }
    return "another process";
}

FileError busy(int file, Rival const& rival) {
    return FileError(fmt::format("{}: is being written by {}{}; {}", rival.what, holder_of(file), rival.detail, rival.advice));
}

OpenFile locked(std::string const& path, FileLock::Kind kind, FileLock::Wait wait, Rival const& rival) {
    for (;;) {
        OpenFile file(path, O_RDWR | O_CREAT);
        if (is_held_elsewhere(file.get(), operation_of(kind) | (wait == FileLock::Wait::no ? LOCK_NB : 0))) throw busy(file.get(), rival);
        if (is_named(file.get(), path)) return file;
    }
}

}  // namespace

FileLock::FileLock(std::string path, Kind kind, Wait wait, Rival const& rival) : file_(locked(path, kind, wait, rival)) {}

void FileLock::change(Kind kind, Rival const& rival) {
    if (is_held_elsewhere(file_.get(), operation_of(kind) | LOCK_NB)) throw busy(file_.get(), rival);
}

void FileLock::require_free(std::string const& path, Rival const& rival) {
    if (!is_there(path)) return;
    OpenFile const file(path, O_RDWR);  // as locks over a network ask for
    if (is_held_elsewhere(file.get(), LOCK_EX | LOCK_NB)) throw busy(file.get(), rival);
}

void FileLock::remove() { remove_file(file_.path()); }

}  // namespace slideway
