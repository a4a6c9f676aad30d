// This process: its memory, the signals that end it early, and work in one apart, for libraries that crash on what a damaged file holds.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace slideway {

struct ApartLimits {
    std::uint64_t cpu_seconds;  // of the processor's time: neither a slow disk nor a busy machine uses it up
    std::uint64_t bytes;        // of memory, beyond what this process has mapped
};

/// What came of it.
struct ApartOutcome {
    std::optional<std::string> answer;  // what the work returned; nothing where the process died, or the work threw
    int signal = 0;                     // that it died by; 0: by none, or nobody knows
};

/// Does the work in a forked copy of this process, which says nothing, leaves no core and runs no handlers of its exit, and waits for it.
/// Nothing that it changes is seen here.  Of the threads of this process only the caller is there.
/// @throws FileError if no process can be started
ApartOutcome run_apart(std::function<std::string()> const& work, ApartLimits const& limits);

// How much memory this process may still take, where a limit says so (ulimit -v, RLIMIT_AS).

/// [B] of address space that the process has mapped.
std::uint64_t mapped_bytes();

/// [B] that it may still map; the largest number where there is no limit.
std::uint64_t memory_room();

/// [B] that so many threads take before they do anything: their stacks, and what the C library keeps for each.
std::uint64_t bytes_of_threads(int threads);

/// Asked before libraries are that find no words for a lack of memory: they crash, end the process, or take a file for damaged.
/// @throws std::bad_alloc if there is less room
void require_memory(std::uint64_t bytes);

// The signals that end a run early with what it has finished.

struct StopSignal {
    int number;
    bool repeats;  // senders repeat it without meaning more: only of the others a second one ends the process at once
};

/// Of terminals and users (INT, QUIT, TERM), of a terminal that closes (HUP, from the kernel and from the shell), of job schedulers ahead of a
/// kill (USR1, USR2, TERM, XCPU), of limits (XCPU, every second from the soft one on; ALRM).  What is ignored when a process starts stays
/// ignored, as nohup has it.
inline constexpr StopSignal stop_signals[] = {{SIGINT, false}, {SIGTERM, false}, {SIGQUIT, false}, {SIGHUP, true},
                                              {SIGUSR1, true}, {SIGUSR2, true},  {SIGXCPU, true},  {SIGALRM, true}};

}  // namespace slideway
