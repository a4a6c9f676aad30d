// Programs that compile laws and mechanisms of one's own, each test into a folder of its own.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing {

class ProgramWithOwnModules : public ProgramWithResults {
protected:
    ProgramWithOwnModules() { setenv("XDG_CACHE_HOME", path("cache").c_str(), 1); }
    ~ProgramWithOwnModules() override { unsetenv("XDG_CACHE_HOME"); }

    static std::string best() { return std::string(name_of(best_isa())); }
    /// The widest instruction set, and scalar code where that is another.
    static std::vector<std::string> best_and_scalar() {
        std::vector<std::string> names{best()};
        if (best_isa() != Isa::scalar && is_built(Isa::scalar)) names.emplace_back("scalar");
        return names;
    }
};

}  // namespace slideway::testing
