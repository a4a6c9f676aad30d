// What a check makes of members' numbers, of made-up ones.
#include "host/study/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/support/scene_fixture.hpp"

namespace slideway::testing::verification_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using Kind = MemberNumbers::Kind;

Scene scene() {
    return scene_of("schema = 1\n[mechanism]\nkind = \"slider_crank\"\n[contact]\nlaw = \"conservative\"\n[study]\nkind = \"ensemble\"\nmembers = 400\nduration = \"1 s\"\nsamples = 0\n");
}

std::vector<double> draws(double mean, double sd, unsigned seed, std::size_t count = 400) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> draw(mean, sd);
    std::vector<double> values(count);
    for (double& x : values) x = draw(engine);
    return values;
}

/// A study of one number, some of whose members run again by two methods in turn.
struct MadeUp {
    std::vector<double> own;
    std::vector<double> again;  // of the first members
    Kind kind = Kind::quantity;
    std::string unit = "kg";
    std::vector<std::size_t> cut = {};  // of them
    std::vector<MemberGroup> groups = {};
    double other = 0;  // what the second method adds
    std::vector<CheckMethod> methods = std::vector<CheckMethod>(2);

    CheckedNumber checked(std::size_t group = 0) const {
        Verification v;
        v.methods = methods;
        v.study.columns.push_back({"column", unit, kind, own});
        v.study.finished.assign(own.size(), 1);
        v.groups = {{"", std::vector<char>(own.size(), 1)}};
        v.groups.insert(v.groups.end(), groups.begin(), groups.end());
        v.again.resize(1);
        for (std::size_t i = 0; i < again.size(); ++i) {
            bool const finished = std::ranges::count(cut, i) == 0;
            v.pairs.push_back({i, i % 2, finished});
            v.again[0].push_back(finished ? again[i] + (i % 2) * other : nan);
        }
        v.draws.assign(own.size(), 1);
        v.all = own.size();
        return check_numbers(v, scene())[group];
    }
};

std::vector<double> first(std::vector<double> const& values, std::size_t count, double shift = 0, double scatter = 0) {
    std::vector<double> some = draws(shift, scatter > 0 ? scatter : 1e-300, 99, count);
    for (std::size_t i = 0; i < count; ++i) some[i] += values[i];
    return some;
}

/// Of 400 members with a standard deviation of 10 the interval is ± 0.98, and a thousandth of 100 is 0.1: the margin.
TEST(Verdict, IsResolvedWhereTheErrorIsBelowTheStudysOwnInterval) {
    auto const own = draws(100, 10, 1);
    CheckedNumber const same = MadeUp{own, first(own, 40)}.checked();
    EXPECT_EQ(same.verdict, Verdict::resolved);
    EXPECT_NEAR(same.half_width, 1.966 * 10 / 20, 0.1);
    EXPECT_EQ(same.margin, same.half_width);
    EXPECT_EQ(MadeUp({own, first(own, 40, 0.5)}).checked().verdict, Verdict::resolved);
}

/// Members err by 1, with a quarter of the step by a quarter of that.
TEST(Verdict, TakesAFixedStepToErrByFirstOrder) {
    Scene stepped = scene();
    EXPECT_EQ(check_methods(stepped).front().error_per_difference, 1);
    stepped.integrator.method = Method::rk4;
    stepped.integrator.fixed_step = 1e-5;
    auto const own = draws(100, 10, 1);
    MadeUp study{own, first(own, 40, -0.75)};
    study.other = -0.25;  // by small tolerances
    study.methods = check_methods(stepped);
    EXPECT_NEAR(study.checked().error.difference, -1, 1e-9);
    // Its steps cannot end where a force jumps, nor do those of its check.
    stepped.parts.law = Law::paper;
    EXPECT_FALSE(check_methods(stepped).front().scene.integrator.locate_modes);
}

TEST(Verdict, IsNotResolvedWhereADifferenceIsBeyondChanceAndAboveTheMargin) {
    auto const own = draws(100, 10, 1);
    CheckedNumber const found = MadeUp{own, first(own, 40, 3, 2)}.checked();
    EXPECT_EQ(found.verdict, Verdict::not_resolved);
    EXPECT_NEAR(found.error.difference, 3, 1);
    EXPECT_LT(found.p, 0.02);
}

TEST(Verdict, BoundsTheErrorWhereOrbitsPart) {
    // Pairs are as good as independent: 2.02 · √2 · 10/√40 = 4.5.
    CheckedNumber const parted = MadeUp{draws(100, 10, 1), draws(100, 10, 2, 40)}.checked();
    EXPECT_EQ(parted.verdict, Verdict::bounded);
    EXPECT_NEAR(parted.error.half_width, 4.5, 1);
    EXPECT_GE(parted.error.bound, parted.error.half_width);
}

TEST(Verdict, IsUndecidedWhereTheBoundSaysNothing) {
    auto const own = draws(100, 10, 1);
    EXPECT_EQ(MadeUp({own, {own[0] - 20, own[1] + 20, own[2] + 20, own[3] - 20}}).checked().verdict, Verdict::undecided) << "above the members' own scatter";
    EXPECT_EQ(MadeUp({own, {}}).checked().verdict, Verdict::undecided) << "nobody ran again";
}

TEST(Verdict, IsUndecidedWhereMembersWereCutShort) {
    auto const own = draws(100, 10, 1);
    CheckedNumber const found = MadeUp{.own = own, .again = first(own, 40), .cut = {7}}.checked();
    EXPECT_EQ(found.verdict, Verdict::undecided);
    EXPECT_EQ(found.cut, 1u);
    EXPECT_EQ(found.error.pairs, 39u);
}

TEST(Verdict, NamesMembersThatWereCutShort) {
    Verification v;
    v.methods.resize(2);
    v.methods[0].words = "auto at rtol 1e-08", v.methods[1].words = "verner65 at rtol 1e-08";
    v.cut = {1, 3};
    v.study.columns.push_back({"column", "N", Kind::quantity, {1, 2, 3, 4}});
    v.study.finished = {1, 1, 1, 1};
    v.members = {100, 101, 102, 103};
    v.groups = {{"", {1, 1, 1, 1}}};
    v.pairs = {{0, 0, true}, {1, 1, true}, {2, 0, false}};
    v.again = {{1, 2, nan}};
    v.draws = {1, 1, 1, 1};
    v.all = 4;
    v.numbers = check_numbers(v, scene());
    conclude(v, scene(), {});
    EXPECT_EQ(v.resolution, Resolution::undecided);
    EXPECT_TRUE(v.summary.starts_with("undecided: 2 members again")) << v.summary;
    EXPECT_TRUE(contains(v.summary, "cut short: member 102")) << v.summary;
    EXPECT_TRUE(contains(v.summary, "verner65 at rtol 1e-08 did not bring 3 of them to their end")) << v.summary;
    for (CheckPair& pair : v.pairs) pair.finished = false;
    conclude(v, scene(), {});
    EXPECT_TRUE(v.summary.starts_with("undecided: no member again to its end")) << v.summary;
}

TEST(Verdict, IsNotResolvedByFewPairsThatSeeNothing) {
    // The margin is 0.98; six pairs leave room for 0.39 of the members, at 10 each.
    auto const own = draws(100, 10, 1);
    CheckedNumber const found = MadeUp{own, first(own, 6)}.checked();
    EXPECT_EQ(found.verdict, Verdict::bounded);
    EXPECT_NEAR(found.error.bound, 3.9, 0.3);
}

TEST(Verdict, OfAMeanThatFewMembersMakeLeavesRoomForOthersLikeThem) {
    // Two of 400 have all of it; forty pairs have neither.  A share of 0.069 may hold as many more, at 100 each.
    std::vector<double> own(400, 0);
    own[100] = own[200] = 100;
    CheckedNumber const found = MadeUp{own, first(own, 40)}.checked();
    EXPECT_EQ(found.verdict, Verdict::bounded);
    EXPECT_NEAR(found.error.bound, 6.9, 0.2);
}

TEST(Verdict, IsOfTheMethodThatSeesMost) {
    // The first method sees nothing, the second 1.6; their mean, 0.8, would pass.
    auto const own = draws(100, 10, 1);
    CheckedNumber const found = MadeUp{.own = own, .again = first(own, 80, 0, 0.01), .other = 1.6}.checked();
    EXPECT_EQ(found.verdict, Verdict::not_resolved);
    EXPECT_NEAR(found.error.difference, 1.6, 0.01);
}

TEST(Verdict, IsOfEachGroupAlone) {
    // Ten of 400 members share a value, and are off by 30: that moves the mean of all by 0.75 alone.
    MadeUp made{draws(100, 10, 1), {}};
    MemberGroup slow{"speed = 3", std::vector<char>(400, 0)};
    for (std::size_t i = 0; i < 10; ++i) slow.has[i] = 1;
    made.again = first(made.own, 400, 0, 1e-3);
    for (std::size_t i = 0; i < 10; ++i) made.again[i] += 30;
    made.groups = {slow};
    EXPECT_NE(made.checked(0).verdict, Verdict::not_resolved);
    EXPECT_EQ(made.checked(1).verdict, Verdict::not_resolved);
    EXPECT_NEAR(made.checked(1).error.difference, 30, 1e-2);
}

TEST(Verdict, OfAYieldThatNobodyMissesKnowsThatTheNextMight) {
    std::vector<double> const all(400, 1.0);
    CheckedNumber const found = MadeUp{.own = all, .again = first(all, 50), .kind = Kind::limit, .unit = "1"}.checked();
    EXPECT_NEAR(found.half_width, 0.5 * 3.84 / 403.84, 1e-4);  // Wilson's interval reaches from 400/403.84 to 1
    EXPECT_GT(found.spread, 0);
    EXPECT_EQ(found.verdict, Verdict::resolved);
    auto missed = first(all, 40);
    for (std::size_t i = 0; i < 4; ++i) missed[i] = 0;
    EXPECT_NE(MadeUp({all, missed, Kind::limit, "1"}).checked().verdict, Verdict::resolved);
}

/// Those that would show it may be missing, as pairs that see nothing: 0 is told, not called resolved, and speaks against no other number.
TEST(Verdict, OfANumberThatIsZeroInAllMembersIsNone) {
    auto const own = draws(0, 1e-19, 4);
    CheckedNumber const noise = MadeUp{.own = own, .again = first(own, 40, 3e-19, 1e-19), .unit = "J"}.checked();
    EXPECT_TRUE(noise.is_unseen()) << "but for rounding";
    EXPECT_EQ(noise.verdict, Verdict::undecided);
    EXPECT_EQ(MadeUp({.own = own, .again = first(own, 40, 3e-8, 1e-9), .unit = "J"}).checked().verdict, Verdict::not_resolved);
    std::vector<double> const zeros(400), ones(400, 1.0);
    CheckedNumber const unseen = MadeUp{.own = zeros, .again = first(zeros, 40, 0, 0), .unit = "s"}.checked();
    EXPECT_TRUE(unseen.is_unseen());
    EXPECT_EQ(unseen.verdict, Verdict::undecided);
    EXPECT_EQ(MadeUp({ones, first(ones, 40, 0, 0)}).checked().verdict, Verdict::resolved) << "all have it";

    Verification v;
    v.study.columns = {{"surface_time", "s", Kind::quantity, zeros}, {"loss", "J", Kind::quantity, own}};
    v.methods.resize(2);
    v.methods[0].words = "auto", v.methods[1].words = "verner65";
    v.groups = {{"", std::vector<char>(400, 1)}};
    CheckedNumber loss = MadeUp({draws(100, 10, 1), first(draws(100, 10, 1), 40)}).checked();
    loss.column = 1;
    v.numbers = {unseen, loss};
    conclude(v, scene(), {});
    EXPECT_EQ(v.resolution, Resolution::resolved);
    EXPECT_NE(v.summary.find("0 in all members that were looked at, and in those that ran again: surface_time"), std::string::npos) << v.summary;
    v.numbers = {unseen};
    conclude(v, scene(), {});
    EXPECT_EQ(v.resolution, Resolution::undecided) << "nothing was compared";
    v.orbit = OrbitCheck{1, std::numeric_limits<double>::infinity()};
    conclude(v, scene(), {});
    EXPECT_EQ(v.resolution, Resolution::resolved) << "its orbit was";
    // What one method alone has seen, or not to its end, is neither.
    MadeUp alone{.own = zeros, .again = first(zeros, 40, 0, 0), .unit = "s"};
    alone.cut = {3};
    EXPECT_FALSE(alone.checked().is_unseen());
    for (std::size_t odd = 1; odd < 40; odd += 2) alone.cut.push_back(odd);
    EXPECT_FALSE(alone.checked().is_unseen());
}

TEST(Verdict, RefutesASignThatOnlyTheStudyIsCertainOf) {
    auto const refuted = [](std::vector<double> const& own, std::vector<double> const& again, Kind kind = Kind::exponent) {
        return MadeUp{own, again, kind, "1/s"}.checked().refutes_sign;
    };
    auto const positive = draws(4000, 500, 7);
    EXPECT_TRUE(refuted(positive, draws(-1, 0.1, 8, 16)));
    EXPECT_TRUE(refuted(positive, draws(0, 100, 9, 16)));
    EXPECT_FALSE(refuted(positive, first(positive, 16, 100))) << "larger, of the same sign";
    EXPECT_FALSE(refuted(draws(0, 100, 10), draws(5, 100, 11, 16))) << "certain in neither";
    EXPECT_FALSE(refuted(positive, draws(-1, 0.1, 8, 16), Kind::quantity)) << "no exponent";
}

/// Members of a study beside what is drawn of them.
TEST(CheckSample, TakesEachMemberOnceAndAllInTheEnd) {
    std::vector<std::size_t> rows(100);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    CheckSample sample(rows, {{"", std::vector<char>(100, 1)}}, std::vector<double>(100, 1), 7);
    std::vector<std::size_t> drawn;
    for (std::size_t const count : {3u, 30u, 50u, 40u}) {
        for (std::size_t const row : sample.next(count)) drawn.push_back(row);
    }
    std::ranges::sort(drawn);
    EXPECT_EQ(drawn, rows);
    EXPECT_EQ(sample.left(), 0u);
    EXPECT_TRUE(sample.next(1).empty());
}

TEST(CheckSample, IsEvenOverGroupsAndOverCostWithinThem) {
    // 64 members of either of two groups, in turn; the cost rises along the members.
    std::vector<std::size_t> rows(128);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::vector<double> const cost(rows.begin(), rows.end());
    MemberGroup odd{"odd", std::vector<char>(128)}, even{"even", std::vector<char>(128)};
    for (std::size_t i = 0; i < 128; ++i) (i % 2 ? odd : even).has[i] = 1;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        CheckSample sample(rows, {{"", std::vector<char>(128, 1)}, even, odd}, cost, seed);
        std::array<int, 8> cells{};  // [group][quarter of the cost]
        for (std::size_t const row : sample.next(8)) ++cells[4 * (row % 2) + row / 32];
        EXPECT_EQ(std::ranges::count(cells, 1), 8) << seed;
    }
}

TEST(CheckSample, DrawsEveryMemberAlikeOften) {
    std::vector<std::size_t> rows(40);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::vector<int> drawn(40);
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        CheckSample sample(rows, {{"", std::vector<char>(40, 1)}}, std::vector<double>(40, 1), seed);
        for (std::size_t const row : sample.next(10)) ++drawn[row];
    }
    // 1000 times each, with a standard deviation of √(4000 · ¼ · ¾) = 27.
    EXPECT_GT(std::ranges::min(drawn), 850);
    EXPECT_LT(std::ranges::max(drawn), 1150);
}

/// A check of six members by `auto` at a hundredth of the tolerance, foreseen at four times a member's work, is more than a tenth of few members' work.
TEST(ForeseenCheck, IsATenthOfTheWorkWhereThatIsEnough) {
    Scene const varied = scene_of("schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nmembers = 400\nduration = \"1 s\"\n[study.vary]\n\"initial.y\" = { dist = \"norm\", mean = 0, sd = 1e-5 }\n");
    EXPECT_EQ(foreseen_check(varied, {}, 10'000), 1000);
    EXPECT_EQ(foreseen_check(varied, {}, 100), 0);
    EXPECT_EQ(foreseen_check(varied, 0u, 1000), 0);
    EXPECT_GT(foreseen_check(varied, 50u, 1000), 50);
    EXPECT_EQ(foreseen_check(varied, 5000u, 1000), foreseen_check(varied, 1000u, 1000)) << "no more than there are";
    EXPECT_EQ(foreseen_check(scene(), {}, 400), 0) << "nothing varies: they are one member";
}

/// A steel block of 0.1872 kg falls through 0.1 mm: 1.8366e-4 J with what the crank's speed of π rad/s adds.
TEST(EnergyCheck, IsOfTheFallThroughTheClearance) {
    EXPECT_NEAR(fall_energy(scene()), 0.1872 * (9.81 * 1e-4 + std::pow(1e-4 * std::numbers::pi, 2)), 1e-12);
    EXPECT_FALSE(audit_energy({}, scene())) << "no check asked for it";
    auto const little = audit_energy({1e-6, -1e-6, nan, 1e-6}, scene());  // 1 s is less than a revolution, and counts as one
    ASSERT_TRUE(little);
    EXPECT_NEAR(little->share, 1e-6 / fall_energy(scene()), 1e-12);
    EXPECT_FALSE(little->is_too_much);
    EXPECT_TRUE(audit_energy(std::vector<double>(4, -2e-6), scene())->is_too_much);
    Scene longer = scene();
    longer.integrator.end_time = 20;  // ten revolutions
    EXPECT_NEAR(audit_energy(std::vector<double>(4, -2e-6), longer)->share, 2e-7 / fall_energy(scene()), 1e-12);
    EXPECT_FALSE(audit_energy(std::vector<double>(4, nan), scene())) << "nobody came to the end";
}

TEST(EnergyCheck, IsAskedOfExponentsUnderALawThatKeepsEnergyByOneCheckAlone) {
    auto const audits = [](std::string const& law, std::string const& kind, std::string const& asked = "") {
        Scene const study = scene_of("schema = 1\n[contact]\nlaw = \"" + law + "\"\n[study]\nkind = \"" + kind +
                                     "\"\nmembers = 8\nduration = \"2 s\"\n" + asked);
        auto const methods = check_methods(study);
        for (CheckMethod const& m : methods) {
            // The study's own orbits, with their energy.
            if (m.audits_energy) {
                EXPECT_EQ(m.scene.integrator.rtol, study.integrator.rtol);
                EXPECT_TRUE(selects(m.scene.quantities, Quantity::energy_residual));
                EXPECT_TRUE(m.of_exponents);
            }
        }
        return std::ranges::count_if(methods, &CheckMethod::audits_energy);
    };
    std::string const residual = "quantities = [\"energy_residual\"]\n";
    EXPECT_EQ(audits("conservative", "lyapunov"), 1);
    EXPECT_EQ(audits("kelvin_voigt", "lyapunov", residual), 1);
    EXPECT_EQ(audits("paper", "lyapunov", residual), 0) << "its switches make energy";
    EXPECT_EQ(audits("conservative", "tolerance", residual), 0) << "no exponents";
    EXPECT_EQ(audits("paper", "tolerance", residual), 0);
}

/// Steps of one member by each check of a scene.
std::vector<std::uint64_t> steps_of_checks(std::string const& text) {
    std::vector<std::uint64_t> steps;
    auto const backend = cpu_backend(best_isa());
    Scene const study = scene_of(text);
    FreshRun const run{*backend};
    steps.push_back(fresh_numbers(without_series(study), {0}, run).steps.front());
    for (CheckMethod const& method : check_methods(study)) steps.push_back(fresh_numbers(method.scene, {0}, run).steps.front());
    return steps;
}

TEST(CheckMethods, TakeStepsOfTheirOwn) {
    std::string const planar = "[mechanism]\nkind = \"planar_slider_crank\"\n", rigid = "[contact]\nlaw = \"rigid\"\nrestitution = 0.5\n";
    for (std::string const& what : {std::string(), std::string("[contact]\nlaw = \"conservative\"\n"), planar, planar + rigid, rigid}) {
        for (std::string const method : {"auto", "dopri5", "bs32", "dop853", "verner65"}) {
            if (what.ends_with(rigid) && (method == "bs32" || method == "dop853")) continue;
            auto const steps = steps_of_checks("schema = 1\n" + what + "[integrator]\nmethod = \"" + method +
                                               "\"\n[initial]\nvy = 0.1\n[study]\nmembers = 8\nduration = \"8 ms\"\n");
            ASSERT_EQ(steps.size(), 3u);
            EXPECT_NE(steps[1], steps[2]) << "the checks are two: " << what << method;
            EXPECT_NE(steps[0], steps[2]) << what << method;
        }
    }
}

TEST(MemberNumbers, LeaveOutTheResidualOfALawThatKeepsEnergy) {
    auto const has_residual = [](char const* law) {
        Scene const study = scene_of(std::string("schema = 1\n[mechanism]\nkind = \"slider_crank\"\n[contact]\nlaw = \"") + law +
                                     "\"\n[study]\nkind = \"ensemble\"\nmembers = 1\nduration = \"1 us\"\nsamples = 0\nquantities = [\"energy_residual\"]\n");
        auto const backend = cpu_backend(best_isa());
        auto const columns = fresh_numbers(study, {0}, {*backend}).columns;
        return std::ranges::any_of(columns, [](auto const& column) { return column.name == "energy_residual"; });
    };
    EXPECT_TRUE(has_residual("paper"));
    EXPECT_FALSE(has_residual("conservative"));
    EXPECT_FALSE(has_residual("kelvin_voigt"));
}

TEST(MemberNumbers, OfMembersThatAreCutShortAreNone) {
    Scene const study = scene_of("schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nmembers = 4\nduration = \"20 ms\"\nquantities = [\"drive_work\"]\n"
                                 "[study.vary]\n\"initial.y\" = { dist = \"unif\", low = \"-0.05 mm\", high = \"0.05 mm\" }\n");
    auto const backend = cpu_backend(best_isa());
    MemberNumbers const whole = fresh_numbers(study, {0, 1, 2, 3}, {*backend});
    MemberNumbers const bounded = fresh_numbers(study, {0, 1, 2, 3}, {*backend}, {1'000'000, whole.steps[1] / 3, 1'000'000, whole.steps[3] / 3});
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(whole.finished[i]);
        EXPECT_EQ(bounded.finished[i] != 0, i % 2 == 0);
        EXPECT_EQ(std::isnan(bounded.columns[0].values[i]), i % 2 == 1);
        if (i % 2 == 1) {
            EXPECT_EQ(bounded.steps[i], whole.steps[i] / 3);
        }
    }
    EXPECT_EQ(bounded.columns[0].values[0], whole.columns[0].values[0]);
}

}  // namespace
}  // namespace slideway::testing::verification_test
