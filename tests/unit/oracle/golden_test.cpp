// The oracle held against golden data, and the measures by which a table is held against another.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/oracle/golden_table.hpp"
#include "tests/oracle/oracle.hpp"

namespace golden_test {
namespace {

using oracle::State;

constexpr double golden_tolerance = 2e-8;

golden::Table golden_table(std::string const& name) {
    return golden::Table::read(SLIDEWAY_TEST_DATA "/golden/" + name);
}

golden::Table oracle_table(golden::Table const& reference) {
    golden::Table table(golden::computed_columns());
    for (std::size_t row = 0; row < reference.rows(); ++row) {
        golden::Case const c = golden::case_of(reference, row);
        table.add(golden::computed_row(oracle::evaluate(c.inputs, c.parts, c.t, c.state)));
    }
    return table;
}

class GoldenRows : public ::testing::TestWithParam<std::tuple<char const*, std::size_t>> {};

TEST_P(GoldenRows, AreMetByTheOracle) {
    auto const [name, rows] = GetParam();
    golden::Table const reference = golden_table(name);
    EXPECT_EQ(reference.rows(), rows);
    auto const worst = golden::worst_difference(reference, oracle_table(reference));
    EXPECT_LE(worst.value, golden_tolerance) << worst.where;
}

INSTANTIATE_TEST_SUITE_P(Oracle, GoldenRows,
                         ::testing::Values(std::tuple{"rhs_paper.csv", 300}, std::tuple{"rhs_conservative.csv", 300},
                                         std::tuple{"rhs_parameters.csv", 400}, std::tuple{"rhs_kelvin_voigt.csv", 240},
                                         std::tuple{"rhs_kelvin_voigt_parameters.csv", 80}, std::tuple{"rhs_foundation.csv", 240},
                                         std::tuple{"rhs_foundation_parameters.csv", 80}));

TEST(GoldenCase, HasTheNumbersOfItsLawAndNoOthers) {
    using slideway::Law;
    golden::Table table({"contact.law", "contact.apex_stiffness", "contact.apex_damping", "joint.clearance"});
    for (char const* law : {"kelvin_voigt", "paper", "conservative"}) table.add({law, "3e6", "40", "2e-4"});
    table.add({"hooke", "3e6", "40", "2e-4"});
    golden::Case const own = golden::case_of(table, 0);
    EXPECT_EQ(own.parts.law, Law::kelvin_voigt);
    EXPECT_EQ(own.inputs.law_a, 3e6);
    EXPECT_EQ(own.inputs.law_b, 40);
    for (std::size_t row : {1, 2}) {
        golden::Case const other = golden::case_of(table, row);
        EXPECT_EQ(other.parts.law, row == 1 ? Law::paper : Law::conservative);
        EXPECT_EQ(other.inputs.law_a, 0);
        EXPECT_EQ(other.inputs.law_b, 0);
    }
    EXPECT_THROW(golden::case_of(table, 3), std::invalid_argument);
    golden::Table bare({"contact.law"});
    bare.add({"kelvin_voigt"});
    EXPECT_TRUE(std::isnan(golden::case_of(bare, 0).inputs.law_a));
    EXPECT_EQ(golden::case_of(bare, 0).inputs.law_b, 0);
}

TEST(GoldenMeasure, SeesADigitANanAndAMissingRow) {
    golden::Table const reference = golden_table("rhs_paper.csv");
    golden::Table good(reference.columns()), wrong(reference.columns()), broken(reference.columns());
    for (std::size_t row = 0; row < reference.rows(); ++row) {
        std::vector<std::string> cells, wrong_cells, broken_cells;
        for (std::string const& column : reference.columns()) {
            cells.push_back(reference.text(row, column));
            bool const here = row == 7 && column == "energy";
            wrong_cells.push_back(here ? std::to_string(reference.number(row, column) * (1 + 1e-3)) : cells.back());
            broken_cells.push_back(row == 7 && column == "d_wx" ? "nan" : cells.back());
        }
        good.add(cells), wrong.add(wrong_cells), broken.add(broken_cells);
    }
    EXPECT_EQ(golden::worst_difference(reference, good).value, 0);
    auto const worst = golden::worst_difference(reference, wrong);
    EXPECT_NEAR(worst.value, 1e-3, 1e-4);
    EXPECT_EQ(worst.where, "energy energy row 7");
    EXPECT_TRUE(std::isnan(golden::worst_difference(reference, broken).value));
    EXPECT_THROW(golden::worst_difference(reference, golden::Table(reference.columns())), std::runtime_error);
    EXPECT_THROW(golden_table("no_such_table.csv"), std::runtime_error);
}

TEST(GoldenMeasure, HoldsTrajectoriesToTheirUncertainty) {
    golden::Table const table = golden_table("trajectories.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        State state = golden::case_of(table, row).state;
        EXPECT_EQ(golden::worst_difference(table, row, state).value, 0);
        double const allowed = 30 * table.number(row, "u_y") + 1e-7 * table.number(row, "joint.clearance");
        state[0] += 2 * allowed;
        EXPECT_NEAR(golden::worst_difference(table, row, state).value, 2, 1e-3);
    }
}

}  // namespace
}  // namespace golden_test
