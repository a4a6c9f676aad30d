#include "host/base/process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

constexpr char end_of_answer = '\0';  // an answer without it was cut short

void limit(decltype(RLIMIT_CPU) what, std::uint64_t amount) {
    rlimit now{};
    if (getrlimit(what, &now) != 0) return;
    now.rlim_cur = std::min<rlim_t>(amount, now.rlim_max);
    setrlimit(what, &now);
}

/// Neither a core nor what the C library says as it aborts.  A signal to the whole job is its parent's to obey, whose end is its end: else a
/// stopped check would look like a damaged file.  A limit of the processor's time is its own.
void be_quiet(ApartLimits const& limits) {
    for (StopSignal const& one : stop_signals) std::signal(one.number, one.number == SIGXCPU ? SIG_DFL : SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_DUMPABLE, 0);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.cpu_seconds);
    limit(RLIMIT_AS, mapped_bytes() + limits.bytes);
    int const nothing = open("/dev/null", O_RDWR);
    for (int const stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
}

[[noreturn]] void work_and_leave(int pipe, std::function<std::string()> const& work, ApartLimits const& limits) {
    be_quiet(limits);
    try {
        std::string const answer = work() + end_of_answer;
        for (std::string_view rest = answer; !rest.empty();) {
            ssize_t const written = write(pipe, rest.data(), rest.size());
            if (written < 0 && errno != EINTR) break;
            rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
        }
    } catch (...) {
    }
    _exit(0);
}

std::string read_all(int pipe) {
    std::string text;
    std::array<char, 4096> piece;
    for (;;) {
        ssize_t const got = read(pipe, piece.data(), piece.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return text;
        text.append(piece.data(), static_cast<std::size_t>(got));
    }
}

}  // namespace

ApartOutcome run_apart(std::function<std::string()> const& work, ApartLimits const& limits) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw FileError(fmt::format("slideway: cannot open a pipe: {}", std::strerror(errno)));
    pid_t const child = fork();
    if (child == 0) work_and_leave(ends[1], work, limits);
    int const reason = errno;
    close(ends[1]);
    std::string text = child > 0 ? read_all(ends[0]) : std::string();
    close(ends[0]);
    if (child < 0) throw FileError(fmt::format("slideway: cannot start a process: {}", std::strerror(reason)));
    ApartOutcome outcome;
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno == EINTR) continue;
        status = 0;  // whoever started this process wants to hear of no children
        break;
    }
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    if (outcome.signal == 0 && text.ends_with(end_of_answer)) {
        text.pop_back();
        outcome.answer = std::move(text);
    }
    return outcome;
}

namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t soft_limit(decltype(RLIMIT_AS) what) {
    rlimit limit{};
    return getrlimit(what, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ? unlimited : limit.rlim_cur;
}

}  // namespace

std::uint64_t mapped_bytes() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t memory_room() {
    std::uint64_t const limit = soft_limit(RLIMIT_AS);
    return limit == unlimited ? unlimited : limit - std::min(limit, mapped_bytes());
}

std::uint64_t bytes_of_threads(int threads) {
    constexpr std::uint64_t least_stack = 2 << 20, most_stack = 64 << 20, beside = 16 << 20;
    std::uint64_t const stack = soft_limit(RLIMIT_STACK);
    return static_cast<std::uint64_t>(threads) * (beside + (stack == unlimited ? least_stack : std::min(stack, most_stack)));
}

void require_memory(std::uint64_t bytes) {
    if (memory_room() < bytes) throw std::bad_alloc();
}

}  // namespace slideway
