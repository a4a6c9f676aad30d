// Programs that compile laws and mechanisms of one's own, each test with a folder of its own.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/backend.hpp"
#include "host/backend/module_files.hpp"
#include "host/base/file_lock.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing {

class ProgramWithOwnModules : public ProgramWithResults {
protected:
    ProgramWithOwnModules() { setenv("XDG_CACHE_HOME", path("cache").c_str(), 1); }
    ~ProgramWithOwnModules() override { unsetenv("XDG_CACHE_HOME"); }

    Outcome run_scene(std::vector<std::string> options, std::string const& output = "s.nc") const {
        options.insert(options.begin(), {"run", "s.toml", "--no-progress", "--quiet", "-o", output});
        return run(options);
    }

    static std::string best() { return std::string(name_of(best_isa())); }
    /// The widest instruction set, and scalar code where that is another.
    static std::vector<std::string> best_and_scalar() {
        std::vector<std::string> names{best()};
        if (best_isa() != Isa::scalar && is_built(Isa::scalar)) names.emplace_back("scalar");
        return names;
    }

    /// The motor of docs/how_to/extending.md in the folder `own`.  It takes long to compile: the first test that asks does it for all of a call of
    /// scripts/test.sh, or for this version of the kernels; example.sh and Python's test_modules.py among them.  They all ask for the widest
    /// instruction set; another is compiled for one test alone.
    void provide_motor(std::vector<std::string> const& isas = {best()}) const {
        namespace fs = std::filesystem;
        fs::path const cache = fs::path(SLIDEWAY_TEST_RESULTS) / "cache", common = cache / "slideway/modules";
        fs::create_directories(common);
        FileLock const alone(common / "lock", FileLock::Kind::alone, FileLock::Wait::yes);
        setenv("XDG_CACHE_HOME", cache.c_str(), 1);
        Outcome const outcome = run({"compile", SLIDEWAY_SOURCE "/tests/extending/motor_yoke.hpp", "--isa", fmt::format("{}", fmt::join(isas, ","))});
        fs::path const modules = user_module_folder();
        setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        fs::create_directory(path("own"));
        for (std::string const& isa : isas) {
            std::string const name = fmt::format("slideway_mechanism_motor_yoke_{}.so", isa);
            fs::copy(modules / name, path("own") / name);
        }
    }
};

}  // namespace slideway::testing
