// Work in a process apart, for libraries that crash on what a damaged file holds.
#pragma once

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

}  // namespace slideway
