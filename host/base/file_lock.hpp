// A lock that ends with the process that holds it, however it ends.
#pragma once

#include <string>

#include "host/base/open_file.hpp"

namespace slideway {

/// What is said to whoever finds a lock held: "s.nc.shards: is being written by process 1234; wait for its end or give another name with -o".
struct Rival {
    std::string what;  // is being written
    std::string detail = {};  // behind who writes it
    std::string advice = "wait for its end or give another name with -o";
};

/// Holds flock on a file that is there for nothing else; makes the file.  Where a file system has no locks, it is had at once.
class FileLock {
public:
    enum class Kind { shared, alone };
    enum class Wait { no, yes };

    /// @param rival what the FileError says if another process holds the lock and `wait` is no.  @throws FileError, also if `path` is no file
    FileLock(std::string path, Kind kind, Wait wait, Rival const& rival = {});
    /// Another kind of a lock that is held, without waiting.  @throws FileError if others hold it too
    void change(Kind kind, Rival const& rival);
    /// That nobody holds a lock, whether its file is there or not; nothing is made or written.  @throws FileError
    static void require_free(std::string const& path, Rival const& rival);
    /// Removes the file while the lock on it is held; who waits for it then makes a new one.  @throws FileError
    void remove();

private:
    OpenFile file_;
};

}  // namespace slideway
