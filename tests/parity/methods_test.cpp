// Every method gives a member the same bits in every instruction set, block, order and company.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/models/models.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {
namespace {

constexpr Method methods[] = {Method::automatic, Method::dopri5, Method::dop853, Method::bs32, Method::ros34pw2, Method::rk4,
                              Method::verner65};
/// Each kind of mixed_members with and without those that fail, and lanes of eight filled six times.
constexpr std::size_t members_each = 48;
constexpr double tolerance = 1e-4, end_time = 0.01;
std::vector<double> const sample_times = {0, 1e-3, 2.5e-3, 7e-3, 1e-2};

/// Sliders that fly, bounce, lie on the way and fail, on a way of soft rubber or steel: costs differ 1,000-fold.
std::vector<Inputs> mixed_members(std::size_t count) {
    auto members = testing::scattered_starts(count);
    for (std::size_t i = 0; i < count; ++i) {
        auto& in = members[i];
        in.slider_young_modulus = in.way_young_modulus = i % 5 == 1 ? 1e6 : i % 5 == 2 ? 2e11 : 1e9;
        in.chi_line = in.chi_surface = 10;
        in.vy = i % 3 == 0 ? -0.05 : 0;
        if (i % 4 == 2) in.y = -1e-4 - 1e-9, in.z = in.roll = in.yaw = in.pitch = 0;  // lies on the way
        if (i % 16 == 7) in.vz = NAN;
        if (i % 16 == 13) in.y = 1;
    }
    return members;
}

testing::RunOptions options_of(Method method) {
    testing::RunOptions o;
    o.parts = {Law::conservative, Damping::rate, true, false};
    o.settings.method = method;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = end_time;
    o.settings.fixed_step = 4e-6;
    o.settings.max_steps = 6'000;
    o.series = testing::state_selection;
    o.sample_times = sample_times;
    return o;
}

struct Outcome {
    MemberRecord record;
    std::vector<double> numbers;  // final state, quantities, samples
};

Outcome outcome_of(testing::EnsembleResult const& r, std::size_t i, std::size_t count) {
    Outcome outcome{r.records[i], {r.states[i].begin(), r.states[i].end()}};
    auto& numbers = outcome.numbers;
    numbers.insert(numbers.end(), r.quantities[i].begin(), r.quantities[i].end());
    for (std::size_t s = 0; s < state_size; ++s) {
        for (std::size_t k = 0; k < sample_times.size(); ++k) {
            numbers.push_back(r.series[(s * count + i) * sample_times.size() + k]);
        }
    }
    return outcome;
}

/// Members in the given order, cut into blocks, each with its outcome at its own place.
std::vector<Outcome> outcomes(Isa isa, Method method, std::vector<Inputs> const& members,
                              std::vector<std::size_t> const& order, std::size_t block) {
    std::vector<Outcome> all(members.size());
    for (std::size_t first = 0; first < order.size(); first += block) {
        std::size_t const count = std::min(block, order.size() - first);
        std::vector<Inputs> part;
        for (std::size_t i = 0; i < count; ++i) part.push_back(members[order[first + i]]);
        auto const r = testing::run(isa, options_of(method), part);
        for (std::size_t i = 0; i < count; ++i) {
            all[order[first + i]] = outcome_of(r, i, count);
        }
    }
    return all;
}

bool same(Outcome const& a, Outcome const& b) {
    auto const &x = a.record, &y = b.record;
    return x.status == y.status && x.steps_accepted == y.steps_accepted && x.steps_rejected == y.steps_rejected &&
           x.rhs_evaluations == y.rhs_evaluations && x.stiff_steps == y.stiff_steps &&
           x.jacobian_evaluations == y.jacobian_evaluations && x.time == y.time &&
           std::memcmp(a.numbers.data(), b.numbers.data(), a.numbers.size() * sizeof(double)) == 0;
}

/// One block whose members are taken in the given order.
std::vector<Outcome> outcomes_taken(Isa isa, Method method, std::vector<Inputs> const& members,
                                    std::vector<std::uint32_t> const& order) {
    auto o = options_of(method);
    o.order = order;
    auto const r = testing::run(isa, o, members);
    std::vector<Outcome> all(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) all[i] = outcome_of(r, i, members.size());
    return all;
}

std::vector<std::size_t> natural_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i;
    return order;
}

class MethodParity : public ::testing::TestWithParam<Method> {};

TEST_P(MethodParity, BitsDependOnTheMemberAlone) {
    auto const members = mixed_members(members_each);
    auto const forwards = natural_order(members.size());
    std::vector<std::size_t> const backwards(forwards.rbegin(), forwards.rend());
    auto const reference = outcomes(Isa::scalar, GetParam(), members, forwards, 1);
    std::uint64_t finished = 0, stiff = 0;
    for (auto const& outcome : reference) {
        finished += outcome.record.status == Status::finished;
        stiff += outcome.record.stiff_steps > 0;
    }
    EXPECT_GT(finished, members_each * 3 / 8);
    EXPECT_LT(finished, members_each) << "some members must fail";
    EXPECT_EQ(stiff > 0, GetParam() == Method::automatic || GetParam() == Method::ros34pw2);
    for (Isa const isa : testing::supported_isas()) {
        for (std::size_t const block : {std::size_t(1), std::size_t(7), std::size_t(512)}) {
            if (isa == Isa::scalar && block != 512) continue;
            for (auto const& order : {forwards, backwards}) {
                // The same blocks, and a lane that is alone in either order (the next test has another of its members).
                if (order == backwards && (block == 1 || isa == Isa::scalar)) continue;
                auto const got = outcomes(isa, GetParam(), members, order, block);
                for (std::size_t i = 0; i < members.size(); ++i) {
                    EXPECT_TRUE(same(reference[i], got[i])) << name_of(isa) << " member " << i << ", blocks of "
                                                            << block << (order == forwards ? "" : ", reversed");
                }
            }
        }
    }
}

TEST_P(MethodParity, TheOrderInWhichABlockTakesItsMembersChangesNothing) {
    auto const members = mixed_members(members_each);
    auto const count = static_cast<std::uint32_t>(members.size());
    for (Isa const isa : all_isas()) {
        if (!is_supported(isa)) continue;
        auto const reference = outcomes_taken(isa, GetParam(), members, {});
        // As the driver orders them, dearest first; the cheapest first; and as if shuffled: 31 and 48 have no common factor.
        std::vector<std::uint32_t> dearest(count), shuffled(count);
        for (std::uint32_t i = 0; i < count; ++i) dearest[i] = i, shuffled[i] = 31 * i % count;
        std::ranges::stable_sort(dearest, std::greater{}, [&](auto i) { return reference[i].record.rhs_evaluations; });
        std::vector<std::uint32_t> const cheapest(dearest.rbegin(), dearest.rend());
        std::vector<std::vector<std::uint32_t>> orders{shuffled};
        if (lanes_of(isa) > 1) orders.insert(orders.end(), {dearest, cheapest});  // a lane alone has no neighbours
        for (auto const& order : orders) {
            auto const got = outcomes_taken(isa, GetParam(), members, order);
            for (std::size_t i = 0; i < members.size(); ++i) {
                EXPECT_TRUE(same(reference[i], got[i])) << name_of(isa) << " member " << i << ", first " << order[0];
            }
        }
    }
}

TEST_P(MethodParity, ModelsOfOtherKindsHaveOneSetOfBits) {
    std::vector<testing::BallInputs> balls;
    std::vector<testing::TrackerInputs> trackers;
    std::vector<testing::ValveInputs> valves;
    for (int i = 0; i < 23; ++i) {
        balls.push_back({.height = 0.1 + 0.07 * i, .speed = 0.1 * (i % 5), .level = 0.3});
        trackers.push_back(
            {.rate = i % 4 == 0 ? -1.0 : -std::pow(10.0, i / 4), .wall = i % 6 == 1 ? 0.5 : testing::never});
        valves.push_back({.inflow = 0.3 + 0.4 * i});
    }
    auto s = testing::equal_steps(GetParam(), 0.02, 1.0);
    s.rtol = s.atol = s.stiff_tolerance = 1e-5;
    s.max_steps = 5000;
    std::vector<double> const times = {0, 0.1, 0.77, 1};
    auto const expect_same = [&](auto const& members) {
        auto const want = testing::run(Isa::scalar, s, members, times);
        for (Isa const isa : testing::isas_beside_scalar()) {
            auto const got = testing::run(isa, s, members, times);
            for (auto const part :
                 {&testing::ModelResult::states, &testing::ModelResult::quantities, &testing::ModelResult::series}) {
                auto const &a = want.*part, &b = got.*part;
                EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0) << name_of(isa);
            }
            for (std::size_t i = 0; i < members.size(); ++i) {
                EXPECT_EQ(want.records[i].status, got.records[i].status) << i;
                EXPECT_EQ(want.records[i].rhs_evaluations, got.records[i].rhs_evaluations) << i;
            }
        }
    };
    expect_same(balls);
    expect_same(trackers);
    expect_same(valves);
}

INSTANTIATE_TEST_SUITE_P(Methods, MethodParity, ::testing::ValuesIn(methods),
                         [](auto const& p) { return std::string(name_of(p.param)); });

}  // namespace
}  // namespace slideway
