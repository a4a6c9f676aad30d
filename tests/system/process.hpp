// Runs the built program as a user does, in a folder of its own.
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace slideway::testing {

struct Outcome {
    int code;  // exit code; -signal if a signal ended the process
    std::string out, err;
};

inline std::string file_text(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether it comes true before half a minute is over.
template <class Condition> bool comes_true(Condition const& condition) {
    for (int i = 0; i < 15000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

/// Options of a run whose result is s.nc whatever they change, also where there is one, unless they say otherwise.
inline std::vector<std::string> to_result(std::vector<std::string> options) {
    auto const has = [&](std::initializer_list<char const*> names) {
        return std::any_of(options.begin(), options.end(),
                           [&](std::string const& word) { return std::find(names.begin(), names.end(), word) != names.end(); });
    };
    if (!has({"-o", "--member", "--members"})) options.insert(options.end(), {"-o", "s.nc"});
    if (!has({"--resume"})) options.push_back("--force");
    return options;
}

class Program : public ::testing::Test {
protected:
    Program() : folder_(std::filesystem::temp_directory_path() / ("slideway_cli_test_" + std::to_string(getpid()))) {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~Program() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path path(std::string const& name) const { return folder_ / name; }
    void write(std::string const& name, std::string const& text) const { std::ofstream(path(name)) << text; }

    /// Starts the program in the folder; its output goes to the files `out` and `err` there.
    pid_t start(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), SLIDEWAY_BINARY);
        pid_t const child = fork();
        if (child != 0) return child;
        std::vector<char*> words;
        for (std::string& argument : arguments) words.push_back(argument.data());
        words.push_back(nullptr);
        int const flags = O_WRONLY | O_CREAT | O_TRUNC;
        if (chdir(folder_.c_str()) != 0 || dup2(open("out", flags, 0600), 1) < 0 ||
            dup2(open("err", flags, 0600), 2) < 0) {
            _exit(127);
        }
        execv(SLIDEWAY_BINARY, words.data());
        _exit(127);
    }
    Outcome wait(pid_t child) const {
        int status = 0;
        if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid");
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), file_text(path("out")),
                file_text(path("err"))};
    }
    Outcome run(std::vector<std::string> arguments) const { return wait(start(std::move(arguments))); }

    /// The program refuses with one line on stderr, which contains `part`, and prints nothing else.
    void expect_refusal(int code, std::string const& part, std::vector<std::string> arguments) const {
        Outcome const outcome = run(std::move(arguments));
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }

    /// How many shards the folder lists.
    std::size_t shards_in(std::string const& shards) const {
        std::size_t count = 0;
        std::error_code ignored;
        for (std::filesystem::directory_iterator entry(path(shards), ignored), end; entry != end;
             entry.increment(ignored)) {
            if (!entry->path().filename().string().starts_with("manifest-")) continue;
            std::string const lines = file_text(entry->path());
            count += static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n'));
        }
        return count;
    }

private:
    std::filesystem::path folder_;
};

}  // namespace slideway::testing
