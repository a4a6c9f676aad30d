#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include "host/backend/kernel_modules.hpp"
#include "host/base/process.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"

namespace {

using namespace slideway;
using namespace slideway::cli;

/// The code counts even where nobody can read the line.
int complain(int code, std::string_view line) {
    tell_text(line);
    return code;
}

/// HDF5 crashes in its exit handler over a file that it could not write, so there no handlers may run.
[[noreturn]] void complain_of_file(std::string_view line) {
    output_failure();
    complain(exit_code::file_trouble, line);
    std::_Exit(exit_code::file_trouble);
}

/// A stream that was closed before the start stays closed to what is written to it: else the next file that is opened would have its number,
/// and be written to in its place.
void hold_closed_streams() {
    for (int const stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

/// Of a pipe whose reader has gone a process hears by SIGPIPE, as users of `| head` expect; but not before its work is done.
class PipeSignal {
public:
    PipeSignal() : former_(std::signal(SIGPIPE, SIG_IGN)) {}
    void raise_if(bool reader_is_gone) const {
        if (!reader_is_gone || former_ != SIG_DFL) return;
        std::signal(SIGPIPE, SIG_DFL);
        std::raise(SIGPIPE);
    }

private:
    void (*const former_)(int);
};

int finish(int code, PipeSignal const& pipe) {
    int const failure = output_failure();
    if (failure == 0) return code;
    pipe.raise_if(failure == EPIPE);
    return complain(exit_code::file_trouble, "slideway: cannot write to the standard output");
}

}  // namespace

int main(int argc, char** argv) {
    hold_closed_streams();
    // A full quota then is an error of the write, not the end of the process.
    std::signal(SIGXFSZ, SIG_IGN);
    PipeSignal const pipe;
    on_compiling([](std::string const& line) { tell("{}\n", line); });
    try {
        constexpr std::uint64_t least_memory = 16 << 20;
        require_memory(least_memory);
        return finish(std::visit([](auto const& given) { return execute(given); }, parse_arguments(argc, argv)), pipe);
    } catch (FileError const& error) {
        complain_of_file(error.what());
    } catch (...) {
        Complaint const complaint = complaint_of(std::current_exception());
        return complain(complaint.code, complaint.line);
    }
}
