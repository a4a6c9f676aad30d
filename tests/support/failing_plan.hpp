// Which calls fail, read from the environment: see failing_calls.cpp, the only file that includes this.
#pragma once

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace {

enum Family : unsigned {
    opens = 1,
    writes = 2,
    syncs = 4,
    renames = 8,
    links = 16,
    truncates = 32,
    mkdirs = 64,
    unlinks = 128
};

struct Counts {
    std::atomic<std::uint64_t> counted, failed;
};
static_assert(sizeof(Counts) == 16 && std::atomic<std::uint64_t>::is_always_lock_free);

// No constructors and no allocation: calls may come before this library's and after the program's own end.
struct Plan {
    char folder[PATH_MAX] = "";
    std::size_t folder_length = 0;
    unsigned families = ~0u;
    std::uint64_t at = 0;
    int error = ENOSPC;
    bool once = false, is_short = false;
    Counts* counts = nullptr;
};
Plan plan;
Counts own_counts;
std::atomic<bool> is_ready = false;

char const* variable(char const* name) {
    char const* const text = getenv(name);
    return text != nullptr && *text != '\0' ? text : nullptr;
}

unsigned families_in(std::string_view list) {
    constexpr std::string_view names[] = {"open", "write", "sync", "rename", "link", "truncate", "mkdir", "unlink"};
    unsigned found = 0;
    while (!list.empty()) {
        std::string_view const word = list.substr(0, list.find(','));
        for (unsigned i = 0; i < 8; ++i) {
            if (word == names[i]) found |= 1u << i;
        }
        list.remove_prefix(word.size() < list.size() ? word.size() + 1 : word.size());
    }
    return found;
}

__attribute__((constructor)) void read_plan() {
    plan.counts = &own_counts;
    char const* const under = variable("SLIDEWAY_FAIL_UNDER");
    if (under == nullptr || realpath(under, plan.folder) == nullptr) return;
    plan.folder_length = strlen(plan.folder);
    if (char const* const list = variable("SLIDEWAY_FAIL_CALLS")) plan.families = families_in(list);
    if (char const* const at = variable("SLIDEWAY_FAIL_AT")) plan.at = strtoull(at, nullptr, 10);
    if (char const* const name = variable("SLIDEWAY_FAIL_ERRNO")) {
        plan.error = strcmp(name, "ENOSPC") == 0 ? ENOSPC : strcmp(name, "EIO") == 0 ? EIO : atoi(name);
    }
    plan.once = variable("SLIDEWAY_FAIL_ONCE") != nullptr && *variable("SLIDEWAY_FAIL_ONCE") == '1';
    plan.is_short = variable("SLIDEWAY_FAIL_SHORT") != nullptr && *variable("SLIDEWAY_FAIL_SHORT") == '1';
    if (char const* const file = variable("SLIDEWAY_FAIL_COUNT")) {
        auto const fd = static_cast<int>(syscall(SYS_openat, AT_FDCWD, file, O_RDWR | O_CREAT | O_CLOEXEC, 0600));
        // Mapped, the numbers outlive the process however it ends.
        if (fd >= 0 && syscall(SYS_ftruncate, fd, sizeof(Counts)) == 0) {
            void* const memory = mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
            if (memory != MAP_FAILED) plan.counts = static_cast<Counts*>(memory);
        }
        if (fd >= 0) syscall(SYS_close, fd);
    }
    is_ready = true;
}

/// Whether a path without links lies in the folder or is it.
bool lies_under(char const* path) {
    return strncmp(path, plan.folder, plan.folder_length) == 0 &&
           (path[plan.folder_length] == '/' || path[plan.folder_length] == '\0');
}

bool is_ours(int fd) {
    char link[40], path[PATH_MAX];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    auto const length = syscall(SYS_readlinkat, AT_FDCWD, link, path, sizeof path - 1);
    if (length <= 0) return false;
    path[length] = '\0';
    return lies_under(path);
}

/// The file need not be there, so the folder that it is or would be in decides.
bool is_ours(int at, char const* name) {
    char full[2 * PATH_MAX], resolved[PATH_MAX];
    if (name == nullptr || *name == '\0') return false;
    if (*name == '/' || at == AT_FDCWD) {
        snprintf(full, sizeof full, "%s", name);
    } else {
        snprintf(full, sizeof full, "/proc/self/fd/%d/%s", at, name);
    }
    char* const slash = strrchr(full, '/');
    if (slash == nullptr) return realpath(".", resolved) != nullptr && lies_under(resolved);
    *slash = '\0';
    return realpath(slash == full ? "/" : full, resolved) != nullptr && lies_under(resolved);
}

enum class Fate { passes, fails, writes_half };

/// Counts a call and says what becomes of it.
template <class... Where> Fate fate(Family family, std::size_t bytes, Where... where) {
    if (!is_ready || (plan.families & family) == 0) return Fate::passes;
    int const before = errno;
    bool const ours = is_ours(where...);
    errno = before;
    if (!ours) return Fate::passes;
    std::uint64_t const call = plan.counts->counted.fetch_add(1) + 1;
    if (plan.at == 0 || call < plan.at) return Fate::passes;
    std::uint64_t const late = call - plan.at;
    if (plan.once && late > 0) return Fate::passes;
    plan.counts->failed.fetch_add(1);
    if (plan.is_short && late == 0 && bytes > 1) return Fate::writes_half;
    errno = plan.error;
    return Fate::fails;
}

}  // namespace
