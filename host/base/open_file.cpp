#include "host/base/open_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

FileError cannot(std::string const& path, char const* action, int reason) {
    return FileError(fmt::format("{}: cannot {}: {}", path, action, std::strerror(reason)));
}

FileError no_file(std::string const& path, mode_t mode) {
    return FileError(path + (S_ISDIR(mode) ? ": is a folder; give the name of a file" : ": is a device or a pipe; give the name of a file"));
}

/// Looked at before it is opened, for opening alone sets some devices going, and after, for another may be there by then.
int open_checked(std::string const& path, int flags) {
    struct stat found {};
    bool const wants_folder = (flags & O_DIRECTORY) != 0;
    if (!wants_folder && stat(path.c_str(), &found) == 0 && !S_ISREG(found.st_mode)) throw no_file(path, found.st_mode);
    int const file = ::open(path.c_str(), flags | O_CLOEXEC | O_NONBLOCK, 0666);
    if (file < 0) throw cannot(path, (flags & O_CREAT) != 0 ? "create" : "open", errno);
    if (wants_folder || (fstat(file, &found) == 0 && S_ISREG(found.st_mode))) return file;
    ::close(file);
    throw no_file(path, found.st_mode);
}

/// Waits where a pipe has nothing yet.  @return as read(2)
ssize_t read_some(int file, char* to, std::size_t most) {
    for (;;) {
        ssize_t const got = ::read(file, to, most);
        if (got >= 0 || (errno != EINTR && errno != EAGAIN)) return got;
        pollfd wanted{file, POLLIN, 0};
        if (errno == EAGAIN) poll(&wanted, 1, -1);
    }
}

}  // namespace

OpenFile::OpenFile(std::string path, int flags) : path_(std::move(path)), file_(open_checked(path_, flags)) {}

OpenFile::~OpenFile() {
    if (file_ >= 0) ::close(file_);
}

OpenFile::OpenFile(OpenFile&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

void OpenFile::close() {
    if (::close(std::exchange(file_, -1)) != 0) throw cannot(path_, "write", errno);
}

void require_file(std::string const& path) {
    struct stat found {};
    if (stat(path.c_str(), &found) == 0 && !S_ISREG(found.st_mode)) throw no_file(path, found.st_mode);
}

bool is_file(std::string const& path) {
    struct stat found {};
    return stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode);
}

std::unique_ptr<std::istream> file_stream(std::string const& path) {
    require_file(path);
    errno = 0;
    auto stream = std::make_unique<std::ifstream>(path, std::ios::binary);
    if (!*stream) throw cannot(path, "read", errno);
    return stream;
}

std::string InputText::why() const { return error == EPIPE ? "nobody writes to this pipe" : std::strerror(error); }

InputText read_input(std::string const& path, std::size_t most) {
    InputText input;
    int const file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return {{}, errno};
    char part[1 << 16];
    for (ssize_t got = 1; got > 0 && input.text.size() <= most;) {
        got = read_some(file, part, std::min(sizeof part, most + 1 - input.text.size()));
        if (got < 0) input.error = errno;
        if (got > 0) input.text.append(part, static_cast<std::size_t>(got));
    }
    struct stat found {};
    if (input.text.empty() && input.error == 0 && fstat(file, &found) == 0 && S_ISFIFO(found.st_mode)) input.error = EPIPE;
    ::close(file);
    return input;
}

std::unique_ptr<std::istream> input_stream(std::string const& path) {
    if (is_file(path)) return file_stream(path);
    constexpr std::size_t most = std::size_t{1} << 28;
    InputText input = read_input(path, most);
    if (input.error != 0) throw FileError(fmt::format("{}: cannot read: {}", path, input.why()));
    if (input.text.size() > most) throw FileError(path + ": is larger than 256 MiB; give the name of a file");
    return std::make_unique<std::istringstream>(std::move(input.text));
}

}  // namespace slideway
