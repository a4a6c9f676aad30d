// The one way in which the program opens what has to be a file.  A pipe, a device or a folder of its name is refused in one line: whoever
// opened a pipe without looking would wait for its other end for ever.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <string>

namespace slideway {

/// An open file that is closed whatever happens.
class OpenFile {
public:
    /// @param flags as of open(2)  @throws FileError if it cannot be opened, or is no file (a folder if O_DIRECTORY is set)
    OpenFile(std::string path, int flags);
    ~OpenFile();
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&&) = delete;

    int get() const { return file_; }
    std::string const& path() const { return path_; }
    /// Network file systems tell only here that something was not written.  @throws FileError
    void close();

private:
    std::string path_;
    int file_;
};

/// For libraries that open by name.  @throws FileError if there is something of this name and it is no file; what is missing is theirs to tell
void require_file(std::string const& path);

/// Whether there is a file of this name, links followed.
bool is_file(std::string const& path);

/// A file to read as a stream.  @throws FileError
std::unique_ptr<std::istream> file_stream(std::string const& path);

/// What a user names as a text to read once: a file, or a pipe that somebody writes to already (a shell's `<(...)`, /dev/stdin).  One that
/// nobody writes to ends at once.
struct InputText {
    std::string text;  // at most one byte more than asked for
    int error = 0;     // errno of what failed
    std::string why() const;  // in words
};
InputText read_input(std::string const& path, std::size_t most);

/// The same to read as a stream: files as they come, pipes up to 256 MiB.  @throws FileError
std::unique_ptr<std::istream> input_stream(std::string const& path);

}  // namespace slideway
