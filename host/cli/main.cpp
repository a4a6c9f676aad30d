#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <new>
#include <system_error>

#include <fmt/format.h>

#include "host/cli/commands.hpp"

namespace {

using namespace slideway;
using namespace slideway::cli;

int dispatch(Arguments const& arguments) {
    struct Visitor {
        int operator()(RunArguments const& given) const { return run(given); }
        int operator()(CheckArguments const& given) const { return check(given); }
        int operator()(ProbeArguments const& given) const { return probe(given); }
        int operator()(InfoArguments const& given) const { return info(given); }
        int operator()(StatsArguments const& given) const { return stats(given); }
        int operator()(ListArguments const& given) const { return list(given); }
        int operator()(TextOnly const& only) const {
            fmt::print("{}", only.text);
            return exit_code::done;
        }
    };
    return std::visit(Visitor{}, arguments);
}

int complain(int code, std::string_view line) {
    fmt::print(stderr, "{}\n", line);
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
        int const code = dispatch(parse_arguments(argc, argv));
        std::cout.flush();
        if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout)) {
            return complain(exit_code::file_trouble, "slideway: cannot write to the standard output");
        }
        return code;
    } catch (SceneError const& error) {
        return complain(exit_code::bad_usage, error.what());
    } catch (FileError const& error) {
        complain_of_file(error.what());
    } catch (std::bad_alloc const&) {
        return complain(exit_code::file_trouble, "slideway: not enough memory; ask for fewer members or samples");
    } catch (std::system_error const& error) {
        return complain(exit_code::file_trouble, fmt::format("slideway: {}", error.what()));
    } catch (std::exception const& error) {
        return complain(exit_code::internal_error, fmt::format("slideway: internal error: {}", error.what()));
    }
}
