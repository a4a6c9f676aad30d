// Every number a kernel gives of a state, held against the independent oracle on thousands of states.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "host/backend/backend.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/unit/oracle_comparison.hpp"

namespace slideway {
namespace {

using testing::compare_probe;

class KernelsAgainstOracle : public ::testing::TestWithParam<Isa> {};

TEST_P(KernelsAgainstOracle, AgreeOnThousandsOfStates) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine lacks " << name_of(GetParam());
    auto const cases = oracle::make_cases(20200103, 4000);
    int compared = 0;
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i)
        compared += compare_probe(GetParam(), cases[i], "case " + std::to_string(i));
    EXPECT_GT(compared, 3500);
}

INSTANTIATE_TEST_SUITE_P(Isas, KernelsAgainstOracle, ::testing::ValuesIn(built_isas()),
                         [](auto const& p) { return std::string(name_of(p.param)); });

}  // namespace
}  // namespace slideway
