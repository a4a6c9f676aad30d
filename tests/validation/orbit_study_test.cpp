// Lyapunov exponents of slider-cranks whose sign, sum or pairs theory knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "host/chaos/exponents.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/exponent_table.hpp"

namespace slideway::orbit_study_test {
namespace {

constexpr std::size_t row_size = section_columns(state_size);
constexpr char const* scattered_starts = R"(
[study.vary]
"initial.y" = { dist = "unif", low = "-0.03 mm", high = "0.03 mm" }
"initial.z" = { dist = "unif", low = "-0.03 mm", high = "0.03 mm" }
"initial.roll" = { dist = "unif", low = -1e-3, high = 1e-3 }
"initial.yaw" = { dist = "unif", low = -1e-3, high = 1e-3 }
"initial.pitch" = { dist = "unif", low = -1e-3, high = 1e-3 }
)";

/// Exponents and their standard errors, [member][k].
struct Found {
    std::size_t k = 0;
    std::vector<double> values, errors;
    std::vector<double> of(std::size_t j) const {
        std::vector<double> column;
        for (std::size_t i = j; i < values.size(); i += k) column.push_back(values[i]);
        return column;
    }
};

Found exponents(std::string_view study, std::string_view starts = scattered_starts) {
    Scene const scene = parse_scene(fmt::format("schema = 1\n{}{}", study, starts), "test.toml");
    MemberSet const all(MemberRange{0, member_count(scene)});
    EnsemblePlan const plan = ensemble_plan(scene, all, *cpu_backend(best_isa()), 1);
    ExponentTable const table(scene);
    Found found;
    found.k = static_cast<std::size_t>(scene.chaos.exponents);
    found.values.resize(all.count() * found.k);
    found.errors = found.values;
    auto const keep = [&](BlockResult const& block) {
        for (std::size_t i = 0; i < block.members.size(); ++i) {
            std::vector<double> const row = table.row(block, i);  // exponents, then their errors
            std::size_t const at = block.members[i] * found.k;
            std::copy_n(row.begin(), found.k, found.values.begin() + static_cast<std::ptrdiff_t>(at));
            std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(found.k), found.k, found.errors.begin() + static_cast<std::ptrdiff_t>(at));
        }
    };
    EnsembleTotals const totals =
        run_ensemble(plan, cpu_backend(best_isa())->kernel(scene.parts, true), keep, StopRequest{});
    EXPECT_EQ(totals.failed(), 0u);
    return found;
}

/// Crank at rest, no friction and no damping: a Hamiltonian system of five degrees of freedom.  Its flow keeps phase volume, so that all
/// exponents add up to 0, and is symplectic, so that they come in pairs ±λ; along the orbit and across energies offsets neither grow
/// nor shrink, which makes the fifth pair 0.  An impact grows and shrinks offsets by factors of 1e5.
TEST(ConservativeBounce, ExponentsComeInPairs) {
    Found const found = exponents(R"(
[mechanism]
crank_speed = 0
start_angle = "30 deg"
[contact]
law = "conservative"
eta = 0
[study]
kind = "lyapunov"
members = 8
exponents = 10
Ttr = "5 ms"
duration = "40 ms"
dt = "2 us"
d0 = 1e-8
)");
    std::vector<double> means;
    for (std::size_t j = 0; j < 10; ++j) means.push_back(mean_of_members(found.of(j)).mean);
    std::sort(means.begin(), means.end(), std::greater<>());
    double sum = 0, size = 0;
    for (std::size_t j = 0; j < 5; ++j) {
        double const up = means[j], down = means[9 - j];
        EXPECT_NEAR(up + down, 0, 0.05 * up + 15) << j << ": " << up << ' ' << down;
        sum += up + down;
        size += up - down;
    }
    EXPECT_GT(means[2], 50);
    EXPECT_LT(means[4] - means[5], 60);
    EXPECT_LT(std::abs(sum), 0.02 * size);
}

/// The planar slider-crank, let go, with impacts that lose nothing: three degrees of freedom, and pairs as above.  Its depths are differences of lengths
/// of the links, which rounding keeps from being located as those within a clearance are.
TEST(PlanarBounceWithoutLoss, ExponentsComeInPairs) {
    Found const found = exponents(R"(
[mechanism]
kind = "planar_slider_crank"
crank_length = 0.153
rod_length = 0.306
crank_speed = 150
[drive]
kind = "free"
[joint]
slider_length = 0.1
slider_height = 0.05
clearance = 1e-3
[contact]
point_stiffness = 1e11
restitution = 1
[initial]
vy = 0.1
[integrator]
rtol = 1e-8
atol = 1e-8
[study]
kind = "lyapunov"
members = 8
exponents = 6
Ttr = 0
duration = "160 ms"
dt = "20 us"
d0 = 1e-7
)", R"(
[study.vary]
"initial.y" = { dist = "unif", low = "-0.3 mm", high = "0.3 mm" }
)");
    std::vector<double> means;
    for (std::size_t j = 0; j < 6; ++j) means.push_back(mean_of_members(found.of(j)).mean);
    std::sort(means.begin(), means.end(), std::greater<>());
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(means[j] + means[5 - j], 0, 0.05 * means[j] + 30) << j;
    EXPECT_GT(means[0], 500);
}

/// It leans to one side or the other, 7e-6 of the joint's scale apart: a shadow must not come to rest in the other place.
TEST(RestingSlider, HasNoPositiveExponent) {
    for (char const* const dt : {"1 ms", "20 ms"}) {
        Found const found = exponents(fmt::format(R"(
[mechanism]
crank_speed = 0
[contact]
law = "conservative"
chi_line = 0.5
chi_surface = 0.5
[friction]
[initial]
y = "-0.1 mm"
[study]
kind = "lyapunov"
members = 16
Ttr = "0.2 s"
duration = "0.4 s"
dt = "{}"
)",
                                                  dt),
                                      "");
        // On a way without slope every place is as good as any: one exponent is 0, to the rounding of offsets, 1e-15/(d0 dt).
        for (double const exponent : found.values) EXPECT_NEAR(exponent, 0, 1e-5) << dt;
    }
}

/// A slider that glides back and forth repeats itself every turn.
TEST(GlidingSlider, HasNoPositiveExponent) {
    Found const found = exponents(R"(
[contact]
law = "conservative"
chi_line = 10
chi_surface = 10
[friction]
[study]
kind = "lyapunov"
members = 32
transient_revolutions = 1
revolutions = 3
)");
    MeanOfMembers const mean = mean_of_members(found.values);
    EXPECT_LT(mean.mean + mean.half_width, 0) << mean.mean;
    for (double const exponent : found.values) EXPECT_LT(exponent, 0.02);
}

std::string paper_law(std::string_view more, std::string_view integrator = "") {
    return fmt::format(
        "[contact]\nlaw = \"paper\"\n[friction]\n[integrator]\n{}[study]\nkind = \"lyapunov\"\nmembers = 32\n"
        "transient_revolutions = 0.05\nrevolutions = 0.15\n{}",
        integrator, more);
}

/// Converged: neither the distance of the shadows nor the time between rescalings, nor the tolerance of the steps, has a say.
TEST(PaperLaw, ExponentDependsOnNeitherOffsetNorRescalings) {
    MeanOfMembers const usual = mean_of_members(exponents(paper_law("")).values);
    EXPECT_GT(usual.mean - usual.half_width, 300);
    for (std::string const& other :
         {paper_law("d0 = 1e-4\n"), paper_law("d0 = 1e-8\nrescalings_per_revolution = 20000\n"),
          paper_law("", "rtol = 1e-8\natol = 1e-8\n")}) {
        MeanOfMembers const mean = mean_of_members(exponents(other).values);
        EXPECT_NEAR(mean.mean, usual.mean, 1.5 * (mean.half_width + usual.half_width)) << other;
    }
}

/// Where steps leap over the switches of the contact modes, member and shadow switch in the same stage of the same step, and the jump of
/// the force between their switches is lost: the exponent is another one.
TEST(PaperLaw, StepsThatLeapOverSwitchesMissHowTheySeparate) {
    MeanOfMembers const located = mean_of_members(exponents(paper_law("")).values);
    MeanOfMembers const leaping = mean_of_members(exponents(paper_law("", "locate_modes = false\n")).values);
    EXPECT_GT(std::abs(leaping.mean - located.mean), 2 * (leaping.half_width + located.half_width))
        << leaping.mean << ' ' << located.mean;
}

/// With restitution the paper's law jumps where pairs part, which no memory records: steps end there too.
TEST(PaperLaw, WithRestitutionHasAnExponentThatToleranceDoesNotChange) {
    auto const with = [](double tolerance) {
        return mean_of_members(
            exponents(fmt::format("[contact]\nlaw = \"paper\"\nrestitution = 0.9\n[friction]\n[integrator]\n"
                                  "rtol = {0}\natol = {0}\n[study]\nkind = \"lyapunov\"\nmembers = 32\n"
                                  "transient_revolutions = 0.1\nrevolutions = 0.3\n",
                                  tolerance))
                .values);
    };
    MeanOfMembers const loose = with(1e-5), tight = with(1e-8);
    EXPECT_NEAR(loose.mean, tight.mean, 1.5 * (loose.half_width + tight.half_width));
}

/// Sections of members that change between the explicit pair and the stiff method, and what they cost.
struct Sections {
    std::vector<double> rows;  // [member][place][time and state]
    std::vector<MemberRecord> records;
};

Sections sections(Isa isa, std::string_view method, double rtol = 1e-6, double revolutions = 0.3) {
    Scene const scene = parse_scene(fmt::format(R"(schema = 1
[contact]
law = "conservative"
chi_line = 10
chi_surface = 10
[friction]
[integrator]
method = "{}"
rtol = {}
[study]
kind = "poincare"
members = 12
section = {{ on = "vy", direction = "both" }}
max_crossings = 400
transient_revolutions = 0
revolutions = {}
{})",
                                                method, rtol, revolutions, scattered_starts),
                                    "test.toml");
    EnsemblePlan const plan = ensemble_plan(scene, MemberSet(MemberRange{0, scene.members}), *cpu_backend(isa), 1);
    Sections found;
    found.records.resize(scene.members);
    found.rows.resize(scene.members * scene.chaos.max_crossings * row_size);
    auto const keep = [&](BlockResult const& block) {
        auto const rows = static_cast<std::ptrdiff_t>(block.members.front() * scene.chaos.max_crossings * row_size);
        std::copy(block.sections.begin(), block.sections.end(), found.rows.begin() + rows);
        std::copy(block.records.begin(), block.records.end(),
                  found.records.begin() + static_cast<std::ptrdiff_t>(block.members.front()));
    };
    run_ensemble(plan, cpu_backend(isa)->kernel(scene.parts, false), keep, StopRequest{});
    return found;
}

TEST(SectionsOfStiffSteps, LieOnTheirSurfaceAndCostWhatTheirMemberNeeds) {
    for (char const* const method : {"auto", "ros34pw2"}) {
        Sections const one = sections(Isa::scalar, method);
        std::size_t count = 0, stiff = 0;
        for (std::size_t i = 0; i < one.rows.size(); i += row_size) {
            if (std::isnan(one.rows[i])) continue;
            ++count;
            EXPECT_LT(std::abs(one.rows[i + 3]), 1e-11) << method;  // vy [m/s], of impacts of 1e-2 m/s
        }
        for (MemberRecord const& record : one.records) stiff += record.stiff_steps;
        EXPECT_GT(count, 1000u) << method;
        EXPECT_GT(stiff, 100u) << method;
        if (lanes_of(best_isa()) == 1) continue;
        Sections const packed = sections(best_isa(), method);
        for (std::size_t i = 0; i < one.records.size(); ++i) {
            EXPECT_EQ(packed.records[i].jacobian_evaluations, one.records[i].jacobian_evaluations) << method << i;
            EXPECT_EQ(packed.records[i].rhs_evaluations, one.records[i].rhs_evaluations) << method << i;
            EXPECT_EQ(packed.records[i].crossings, one.records[i].crossings) << method << i;
        }
    }
}

TEST(SectionsOfClockedSteps, AreThoseOfStepsOfTime) {
    // vy is zero in the middle of impacts.  From one to the next errors grow a hundredfold, so that they are judged by another method's.
    Sections const want = sections(best_isa(), "dopri5", 1e-11, 0.006);
    auto const errors = [&](std::string_view method) {
        Sections const found = sections(best_isa(), method, 1e-9, 0.006);
        for (std::size_t i = 0; i < want.records.size(); ++i) EXPECT_EQ(found.records[i].crossings, want.records[i].crossings) << i;
        std::vector<double> late;
        for (std::size_t i = 0; i < want.rows.size(); i += row_size) {
            if (std::isnan(want.rows[i])) continue;
            late.push_back(std::abs(found.rows[i] - want.rows[i]));
            EXPECT_LT(std::abs(found.rows[i + 3]), 1e-11) << "vy [m/s]";
        }
        std::ranges::sort(late);
        return late;
    };
    auto const by_clock = errors("verner65"), by_time = errors("dopri5");
    ASSERT_GT(by_clock.size(), 20u);
    EXPECT_LT(by_clock[by_clock.size() / 2], 1e-9) << "median [s]";
    for (std::size_t i = by_clock.size() / 2; i < by_clock.size(); ++i) EXPECT_LT(by_clock[i], 10 * by_time[i]) << i;
}

}  // namespace
}  // namespace slideway::orbit_study_test
