// Starts programs under mpirun: several ranks on however few cores, also as root.  The variables are Open MPI's; other
// launchers ignore them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/wait.h>

namespace slideway::testing {

/// Why ranks cannot be tested here; empty if they can.
inline std::string why_no_ranks() {
    std::string const launcher = SLIDEWAY_MPIEXEC;
    if (launcher.empty()) return "configured without MPI";
    return std::filesystem::exists(launcher) ? std::string() : launcher + " is not there";
}

/// The start of a shell command that runs what follows on `ranks` ranks.  What hangs is ended after `seconds`.
inline std::string mpirun(int ranks, int seconds = 100) {
    std::string const settings =
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
        "PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe OMPI_MCA_hwloc_base_binding_policy=none "
        "OMPI_MCA_btl_vader_single_copy_mechanism=none ASAN_OPTIONS=detect_leaks=0 ";
    return settings + "timeout -k 5 " + std::to_string(seconds) + " '" + SLIDEWAY_MPIEXEC + "' -n " +
           std::to_string(ranks) + " ";
}

struct ShellOutcome {
    int code = 0;  // exit code; -signal if a signal ended the shell
    std::string out, err;
};

/// Runs a command of a shell in `folder`.  Its output goes to the files `shell_out` and `shell_err` there.
inline ShellOutcome run_shell(std::filesystem::path const& folder, std::string const& command) {
    std::string const line = "cd '" + folder.string() + "' && { " + command + " ; } >shell_out 2>shell_err </dev/null";
    int const status = std::system(line.c_str());
    auto const text = [&](char const* name) {
        std::ifstream in(folder / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), text("shell_out"), text("shell_err")};
}

}  // namespace slideway::testing
