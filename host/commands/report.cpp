#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <istream>
#include <system_error>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/commands/commands.hpp"
#include "host/store/output_target.hpp"
#include "host/store/result_view.hpp"

namespace slideway::cli {
namespace {

/// argv of a program, as the calls of POSIX want it.
class ArgumentList {
public:
    explicit ArgumentList(std::vector<std::string> words) : words_(std::move(words)) {
        for (std::string& word : words_) pointers_.push_back(word.data());
        pointers_.push_back(nullptr);
    }
    char* const* get() const { return pointers_.data(); }

private:
    std::vector<std::string> words_;
    std::vector<char*> pointers_;
};

std::string interpreter() {
    char const* const named = std::getenv("SLIDEWAY_PYTHON");
    return named && *named ? named : "python3";
}

FileError no_interpreter(std::string const& python, int reason) {
    return FileError(
        fmt::format("slideway report: cannot start {}: {}; install Python 3.10 or newer, or name an interpreter with "
                    "SLIDEWAY_PYTHON=PATH",
                    python, std::strerror(reason)));
}

/// Whether the interpreter finds the Python package; that takes a fraction of what importing it does.
bool has_package(std::string const& python) {
    ArgumentList const words({python, "-c",
                              "import importlib.util as u, sys; s = u.find_spec('slideway'); "
                              "sys.exit(0 if s and s.origin else 1)"});
    pid_t child = 0;
    int const error = posix_spawnp(&child, python.c_str(), nullptr, nullptr, words.get(), environ);
    if (error != 0) throw no_interpreter(python, error);
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) throw no_interpreter(python, errno);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// As the Python package marks its pages.
bool is_page(std::string const& path) {
    constexpr std::size_t head = 1024;
    std::string text(head, '\0');
    file_stream(path)->read(text.data(), head);
    return text.find("<meta name=\"generator\" content=\"slideway\">") != text.npos;
}

}  // namespace

int execute(ReportArguments const& arguments) {
    std::string page = arguments.output;
    if (page.empty()) page = std::filesystem::path(arguments.path).replace_extension(".html").string();
    std::string const inputs[] = {arguments.path};
    OutputTarget const target(page, {inputs, arguments.force, is_page});
    require_intact(arguments.path);
    // Packages come from where they are installed, not from whatever lies in this folder.
    setenv("PYTHONSAFEPATH", "1", 1);
    // The Python package has files checked by this program, unless the user names one.
    std::error_code ignored;
    setenv("SLIDEWAY_PROGRAM", std::filesystem::read_symlink("/proc/self/exe", ignored).c_str(), 0);
    std::string const python = interpreter();
    if (!has_package(python)) {
        throw FileError(fmt::format(
            "slideway report: {} has no package slideway; install it with pip install . in the source "
            "tree, and if that was in a virtual environment, name its interpreter with SLIDEWAY_PYTHON=PATH",
            python));
    }
    ArgumentList const words({python, "-m", "slideway", "report", "--force", "--output=" + target.path(), "--", arguments.path});
    execvp(python.c_str(), words.get());
    throw no_interpreter(python, errno);
}

}  // namespace slideway::cli
