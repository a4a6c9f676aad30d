// Runs cards_program in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/shell.hpp"

namespace slideway::testing {

class CardsRun : public ::testing::Test {
protected:
    CardsRun() : folder_(std::filesystem::temp_directory_path() / ("slideway_cards_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~CardsRun() override { std::filesystem::remove_all(folder_); }

    /// The lines that it prints.  It must neither crash nor leak, and end in time.
    /// @param settings of the simulated runtime, without SIMULATED_CUDA_: "FAIL=cudaMalloc:1 DELAY=100"
    std::vector<std::string> run(std::string const& settings, std::string const& arguments, int seconds = 60) {
        std::string environment = "SLIDEWAY_CUDA_MODULE='" SLIDEWAY_SIMULATED_MODULE "' SIMULATED_CUDA_LEAKS=1 ";
        std::istringstream words(settings);
        for (std::string word; words >> word;) environment += "SIMULATED_CUDA_" + word + " ";
        auto const outcome = run_shell(folder_, environment + "timeout -k 5 " + std::to_string(seconds) +
                                                    " '" SLIDEWAY_CARDS_PROGRAM "' " + arguments);
        EXPECT_EQ(outcome.code, 0) << settings << ": " << arguments;
        EXPECT_EQ(outcome.err, "") << settings << ": " << arguments;
        std::istringstream text(outcome.out);
        std::vector<std::string> lines;
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        return lines;
    }

    /// How often the program calls each function of the runtime.
    std::map<std::string, std::uint64_t> calls_of(std::string const& arguments) {
        run("COUNTS=counts", arguments);
        std::ifstream file(folder_ / "counts");
        std::map<std::string, std::uint64_t> calls;
        std::string function;
        for (std::uint64_t count; file >> function >> count;) calls[function] = count;
        return calls;
    }

private:
    std::filesystem::path folder_;
};

using Lines = std::vector<std::string>;

}  // namespace slideway::testing
