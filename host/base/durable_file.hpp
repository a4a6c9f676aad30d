// Files that are there whole or not at all, whatever ends the process or the machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/open_file.hpp"

namespace slideway {

/// What becomes of a file that is there when another is put in its place.
enum class Existing {
    replaced,
    kept  // it is refused
};

/// Puts a file into place: writes `path`.tmp, fsync, rename, fsync of the folder.  So `path` holds what it held before or all of
/// `bytes`, also after a power loss.  Of folders that are slideway's own, where nobody else has a `path`.tmp.
/// @throws FileError; `path` is then as before, but for a failed fsync of the folder, which comes last: `path` then holds all of `bytes`,
/// and a power loss may bring back what it held before.
void write_durably(std::string const& path, std::span<std::byte const> bytes);
void write_durably(std::string const& path, std::string_view text);

/// A new file that is written piece by piece, and gone again unless `finish` has put it on the disk.
class NewFile {
public:
    /// @param truncates one of this name that is there, which else is refused  @throws FileError
    explicit NewFile(std::string const& path, bool truncates = false);
    ~NewFile();
    void append(std::span<std::byte const> bytes);
    void append(std::string_view text) { append(std::as_bytes(std::span(text))); }
    void finish();

private:
    OpenFile file_;
    bool finished_ = false;
};

/// The last steps for a file that another library wrote: fsync, rename, fsync of the folder.  @throws FileError; `from` then stays.
void rename_durably(std::string const& from, std::string const& to, Existing existing = Existing::replaced);

/// What must not stay; what is not there is no matter.  @throws FileError
void remove_file(std::string const& path);
/// Without a word to the disk.  @throws FileError
void rename_file(std::string const& from, std::string const& to);

/// Makes new names and removals in a folder last.  @throws FileError
void sync_folder(std::string const& path);
/// The same for the folder that a path lies in.  @throws FileError, of the path
void sync_name(std::string const& path);

/// The folder that a path lies in; "." for a bare name.
std::string folder_of(std::string const& path);

/// `name` in a folder.
std::string in_folder(std::string const& folder, std::string_view name);

/// Whether there is something of this name.  @throws FileError if that cannot be told: a disk that fails is no missing file.
bool is_there(std::string const& path);

/// @throws FileError with the reason where a file cannot be opened, or its first byte not be read.
void require_readable(std::string const& path);

/// @throws FileError if it cannot be read, or is no file.
std::vector<std::byte> read_bytes(std::string const& path);
std::string read_text(std::string const& path);

/// A file that grows by lines, each on the disk before `append` returns.
class LineFile {
public:
    /// @throws FileError, also if there is such a file already.
    explicit LineFile(std::string path);
    /// @param line without its end.  @throws FileError; the file may then end with a part of the line
    void append(std::string line);

private:
    OpenFile file_;
};

}  // namespace slideway
