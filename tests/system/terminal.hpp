// A program on a terminal of a given width, as a user sees it.
#pragma once

#include <string>
#include <vector>

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace slideway::testing {

/// What the program writes to a terminal of so many columns.
inline std::string on_terminal(std::vector<std::string> arguments, unsigned short columns) {
    arguments.insert(arguments.begin(), SLIDEWAY_BINARY);
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    winsize size{40, columns, 0, 0};
    int terminal = -1;
    pid_t const child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        execv(SLIDEWAY_BINARY, words.data());
        _exit(127);
    }
    std::string text;
    char part[4096];
    for (ssize_t count = 0; (count = read(terminal, part, sizeof part)) > 0;) text.append(part, static_cast<std::size_t>(count));
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    std::erase(text, '\r');
    return text;
}

}  // namespace slideway::testing
