// A library to preload: calls that write files under one folder fail when they are told to, as on a full or broken disk.
//
// SLIDEWAY_FAIL_UNDER  the folder; without it nothing is counted
// SLIDEWAY_FAIL_CALLS  families, comma-separated: open write sync rename link truncate mkdir unlink; all without it
// SLIDEWAY_FAIL_AT     the call that fails, from 1; none without it
// SLIDEWAY_FAIL_ERRNO  its errno: ENOSPC (also without it), EIO, or a number
// SLIDEWAY_FAIL_ONCE   1: only that call fails; else all later ones too
// SLIDEWAY_FAIL_SHORT  1: if that call writes more than a byte it writes half and says so, which is no failure
// SLIDEWAY_FAIL_COUNT  a file that always holds two 64-bit numbers: calls counted, calls that failed or were short
//
// Only calls that come through the dynamic linker are seen: what libc calls within itself (stdio's flushes) is not.
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <sys/uio.h>

#include "tests/support/failing_plan.hpp"

namespace {

template <class Function> Function* real(Function*, char const* name) {
    void* const symbol = dlsym(RTLD_NEXT, name);
    if (symbol == nullptr) abort();
    return reinterpret_cast<Function*>(symbol);
}

/// Not so where a library looks whether a file is there, and it is not: that fails anyhow.
bool writes_file(int at, char const* path, int flags) {
    if ((flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) == 0) return false;
    return (flags & O_CREAT) != 0 || syscall(SYS_faccessat, at, path, F_OK) == 0;
}

bool writes_file(char const* mode) { return strpbrk(mode, "wa+") != nullptr; }

}  // namespace

#define SLIDEWAY_REAL(name) static auto* const call = real(static_cast<decltype(&name)>(nullptr), #name)
#define SLIDEWAY_MODE()                                               \
    mode_t mode = 0;                                                  \
    if ((flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE) { \
        va_list arguments;                                            \
        va_start(arguments, flags);                                   \
        mode = static_cast<mode_t>(va_arg(arguments, int));           \
        va_end(arguments);                                            \
    }                                                                 \
    static_assert(true)

extern "C" {

int open(char const* path, int flags, ...) {
    SLIDEWAY_REAL(open);
    SLIDEWAY_MODE();
    if (writes_file(AT_FDCWD, path, flags) && fate(opens, 0, AT_FDCWD, path) == Fate::fails) return -1;
    return call(path, flags, mode);
}

int open64(char const* path, int flags, ...) {
    SLIDEWAY_REAL(open64);
    SLIDEWAY_MODE();
    if (writes_file(AT_FDCWD, path, flags) && fate(opens, 0, AT_FDCWD, path) == Fate::fails) return -1;
    return call(path, flags, mode);
}

int openat(int at, char const* path, int flags, ...) {
    SLIDEWAY_REAL(openat);
    SLIDEWAY_MODE();
    if (writes_file(at, path, flags) && fate(opens, 0, at, path) == Fate::fails) return -1;
    return call(at, path, flags, mode);
}

int openat64(int at, char const* path, int flags, ...) {
    SLIDEWAY_REAL(openat64);
    SLIDEWAY_MODE();
    if (writes_file(at, path, flags) && fate(opens, 0, at, path) == Fate::fails) return -1;
    return call(at, path, flags, mode);
}

int creat(char const* path, mode_t mode) {
    SLIDEWAY_REAL(creat);
    return fate(opens, 0, AT_FDCWD, path) == Fate::fails ? -1 : call(path, mode);
}

FILE* fopen(char const* path, char const* mode) {
    SLIDEWAY_REAL(fopen);
    return writes_file(mode) && fate(opens, 0, AT_FDCWD, path) == Fate::fails ? nullptr : call(path, mode);
}

FILE* fopen64(char const* path, char const* mode) {
    SLIDEWAY_REAL(fopen64);
    return writes_file(mode) && fate(opens, 0, AT_FDCWD, path) == Fate::fails ? nullptr : call(path, mode);
}

ssize_t write(int fd, void const* data, size_t bytes) {
    SLIDEWAY_REAL(write);
    Fate const f = fate(writes, bytes, fd);
    return f == Fate::fails ? -1 : call(fd, data, f == Fate::writes_half ? bytes / 2 : bytes);
}

ssize_t pwrite(int fd, void const* data, size_t bytes, off_t offset) {
    SLIDEWAY_REAL(pwrite);
    Fate const f = fate(writes, bytes, fd);
    return f == Fate::fails ? -1 : call(fd, data, f == Fate::writes_half ? bytes / 2 : bytes, offset);
}

ssize_t pwrite64(int fd, void const* data, size_t bytes, off64_t offset) {
    SLIDEWAY_REAL(pwrite64);
    Fate const f = fate(writes, bytes, fd);
    return f == Fate::fails ? -1 : call(fd, data, f == Fate::writes_half ? bytes / 2 : bytes, offset);
}

ssize_t writev(int fd, iovec const* parts, int count) {
    SLIDEWAY_REAL(writev);
    // Half of several parts: the first of them.
    Fate const f = fate(writes, count > 1 ? 2 : 0, fd);
    return f == Fate::fails ? -1 : call(fd, parts, f == Fate::writes_half ? 1 : count);
}

int fsync(int fd) {
    SLIDEWAY_REAL(fsync);
    return fate(syncs, 0, fd) == Fate::fails ? -1 : call(fd);
}

int fdatasync(int fd) {
    SLIDEWAY_REAL(fdatasync);
    return fate(syncs, 0, fd) == Fate::fails ? -1 : call(fd);
}

int rename(char const* from, char const* to) noexcept {
    SLIDEWAY_REAL(rename);
    return fate(renames, 0, AT_FDCWD, to) == Fate::fails ? -1 : call(from, to);
}

int renameat(int from_at, char const* from, int to_at, char const* to) noexcept {
    SLIDEWAY_REAL(renameat);
    return fate(renames, 0, to_at, to) == Fate::fails ? -1 : call(from_at, from, to_at, to);
}

int renameat2(int from_at, char const* from, int to_at, char const* to, unsigned flags) noexcept {
    SLIDEWAY_REAL(renameat2);
    return fate(renames, 0, to_at, to) == Fate::fails ? -1 : call(from_at, from, to_at, to, flags);
}

int link(char const* from, char const* to) noexcept {
    SLIDEWAY_REAL(link);
    return fate(links, 0, AT_FDCWD, to) == Fate::fails ? -1 : call(from, to);
}

int linkat(int from_at, char const* from, int to_at, char const* to, int flags) noexcept {
    SLIDEWAY_REAL(linkat);
    return fate(links, 0, to_at, to) == Fate::fails ? -1 : call(from_at, from, to_at, to, flags);
}

int ftruncate(int fd, off_t bytes) noexcept {
    SLIDEWAY_REAL(ftruncate);
    return fate(truncates, 0, fd) == Fate::fails ? -1 : call(fd, bytes);
}

int ftruncate64(int fd, off64_t bytes) noexcept {
    SLIDEWAY_REAL(ftruncate64);
    return fate(truncates, 0, fd) == Fate::fails ? -1 : call(fd, bytes);
}

int truncate(char const* path, off_t bytes) noexcept {
    SLIDEWAY_REAL(truncate);
    return fate(truncates, 0, AT_FDCWD, path) == Fate::fails ? -1 : call(path, bytes);
}

int mkdir(char const* path, mode_t mode) noexcept {
    SLIDEWAY_REAL(mkdir);
    return fate(mkdirs, 0, AT_FDCWD, path) == Fate::fails ? -1 : call(path, mode);
}

int mkdirat(int at, char const* path, mode_t mode) noexcept {
    SLIDEWAY_REAL(mkdirat);
    return fate(mkdirs, 0, at, path) == Fate::fails ? -1 : call(at, path, mode);
}

int unlink(char const* path) noexcept {
    SLIDEWAY_REAL(unlink);
    return fate(unlinks, 0, AT_FDCWD, path) == Fate::fails ? -1 : call(path);
}

int unlinkat(int at, char const* path, int flags) noexcept {
    SLIDEWAY_REAL(unlinkat);
    return fate(unlinks, 0, at, path) == Fate::fails ? -1 : call(at, path, flags);
}

int rmdir(char const* path) noexcept {
    SLIDEWAY_REAL(rmdir);
    return fate(unlinks, 0, AT_FDCWD, path) == Fate::fails ? -1 : call(path);
}

int remove(char const* path) noexcept {
    SLIDEWAY_REAL(remove);
    return fate(unlinks, 0, AT_FDCWD, path) == Fate::fails ? -1 : call(path);
}

}  // extern "C"
