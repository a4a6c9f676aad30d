// Every number a kernel gives of a state, held against the independent oracle on thousands of states under every law.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <tuple>

#include "host/backend/backend.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/unit/mechanisms/oracle_comparison.hpp"

namespace slideway::kernel_oracle_test {
namespace {

using testing::compare_probe;

class KernelsAgainstOracle : public ::testing::TestWithParam<std::tuple<Law, Isa>> {};

TEST_P(KernelsAgainstOracle, AgreeOnThousandsOfStates) {
    auto const [law, isa] = GetParam();
    if (!is_supported(isa)) GTEST_SKIP() << "this machine lacks " << name_of(isa);
    auto const cases = oracle::make_cases(20200103, 2400, Mechanism::slider_crank, law);
    int compared = 0;
    for (std::size_t i = 0; i < cases.size() && !HasFailure(); ++i)
        compared += compare_probe(isa, cases[i], "case " + std::to_string(i));
    EXPECT_GT(compared, 2200);
}

INSTANTIATE_TEST_SUITE_P(
    Isas, KernelsAgainstOracle,
    ::testing::Combine(::testing::ValuesIn(oracle::every_law()), ::testing::ValuesIn(built_isas())), [](auto const& p) {
        return oracle::name_of(std::get<0>(p.param)) + "_" + std::string(name_of(std::get<1>(p.param)));
    });

}  // namespace
}  // namespace slideway::kernel_oracle_test
