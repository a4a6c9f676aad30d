// Members with shadows, and orbits of maps, have the same bits in every instruction set, block and order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "tests/models/models.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {
namespace {

using testing::Following;
using testing::ModelResult;

double spread(std::size_t i) { return std::fmod(static_cast<double>(i + 1) * 0.6180339887498949, 1.0); }

template <class Inputs> Inputs varied(std::size_t i);

template <> testing::LorenzInputs varied(std::size_t i) {
    testing::LorenzInputs in;
    in.rho = 20 + 10 * spread(i), in.x = i % 13 == 4 ? NAN : 20 * spread(i) - 10;
    return in;
}
template <> testing::TableBallInputs varied(std::size_t i) {
    testing::TableBallInputs in;
    in.amplitude = 4 * spread(i), in.frequency = 2 * std::numbers::pi, in.phase = 0.1 * static_cast<double>(i);
    in.restitution = 0.8 + 0.2 * spread(i + 5), in.height = 0.2 + spread(i), in.thrust = i % 3 == 0 ? 0.2 : 0;
    return in;
}
template <> testing::RigidBallInputs varied(std::size_t i) { return {varied<testing::TableBallInputs>(i)}; }
template <> testing::LogisticInputs varied(std::size_t i) { return {3 + spread(i), spread(i + 3)}; }
template <> testing::HenonInputs varied(std::size_t i) {
    return {1.1 + 0.4 * spread(i), 0.3, i % 7 == 2 ? 50.0 : 0.1, 0};
}

IntegratorSettings settings(Method method) {
    IntegratorSettings s;
    s.method = method;
    s.rtol = s.atol = 1e-8;
    s.max_step = 0.1;
    s.fixed_step = 0x1p-7;
    s.max_steps = 4000;
    return s;
}

template <class Inputs>
ModelResult run_members(Isa isa, Method method, std::vector<Inputs> const& members, Following const& f) {
    if constexpr (requires { testing::run(isa, members, f); })
        return testing::run(isa, members, f);
    else
        return testing::run(isa, settings(method), members, f);
}

/// Everything that member i left, number by number.
template <class Inputs> std::vector<double> numbers_of(ModelResult const& r, Following const& f, std::size_t i) {
    std::vector<double> numbers;
    auto const add = [&](std::vector<double> const& all, std::size_t width) {
        auto const from = all.begin() + static_cast<std::ptrdiff_t>(i * width);
        numbers.insert(numbers.end(), from, from + static_cast<std::ptrdiff_t>(width));
    };
    add(r.states, Inputs::size);
    add(r.sections, f.stops.sections() * Inputs::size);
    add(r.growth, f.stops.growths() * static_cast<std::size_t>(f.shadows));
    if (r.records.empty()) return numbers;
    auto const& record = r.records[i];
    for (auto const count : {record.steps_accepted, record.steps_rejected, record.rhs_evaluations})
        numbers.push_back(static_cast<double>(count));
    numbers.push_back(record.time);
    numbers.push_back(static_cast<double>(record.status));
    return numbers;
}

/// NaNs may differ in sign and payload, which say nothing.
bool same(std::vector<double> const& a, std::vector<double> const& b) {
    return std::ranges::equal(a, b, [](double x, double y) {
        return std::memcmp(&x, &y, sizeof x) == 0 || (std::isnan(x) && std::isnan(y));
    });
}

Following following(std::size_t member_count, int shadows) {
    Following f;
    f.stops = {.count = 21, .transient = 4, .section_every = 2};
    f.shadows = shadows;
    // Times of their own, as of sliders with cranks of their own.
    for (std::size_t i = 0; i < member_count; ++i) {
        double const period = 1 + static_cast<double>(i % 4);
        f.clocks.push_back({21 * period / 2 + 0.25, period / 2, period / 2});
    }
    return f;
}

/// A map's clock is the block's.
template <class Inputs> Following following_of(std::size_t count, int shadows) {
    auto f = following(count, shadows);
    if constexpr (requires { testing::run(Isa::scalar, std::vector<Inputs>{}, f); }) f.clocks = {{0, 3, 2}};
    return f;
}

template <class Inputs> Following part_of(Following const& f, std::vector<std::size_t> const& who) {
    auto part = f;
    if (f.clocks.size() == 1) return part;
    part.clocks.clear();
    for (std::size_t const i : who) part.clocks.push_back(f.clocks[i]);
    return part;
}

template <class Inputs> void expect_one_set_of_bits(Method method) {
    constexpr std::size_t count = 37;
    std::vector<Inputs> members;
    for (std::size_t i = 0; i < count; ++i) members.push_back(varied<Inputs>(i));
    for (int const shadows : {0, 1, 2}) {
        auto const f = following_of<Inputs>(count, std::min<int>(shadows, Inputs::size));
        auto const reference = run_members(Isa::scalar, method, members, f);
        for (Isa const isa : all_isas()) {
            if (!is_supported(isa)) continue;
            for (std::size_t const block : {std::size_t(1), std::size_t(7), count}) {
                for (bool const backwards : {false, true}) {
                    // A member alone has one order; a lane alone has no neighbours, but members before it.
                    if (backwards ? block == 1 : isa == Isa::scalar) continue;
                    if (isa == Isa::scalar && block == count) continue;
                    for (std::size_t first = 0; first < count; first += block) {
                        std::vector<std::size_t> who;
                        for (std::size_t i = first; i < std::min(first + block, count); ++i)
                            who.push_back(backwards ? count - 1 - i : i);
                        std::vector<Inputs> some;
                        for (std::size_t const i : who) some.push_back(members[i]);
                        auto const part = part_of<Inputs>(f, who);
                        auto const got = run_members(isa, method, some, part);
                        for (std::size_t i = 0; i < who.size(); ++i) {
                            EXPECT_TRUE(
                                same(numbers_of<Inputs>(reference, f, who[i]), numbers_of<Inputs>(got, part, i)))
                                << name_of(isa) << " member " << who[i] << ", blocks of " << block << ", " << shadows
                                << " shadows";
                        }
                    }
                }
            }
        }
    }
}

TEST(ShadowParity, OfTheLorenzEquations) {
    for (auto const method : {Method::dopri5, Method::bs32, Method::rk4})
        expect_one_set_of_bits<testing::LorenzInputs>(method);
}

TEST(ShadowParity, OfABallThroughItsImpacts) {
    for (auto const method : {Method::dopri5, Method::bs32}) expect_one_set_of_bits<testing::TableBallInputs>(method);
}

TEST(ShadowParity, OfARigidBallThroughItsImpactsAndItsRest) {
    for (auto const method : {Method::dopri5, Method::verner65}) expect_one_set_of_bits<testing::RigidBallInputs>(method);
}

TEST(ShadowParity, OfMaps) {
    expect_one_set_of_bits<testing::LogisticInputs>(Method::automatic);
    expect_one_set_of_bits<testing::HenonInputs>(Method::automatic);
}

TEST(ShadowParity, TheOrderInWhichABlockTakesItsMembersChangesNothing) {
    constexpr std::uint32_t count = 37;
    std::vector<testing::LorenzInputs> members;
    for (std::size_t i = 0; i < count; ++i) members.push_back(varied<testing::LorenzInputs>(i));
    auto f = following(count, 2);
    for (Isa const isa : all_isas()) {
        if (!is_supported(isa)) continue;
        f.order.clear();
        auto const reference = testing::run(isa, settings(Method::dopri5), members, f);
        for (std::uint32_t i = 0; i < count; ++i)
            f.order.push_back(14 * i % count);  // as if shuffled: 14 and 37 have no common factor
        auto const got = testing::run(isa, settings(Method::dopri5), members, f);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_TRUE(
                same(numbers_of<testing::LorenzInputs>(reference, f, i), numbers_of<testing::LorenzInputs>(got, f, i)))
                << name_of(isa) << i;
        }
    }
}

}  // namespace
}  // namespace slideway
