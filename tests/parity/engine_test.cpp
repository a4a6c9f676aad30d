// A member's result depends on its own inputs only: not on the lane, its neighbours, the order or the instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/ensemble.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway {
namespace {

struct PartsCase {
    char const* name;
    Parts parts;
    friend void PrintTo(PartsCase const& c, std::ostream* out) { *out << c.name; }
};

PartsCase const parts_cases[] = {
    {"paper_point_friction", {Law::paper, Damping::point, true, false}},
    {"conservative_rate_friction", {Law::conservative, Damping::rate, true, false}},
    {"conservative_point_way", {Law::conservative, Damping::point, true, true}},
    {"paper_restitution", {Law::paper, Damping::restitution, false, false}},
    {"conservative_restitution_way", {Law::conservative, Damping::restitution, true, true}},
    {"foundation_rate_friction", {Law::foundation, Damping::rate, true, false}},
    {"foundation_restitution_way", {Law::foundation, Damping::restitution, false, true, Mechanism::free_slider}},
    {"kelvin_voigt_friction", {Law::kelvin_voigt, Damping::point, true, false}},
    {"scotch_yoke_kelvin_voigt_way", {Law::kelvin_voigt, Damping::point, true, true, Mechanism::scotch_yoke}},
    {"scotch_yoke_paper_friction", {Law::paper, Damping::point, true, false, Mechanism::scotch_yoke}},
    {"free_slider_kelvin_voigt", {Law::kelvin_voigt, Damping::point, false, false, Mechanism::free_slider}},
    {"carriage_paper_friction", {Law::paper, Damping::point, true, false, Mechanism::carriage}},
    {"carriage_conservative_restitution_way",
     {Law::conservative, Damping::restitution, true, true, Mechanism::carriage}},
    {"free_slider_conservative_rate_friction", {Law::conservative, Damping::rate, true, false, Mechanism::free_slider}},
    {"free_slider_paper_restitution_way", {Law::paper, Damping::restitution, true, true, Mechanism::free_slider}},
    {"planar_point_friction", {Law::paper, Damping::point, true, false, Mechanism::planar_slider_crank}},
    {"planar_restitution_driven",
     {Law::paper, Damping::restitution, true, false, Mechanism::planar_slider_crank}},
    {"planar_restitution_free", {Law::paper, Damping::restitution, true, false, Mechanism::planar_slider_crank, {.by = DriveBy::nothing}}},
};

testing::RunOptions engine_options(Parts const& parts) {
    testing::RunOptions o;
    o.parts = parts;
    o.settings.rtol = o.settings.atol = 1e-6;
    o.settings.end_time = 0.008;
    o.series = info(parts.mechanism).series;
    o.settings.max_steps = 20'000;
    for (int i = 0; i <= 16; ++i) o.sample_times.push_back(i * 5e-4);
    return o;
}

bool same_bits(double const* a, double const* b, std::size_t n) { return std::memcmp(a, b, n * sizeof(double)) == 0; }

void expect_same_member(testing::EnsembleResult const& a, std::size_t i, std::size_t a_count,
                        testing::EnsembleResult const& b, std::size_t j, std::size_t b_count, std::size_t samples,
                        std::string const& what) {
    EXPECT_EQ(a.records[i].status, b.records[j].status) << what;
    EXPECT_EQ(a.records[i].steps_accepted, b.records[j].steps_accepted) << what;
    EXPECT_EQ(a.records[i].steps_rejected, b.records[j].steps_rejected) << what;
    EXPECT_EQ(a.records[i].rhs_evaluations, b.records[j].rhs_evaluations) << what;
    EXPECT_TRUE(same_bits(a.states[i].data(), b.states[j].data(), most_states)) << what;
    EXPECT_TRUE(same_bits(a.quantities[i].data(), b.quantities[j].data(), quantity_columns)) << what;
    ASSERT_EQ(a.series.size() / a_count, b.series.size() / b_count);
    for (std::size_t s = 0; s < a.series.size() / (a_count * samples); ++s) {
        EXPECT_TRUE(same_bits(&a.series[(s * a_count + i) * samples], &b.series[(s * b_count + j) * samples], samples))
            << what << " series in place " << s;
    }
}

class EngineParity : public ::testing::TestWithParam<PartsCase> {};

TEST_P(EngineParity, EveryIsaWithFmaGivesTheSameBits) {
    auto const members = testing::varied_members(21, GetParam().parts);
    auto const o = engine_options(GetParam().parts);
    auto const reference = testing::run(Isa::scalar, o, members);
    EXPECT_GT(reference.value(0, Quantity::contact_onsets), 0) << "the members must meet the way";
    for (Isa const isa : testing::isas_beside_scalar()) {
        auto const got = testing::run(isa, o, members);
        for (std::size_t i = 0; i < members.size(); ++i) {
            expect_same_member(reference, i, members.size(), got, i, members.size(), o.sample_times.size(),
                               std::string(name_of(isa)) + " member " + std::to_string(i));
        }
    }
}

TEST_P(EngineParity, AMemberAloneGivesTheSameBitsAsInAnyLane) {
    auto const members = testing::varied_members(11, GetParam().parts);
    auto const o = engine_options(GetParam().parts);
    std::size_t const samples = o.sample_times.size();
    for (Isa const isa : all_isas()) {
        if (!is_supported(isa)) continue;
        auto const together = testing::run(isa, o, members);
        auto backwards = members;
        std::reverse(backwards.begin(), backwards.end());
        auto const reversed = testing::run(isa, o, backwards);
        for (std::size_t i = 0; i < members.size(); ++i) {
            auto const what = std::string(name_of(isa)) + " member " + std::to_string(i);
            if (lanes_of(isa) > 1) {  // else each is alone in its lane
                auto const alone = testing::run(isa, o, {members[i]});
                expect_same_member(together, i, members.size(), alone, 0, 1, samples, what + " alone");
            }
            expect_same_member(together, i, members.size(), reversed, members.size() - 1 - i, members.size(), samples,
                               what + " reversed");
        }
    }
}

TEST_P(EngineParity, ABadNeighbourChangesNothing) {
    auto const good = testing::varied_members(11, GetParam().parts);
    auto const o = engine_options(GetParam().parts);
    for (Isa const isa : all_isas()) {
        if (!is_supported(isa)) continue;
        auto const clean = testing::run(isa, o, good);
        // One lane has the same place for all, beside whatever neighbours: a third of them, of every kind, and the ends.
        std::size_t const stride = lanes_of(isa) == 1 ? 3 : 1;
        for (std::size_t position = 0; position <= good.size(); position += stride) {
            auto members = good;
            auto bad = good[0];
            switch (position % 4) {
                case 0:
                    bad.vy = NAN;
                    break;
                case 1:
                    // Beyond the rod's reach, where there is a rod.
                    bad.y = o.parts.mechanism == Mechanism::slider_crank ? 1.0 : NAN;
                    break;
                case 2:
                    bad.wz = INFINITY;
                    break;
                case 3:
                    bad.y = 5e-3;
                    break;  // deep inside the wall
            }
            members.insert(members.begin() + static_cast<std::ptrdiff_t>(position), bad);
            auto const got = testing::run(isa, o, members);
            if (position % 4 != 3) {
                EXPECT_NE(got.records[position].status, Status::finished);
            }
            for (std::size_t i = 0; i < good.size(); ++i) {
                expect_same_member(clean, i, good.size(), got, i < position ? i : i + 1, members.size(),
                                   o.sample_times.size(), "bad neighbour at " + std::to_string(position));
            }
        }
    }
}

TEST(EngineParityCases, HaveEveryLawAndMechanism) {
    for (std::size_t law = 0; law < laws().size(); ++law) {
        EXPECT_TRUE(std::ranges::any_of(parts_cases, [&](auto const& c) { return static_cast<std::size_t>(c.parts.law) == law; }))
            << laws()[law].name;
    }
    for (std::size_t i = 0; i < mechanisms().size(); ++i) {
        if (mechanisms()[i].driven_form != nullptr) continue;  // drives_test.cpp has their bits
        EXPECT_TRUE(std::ranges::any_of(parts_cases, [&](auto const& c) { return static_cast<std::size_t>(c.parts.mechanism) == i; }))
            << mechanisms()[i].name;
    }
}

INSTANTIATE_TEST_SUITE_P(Instances, EngineParity, ::testing::ValuesIn(parts_cases),
                         [](auto const& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace slideway
