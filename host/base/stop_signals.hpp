// The signals that end a run early with what it has finished.
#pragma once

#include <csignal>

namespace slideway {

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
