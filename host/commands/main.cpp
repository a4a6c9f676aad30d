#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string_view>

#include "host/commands/commands.hpp"

namespace {

using namespace slideway;
using namespace slideway::cli;

/// The code counts even where nobody can read the line.
int complain(int code, std::string_view line) {
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fputc('\n', stderr);
    return code;
}

/// HDF5 crashes in its exit handler over a file that it could not write, so there no handlers may run.
[[noreturn]] void complain_of_file(std::string_view line) {
    std::fflush(stdout);
    complain(exit_code::file_trouble, line);
    std::_Exit(exit_code::file_trouble);
}

}  // namespace

int main(int argc, char** argv) {
    // A full quota then is an error of the write, not the end of the process.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        int const code = std::visit([](auto const& given) { return execute(given); }, parse_arguments(argc, argv));
        std::cout.flush();
        if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout)) {
            return complain(exit_code::file_trouble, "slideway: cannot write to the standard output");
        }
        return code;
    } catch (FileError const& error) {
        complain_of_file(error.what());
    } catch (...) {
        Complaint const complaint = complaint_of(std::current_exception());
        return complain(complaint.code, complaint.line);
    }
}
