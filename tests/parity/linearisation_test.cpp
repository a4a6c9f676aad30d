// The linearised slider-crank: every instruction set gives the bits of the scalar build, whatever the neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/models/by_isa.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/parity/linearisation_table.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(TableLineariser, linearise_table)

namespace {

/// States in every mode of contact, free ones and one out of the rod's reach among them.
std::vector<LinearisationRow> rows() {
    std::vector<LinearisationRow> all;
    for (auto const& c : oracle::make_cases(77, 1024)) {
        LinearisationRow row{c.inputs, c.t, std::pow(10.0, -7 + static_cast<double>(all.size() % 6))};
        auto& in = row.inputs;
        in.law_a = 3e7, in.law_b = 40;
        double* const state[] = {&in.y,    &in.z,   &in.vy,    &in.vz, &in.roll,
                                 &in.yaw,  &in.pitch, &in.wx,  &in.wy, &in.wz};
        for (std::size_t j = 0; j < 10; ++j) *state[j] = c.state[j];
        if (all.size() % 101 == 50) in.y = 1;
        all.push_back(row);
    }
    return all;
}

/// Every law with friction and a misaligned way, with each of its dampings.
std::vector<Parts> laws() {
    std::vector<Parts> all;
    for (Parts const& parts : testing::all_parts()) {
        if (parts.friction && parts.misaligned_way) all.push_back(parts);
    }
    return all;
}

std::vector<double> linearised(Isa isa, Parts const& parts, std::vector<LinearisationRow> const& table) {
    std::vector<double> result(table.size() * linearisation_values);
    linearise_table_by_isa(isa)(parts, *find_instance(isa, parts).law, table.data(), table.size(), result.data());
    return result;
}

/// NaNs may differ in sign and payload, which say nothing.
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

class LinearisationParity : public ::testing::TestWithParam<Isa> {
protected:
    void SetUp() override {
        if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
    }
};

TEST_P(LinearisationParity, GivesTheBitsOfScalar) {
    auto const table = rows();
    for (Parts const& parts : laws()) {
        SCOPED_TRACE(testing::name_of(parts));
        auto const want = linearised(Isa::scalar, parts, table), got = linearised(GetParam(), parts, table);
        EXPECT_TRUE(std::equal(want.begin(), want.end(), got.begin(), same));
        EXPECT_GT(std::count_if(want.begin(), want.end(), [](double x) { return x != 0 && !std::isnan(x); }), 10'000);
    }
}

TEST_P(LinearisationParity, NeighboursChangeNoBit) {
    auto const table = rows();
    auto reversed = table;
    std::reverse(reversed.begin(), reversed.end());
    for (Parts const& parts : laws()) {
        SCOPED_TRACE(testing::name_of(parts));
        auto const want = linearised(GetParam(), parts, table), got = linearised(GetParam(), parts, reversed);
        std::size_t const width = linearisation_values;
        // Alone: eight copies of one row fill any pack.
        for (std::size_t row = 0; row < table.size(); ++row) {
            auto const expected = want.begin() + static_cast<std::ptrdiff_t>(row * width);
            auto const backwards = got.begin() + static_cast<std::ptrdiff_t>((table.size() - 1 - row) * width);
            auto const alone = linearised(GetParam(), parts, std::vector<LinearisationRow>(8, table[row]));
            EXPECT_TRUE(std::equal(backwards, backwards + width, expected, same)) << row;
            EXPECT_TRUE(std::equal(alone.begin(), alone.begin() + width, expected, same)) << row;
        }
    }
}

std::string isa_name(::testing::TestParamInfo<Isa> const& info) { return std::string(name_of(info.param)); }

INSTANTIATE_TEST_SUITE_P(Isas, LinearisationParity, ::testing::ValuesIn(built_isas()), isa_name);

}  // namespace
}  // namespace slideway
