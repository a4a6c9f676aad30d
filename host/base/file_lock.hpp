// A lock that ends with the process that holds it, however it ends.
#pragma once

#include <string>

namespace slideway {

/// Holds flock on a file that is there for nothing else; makes the file.  Where a file system has no locks, it is had at once.
class FileLock {
public:
    enum class Kind { shared, alone };
    enum class Wait { no, yes };

    /// @param rival the line of the FileError if another process holds the lock and `wait` is no.  @throws FileError
    FileLock(std::string path, Kind kind, Wait wait, std::string const& rival = {});
    ~FileLock();
    FileLock(FileLock const&) = delete;
    FileLock& operator=(FileLock const&) = delete;

    /// Another kind of a lock that is held, without waiting.  @throws FileError, with the line `rival`, if others hold it too
    void change(Kind kind, std::string const& rival);
    /// Removes the file while the lock on it is held; who waits for it then makes a new one.  @throws FileError
    void remove();

private:
    std::string const path_;
    int file_ = -1;
};

}  // namespace slideway
