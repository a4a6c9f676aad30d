// Commands of a shell, and what came of them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/wait.h>

namespace slideway::testing {

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
