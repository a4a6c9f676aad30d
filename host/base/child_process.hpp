// A program that runs to its end beside this one: a compiler.
#pragma once

#include <string>
#include <vector>

namespace slideway {

/// How it ended.
struct ChildEnd {
    int error = 0;   // errno where it did not start
    int status = 0;  // of waitpid(2); 0 also where nobody wants to hear of children
    bool done() const { return error == 0 && status == 0; }
};

/// Whether a terminal's Ctrl-C ends it too.
enum class CtrlC { ends_it, is_not_for_it };

/// Runs it with its input empty and its output in the file `log`.  @param words the program, found on the PATH, and its arguments
ChildEnd run_child(std::vector<std::string> words, std::string const& log, CtrlC interrupt);

}  // namespace slideway
