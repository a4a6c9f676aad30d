// Runs the built program as a user does, in a folder of its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

#include <gtest/gtest.h>

namespace slideway::testing {

struct Outcome {
    int code;  // exit code; -signal if a signal ended the process
    std::string out, err;
};

std::string file_text(std::filesystem::path const& path);

/// Whether it comes true before half a minute is over.
template <class Condition> bool comes_true(Condition const& condition) {
    for (int i = 0; i < 15000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

/// Options of a run whose result is s.nc whatever they change, also where there is one, unless they say otherwise.
std::vector<std::string> to_result(std::vector<std::string> options);

/// The program that the tests of a target start: tests/support/tested_program.cpp, compiled for each.
extern char const* const tested_program;

class Program : public ::testing::Test {
protected:
    Program();
    ~Program() override;

    std::filesystem::path path(std::string const& name) const { return folder_ / name; }
    void write(std::string const& name, std::string const& text) const;

    /// Starts the program in the folder; its output goes to the files `out` and `err` there.
    pid_t start(std::vector<std::string> arguments) const;
    Outcome wait(pid_t child) const;
    Outcome run(std::vector<std::string> arguments) const;

    /// The program refuses with one line on stderr, which contains `part`, and prints nothing else.
    void expect_refusal(int code, std::string const& part, std::vector<std::string> arguments) const;

    /// How many shards the folder lists.
    std::size_t shards_in(std::string const& shards) const;

private:
    std::filesystem::path folder_;
};

}  // namespace slideway::testing
