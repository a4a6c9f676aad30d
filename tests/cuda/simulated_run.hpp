// The program with the module of a simulated card, run as a user does.
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/system/results.hpp"

namespace slideway::testing {

/// A variable of the environment while it lives.
class Variable {
public:
    Variable(std::string name, std::string const& value) : name_(std::move(name)) { setenv(name_.c_str(), value.c_str(), 1); }
    Variable(Variable const&) = delete;
    ~Variable() { unsetenv(name_.c_str()); }

private:
    std::string name_;
};

/// A setting of the simulated card while it lives: Setting("FAIL", "cudaMalloc:1").
class Setting : Variable {
public:
    Setting(std::string const& name, std::string const& value) : Variable("SIMULATED_CUDA_" + name, value) {}
};

class SimulatedRun : public ProgramWithResults {
protected:
    /// Runs a scene on the card, or with `--backend cpu` among the options on the processor.
    Outcome run_scene(std::string const& scene, std::string const& result, std::vector<std::string> options) const {
        std::vector<std::string> words{"run", scene, "-o", result, "--no-progress"};
        bool const is_told = std::find(options.begin(), options.end(), "--backend") != options.end();
        if (!is_told) words.insert(words.end(), {"--backend", "cuda"});
        words.insert(words.end(), options.begin(), options.end());
        return run(words);
    }
    /// The hash of what the processor makes of the scene.
    std::string processor_hash(std::string const& scene, std::vector<std::string> options = {}) const {
        options.insert(options.end(), {"--backend", "cpu"});
        Outcome const outcome = run_scene(scene, "processor.nc", options);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return hash_of("processor.nc");
    }

private:
    Variable const module_{"SLIDEWAY_CUDA_MODULE", SLIDEWAY_SIMULATED_MODULE};
    // Whatever a run leaves behind on the card is a line on stderr.
    Setting const leaks_{"LEAKS", "1"};
};

}  // namespace slideway::testing
