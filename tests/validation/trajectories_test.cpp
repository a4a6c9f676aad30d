// The short trajectories of an independent program (tests/golden/trajectories.csv, model.md 11).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/oracle/golden_table.hpp"
#include "tests/oracle/names.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::trajectories_test {
namespace {

class GoldenTrajectories : public ::testing::TestWithParam<Isa> {};

TEST_P(GoldenTrajectories, AreMetAtTightTolerance) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine lacks " << name_of(GetParam());
    auto const table = golden::Table::read(SLIDEWAY_TEST_DATA "/golden/trajectories.csv");
    ASSERT_EQ(table.rows(), 72u);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto in =
            testing::golden_start(table.number(row, "joint.clearance"), table.number(row, "mechanism.crank_speed"));
        in.chi_line = table.number(row, "contact.chi_line");
        in.chi_surface = table.number(row, "contact.chi_surface");
        testing::RunOptions options;
        options.parts.law = oracle::law_named(table.text(row, "contact.law"));
        options.parts.damping = in.chi_line > 0 ? Damping::rate : Damping::point;
        options.parts.friction = true;
        options.settings.rtol = options.settings.atol = 1e-12;
        options.settings.end_time = table.number(row, "t");
        auto const got = testing::run(GetParam(), options, {in});
        ASSERT_EQ(got.records[0].status, Status::finished);
        auto const difference = golden::worst_difference(table, row, got.states[0]);
        EXPECT_LE(difference.value, 1.0) << difference.where;

        double const work = table.number(row, "work_crank");
        double const energy = 1e-7 * std::abs(work);
        EXPECT_NEAR(got.value(0, Quantity::drive_work), work, energy) << "row " << row;
        EXPECT_NEAR(got.value(0, Quantity::friction_loss), table.number(row, "loss_friction"), energy) << "row " << row;
        EXPECT_NEAR(got.value(0, Quantity::damping_loss), table.number(row, "loss_damping"), energy) << "row " << row;
        // The table gives the paper law's residual to three digits.
        double const residual = table.number(row, "energy_residual");
        EXPECT_NEAR(got.value(0, Quantity::energy_residual), residual, energy + 2e-3 * std::abs(residual))
            << "row " << row;
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, GoldenTrajectories, ::testing::ValuesIn(built_isas()),
                         [](auto const& p) { return std::string(name_of(p.param)); });

}  // namespace
}  // namespace slideway::trajectories_test
