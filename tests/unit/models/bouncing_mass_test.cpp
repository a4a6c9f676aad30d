// The mass between two springs against its algebra.
#include <gtest/gtest.h>

#include <array>

#include "tests/models/bouncing_mass.hpp"

namespace slideway::bouncing_mass_test {
namespace {

using State = std::array<double, 3>;
using Values = std::array<double, BouncingMass::events>;

BouncingMass::Parameters<double> const parameters = BouncingMass::parameters({.stiffness = 8, .rate = 100});

State rates_at(State const& s) {
    State rates;
    BouncingMass::Report<double> report;
    BouncingMass::derivative<false>(0.0, s.data(), parameters, {}, rates.data(), &report);
    return rates;
}

struct EventValues {
    Values value, slope;
};
EventValues events_at(State const& s) {
    EventValues e;
    BouncingMass::event_values(0.0, s.data(), rates_at(s).data(), parameters, e.value.data(), e.slope.data());
    return e;
}

TEST(BouncingMass, FliesUnderItsWeightAlone) {
    EXPECT_EQ(rates_at({0.5, 3, 0}), (State{300, -100, 0}));
    EXPECT_EQ(rates_at({1.5, 3, 0}), (State{300, -100, 0}));  // a stage of a step may pass an edge
}

TEST(BouncingMass, IsPushedBackByTheFaceThatItTouches) {
    EXPECT_EQ(rates_at({1.25, 3, 1}), (State{300, -300, 0}));
    EXPECT_EQ(rates_at({-1.25, -3, -1}), (State{-300, 100, 0}));
}

TEST(BouncingMass, TouchesAreEventsInFlight) {
    auto const e = events_at({0.75, 3, 0});
    EXPECT_EQ(e.value, (Values{-0.25, -1.75, -1}));
    EXPECT_EQ(e.slope, (Values{300, -300, 0}));
}

TEST(BouncingMass, PartingIsTheEventOfAContact) {
    auto const upper = events_at({1.25, 3, 1}), lower = events_at({-1.25, -3, -1});
    EXPECT_EQ(upper.value, (Values{-1, -1, 0.25}));
    EXPECT_EQ(upper.slope, (Values{0, 0, 300}));
    EXPECT_EQ(lower.value, upper.value);
    EXPECT_EQ(lower.slope, upper.slope);
}

TEST(BouncingMass, EventsSetTheFaceAlone) {
    for (auto const& [event, face] : {std::pair{BouncingMass::upper_touch, 1.0}, {BouncingMass::lower_touch, -1.0}, {BouncingMass::parting, 0.0}}) {
        State s{0.5, 3, 0.25};
        BouncingMass::reset(event, false, s.data(), parameters);
        EXPECT_EQ(s, (State{0.5, 3, 0.25}));
        BouncingMass::reset(event, true, s.data(), parameters);
        EXPECT_EQ(s, (State{0.5, 3, face}));
    }
}

}  // namespace
}  // namespace slideway::bouncing_mass_test
