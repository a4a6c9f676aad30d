// Starts programs under mpirun: several ranks on however few cores, also as root.  The variables are Open MPI's; other
// launchers ignore them.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/shell.hpp"

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

}  // namespace slideway::testing
