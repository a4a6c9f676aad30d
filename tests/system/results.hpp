// Runs of the program whose results are read back.
#pragma once

#include <string>

#include "host/store/result_view.hpp"
#include "tests/system/process.hpp"

namespace slideway::testing {

class ProgramWithResults : public Program {
protected:
    ResultReader results(std::string const& name) const { return ResultReader(path(name).string()); }
    /// The hash of a file, which fits its data.
    std::string hash_of(std::string const& name) const {
        ResultReader const file = results(name);
        EXPECT_EQ(file.stored_hash(), file.computed_hash()) << name;
        return file.computed_hash();
    }
};

}  // namespace slideway::testing
