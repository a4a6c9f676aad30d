// One evaluation of the golden states: the bits of a state do not depend on its neighbours in the pack or on the instruction set.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "kernels/laws/list.hpp"
#include "tests/oracle/golden_table.hpp"
#include "tests/support/ensemble.hpp"
#include "tests/support/starting_in.hpp"

namespace slideway {
namespace {

struct Rows {
    std::vector<Inputs> inputs;
    std::vector<double> times;
};

/// The table's states as they come: neighbours touch other faces, some of them both sides of the way at once.
Rows rows_of(std::string const& file) {
    auto const table = golden::Table::read(SLIDEWAY_TEST_DATA "/golden/" + file);
    Rows rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto const c = golden::case_of(table, row);
        rows.inputs.push_back(testing::starting_in(c.inputs, c.state));
        rows.times.push_back(c.t);
    }
    return rows;
}

bool touches_both_sides(ProbeResult const& r) {
    auto const touched = [](double const* depth, std::initializer_list<int> apices) {
        for (int const apex : apices) {
            if (depth[apex] > 0) return true;
        }
        return false;
    };
    return (touched(r.penetration_y, {0, 3, 4, 7}) && touched(r.penetration_y, {1, 2, 5, 6})) ||
           (touched(r.penetration_z, {0, 1, 4, 5}) && touched(r.penetration_z, {2, 3, 6, 7}));
}

void expect_same_bits(ProbeResult const& a, ProbeResult const& b, std::string const& what) {
    EXPECT_EQ(std::memcmp(a.derivative, b.derivative, sizeof a.derivative), 0) << what;
    EXPECT_EQ(std::memcmp(a.normal_force_y, b.normal_force_y, sizeof a.normal_force_y), 0) << what;
    EXPECT_EQ(std::memcmp(a.normal_force_z, b.normal_force_z, sizeof a.normal_force_z), 0) << what;
    EXPECT_EQ(a.power_friction, b.power_friction) << what;
    EXPECT_EQ(a.power_damping, b.power_damping) << what;
    EXPECT_EQ(a.contact_potential, b.contact_potential) << what;
    EXPECT_EQ(a.surfaces, b.surfaces) << what;
    EXPECT_EQ(a.lines, b.lines) << what;
    EXPECT_EQ(a.points, b.points) << what;
}

struct ProbeCase {
    char const* name;
    char const* file;
    Law law;
    Damping damping;
};

class ProbeParity : public ::testing::TestWithParam<ProbeCase> {};

TEST_P(ProbeParity, NeitherNeighboursNorIsaChangeABit) {
    auto const rows = rows_of(GetParam().file);
    std::size_t const n = rows.inputs.size();
    for (bool const friction : {false, true}) {
        Parts const parts{GetParam().law, GetParam().damping, friction, false};
        std::vector<ProbeResult> alone(n), together(n);
        find_instance(Isa::scalar, parts).probe({rows.inputs.data(), rows.times.data(), n, alone.data()});
        int both_sides = 0;
        for (auto const& r : alone) both_sides += touches_both_sides(r) ? 1 : 0;
        EXPECT_GT(both_sides, 10);
        for (Isa const isa : testing::isas_beside_scalar()) {
            find_instance(isa, parts).probe({rows.inputs.data(), rows.times.data(), n, together.data()});
            for (std::size_t i = 0; i < n; ++i) {
                expect_same_bits(alone[i], together[i], std::string(name_of(isa)) + " row " + std::to_string(i));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Golden, ProbeParity,
                         ::testing::Values(ProbeCase{"paper_point", "rhs_paper.csv", Law::paper, Damping::point},
                                           ProbeCase{"paper_rate", "rhs_paper.csv", Law::paper, Damping::rate},
                                           ProbeCase{"kelvin_voigt", "rhs_kelvin_voigt.csv", Law::kelvin_voigt,
                                                     Damping::point},
                                           ProbeCase{"foundation_rate", "rhs_foundation.csv", Law::foundation, Damping::rate},
                                           ProbeCase{"foundation_restitution", "rhs_foundation.csv", Law::foundation, Damping::restitution},
                                           ProbeCase{"conservative_rate", "rhs_conservative.csv", Law::conservative,
                                                     Damping::rate},
                                           ProbeCase{"conservative_restitution", "rhs_conservative.csv",
                                                     Law::conservative, Damping::restitution}),
                         [](auto const& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace slideway
