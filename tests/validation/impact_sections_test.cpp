// Sections of sliders that bounce between rigid faces: what impacts there are follows from the fall of a stone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tests/support/section_runs.hpp"

namespace slideway::impact_sections_test {
namespace {

using namespace testing::section_runs;

/// Impacts up to a time: the k-th flight lasts 2 e^k v/g.
struct Bounce { double time, before, after; };
std::vector<Bounce> bounces(double e, double until) {
    std::vector<Bounce> all;
    double speed = landing_speed;
    for (double t = fall_time; t <= until; t += 2 * speed / gravity) {
        all.push_back({t, -speed, e * speed});
        speed *= e;
    }
    return all;
}

TEST(ImpactSections, HaveTheStatesBeforeAndAfterEachBounce) {
    struct Case { double e; std::size_t impacts; };
    for (auto const& [e, impacts] : {Case{1, 32}, Case{0.99, 39}, Case{0.999, 33}}) {
        auto const want = bounces(e, 1);
        ASSERT_EQ(want.size(), impacts);
        for (char const* const section : {R"(on = "impacts")", R"(on = "gap_y[P1]", value = 0.0, direction = "both")"}) {
            auto const rows = rows_of(falling(section, fmt::format("{:.6f}", e)));
            ASSERT_EQ(rows.size(), 2 * impacts) << section << e;
            for (std::size_t k = 0; k < rows.size(); ++k) {
                Bounce const& bounce = want[k / 2];
                EXPECT_NEAR(rows[k][0], bounce.time, 1e-11) << k;
                EXPECT_NEAR(rows[k][place_y], -clearance, 1e-13) << k;
                EXPECT_NEAR(rows[k][place_vy], k % 2 == 0 ? bounce.before : bounce.after, 1e-10) << k;
            }
            for (std::size_t k = 0; k < rows.size(); k += 2) EXPECT_EQ(rows[k][0], rows[k + 1][0]) << "one time";
        }
    }
}

TEST(ImpactSections, OfOneDirectionHaveTheRowBeforeOrTheRowAfter) {
    auto const both = rows_of(falling(R"(on = "impacts")", "0.9", "", 0.2));
    ASSERT_GT(both.size(), 10u);
    for (std::size_t first : {0u, 1u}) {
        std::string const direction = first == 0 ? "falling" : "rising";
        std::vector<Row> want;
        for (std::size_t k = first; k < both.size(); k += 2) want.push_back(both[k]);
        EXPECT_EQ(rows_of(falling(fmt::format(R"(on = "impacts", direction = "{}")", direction), "0.9", "", 0.2)), want);
        EXPECT_EQ(rows_of(falling(fmt::format(R"(on = "gap_y[P8]", direction = "{}")", direction), "0.9", "", 0.2)), want);
    }
}

TEST(ImpactSections, OfBouncesThatEndArePairsUntilTheyDo) {
    auto const want = bounces(0.9, 0.2);
    auto const rows = rows_of(falling(R"(on = "impacts")", "0.9"));
    ASSERT_GT(rows.size(), 2 * want.size());
    for (std::size_t k = 0; k < want.size(); ++k) {
        EXPECT_NEAR(rows[2 * k][0], want[k].time, 1e-11) << k;
        EXPECT_NEAR(rows[2 * k][place_vy], want[k].before, 1e-10) << k;
        EXPECT_NEAR(rows[2 * k + 1][place_vy], want[k].after, 1e-10) << k;
    }
    // All bounces are over after 1/64 s (1 + 2 e/(1 − e)), and nothing follows.
    EXPECT_NEAR(rows.back()[0], fall_time * (1 + 2 * 0.9 / 0.1), 1e-5);
    EXPECT_NEAR(rows.back()[place_vy], 0, 1e-15);
}

// Without gravity it flies from face to face.  Apices 1, 2, 5, 6 of the hole, on its side +z, meet the way where the slider is at −c; 3, 4, 7, 8 at c.
TEST(ImpactSections, OfAnApexAreThoseOnItsOwnFace) {
    std::string const text = R"(schema = 1
[mechanism]
kind = "free_slider"
gravity = 0.0
[joint]
clearance = "1 mm"
[contact]
law = "rigid"
restitution = 0.9
[initial]
vz = 0.1
vx = 0.2
[study]
kind = "poincare"
members = 1
Ttr = 0.0
duration = 0.3
section = {{ {} }}
)";
    auto const rows = [&](std::string const& section) { return rows_of(fmt::format(fmt::runtime(text), section)); };
    auto const all = rows(R"(on = "impacts")"), above = rows(R"(on = "gap_z[P7]", direction = "both")"),
               below = rows(R"(on = "gap_z[P1]", direction = "both")");
    double t = 0.01, speed = 0.1;
    std::vector<Row> want_above, want_below;
    std::size_t k = 0;
    for (; t < 0.3; ++k, speed *= 0.9, t += 2e-3 / speed) {
        double const side = k % 2 == 0 ? 1 : -1;
        ASSERT_GT(all.size(), 2 * k + 1);
        EXPECT_NEAR(all[2 * k][0], t, 1e-11);
        EXPECT_NEAR(all[2 * k][place_z], 1e-3 * side, 1e-13);
        EXPECT_NEAR(all[2 * k][place_vz], speed * side, 1e-11);
        EXPECT_NEAR(all[2 * k + 1][place_vz], -0.9 * speed * side, 1e-11);
        auto& of_side = k % 2 == 0 ? want_above : want_below;
        of_side.insert(of_side.end(), {all[2 * k], all[2 * k + 1]});
    }
    EXPECT_EQ(all.size(), 2 * k);
    EXPECT_EQ(above, want_above);
    EXPECT_EQ(below, want_below);
    EXPECT_TRUE(rows(R"(on = "gap_y[P1]", direction = "both")").empty());
}

TEST(ImpactSections, AfterATransientAreTheLaterOnes) {
    auto const all = rows_of(falling(R"(on = "impacts")"));
    auto text = falling(R"(on = "impacts")");
    text.replace(text.find("Ttr = 0.0"), 9, "Ttr = 0.5");
    text.replace(text.find("duration = 1"), 12, "duration = 0.5");
    std::vector<Row> want;
    std::ranges::copy_if(all, std::back_inserter(want), [](Row const& row) { return row[0] >= 0.5; });
    EXPECT_EQ(want.size(), 32u);
    EXPECT_EQ(rows_of(text), want);
}

constexpr std::string_view tumbling = R"(schema = 1
[mechanism]
kind = "{}"
crank_speed = 60
[contact]
law = "rigid"
restitution = 0.8
[friction]
{}
[study]
kind = "poincare"
members = 13
seed = 3
Ttr = 0.0
duration = 0.1
section = {{ on = "{}", direction = "both" }}
[study.vary]
{}
)";
constexpr std::string_view spatial_starts = R"("initial.vy" = { dist = "unif", low = -0.05, high = 0.05 }
"initial.vz" = { dist = "unif", low = -0.05, high = 0.05 }
"initial.wx" = { dist = "unif", low = -1, high = 1 })";
constexpr std::string_view planar_starts = R"("initial.y" = { dist = "unif", low = "-0.03 mm", high = "0.03 mm" }
"initial.pitch" = { dist = "unif", low = -1e-3, high = 1e-3 })";

// Of a planar slider-crank the height of the slider's centre is r sin φ + l sin θ, and its corners lie half a length before and behind it.
TEST(ImpactSections, OfAPlanarSliderReverseTheCornersThatMeetTheirWalls) {
    Scene const scene = parse_scene(fmt::format(fmt::runtime(tumbling), "planar_slider_crank", "enabled = false", "impacts", planar_starts), "test.toml");
    Inputs const in = complete_inputs(scene.inputs);
    auto const found = run_scene(fmt::format(fmt::runtime(tumbling), "planar_slider_crank", "enabled = false", "impacts", planar_starts));
    std::size_t single = 0, impacts = 0;
    for (auto const& rows : found.rows) {
        ASSERT_EQ(rows.size() % 2, 0u);
        for (std::size_t k = 0; k < rows.size(); k += 2) {
            auto const &a = rows[k], &b = rows[k + 1];
            ASSERT_EQ(a[0], b[0]);
            ++impacts;
            int near = 0;
            double before = 0, after = 0;
            for (int corner = 0; corner < 4; ++corner) {
                double const along = corner < 2 ? 0.5 * in.slider_length : -0.5 * in.slider_length, side = corner == 0 || corner == 3 ? 1 : -1;
                auto const height = [&](Row const& s) {
                    double const centre = in.crank_length * std::sin(s[1]) + in.rod_length * std::sin(s[2]);
                    return side * (centre + along * std::sin(s[3])) + in.way_width / 2 * (std::cos(s[3]) - 1);
                };
                auto const rate = [&](Row const& s) {
                    double const centre = in.crank_length * std::cos(s[1]) * s[4] + in.rod_length * std::cos(s[2]) * s[5];
                    return -side * (centre + along * std::cos(s[3]) * s[6]) + in.way_width / 2 * std::sin(s[3]) * s[6];
                };
                if (height(a) < in.clearance_y * (1 - 1e-7)) continue;
                ++near, before = rate(a), after = rate(b);
            }
            EXPECT_GE(near, 1) << "an impact is at a wall";
            if (near != 1) continue;
            ++single;
            EXPECT_LT(before, 0);
            if (after > 1e-6) EXPECT_NEAR(after, -0.8 * before, 1e-7 * std::abs(before) + 1e-9);
        }
    }
    EXPECT_GT(impacts, 100u);
    EXPECT_GT(single, impacts / 3);
}

TEST(ImpactSections, HaveTheSameBitsInEveryLane) {
    struct Case { char const* kind; std::string_view starts; char const* on; };
    for (auto const& [kind, starts, on] : {Case{"slider_crank", spatial_starts, "impacts"}, Case{"slider_crank", spatial_starts, "gap_y[P2]"},
                                           Case{"planar_slider_crank", planar_starts, "impacts"}}) {
        auto const text = fmt::format(fmt::runtime(tumbling), kind, "kinetic = 0.1", on, starts);
        auto const one = run_scene(text, Isa::scalar), packed = run_scene(text);
        std::size_t count = 0;
        for (auto const& rows : one.rows) count += rows.size();
        EXPECT_GT(count, 100u) << kind << on;
        EXPECT_EQ(packed.rows, one.rows) << kind << on;
    }
}

}  // namespace
}  // namespace slideway::impact_sections_test
