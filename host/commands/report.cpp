#include <cerrno>
#include <cstdlib>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <istream>
#include <system_error>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
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
    return FileError(fmt::format("slideway: cannot start {}: {}; install Python 3.10 or newer, or name an interpreter with SLIDEWAY_PYTHON=PATH", python,
                                 std::strerror(reason)));
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

/// As the Python package marks what it makes.
bool is_marked(std::string const& path, std::string_view mark) {
    constexpr std::size_t head = 2048;
    std::string text(head, '\0');
    file_stream(path)->read(text.data(), head);
    return text.find(mark) != text.npos;
}

/// Becomes the Python package with these words; it returns only by an exception.  @param command that needs it
[[noreturn]] void become_package(std::string_view command, std::vector<std::string> words) {
    // Packages come from where they are installed, not from whatever lies in this folder.
    setenv("PYTHONSAFEPATH", "1", 1);
    // The Python package has files checked by this program, unless the user names one.
    std::error_code ignored;
    setenv("SLIDEWAY_PROGRAM", std::filesystem::read_symlink("/proc/self/exe", ignored).c_str(), 0);
    std::string const python = interpreter();
    if (!has_package(python)) {
        throw FileError(fmt::format("slideway {}: {} has no package slideway; install it with pip install . in the source tree, and if that was in a virtual "
                                    "environment, name its interpreter with SLIDEWAY_PYTHON=PATH", command, python));
    }
    words.insert(words.begin(), {python, "-m", "slideway"});
    execvp(python.c_str(), ArgumentList(std::move(words)).get());
    throw no_interpreter(python, errno);
}

}  // namespace

int execute(ReportArguments const& arguments) {
    std::string page = arguments.output;
    if (page.empty()) page = std::filesystem::path(arguments.path).replace_extension(".html").string();
    std::string const inputs[] = {arguments.path};
    OutputTarget const target(page, {inputs, arguments.force, [](std::string const& path) { return is_marked(path, "<meta name=\"generator\" content=\"slideway\">"); }});
    require_intact(arguments.path);
    become_package("report", {"report", "--force", "--output=" + target.path(), "--", arguments.path});
}

OutputTarget drawing_target(CheckArguments const& arguments) {
    std::string_view const name = arguments.drawing;
    if (!name.ends_with(".svg") && !name.ends_with(".png")) throw SceneError(fmt::format("--draw {}: give a file that ends in .svg or .png", name));
    std::string const inputs[] = {arguments.scene.path};
    return {arguments.drawing, {inputs, arguments.force, [](std::string const& path) { return is_marked(path, "slideway"); }}};
}

void draw(OutputTarget const& target, std::string const& drawing) {
    int const memory = memfd_create("drawing", 0);
    bool const written = memory >= 0 && write(memory, drawing.data(), drawing.size()) == static_cast<ssize_t>(drawing.size());
    if (!written || lseek(memory, 0, SEEK_SET) != 0 || dup2(memory, STDIN_FILENO) < 0) throw FileError(fmt::format("--draw: {}", std::strerror(errno)));
    std::fflush(stdout);
    become_package("check --draw", {"draw", "--output=" + target.path()});
}

}  // namespace slideway::cli
