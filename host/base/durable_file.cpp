#include "host/base/durable_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"

namespace slideway {
namespace {

[[noreturn]] void fail(std::string const& path, char const* action, int reason) {
    throw FileError(fmt::format("{}: cannot {}: {}", path, action, std::strerror(reason)));
}

void write_all(int file, std::span<std::byte const> bytes, std::string const& path) {
    while (!bytes.empty()) {
        ssize_t const written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path, "write", errno);
        // Nothing written and no reason given: the next call would say the same for ever.
        if (written == 0) fail(path, "write", ENOSPC);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void sync(int file, std::string const& path) {
    if (::fsync(file) != 0) fail(path, "write to the disk", errno);
}

/// rename(2), or its form that leaves what is there alone.  @return 0 or the reason why not
int put_in_place(std::string const& from, std::string const& to, Existing existing) {
    if (existing == Existing::replaced) return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
    // Of file systems that cannot rename so, most can link.
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    if (::link(from.c_str(), to.c_str()) != 0) return errno;
    return ::unlink(from.c_str()) == 0 ? 0 : errno;
}

void sync_folder_for(std::string const& folder, std::string const& path) {
    OpenFile const file(folder, O_RDONLY | O_DIRECTORY);
    // Some file systems cannot, and need not.
    if (::fsync(file.get()) != 0 && errno != EINVAL) fail(path, "write to the disk", errno);
}

}  // namespace

std::string folder_of(std::string const& path) {
    std::string const folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? std::string(".") : folder;
}

void sync_folder(std::string const& path) { sync_folder_for(path, path); }

void sync_name(std::string const& path) { sync_folder_for(folder_of(path), path); }

NewFile::NewFile(std::string const& path, bool truncates) : file_(path, O_WRONLY | O_CREAT | (truncates ? O_TRUNC : O_EXCL)) {}

NewFile::~NewFile() {
    if (!finished_) ::unlink(file_.path().c_str());
}

void NewFile::append(std::span<std::byte const> bytes) { write_all(file_.get(), bytes, file_.path()); }

void NewFile::finish() {
    sync(file_.get(), file_.path());
    file_.close();
    finished_ = true;
}

void write_durably(std::string const& path, std::span<std::byte const> bytes) {
    std::string const temporary = path + ".tmp";
    NewFile file(temporary, true);
    file.append(bytes);
    file.finish();
    if (std::rename(temporary.c_str(), path.c_str()) != 0) {
        int const reason = errno;
        ::unlink(temporary.c_str());
        fail(path, "put in place", reason);
    }
    sync_name(path);
}

void write_durably(std::string const& path, std::string_view text) {
    write_durably(path, std::as_bytes(std::span(text)));
}

void rename_durably(std::string const& from, std::string const& to, Existing existing) {
    {
        OpenFile file(from, O_RDONLY);
        sync(file.get(), from);
    }
    if (int const reason = put_in_place(from, to, existing); reason != 0) {
        throw FileError(fmt::format("{}: cannot replace: {}; the results are in {}", to, std::strerror(reason), from));
    }
    sync_name(to);
}

void remove_file(std::string const& path) {
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) fail(path, "remove", errno);
}

void rename_file(std::string const& from, std::string const& to) {
    if (std::rename(from.c_str(), to.c_str()) != 0) fail(from, "rename", errno);
}

bool is_there(std::string const& path) {
    std::error_code error;
    auto const kind = std::filesystem::status(path, error).type();
    if (kind == std::filesystem::file_type::not_found) return false;
    if (error) fail(path, "look for it", error.value());
    return true;
}

std::string in_folder(std::string const& folder, std::string_view name) {
    return (std::filesystem::path(folder) / name).string();
}

void require_readable(std::string const& path) {
    OpenFile const file(path, O_RDONLY);
    char byte;
    if (::read(file.get(), &byte, 1) < 0) fail(path, "read", errno);
}

std::vector<std::byte> read_bytes(std::string const& path) {
    OpenFile const file(path, O_RDONLY);
    std::error_code ignored;
    auto const size = std::filesystem::file_size(path, ignored);
    // One more than there is: the end then shows without growing.
    constexpr std::size_t least = 1u << 16;
    std::vector<std::byte> bytes(ignored ? least : static_cast<std::size_t>(size) + 1);
    std::size_t used = 0;
    for (;;) {
        if (used == bytes.size()) bytes.resize(std::max(2 * used, least));
        ssize_t const got = ::read(file.get(), bytes.data() + used, bytes.size() - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(path, "read", errno);
        if (got == 0) break;
        used += static_cast<std::size_t>(got);
    }
    bytes.resize(used);
    return bytes;
}

std::string read_text(std::string const& path) {
    std::vector<std::byte> const bytes = read_bytes(path);
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

LineFile::LineFile(std::string path) : file_(std::move(path), O_WRONLY | O_CREAT | O_EXCL | O_APPEND) {}

void LineFile::append(std::string line) {
    line += '\n';
    write_all(file_.get(), std::as_bytes(std::span(line)), file_.path());
    sync(file_.get(), file_.path());
}

}  // namespace slideway
