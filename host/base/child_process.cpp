#include "host/base/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>

extern "C" char** environ;

namespace slideway {

ChildEnd run_child(std::vector<std::string> words, std::string const& log, CtrlC interrupt) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    posix_spawnattr_t apart{};
    posix_spawnattr_init(&apart);
    if (interrupt == CtrlC::is_not_for_it) posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    ChildEnd end;
    end.error = posix_spawnp(&child, arguments.front(), &files, &apart, arguments.data(), environ);
    posix_spawnattr_destroy(&apart);
    posix_spawn_file_actions_destroy(&files);
    if (end.error != 0) return end;
    while (waitpid(child, &end.status, 0) < 0) {
        if (errno == EINTR) continue;
        end.status = 0;
        break;
    }
    return end;
}

}  // namespace slideway
