#include "tests/system/process.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace slideway::testing {
namespace fs = std::filesystem;

std::string file_text(fs::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> to_result(std::vector<std::string> options) {
    auto const has = [&](std::initializer_list<char const*> names) {
        return std::any_of(options.begin(), options.end(),
                           [&](std::string const& word) { return std::find(names.begin(), names.end(), word) != names.end(); });
    };
    if (!has({"-o", "--member", "--members"})) options.insert(options.end(), {"-o", "s.nc"});
    if (!has({"--resume"})) options.push_back("--force");
    return options;
}

Program::Program()
    : folder_(fs::temp_directory_path() / ("slideway_cli_test_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
}

Program::~Program() { fs::remove_all(folder_); }

void Program::write(std::string const& name, std::string const& text) const { std::ofstream(path(name)) << text; }

pid_t Program::start(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), tested_program);
    pid_t const child = fork();
    if (child != 0) return child;
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    int const flags = O_WRONLY | O_CREAT | O_TRUNC;
    if (chdir(folder_.c_str()) != 0 || dup2(open("out", flags, 0600), 1) < 0 || dup2(open("err", flags, 0600), 2) < 0) {
        _exit(127);
    }
    execv(tested_program, words.data());
    _exit(127);
}

Outcome Program::wait(pid_t child) const {
    int status = 0;
    if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), file_text(path("out")), file_text(path("err"))};
}

Outcome Program::run(std::vector<std::string> arguments) const { return wait(start(std::move(arguments))); }

void Program::expect_refusal(int code, std::string const& part, std::vector<std::string> arguments) const {
    Outcome const outcome = run(std::move(arguments));
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
}

std::size_t Program::shards_in(std::string const& shards) const {
    std::size_t count = 0;
    std::error_code ignored;
    for (fs::directory_iterator entry(path(shards), ignored), end; entry != end; entry.increment(ignored)) {
        if (!entry->path().filename().string().starts_with("manifest-")) continue;
        std::string const lines = file_text(entry->path());
        count += static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n'));
    }
    return count;
}

}  // namespace slideway::testing
