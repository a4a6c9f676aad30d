// A method outside its stable range says so; one inside is never accused (docs/evidence/stability.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "host/config/scene.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::stability_test {
namespace {

constexpr Selection audit = selection_of(Quantity::energy_residual);

/// The slider on its lower face, pressed so hard that it stays there, with a little rocking: a linear oscillation.
/// The crank is at rest and nothing rubs or damps, so the rocking frequency is √(k (L_k/2)² / I_z), k = E_s L_k w_b / l_a.
struct Rocking {
    Inputs inputs;
    double rate;  // Ω [rad/s]

    Rocking() {
        Inputs in;
        in.crank_speed = 0;
        in.eta = 0;
        in.gravity = 1e4;
        in = complete_inputs(in);
        double const stiffness = in.slider_young_modulus * in.slider_length * in.way_depth / in.thickness_y;
        double const weight = (in.slider_mass + in.rod_mass * in.rod_mass_center) * in.gravity;
        double const depth = weight / stiffness, lever = in.slider_length / 2;
        in.y = -in.clearance_y - depth;
        rate = std::sqrt(stiffness * lever * lever / in.slider_inertia_z);
        in.wz = 0.01 * depth / lever * rate;  // the ends move by a hundredth of the depth
        inputs = in;
    }

    /// Its end under rk4 with a step of `fraction` of the linear limit 2√2/Ω.
    MemberRecord run(double fraction, Selection quantities) const {
        testing::RunOptions o;
        o.parts = {Law::paper, Damping::point, false, false};
        o.settings.method = Method::rk4;
        o.settings.fixed_step = fraction * 2 * std::numbers::sqrt2 / rate;
        o.settings.end_time = 2e-3;
        o.quantities = quantities;
        return testing::run(best_isa(), o, {inputs}).records[0];
    }
};

TEST(FixedStep, IsStableUpToTheLinearLimit) {
    Rocking const rocking;
    for (double const fraction : {0.25, 0.5, 0.9}) {
        EXPECT_EQ(rocking.run(fraction, 0).status, Status::finished) << fraction;
    }
    for (double const fraction : {1.5, 2.0, 3.0}) {
        EXPECT_NE(rocking.run(fraction, 0).status, Status::finished) << fraction;
    }
}

TEST(FixedStep, IsJudgedWhateverIsAskedFor) {
    // The same steps and the same verdict with no quantity, with the audit and with one that is none of the audit's.
    for (Law const law : testing::every_law()) {
        testing::RunOptions o;
        o.parts = {law, info(law).has(Damping::rate) ? Damping::rate : Damping::point, true, false};
        o.settings.method = Method::rk4;
        o.settings.fixed_step = 1.8e-5;
        o.settings.end_time = 0.05;
        auto const members = testing::scattered_starts(11, 1e-4, std::numbers::pi, law);
        o.quantities = audit;
        auto const expected = testing::run(best_isa(), o, members);
        for (Selection const quantities : {Selection{0}, selection_of(Quantity::peak_tilt)}) {
            o.quantities = quantities;
            auto const got = testing::run(best_isa(), o, members);
            for (std::size_t i = 0; i < members.size(); ++i) {
                EXPECT_EQ(got.records[i].status, expected.records[i].status);
                EXPECT_EQ(got.states[i], expected.states[i]);
            }
        }
    }
}

/// Members of each status.
std::array<int, status_count> count_ends(testing::EnsembleResult const& r) {
    std::array<int, status_count> ended{};
    for (auto const& record : r.records) ++ended[static_cast<std::size_t>(record.status)];
    return ended;
}

int count_of(std::array<int, status_count> const& ended, Status status) {
    return ended[static_cast<std::size_t>(status)];
}

class FixedStepInImpacts : public ::testing::TestWithParam<Law> {
protected:
    /// Falling starts; @param fraction of the linear limit of a slider that rocks on its lower face.
    std::array<int, status_count> run(double fraction, double crank_speed = std::numbers::pi,
                                      double end_time = 0.1) const {
        testing::RunOptions o;
        o.parts = {GetParam(), info(GetParam()).has(Damping::rate) ? Damping::rate : Damping::point, true, false};
        o.settings.method = Method::rk4;
        o.settings.fixed_step = fraction * limit() * 2 * std::numbers::sqrt2 / Rocking().rate;
        o.settings.end_time = end_time;
        o.quantities = 0;
        return count_ends(testing::run(best_isa(), o, testing::scattered_starts(members, 1e-4, crank_speed, GetParam())));
    }
    /// A bed is stiff at the apices by a third of what it is in all, and meets the way with little of it.
    static double limit() { return GetParam() == Law::foundation ? 3 : 1; }
    static bool has_points() { return has_group(info(GetParam()).groups, KeyGroup::hertz); }
    static constexpr int members = 16;
};

TEST_P(FixedStepInImpacts, WellBelowTheLimitFinishes) {
    // Apices softer than the surface meet the way slowly; those of a law without points do so at the limit's own rate.
    EXPECT_EQ(count_of(run(has_points() ? 0.5 : 0.1), Status::finished), members);
}

TEST_P(FixedStepInImpacts, BeyondTheLimitIsToldFromAResult) {
    auto const twice = run(2), thrice = run(3), tenfold = run(10);
    if (has_points()) {
        EXPECT_EQ(count_of(twice, Status::unstable), members) << "all reach the end, and none is believed";
    }
    for (auto const& ended : {twice, thrice, tenfold}) EXPECT_EQ(count_of(ended, Status::finished), 0);
}

TEST_P(FixedStepInImpacts, BeyondTheLimitIsToldWhereFrictionBurnsMost) {
    // At 47 rad/s friction burns a hundred times what impacts do: the first turn.
    EXPECT_EQ(count_of(run(2, 47, 2 * std::numbers::pi / 47), Status::finished), 0);
}

INSTANTIATE_TEST_SUITE_P(Laws, FixedStepInImpacts, ::testing::ValuesIn(testing::every_law()),
                         [](auto const& p) { return std::string(slideway::info(p.param).name); });

TEST(StiffMethodAlone, IsFlaggedWhereAnImpactCostItEnergy) {
    testing::RunOptions o;
    o.parts = {Law::conservative, Damping::rate, true, false};
    o.settings.method = Method::ros34pw2;
    o.settings.rtol = o.settings.atol = 1e-5;  // loose enough for it to leap into the way
    o.settings.end_time = 0.02;  // one to three impacts
    o.quantities = testing::all_quantities;
    auto const r = testing::run(best_isa(), o, testing::scattered_starts(64));
    int flagged = 0;
    for (std::size_t i = 0; i < r.records.size(); ++i) {
        double const burnt = r.value(i, Quantity::friction_loss) + std::abs(r.value(i, Quantity::damping_loss));
        // What contact stored at most is not among the quantities; no more than was burnt in the end.
        bool const lost = std::abs(r.value(i, Quantity::energy_residual)) > 0.4 * burnt;
        if (lost) {
            EXPECT_EQ(r.records[i].status, Status::unstable) << i;
        }
        flagged += r.records[i].status == Status::unstable;
    }
    EXPECT_GT(flagged, 0);
    // dopri5 makes the same falls without.
    o.settings.method = Method::dopri5;
    EXPECT_EQ(count_of(count_ends(testing::run(best_isa(), o, testing::scattered_starts(64))), Status::unstable), 0);
}

TEST(StiffMethodAlone, IsFlaggedUnderALawThatMakesEnergyToo) {
    // Few impacts: what the method loses in one shows in what is burnt, threefold and more.
    testing::RunOptions o;
    o.parts = {Law::paper, Damping::point, true, false};
    o.settings.method = Method::ros34pw2;
    o.settings.rtol = o.settings.atol = o.settings.stiff_tolerance = 1e-3;
    o.settings.end_time = 0.1;
    o.quantities = 0;
    auto const members = testing::scattered_starts(16, 1e-4, 0.1);
    EXPECT_GE(count_of(count_ends(testing::run(best_isa(), o, members)), Status::unstable), 4);
}

TEST(ThePapersLaw, IsNotTheMethodsFault) {
    // Without damping nothing burns what the law makes, and starts inside the way turn into heat and flight what no fall could.
    auto undamped = testing::scattered_starts(16), inside = undamped;
    for (auto& in : undamped) in.eta = 0;
    for (auto& in : inside) in.y = -1.1 * in.clearance_y;
    testing::RunOptions o;
    o.parts = {Law::paper, Damping::point, true, false};
    o.quantities = testing::all_quantities;
    double made = 0;  // by the law, over what was burnt: at most
    for (auto const& [members, end] : {std::pair{undamped, 0.5}, {inside, 0.1}}) {
        for (Method const method : {Method::automatic, Method::dopri5, Method::bs32, Method::rk4}) {
            o.settings.method = method;
            o.settings.rtol = o.settings.atol = 1e-4;
            o.settings.fixed_step = 0.25 * 2 * std::numbers::sqrt2 / Rocking().rate;
            o.settings.end_time = end;
            auto const r = testing::run(best_isa(), o, members);
            EXPECT_EQ(count_of(count_ends(r), Status::unstable), 0) << name_of(method) << " until " << end << " s";
            for (std::size_t i = 0; i < members.size(); ++i) {
                double const burnt = r.value(i, Quantity::friction_loss) + std::abs(r.value(i, Quantity::damping_loss));
                made = std::max(made, r.value(i, Quantity::energy_residual) / burnt);
            }
        }
    }
    EXPECT_GT(made, 0.5) << "the law must be made to show what it does";
}

TEST(AdaptiveMethods, AreNeverAccused) {
    for (Law const law : testing::every_law()) {
        for (Method const method : {Method::automatic, Method::dopri5, Method::bs32}) {
            for (double const tolerance : {1e-3, 1e-6}) {
                for (auto const& [clearance, speed] :
                     {std::pair{1e-4, 3.14}, {5e-4, 47.0}, {1e-4, 0.0}, {5e-3, 500.0}}) {
                    testing::RunOptions o;
                    o.parts = {law, Damping::point, true, false};
                    o.settings.method = method;
                    o.settings.rtol = o.settings.atol = tolerance;
                    o.settings.end_time = 0.02;
                    o.quantities = audit;
                    auto const r = testing::run(best_isa(), o, testing::scattered_starts(16, clearance, speed, law));
                    // Where a coarse tolerance meets the hardest impacts, a member or two do make a fifth of what contact turns over.
                    bool const coarse = method == Method::dopri5 && tolerance == 1e-3 && speed == 500;
                    EXPECT_GE(count_of(count_ends(r), Status::finished), coarse ? 14 : 16)
                        << name_of(method) << " at " << tolerance << ", " << clearance << " m, " << speed << " rad/s";
                }
            }
        }
    }
}

TEST(Scenes, AreNeverAccused) {
    for (auto const& entry : std::filesystem::directory_iterator(SLIDEWAY_SCENES)) {
        if (entry.path().extension() != ".toml") continue;
        bool const spatial = info(read_scene(entry.path().string()).parts.mechanism).spatial;
        for (LawInfo const& law : laws()) {
            if (!spatial && &law != &laws().front()) continue;  // a plane has no faces: one run is that of every law
            for (std::string const method : {"auto", "dopri5"}) {
                Overrides overrides{{"integrator.method", method}};
                if (spatial) overrides.emplace_back("contact.law", law.name);
                Scene const scene = read_scene(entry.path().string(), overrides);
                testing::RunOptions o;
                o.parts = scene.parts;
                o.settings = scene.integrator;
                o.settings.end_time = std::min(o.settings.end_time, 0.05);
                o.quantities = scene.quantities | audit;
                std::vector<Inputs> members;
                for (std::uint64_t i = 0; i < std::min<std::uint64_t>(scene.members, 8); ++i) {
                    members.push_back(member_inputs(scene, i));
                }
                auto const ended = count_ends(testing::run(best_isa(), o, members));
                EXPECT_EQ(count_of(ended, Status::finished), static_cast<int>(members.size()))
                    << entry.path() << " " << law.name << " " << method;
            }
        }
    }
}

}  // namespace
}  // namespace slideway::stability_test
