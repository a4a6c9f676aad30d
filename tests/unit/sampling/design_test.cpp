#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "host/sampling/random.hpp"
#include "host/sampling/sobol_points.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/unit/sampling/samples.hpp"

namespace slideway::design_test {
namespace {

using Kind = Distribution::Kind;
using testing::Columns;
using testing::columns_of;
using testing::design_of;
using testing::planned;
using testing::unit_uniform;
using testing::variations_of;

constexpr DesignKind drawn_kinds[] = {DesignKind::mc, DesignKind::lhs, DesignKind::sobol, DesignKind::saltelli,
                                      DesignKind::grid};

TEST(Design, McDrawsByPhiloxOfSeedMemberAndName) {
    auto const variations = variations_of(5, {Kind::uniform, 0, 0, -2, 6});
    auto const columns = columns_of(design_of(DesignKind::mc), variations, 50, 9);
    for (std::size_t i = 0; i < variations.size(); ++i) {
        for (std::uint64_t member = 0; member < 50; ++member) {
            std::uint64_t const word = philox({member, 0, 0, 0}, {9, name_hash(variations[i].key->name)})[0];
            double const u = (static_cast<double>(word / 4096) + 0.5) / 4503599627370496.0;  // 2^52
            EXPECT_EQ(columns[i][member], -2 + u * 8);
        }
    }
}

TEST(Design, AMemberAloneIsTheSameAmongAll) {
    auto variations = variations_of(4, {Kind::truncated_normal, 1, 2, 0, 3});
    for (DesignKind const kind : drawn_kinds) {
        auto const [design, members] = planned(kind, 4, 600);
        auto const all = columns_of(design, variations, members);
        std::vector<double> values(4);
        for (std::uint64_t const member : {members - 1, std::uint64_t(0), members / 2}) {
            Sampler(design, variations, 1, members).draw(member, values);
            for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(values[i], all[i][member]) << name_of(kind);
        }
    }
}

TEST(Design, ThreadsShareASampler) {
    auto const variations = variations_of(3, {Kind::normal, 0, 1});
    for (DesignKind const kind : drawn_kinds) {
        auto const [design, members] = planned(kind, 3, 1000);
        Sampler const sampler(design, variations, 1, members);
        Columns found[4];
        std::vector<std::thread> threads;
        for (Columns& columns : found) {
            threads.emplace_back([&, count = members] { columns = columns_of(sampler, 3, count); });
        }
        for (std::thread& thread : threads) thread.join();
        for (Columns const& columns : found) EXPECT_EQ(columns, columns_of(design, variations, members));
    }
}

TEST(Design, SeedsDiffer) {
    auto const variations = variations_of(2, unit_uniform());
    for (DesignKind const kind : {DesignKind::mc, DesignKind::lhs, DesignKind::sobol, DesignKind::saltelli}) {
        auto const [design, members] = planned(kind, 2, 64);
        auto const one = columns_of(design, variations, members, 1), two = columns_of(design, variations, members, 2);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_NE(one[i], two[i]) << name_of(kind);
    }
}

std::shared_ptr<MemberTable const> small_table() {
    auto table = std::make_shared<MemberTable>();
    table->path = "members.csv";
    table->columns = 2;
    table->values = {1, 2, 3, 4, 5, std::nan("")};
    return table;
}

TEST(Design, TablesGiveTheirRowsAndDrawTheRest) {
    auto variations = variations_of(3, unit_uniform());
    variations[0].column = 1;
    variations[2].column = 0;
    Design design = design_of(DesignKind::table);
    design.table = small_table();
    auto const x = columns_of(design, variations, 3);
    EXPECT_EQ(x[0][0], 2);
    EXPECT_EQ(x[0][1], 4);
    EXPECT_TRUE(std::isnan(x[0][2]));  // that member's own matter
    EXPECT_EQ(x[2], (std::vector{1.0, 3.0, 5.0}));
    EXPECT_EQ(x[1], columns_of(design_of(DesignKind::mc), variations, 3)[1]);
    design.correlation = {{0, 1}, {1, 0.5, 0.5, 1}};
    EXPECT_THROW(Sampler(design, variations, 1, 3), SceneError);
}

std::string refusal(Design const& design, std::vector<Variation> const& variations, std::uint64_t members) {
    try {
        Sampler(design, variations, 1, members);
    } catch (SceneError const& error) {
        return error.what();
    }
    return {};
}

TEST(Design, RefusesWhatDoesNotFit) {
    auto variations = variations_of(2, unit_uniform());
    Design saltelli = design_of(DesignKind::saltelli);
    saltelli.base = 8;
    EXPECT_EQ(refusal(saltelli, variations, 32), "");
    EXPECT_EQ(refusal(saltelli, variations, 30),
              "study.members is 30 (8 rows of 2 variations are 32 members); use that number");
    Design grid = design_of(DesignKind::grid);
    grid.levels = {3};
    EXPECT_EQ(refusal(grid, variations, 3),
              "study.design is \"grid\" (1 levels for 2 variations); give each variation its levels");
    grid.levels = {3, 4};
    EXPECT_EQ(refusal(grid, variations, 11),
              "study.members is 11 (the grid has 12 combinations of levels); use that number");
    grid.levels = {3, 0};
    EXPECT_NE(refusal(grid, variations, 0), "");
    grid.levels = {std::uint64_t(1) << 33, std::uint64_t(1) << 31};
    EXPECT_NE(refusal(grid, variations, 0), "");  // 2^64
    Design table = design_of(DesignKind::table);
    EXPECT_EQ(refusal(table, variations, 1), "study.design is \"table\" (there is no table); give study.table");
    table.table = small_table();
    EXPECT_EQ(refusal(table, variations, 4), "study.members is 4 (members.csv has 3 rows); use at most that number");
    variations[1].column = 2;
    EXPECT_NE(refusal(table, variations, 3), "");
}

TEST(Design, RefusesMoreDimensionsThanHaveNumbers) {
    std::vector<Variation> const many(sobol_dimensions() + 1, {&keys()[0], unit_uniform(), 1});
    std::span<Variation const> const all = many;
    EXPECT_THROW(Sampler(design_of(DesignKind::sobol), all, 1, 4), SceneError);
    Design saltelli = design_of(DesignKind::saltelli);
    saltelli.base = 1;
    std::size_t const half = sobol_dimensions() / 2 + 1;
    EXPECT_THROW(Sampler(saltelli, all.first(half), 1, half + 2), SceneError);
}

TEST(Design, MembersBeyondItsEndAreRefused) {
    auto const variations = variations_of(2, unit_uniform());
    std::vector<double> values(2);
    for (DesignKind const kind : {DesignKind::lhs, DesignKind::saltelli, DesignKind::grid}) {
        auto const [design, members] = planned(kind, 2, 16);
        EXPECT_THROW(Sampler(design, variations, 1, members).draw(members, values), std::out_of_range);
    }
    std::vector<double> few(1);
    EXPECT_THROW(Sampler(design_of(DesignKind::mc), variations, 1, 2).draw(0, few), std::invalid_argument);
}

TEST(Design, MembersOfASceneFollowIt) {
    Scene scene = testing::scene_of(R"(schema = 1
[study]
members = 64
seed = 5
[study.vary]
"initial.y" = { dist = "unif", low = -4e-5, high = 4e-5 }
"initial.z" = { dist = "unif", low = -4e-5, high = 4e-5 }
)");
    ASSERT_NE(scene.sampler, nullptr);
    scene.design.kind = DesignKind::lhs;
    prepare_sampler(scene);
    Scene by_hand = scene;
    by_hand.sampler = nullptr;
    std::vector<double> y;
    for (std::uint64_t member = 0; member < 64; ++member) {
        Inputs const inputs = member_inputs(scene, member);
        y.push_back(inputs.y);
        EXPECT_EQ(inputs.y, member_inputs(by_hand, member).y);
        EXPECT_EQ(inputs.z, member_inputs(by_hand, member).z);
        EXPECT_EQ(inputs.z, draw(scene, scene.variations[1], member));
    }
    std::sort(y.begin(), y.end());
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(std::floor((y[i] + 4e-5) / 8e-5 * 64), static_cast<double>(i));
    scene.design.kind = DesignKind::grid;
    try {
        prepare_sampler(scene);
        FAIL();
    } catch (SceneError const& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("scene.toml: study.design is \"grid\"")) << error.what();
    }
}

TEST(Design, ColumnsOfASweepHaveTheSameStarts) {
    Scene scene = testing::scene_of(R"(schema = 1
[study]
kind = "sweep"
members = 16
parameter = "joint.clearance"
from = "0.1 mm"
to = "0.2 mm"
points = 3
[study.vary]
"initial.y" = { dist = "unif", low = -4e-5, high = 4e-5 }
)");
    scene.design.kind = DesignKind::sobol;
    prepare_sampler(scene);
    for (std::uint64_t start = 0; start < 16; ++start) {
        double const y = member_inputs(scene, start).y;
        EXPECT_EQ(y, draw(scene, scene.variations[0], start));
        EXPECT_EQ(y, member_inputs(scene, 16 + start).y);
        EXPECT_EQ(y, member_inputs(scene, 32 + start).y);
    }
}

}  // namespace
}  // namespace slideway::design_test
